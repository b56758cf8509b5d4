// Lines of points to fit curves to: smooth ones, cornered ones, noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/cubic.h"
#include "drawings.h"

namespace inkgrid::testing {

using Line = std::vector<Vec2>;
using std::numbers::pi;

// Points of a polygon at steps of about `step`, its vertices among them.
inline Line dense(const Line& vertices, double step = 1) {
  Line line{vertices.front()};
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const int pieces = std::max(1, static_cast<int>(norm(vertices[i] - vertices[i - 1]) / step));
    for (int k = 1; k <= pieces; ++k) line.push_back(lerp(vertices[i - 1], vertices[i], static_cast<double>(k) / pieces));
  }
  return line;
}

inline Line dense_arc(Vec2 centre, double radius, double from, double to) {
  return testing::arc(centre, radius, from, to, std::max(8, static_cast<int>(radius * std::abs(to - from))));
}

inline Line full_circle(Vec2 centre, double radius) {
  Line line = dense_arc(centre, radius, 0.3, 0.3 + 2 * pi);
  line.back() = line.front();
  return line;
}

inline Line joined(const std::vector<Line>& parts) {
  Line line;
  for (const Line& part : parts)
    for (const Vec2 p : part)
      if (line.empty() || norm(p - line.back()) > 1e-9) line.push_back(p);
  return line;
}

inline Line rounded_rectangle(double w, double h, double r) {
  Line line = joined({dense({{r, 0}, {w - r, 0}}), dense_arc({w - r, r}, r, -pi / 2, 0), dense({{w, r}, {w, h - r}}),
                      dense_arc({w - r, h - r}, r, 0, pi / 2), dense({{w - r, h}, {r, h}}), dense_arc({r, h - r}, r, pi / 2, pi),
                      dense({{0, h - r}, {0, r}}), dense_arc({r, r}, r, pi, 1.5 * pi)});
  line.back() = line.front();
  return line;
}

inline Line star_vertices(int points, double outer, double inner) {
  Line vertices;
  for (int i = 0; i <= 2 * points; ++i) {
    const double angle = pi * (i % (2 * points)) / points + 0.3;
    vertices.push_back((i % 2 ? inner : outer) * Vec2{std::cos(angle), std::sin(angle)});
  }
  return vertices;
}

inline Line ellipse(double a, double b) {
  Line line;
  for (int i = 0; i <= 400; ++i) line.push_back({a * std::cos(2 * pi * i / 400), b * std::sin(2 * pi * i / 400)});
  line.back() = line.front();
  return line;
}

// A cubic polynomial wave: one inflection.
inline Line s_curve() {
  const Cubic c{{0, 0}, {120, 10}, {30, 140}, {150, 150}};
  Line line;
  for (int i = 0; i <= 250; ++i) line.push_back(point_on(c, i / 250.0));
  return line;
}

// A curve of random, slowly changing curvature of radius 17 at least.
inline Line smooth_walk(unsigned seed, int steps) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Line line;
  Vec2 p{300, 300};
  double angle = 0, curvature = 0;
  for (int i = 0; i < steps; ++i) {
    line.push_back(p);
    curvature = std::clamp(0.97 * curvature + 0.004 * normal(random), -0.06, 0.06);
    angle += curvature;
    p += Vec2{std::cos(angle), std::sin(angle)};
  }
  return line;
}

inline Line noisy(Line line, bool closed, unsigned seed, double amplitude = 0.25) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  for (Vec2& p : line) p += Vec2{shift(random), shift(random)};
  if (closed) line.back() = line.front();
  return line;
}

inline Line mapped(Line line, Vec2 rotation, Vec2 shift) {
  for (Vec2& p : line) p = rotation * p + shift;
  return line;
}

}  // namespace inkgrid::testing
