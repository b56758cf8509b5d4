#include "arguments.h"

#include <CLI/CLI.hpp>
#include <array>

#include "inkgrid/inkgrid.h"
#include "options.h"

namespace inkgrid::cli {
namespace {

constexpr std::array kCommandOptions{
    CommandOption{"-o", "--output", "FILE", &Arguments::output,
                  "write the curves to FILE, into FILE if it is a directory, or to standard output if it is -"},
    CommandOption{"", "--mask", "FILE", &Arguments::mask,
                  "an image of the drawing's size: less simplification under purple scribbles, more under orange ones"},
    CommandOption{"", "--report", "FILE", &Arguments::report, "write what was measured, chosen and counted to FILE, as JSON"},
    CommandOption{"", "--stages", "DIR", &Arguments::stages,
                  "draw every stage of the method over the drawing, as PNG files in DIR"},
    CommandOption{"-q", "--quiet", "", &Arguments::quiet, "say nothing of choices and warnings, only errors"},
    CommandOption{"-h", "--help", "", &Arguments::help, "print this help and exit"},
    CommandOption{"", "--version", "", &Arguments::version, "print the version and exit"},
    CommandOption{"", "--man", "", &Arguments::man, "print the manual page (roff) and exit"},
};

void add_command_option(CLI::App& app, Arguments& arguments, const CommandOption& option) {
  const std::string names = (option.letter.empty() ? "" : std::string(option.letter) + ",") + std::string(option.name);
  if (const auto* text = std::get_if<std::string Arguments::*>(&option.member))
    app.add_option(names, arguments.**text);
  else
    app.add_flag(names, arguments.*std::get<bool Arguments::*>(option.member));
}

}  // namespace

std::span<const CommandOption> command_options() {
  return kCommandOptions;
}

Arguments parse_arguments(int count, const char* const* words) {
  Arguments arguments;
  CLI::App app;
  app.set_help_flag();  // help and manual are both made from the tables
  app.add_option("DRAWING", arguments.drawings);
  for (const CommandOption& option : kCommandOptions) add_command_option(app, arguments, option);
  for (const OptionRow& row : option_table())
    app.add_option_function<std::string>("--" + std::string(row.name),
                                         [&](const std::string& text) { set_option(arguments.options, row, text); });
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::usage, std::string(error.what()) + " (see inkgrid --help)");
  }
  return arguments;
}

}  // namespace inkgrid::cli
