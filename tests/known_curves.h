// Curves as lines of points, and how far they are from those that were drawn.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/cubic.h"
#include "drawings.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid::testing {

constexpr double kDegree = std::numbers::pi / 180;

inline Vec2 polar(double radius, double angle) {
  return radius * Vec2{std::cos(angle), std::sin(angle)};
}

using Line = std::vector<Vec2>;

inline Line points_of(const Curve& curve) {
  Line points;
  for (const Cubic& c : curve.segments)
    for (int k = 0; k < 24; ++k) points.push_back(point_on(c, k / 24.0));
  points.push_back(curve.segments.back().p3);
  return points;
}

inline std::vector<Line> lines_of(const Drawing& drawing) {
  std::vector<Line> lines;
  for (const Curve& curve : drawing.curves) lines.push_back(points_of(curve));
  return lines;
}

// With points at most a pixel apart.
inline Line dense(const Line& line) {
  Line points;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const int steps = 1 + static_cast<int>(norm(line[i + 1] - line[i]));
    for (int k = 0; k <= steps; ++k) points.push_back(lerp(line[i], line[i + 1], static_cast<double>(k) / steps));
  }
  return points;
}

inline double distance(Vec2 p, const std::vector<Line>& lines) {
  double least = std::numeric_limits<double>::infinity();
  for (const Line& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i) least = std::min(least, distance_to_segment(p, line[i], line[i + 1]));
  return least;
}

// One-sided Hausdorff distance.
inline double farthest(const std::vector<Line>& from, const std::vector<Line>& to) {
  double most = 0;
  for (const Line& line : from)
    for (const Vec2 p : dense(line)) most = std::max(most, distance(p, to));
  return most;
}

// The larger of the two one-sided ones.
inline double distance_between(const std::vector<Line>& a, const std::vector<Line>& b) {
  return std::max(farthest(a, b), farthest(b, a));
}

inline Image painted(const std::vector<Line>& lines, double pen, int width, int height, double grey = 0) {
  Image image = blank(width, height);
  for (const Line& line : lines) paint(image, line, pen, grey);
  return image;
}

inline Drawing traced(const Image& image, Preset preset = Preset::automatic) {
  Options options;
  options.preset = preset;
  return vectorize(image, options).drawing;
}

inline int free_ends(const Drawing& drawing) {
  int ends = 0;
  for (const Curve& curve : drawing.curves)
    if (!curve.closed) ends += (curve.start_junction < 0) + (curve.end_junction < 0);
  return ends;
}

}  // namespace inkgrid::testing
