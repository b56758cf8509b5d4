// What:   the command line of the program: what it may hold, and what it did.
// Cost:   none.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "export/export.h"
#include "inkgrid/options.h"
#include "options.h"

namespace inkgrid::cli {

struct Arguments {
  std::vector<std::string> drawings;  // "-" is standard input
  std::string project;                // the same; instead of a drawing
  std::vector<std::string> outputs;   // each a file, a directory, or "-" for standard output; none: beside the drawing
  std::string format;                 // of ExportFormat, or empty: by the extension of each output
  std::string save_project;
  std::string mask;
  std::string report;
  std::string stages;
  bool quiet = false;
  bool help = false;
  bool version = false;
  bool man = false;
  std::vector<std::pair<const OptionRow*, std::string>> given;  // parameters of the method and their values, in order
  ExportOptions export_options;
};

// An option of the program that is no parameter of the method or of a format (option_table(), export_option_table()).
struct CommandOption {
  std::string_view letter;  // "-o", or empty
  std::string_view name;    // "--output"
  std::string_view value;   // "FILE", or empty for a switch
  std::variant<std::string Arguments::*, std::vector<std::string> Arguments::*, bool Arguments::*> member;
  std::string_view help;  // one line, no full stop
};

std::span<const CommandOption> command_options();

// Sets what was given, and leaves the rest.
void apply_given(const Arguments& arguments, Options& options);

// Throws Error{usage}.
Arguments parse_arguments(int count, const char* const* words);

}  // namespace inkgrid::cli
