#include "arguments.h"

#include <CLI/CLI.hpp>
#include <array>

#include "base/overloaded.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid::cli {
namespace {

constexpr std::array kCommandOptions{
    CommandOption{"-o", "--output", "FILE", &Arguments::outputs,
                  "write the curves to FILE, into FILE if it is a directory, or to standard output if it is -; may be given "
                  "several times"},
    CommandOption{"", "--format", "NAME", &Arguments::format,
                  "the format of what is written, whatever the extension of FILE says"},
    CommandOption{
        "", "--project", "FILE", &Arguments::project,
        "take drawing, mask, scribbles, options and hand edits from FILE; what else is given comes before what it holds"},
    CommandOption{"", "--save-project", "FILE", &Arguments::save_project,
                  "write drawing, mask, options and what else there is to FILE, to go on from there"},
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

// An empty name is mostly a variable of a script that was never set; taken as not given, it would write somewhere else.
std::string refuse_empty(const std::string& value) {
  return value.empty() ? "a name is missing" : "";
}

void add_command_option(CLI::App& app, Arguments& arguments, const CommandOption& option) {
  const std::string names = (option.letter.empty() ? "" : std::string(option.letter) + ",") + std::string(option.name);
  std::visit(Overloaded{[&](std::string Arguments::*m) { app.add_option(names, arguments.*m)->check(refuse_empty); },
                        [&](std::vector<std::string> Arguments::*m) {
                          app.add_option(names, arguments.*m)->allow_extra_args(false)->check(refuse_empty);
                        },
                        [&](bool Arguments::*m) { app.add_flag(names, arguments.*m); }},
             option.member);
}

}  // namespace

std::span<const CommandOption> command_options() {
  return kCommandOptions;
}

void apply_given(const Arguments& arguments, Options& options) {
  for (const auto& [row, text] : arguments.given) set_option(options, *row, text);
}

Arguments parse_arguments(int count, const char* const* words) {
  Arguments arguments;
  CLI::App app;
  app.set_help_flag();  // help and manual are both made from the tables
  app.add_option("DRAWING", arguments.drawings);
  for (const CommandOption& option : kCommandOptions) add_command_option(app, arguments, option);
  for (const OptionRow& row : option_table())
    app.add_option_function<std::string>("--" + std::string(row.name), [&](const std::string& text) {
      Options checked;
      set_option(checked, row, text);
      arguments.given.emplace_back(&row, text);
    });
  for (const ExportOptionRow& row : export_option_table())
    app.add_option_function<std::string>("--" + std::string(row.name),
                                         [&](const std::string& text) { set_option(arguments.export_options, row, text); });
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::usage, std::string(error.what()) + " (see inkgrid --help)");
  }
  if (!arguments.format.empty()) export_format(arguments.format);
  return arguments;
}

}  // namespace inkgrid::cli
