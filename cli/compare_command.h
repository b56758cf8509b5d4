// What:   `inkgrid compare`: how near the curves of one SVG file are to those of another.
// Cost:   reading two files and comparing them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "inkgrid/compare.h"

namespace inkgrid::cli {

constexpr std::string_view kCompareCommand = "compare";

struct CompareArguments {
  std::string result;  // "-" is standard input
  std::string truth;
  bool json = false;
  bool help = false;
  CompareOptions options;
};

struct CompareOption {
  std::string_view letter;  // "-h", or empty
  std::string_view name;    // "--help"
  std::string_view value;   // "PX", or empty for a switch
  std::variant<bool CompareArguments::*, std::optional<double> CompareOptions::*, double CompareOptions::*> member;
  std::string_view help;  // one line, no full stop
};

std::span<const CompareOption> compare_options();

// The words after `inkgrid`, of which the first is the command.  Throws Error{usage} and Error{file}.
void run_compare(int count, const char* const* words);

}  // namespace inkgrid::cli
