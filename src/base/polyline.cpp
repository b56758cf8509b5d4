#include "base/polyline.h"

#include <algorithm>
#include <cmath>

namespace inkgrid {
namespace {

constexpr double kParallel = 1e-6;  // sine of an angle below which a crossing has no place

// Of a place on segment i, which lies between its ends.
Vec2 point_between(const std::vector<Vec2>& path, const std::vector<double>& lengths, std::size_t i, double s) {
  const double step = lengths[i] - lengths[i - 1];
  return step > 0 ? lerp(path[i - 1], path[i], (s - lengths[i - 1]) / step) : path[i];
}

}  // namespace

std::vector<double> lengths_along(const std::vector<Vec2>& path) {
  std::vector<double> lengths(path.size(), 0);
  for (std::size_t i = 1; i < path.size(); ++i) lengths[i] = lengths[i - 1] + norm(path[i] - path[i - 1]);
  return lengths;
}

Vec2 point_at(const std::vector<Vec2>& path, const std::vector<double>& lengths, double s) {
  if (s <= 0) return path.front();
  if (s >= lengths.back()) return path.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(lengths.begin(), lengths.end(), s) - lengths.begin());
  return point_between(path, lengths, i, s);
}

std::vector<Vec2> resampled(const std::vector<Vec2>& path, double step) {
  const auto lengths = lengths_along(path);
  const int n = std::max(1, static_cast<int>(std::lround(lengths.back() / step)));
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(n) + 1);
  points.push_back(path.front());
  std::size_t i = 1;
  for (int k = 1; k < n; ++k) {
    const double s = lengths.back() * k / n;
    while (i + 1 < path.size() && lengths[i] <= s) ++i;
    points.push_back(point_between(path, lengths, i, s));
  }
  points.push_back(path.back());
  return points;
}

Vec2 tangent_at(const std::vector<Vec2>& path, int k, int span, bool closed) {
  const int n = static_cast<int>(path.size());
  const auto at = [&](int i) {
    if (closed) i = ((i % (n - 1)) + (n - 1)) % (n - 1);
    return path[static_cast<std::size_t>(std::clamp(i, 0, n - 1))];
  };
  if (closed) span = std::min(span, (n - 1) / 4 + 1);
  for (; span < n; ++span) {
    const Vec2 t = unit(at(k + span) - at(k - span));
    if (!(t == Vec2{})) return t;
  }
  return {1, 0};
}

std::optional<std::pair<double, double>> crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double denominator = cross(b - a, d - c);
  const auto parallel = [&] { return std::abs(denominator) <= kParallel * norm(b - a) * norm(d - c); };
  const double s = cross(c - a, d - c) / denominator, t = cross(c - a, b - a) / denominator;
  if (!(s >= 0 && s < 1 && t >= 0 && t < 1) || parallel()) return std::nullopt;
  return std::pair{s, t};
}

double nearest_parameter(Vec2 p, Vec2 a, Vec2 b) {
  const double length2 = norm2(b - a);
  return length2 > 0 ? std::clamp(dot(p - a, b - a) / length2, 0.0, 1.0) : 0;
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  return norm(p - lerp(a, b, nearest_parameter(p, a, b)));
}

}  // namespace inkgrid
