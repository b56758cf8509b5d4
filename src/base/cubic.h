// One cubic Bezier segment: its points, its derivatives, its parts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "inkgrid/drawing.h"

namespace inkgrid {

inline std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

inline Vec2 point_on(const Cubic& c, double t) {
  const auto b = bernstein(t);
  return b[0] * c.p0 + b[1] * c.p1 + b[2] * c.p2 + b[3] * c.p3;
}

inline Vec2 velocity_on(const Cubic& c, double t) {
  const double s = 1 - t;
  return 3 * (s * s * (c.p1 - c.p0) + 2 * s * t * (c.p2 - c.p1) + t * t * (c.p3 - c.p2));
}

inline Vec2 acceleration_on(const Cubic& c, double t) {
  return 6 * ((1 - t) * (c.p2 - 2 * c.p1 + c.p0) + t * (c.p3 - 2 * c.p2 + c.p1));
}

inline Cubic reversed(const Cubic& c) {
  return {c.p3, c.p2, c.p1, c.p0};
}

// The parts before and after t, which meet to the last digit.
inline std::pair<Cubic, Cubic> cut(const Cubic& c, double t) {
  const Vec2 a = lerp(c.p0, c.p1, t), b = lerp(c.p1, c.p2, t), d = lerp(c.p2, c.p3, t);
  const Vec2 ab = lerp(a, b, t), bd = lerp(b, d, t), middle = lerp(ab, bd, t);
  return {{c.p0, a, ab, middle}, {middle, bd, d, c.p3}};
}

// Equal steps of t whose chords stay within `tolerance` of the segment: |B''| h^2 / 8, and B'' is largest at an end.
inline int chords_within(const Cubic& c, double tolerance) {
  const double bend = std::max(norm(acceleration_on(c, 0)), norm(acceleration_on(c, 1)));
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(bend / (8 * tolerance)))));
}

}  // namespace inkgrid
