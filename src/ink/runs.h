// What:   connected pieces of a mask, by runs of its pixels.
// Source: textbook.
// Differs: nothing.
// Cost:   linear in the pixels; memory a run.
#pragma once

#include <cstdint>
#include <vector>

#include "base/raster.h"
#include "base/union_find.h"

namespace inkgrid {

// Pixels first .. last of row y.
struct Run {
  int y, first, last;

  int pixels() const { return last + 1 - first; }
};

// Row by row, all that equal `value`, 0 or 1.
std::vector<Run> runs_of(const Raster<std::uint8_t>& mask, std::uint8_t value);

// Sets of runs that touch; `corners`: over the corners of pixels, too.
UnionFind pieces_of(const std::vector<Run>& runs, bool corners);

}  // namespace inkgrid
