// What:   help and manual page, both made from the tables of options.
// Cost:   none.
#pragma once

#include <string>

namespace inkgrid::cli {

// For a terminal of 80 columns or more.
std::string help_text();
std::string compare_help_text();

// inkgrid.1, in the man macros of roff.
std::string manual_page();

}  // namespace inkgrid::cli
