// What:   the command line of the program: what it may hold, and what it did.
// Cost:   none.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "inkgrid/options.h"

namespace inkgrid::cli {

struct Arguments {
  std::vector<std::string> drawings;  // "-" is standard input
  std::string output;                 // file, directory, "-" for standard output, or empty: beside the drawing
  std::string mask;
  std::string report;
  std::string stages;
  bool quiet = false;
  bool help = false;
  bool version = false;
  bool man = false;
  Options options;
};

// An option of the program that is no parameter of the method (those are in option_table()).
struct CommandOption {
  std::string_view letter;  // "-o", or empty
  std::string_view name;    // "--output"
  std::string_view value;   // "FILE", or empty for a switch
  std::variant<std::string Arguments::*, bool Arguments::*> member;
  std::string_view help;  // one line, no full stop
};

std::span<const CommandOption> command_options();

// Throws Error{usage}.
Arguments parse_arguments(int count, const char* const* words);

}  // namespace inkgrid::cli
