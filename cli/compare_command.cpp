#include "compare_command.h"

#include <CLI/CLI.hpp>
#include <array>

#include "compare/comparison_text.h"
#include "files.h"
#include "images/image_io.h"
#include "inkgrid/inkgrid.h"
#include "manual.h"

namespace inkgrid::cli {
namespace {

constexpr std::array kOptions{
    CompareOption{"", "--json", "", &CompareArguments::json, "write all measures as JSON"},
    CompareOption{"", "--tolerance", "PX", &CompareOptions::tolerance,
                  "how near is near enough, in pixels; without it, from the pen and the kind of drawing that TRUTH names"},
    CompareOption{"", "--tolerance-pens", "NUMBER", &CompareOptions::tolerance_pens,
                  "the same in pen widths, but at least 1.5 px"},
    CompareOption{"", "--distance", "NUMBER", &CompareOptions::distance,
                  "how near is near enough for the benchmark's F-score, in thousandths of the longer side"},
    CompareOption{"-h", "--help", "", &CompareArguments::help, "print this help and exit"},
};

void add_option(CLI::App& app, CompareArguments& arguments, const CompareOption& option) {
  const std::string names = (option.letter.empty() ? "" : std::string(option.letter) + ",") + std::string(option.name);
  if (const auto* flag = std::get_if<bool CompareArguments::*>(&option.member))
    app.add_flag(names, arguments.**flag);
  else if (const auto* number = std::get_if<double CompareOptions::*>(&option.member))
    app.add_option(names, arguments.options.**number);
  else
    app.add_option(names, arguments.options.*std::get<std::optional<double> CompareOptions::*>(option.member));
}

CompareArguments parse(int count, const char* const* words) {
  CompareArguments arguments;
  CLI::App app;
  app.set_help_flag();  // made from the table
  app.add_option("RESULT", arguments.result);
  app.add_option("TRUTH", arguments.truth);
  for (const CompareOption& option : kOptions) add_option(app, arguments, option);
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::usage, std::string(error.what()) + " (see inkgrid compare --help)");
  }
  if (!arguments.help && arguments.truth.empty())
    throw Error(ErrorCode::usage, "two SVG files are compared, a result and a truth (see inkgrid compare --help)");
  if (arguments.result == "-" && arguments.truth == "-")
    throw Error(ErrorCode::usage, "the result and the truth can't both come from standard input");
  return arguments;
}

SvgText read_text(const std::string& path) {
  return {path == "-" ? "standard input" : path, read_bytes(path)};
}

}  // namespace

std::span<const CompareOption> compare_options() {
  return kOptions;
}

void run_compare(int count, const char* const* words) {
  const CompareArguments arguments = parse(count, words);
  if (arguments.help) return write_file("-", compare_help_text());
  const Comparison comparison = compare_svg(read_text(arguments.result), read_text(arguments.truth), arguments.options);
  write_file("-", arguments.json ? comparison_json(comparison) : comparison_text(comparison));
}

}  // namespace inkgrid::cli
