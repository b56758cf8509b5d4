// What:   the command line of `inkgrid studio`.
// Source: ours.
// Differs: nothing.
// Cost:   none.
#pragma once

#include <string>

namespace inkgrid::studio {

struct Arguments {
  std::string file;  // a drawing or a project; empty: none
  std::string host = "127.0.0.1";
  int port = 0;  // 0: any free one
  bool browser = true;
  bool help = false;
};

// `words` begins with "studio".  Throws Error{usage}.
Arguments parse_arguments(int count, const char* const* words);

std::string help_text();

}  // namespace inkgrid::studio
