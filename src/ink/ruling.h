// What:   the lines of ruled and squared paper, paler than the drawing on it.
// Source: ours (docs/METHOD.md, "Threshold").
// Differs: nothing.
// Cost:   a pass over the pixels for rows and one for columns.
#pragma once

#include "base/raster.h"

namespace inkgrid {

// How dark the lines are that rule a page, in rows or columns; 0 where none do.
struct Ruling {
  double usual = 0;
  double most = 0;  // of nearly all pixels
};

// `weak`: darkness above which there is more than paper.
Ruling ruling_of(const Raster<float>& darkness, double weak);

}  // namespace inkgrid
