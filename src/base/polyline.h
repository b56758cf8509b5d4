// Small helpers on point sequences.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "inkgrid/vec2.h"

namespace inkgrid {

// Length along the path up to each of its points; one 0 for a single point.
std::vector<double> lengths_along(const std::vector<Vec2>& path);

// The point at length s along the path, clamped to its ends.
Vec2 point_at(const std::vector<Vec2>& path, const std::vector<double>& lengths, double s);

// Points at equal steps of about `step`, both ends kept to the last digit; at least two points.
std::vector<Vec2> resampled(const std::vector<Vec2>& path, double step);

// Unit tangent at point k from the points within `span` of it on either side (by index); closed paths wrap (front == back).
Vec2 tangent_at(const std::vector<Vec2>& path, int k, int span, bool closed);

// Parameters, 0..1, of the place where the segments a-b and c-d cross; their second ends are not counted, so that of a path each
// point counts once.  Parallel ones do not cross.
std::optional<std::pair<double, double>> crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

// Where on the segment a-b, 0..1, the point nearest to p lies; 0 on one of no length.
double nearest_parameter(Vec2 p, Vec2 a, Vec2 b);

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b);

}  // namespace inkgrid
