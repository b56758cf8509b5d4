// What:   points along a polyline, dense enough to fit to, and its corners.
// Source: section 6.3, "Curve fitting" (preparation).
// Differs: the paper fits through corners; here they split the chain and are sharpened (docs/METHOD.md, "Curve fitting").
// Cost:   linear in the length of the polyline.
#pragma once

#include <span>
#include <vector>

#include "fit/fit.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

// A polyline with its arc length; closed: the last point is the first.
struct Samples {
  std::vector<Vec2> points;
  std::vector<double> arc;  // px from the first point, strictly increasing
  bool closed = false;
};

// The finite points of the polyline without repetitions, and points between them where they are further apart than `spacing`.
Samples sample_polyline(std::span<const Vec2> polyline, bool closed, double spacing);

struct Corner {
  Vec2 point;          // where the two sides meet, or the polyline's sharpest point
  double arc = 0;      // px: the place of the corner along the polyline
  double rounded = 0;  // px to either side along which the polyline cuts the corner
};

// Turns of more than about 38 degrees within `span` px that stand out from the curvature around them and are no arcs of the ink,
// in order along the polyline.
std::vector<Corner> find_corners(const Samples& samples, double span, const InkDepth& depth);

}  // namespace inkgrid
