// What:   curves as points at equal steps along them, with tangents and the length that each point stands for.
// Source: own.
// Cost:   two points a pixel of length.
#pragma once

#include <string>
#include <vector>

#include "compare/point_tree.h"
#include "compare/svg_document.h"

namespace inkgrid {

constexpr double kSampleStep = 0.5;  // px

struct CurveSamples {
  std::vector<Vec2> points;
  std::vector<double> angles;   // rad, 0 to pi: of the tangent, whichever way it points
  std::vector<double> weights;  // px of curve
  std::vector<int> curves;      // index into the three below; ascending

  std::vector<std::vector<Vec2>> polylines;  // no two points in a row are the same
  std::vector<bool> closed;
  std::vector<bool> overdrawn;

  PointTree tree;     // of the points
  double length = 0;  // px, of all curves

  int size() const { return static_cast<int>(points.size()); }
};

// Curves without length are left out.  `name` is for the message of Error{file}, thrown where there are more than 8 million.
CurveSamples sample_curves(const std::vector<SvgCurve>& curves, const std::string& name);

}  // namespace inkgrid
