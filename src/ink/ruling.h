// What:   the lines of ruled and squared paper, paler than the drawing on it.
// Source: ours (docs/METHOD.md, "Threshold").
// Differs: nothing.
// Cost:   a pass over the pixels for rows and one for columns.
#pragma once

#include "base/raster.h"

namespace inkgrid {

// The darkness of what rules the page, in rows or columns, of which little is darker; 0 where nothing does.  `weak`: darkness
// above which there is more than paper.
double ruling_of(const Raster<float>& darkness, double weak);

}  // namespace inkgrid
