// What:   the outlines of filled areas.
// Source: ours (docs/METHOD.md, "Fills"); the paper has strokes only.
// Cost:   linear in the areas' bounding boxes.
#pragma once

#include "ink/fills.h"

namespace inkgrid {

// Fills in the outlines: where the darkness falls to half of what it is inside, but for the strokes that lead into a fill; these
// are cut off.  Holes much smaller than a stroke is wide are filled.
void trace_outlines(Fills& fills, const Binarisation& ink);

}  // namespace inkgrid
