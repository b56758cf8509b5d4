// What:   the outlines of filled areas as closed curves.
// Source: section 6.3, "Curve fitting"; fills are ours (docs/METHOD.md, "Fills").
// Cost:   that of the fit.
#pragma once

#include <vector>

#include "ink/fills.h"
#include "inkgrid/drawing.h"

namespace inkgrid {

// The outlines as closed curves; `tolerance` as that of other curves, but of four pixels, not of a stroke.  `pixel`: the side of
// a pixel of the fills in the drawing, px.
std::vector<Fill> fit_outlines(const Fills& fills, double tolerance, double pixel = 1);

}  // namespace inkgrid
