// What:   the outlines of filled areas.
// Source: section 6.3 for the fit; fills are ours (docs/METHOD.md, "Fills").
// Cost:   linear in the areas' bounding boxes, and that of the fit.
#pragma once

#include <vector>

#include "fills.h"
#include "inkgrid/drawing.h"

namespace inkgrid {

// Fills in the outlines: where the darkness falls to half of what it is inside, but for the strokes that lead into a fill; these
// are cut off.  Holes much smaller than a stroke is wide are filled.
void trace_outlines(Fills& fills, const Binarisation& ink);

// The outlines as closed curves; `tolerance` as that of other curves, but of four pixels, not of a stroke.
std::vector<Fill> fit_outlines(const Fills& fills, double tolerance);

}  // namespace inkgrid
