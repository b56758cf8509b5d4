#include "arrival.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace inkgrid {
namespace {

constexpr double kLongest = 4;      // strokes of which the line is told
constexpr double kShrink = 0.7;     // of the length that no parabola explained
constexpr double kBent = 0.35;      // strokes: beside what is not confirmed the ridge is bent by it
constexpr double kStraight = 0.02;  // strokes: lesser sagittas are straight
constexpr double kNoise = 0.1;      // px, of points from a parabola
constexpr double kUnsure = 6;       // strokes that may have paper on one side only, as beside the other arm of a fork
constexpr double kParallel = 0.05;  // sine

struct Sample {
  double x, y, weight;
};

// Least squares of y = c0 + c1 x + c2 x^2, or without the last term.
std::array<double, 3> fitted_parabola(const std::vector<Sample>& samples, bool straight) {
  std::array<double, 5> power{};
  std::array<double, 3> right{};
  for (const auto& s : samples) {
    double x = s.weight;
    for (std::size_t k = 0; k < 5; ++k, x *= s.x) {
      power[k] += x;
      if (k < 3) right[k] += x * s.y;
    }
  }
  const double line = power[0] * power[2] - power[1] * power[1];
  if (straight)
    return {(power[2] * right[0] - power[1] * right[1]) / line, (power[0] * right[1] - power[1] * right[0]) / line, 0};
  const double a = power[2] * power[4] - power[3] * power[3], b = power[2] * power[3] - power[1] * power[4],
               c = power[1] * power[3] - power[2] * power[2], d = power[0] * power[4] - power[2] * power[2],
               e = power[1] * power[2] - power[0] * power[3];
  const double whole = power[0] * a + power[1] * b + power[2] * c;
  return {(a * right[0] + b * right[1] + c * right[2]) / whole, (b * right[0] + d * right[1] + e * right[2]) / whole,
          (c * right[0] + e * right[1] + line * right[2]) / whole};
}

double spread_about(const std::vector<Sample>& samples, const std::array<double, 3>& curve) {
  double sum = 0, weight = 0;
  for (const auto& s : samples) {
    const double off = s.y - curve[0] - s.x * (curve[1] + s.x * curve[2]);
    sum += s.weight * off * off;
    weight += s.weight;
  }
  return std::sqrt(sum / weight);
}

// Coordinates along `axis` from `origin`, of the confirmed points.
std::vector<Sample> samples_of(const RidgeChain& ridge, int k, int far, int step, Vec2 origin, Vec2 axis) {
  std::vector<Sample> samples;
  for (int i = k; i != far + step; i += step) {
    const auto at = static_cast<std::size_t>(i);
    const Vec2 p = ridge.chain.points[at] - origin;
    if (ridge.sections[at].weight > 0) samples.push_back({dot(p, axis), cross(axis, p), ridge.sections[at].weight});
  }
  return samples;
}

}  // namespace

Arrival arrival_from(const RidgeChain& ridge, int first, bool forward) {
  const auto& points = ridge.chain.points;
  const int n = static_cast<int>(points.size()), step = forward ? 1 : -1;
  const auto at = [&](int k) { return points[static_cast<std::size_t>(k)]; };
  const auto inside = [&](int k) { return k >= 0 && k < n; };
  const double width = std::max(2.0, ridge.chain.width);
  const auto weight = [&](int k) { return ridge.sections[static_cast<std::size_t>(k)].weight; };
  int k = first;
  while (inside(k) && weight(k) <= 0) k += step;
  int sure = k;
  while (inside(sure) && weight(sure) < 1 && norm(at(sure) - at(k)) < kUnsure * width) sure += step;
  if (inside(sure + 2 * step) && weight(sure) == 1) k = sure;
  if (!inside(k + 2 * step)) return {};
  const auto within = [&](int from, double span) {
    int far = from + step;
    while (inside(far + step) && norm(at(far) - at(from)) < span) far += step;
    return far;
  };
  const int last = k, bent = within(k, kBent * width), from = inside(bent + 2 * step) ? bent : k;
  Arrival arrival{true, at(last), {}, std::abs(last - first)};
  for (double span = kLongest * width;; span *= kShrink) {
    const bool shortest = span <= width;
    const int far = within(from, std::max(span, width));
    const Vec2 axis = unit(at(last) - at(far));
    arrival.direction = axis;
    const auto samples = samples_of(ridge, from, far, step, at(last), axis);
    if (samples.size() < 5) return arrival;
    const double length = samples.front().x - samples.back().x;
    auto curve = fitted_parabola(samples, false);
    if (!shortest && spread_about(samples, curve) > kStraight * width + kNoise) continue;
    if (shortest || std::abs(curve[2]) * length * length / 4 < kStraight * width + kNoise) curve = fitted_parabola(samples, true);
    arrival.point += curve[0] * quarter_turn(axis);
    arrival.direction = unit(axis + curve[1] * quarter_turn(axis));
    return arrival;
  }
}

Arrival arrival_at(const RidgeChain& ridge, bool at_start) {
  return arrival_from(ridge, at_start ? 0 : static_cast<int>(ridge.chain.points.size()) - 1, at_start);
}

std::optional<Vec2> meeting_of(const Arrival& a, const Arrival& b, double passed) {
  const double sine = cross(a.direction, b.direction);
  if (!a.known || !b.known || std::abs(sine) < kParallel) return std::nullopt;
  const double ahead = cross(b.point - a.point, b.direction) / sine, ahead_b = cross(b.point - a.point, a.direction) / sine;
  if (std::min(ahead, ahead_b) < -passed) return std::nullopt;
  return a.point + ahead * a.direction;
}

}  // namespace inkgrid
