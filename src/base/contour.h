// What:   the lines along which a raster takes a value.
// Source: textbook (marching squares).
// Differs: lines close along the border of the raster, where values above the level end.
// Cost:   linear in the pixels.
#pragma once

#include <vector>

#include "base/raster.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

// Closed polylines (front == back), linear between pixel centres, in the order of their first pixels; higher values lie on the
// same side of all.
std::vector<std::vector<Vec2>> contours_at(const Raster<float>& values, float level);

// Positive where the line runs from the x axis towards the y axis around what it encloses; px^2.
double enclosed_area(const std::vector<Vec2>& closed_line);

}  // namespace inkgrid
