// What:   sharp corners whose tip the grid reached with one side alone.
// Source: ours; an isoline cannot turn by more than a quarter, so that the sides of an acute corner join below its tip
// (section 6.3). Differs: docs/METHOD.md, "Corners". Cost:   linear in the number of junctions.
#pragma once

#include <vector>

#include "ridge.h"

namespace inkgrid {

// A short chain that ends freely, at a junction of it and two others alone, is dropped where the lines along which the others
// arrive meet within `near` px of its free end and which it goes on: it was the tip of a corner.  `longest` px is what counts as
// short.  The junctions keep their places; locate_junctions puts the corner where its sides meet.
std::vector<RidgeChain> open_corners(std::vector<RidgeChain> ridges, int junctions, double longest, double near);

}  // namespace inkgrid
