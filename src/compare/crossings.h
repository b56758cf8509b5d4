// What:   the points where polylines cross or touch each other or themselves.
// Source: own; a grid of cells finds the pieces that may meet.
// Cost:   pieces of up to 8 px; pairs that share a cell.
#pragma once

#include <vector>

#include "inkgrid/vec2.h"

namespace inkgrid {

// Whether its ends are all but one point.
bool is_closed(const std::vector<Vec2>& polyline);

// Thinned to steps of about 1.5 px; ends, corners and short polylines are kept.
std::vector<Vec2> thinned(const std::vector<Vec2>& polyline);

// Neighbouring pieces of one polyline are not compared; parallel ones have no crossing.  Throws Error{file} where there
// are more than some millions.
std::vector<Vec2> crossings(const std::vector<std::vector<Vec2>>& polylines);

}  // namespace inkgrid
