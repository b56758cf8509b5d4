// How values that tests run over are named in lists and failures.
#pragma once

#include <ostream>

#include "options.h"

namespace inkgrid {

inline void PrintTo(const OptionRow& row, std::ostream* out) {
  *out << row.name;
}

}  // namespace inkgrid
