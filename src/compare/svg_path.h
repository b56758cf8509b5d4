// What:   path data and basic shapes as lines, quadratic and cubic Bezier segments.
// Source: SVG 1.1, sections 8.3 (path data, all commands), 9 (shapes), F.6 (arcs).
// Differs: arcs become cubics of at most a quarter turn, 0.03 % of the radius off at most.
// Cost:   one pass over the text.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "base/at.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

struct PathSegment {
  std::array<Vec2, 4> points;  // degree + 1 of them count
  int degree = 1;              // 1: line, 2: quadratic, 3: cubic

  Vec2 front() const { return points[0]; }
  Vec2 back() const { return points[at(degree)]; }
};

using SubPath = std::vector<PathSegment>;  // each begins where the one before ends; never empty

struct PathData {
  std::vector<SubPath> sub_paths;
  bool complete = true;  // false: an error in the data, which counts up to there, as SVG asks
};

PathData parse_path(std::string_view text);

// None or one sub-path each.
std::vector<SubPath> line_path(Vec2 a, Vec2 b);
std::vector<SubPath> polyline_path(const std::vector<double>& coordinates, bool closed);
std::vector<SubPath> ellipse_path(Vec2 centre, Vec2 radii);
std::vector<SubPath> rectangle_path(Vec2 corner, Vec2 size, Vec2 radii);

}  // namespace inkgrid
