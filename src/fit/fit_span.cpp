#include "fit/fit_span.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/at.h"
#include "base/polyline.h"
#include "fit/fit_spline.h"

namespace inkgrid {
namespace {

constexpr int kMostPoints = 20;     // that a span is fitted to
constexpr double kPolygon = 2;      // of the limit: how far the polygon of possible cuts is from the points
constexpr int kPlaces = 5;          // tried for each cut
constexpr double kAlong = 0.05;     // weight of the distance along the curve against the one across it
constexpr double kTooShort = 1e2;   // cost of a span that is too short
constexpr double kOverLimit = 1e3;  // cost of a span beyond the limit, against a whole curve at the limit

struct Thinned {
  std::array<Vec2, kMostPoints> points;
  std::array<double, kMostPoints> t;
  int count = 0;
};

Thinned thin(const Samples& samples, int first, int last) {
  Thinned thinned;
  thinned.count = std::min(last - first + 1, kMostPoints);
  const double start = samples.arc[at(first)], length = samples.arc[at(last)] - start;
  for (int k = 0; k < thinned.count; ++k) {
    const int i = first + static_cast<int>((static_cast<long>(last - first) * k + (thinned.count - 1) / 2) / (thinned.count - 1));
    thinned.points[at(k)] = samples.points[at(i)];
    thinned.t[at(k)] = (samples.arc[at(i)] - start) / length;
  }
  return thinned;
}

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

Cubic fit_by_arc(const Thinned& thinned) {
  Eigen::Matrix4d matrix = 1e-9 * Eigen::Matrix4d::Identity();
  Eigen::Matrix<double, 4, 2> right = Eigen::Matrix<double, 4, 2>::Zero();
  const Vec2 origin = thinned.points[0];
  for (int k = 0; k < thinned.count; ++k) {
    const auto b = bernstein(thinned.t[at(k)]);
    const Eigen::Vector4d row(b[0], b[1], b[2], b[3]);
    const Vec2 p = thinned.points[at(k)] - origin;
    matrix += row * row.transpose();
    right += row * Eigen::RowVector2d(p.x, p.y);
  }
  const Eigen::Matrix<double, 4, 2> c = matrix.llt().solve(right);
  const auto control = [&](int i) { return origin + Vec2{c(i, 0), c(i, 1)}; };
  return {control(0), control(1), control(2), control(3)};
}

void move_parameters(Thinned& thinned, const Cubic& c) {
  for (int k = 1; k + 1 < thinned.count; ++k) {
    double& t = thinned.t[at(k)];
    const Vec2 gap = point_on(c, t) - thinned.points[at(k)], velocity = velocity_on(c, t);
    const double speed2 = norm2(velocity), curve = std::max(speed2 + dot(gap, acceleration_on(c, t)), 0.3 * speed2);
    if (curve > 0) t = std::clamp(t - std::clamp(dot(gap, velocity) / curve, -0.2, 0.2), 0.0, 1.0);
  }
}

// One Gauss-Newton step on the distances across the curve.
void improve(Cubic& c, const Thinned& thinned) {
  Matrix8 matrix = Matrix8::Zero();
  Vector8 right = Vector8::Zero();
  for (int k = 0; k < thinned.count; ++k) {
    const double t = thinned.t[at(k)];
    const auto b = bernstein(t);
    const Vec2 gap = point_on(c, t) - thinned.points[at(k)], along = fast_unit(velocity_on(c, t)), across = quarter_turn(along);
    const double w = k == 0 || k + 1 == thinned.count ? 1 : kAlong;
    Vector8 row, second;
    for (Eigen::Index i = 0; i < 4; ++i) {
      row[2 * i] = b[at(i)] * across.x, row[2 * i + 1] = b[at(i)] * across.y;
      second[2 * i] = w * b[at(i)] * along.x, second[2 * i + 1] = w * b[at(i)] * along.y;
    }
    matrix += row * row.transpose() + second * second.transpose();
    right += row * dot(gap, across) + second * (w * dot(gap, along));
  }
  matrix.diagonal().array() += 1e-9 * thinned.count;
  const Vector8 step = matrix.llt().solve(right);
  if (!step.allFinite()) return;
  const auto moved = [&](Vec2 p, Eigen::Index i) { return p - Vec2{step[2 * i], step[2 * i + 1]}; };
  c = {moved(c.p0, 0), moved(c.p1, 1), moved(c.p2, 2), moved(c.p3, 3)};
}

struct Bracket {
  int low, high;
};

std::vector<int> places_in(const Bracket& bracket) {
  std::vector<int> places;
  for (int i = 0; i < kPlaces; ++i) {
    const int place = bracket.low + ((bracket.high - bracket.low) * i + (kPlaces - 1) / 2) / (kPlaces - 1);
    if (places.empty() || place > places.back()) places.push_back(place);
  }
  return places;
}

class Cutter {
 public:
  Cutter(const Samples& samples, const CutOptions& options) : samples_(samples), options_(options) {}

  std::vector<int> cut(int first, int last) const {
    const std::vector<int> places = polygon(first, last);
    const std::vector<int> chosen = cheapest_chain(places);
    std::vector<Bracket> brackets;
    for (const int i : chosen) {
      const int before = places[at(std::max(i - 1, 0))], here = places[at(i)];
      const int after = places[at(std::min(i + 1, static_cast<int>(places.size()) - 1))];
      const bool end = here == first || here == last;
      brackets.push_back(end ? Bracket{here, here} : Bracket{(before + here + 1) / 2, (here + after) / 2});
    }
    return best_cuts(brackets);
  }

 private:
  double length(int a, int b) const { return samples_.arc[at(b)] - samples_.arc[at(a)]; }

  struct Cost {
    double value;
    bool within;  // the limit
  };

  Cost cost(int a, int b) const {
    const SpanFit span = fit_span(samples_, a, b);
    const double over = span.largest > options_.limit ? kOverLimit * span.largest / options_.limit : 0;
    const double brief = length(a, b) < options_.shortest ? kTooShort : 0;
    return {1 + span.squares / options_.worth + over + brief, over == 0};
  }

  // The corners of a polygon along the points: where spans may meet.
  std::vector<int> polygon(int first, int last) const {
    std::vector<int> corners{first}, open{last};
    while (!open.empty()) {
      const int a = corners.back(), b = open.back();
      int furthest = -1;
      double most = kPolygon * options_.limit;
      for (int i = a + 1; i < b; ++i) {
        const double d = distance_to_segment(samples_.points[at(i)], samples_.points[at(a)], samples_.points[at(b)]);
        if (d > most) most = d, furthest = i;
      }
      if (furthest >= 0) {
        open.push_back(furthest);
        continue;
      }
      corners.push_back(b);
      open.pop_back();
    }
    return spaced(corners);
  }

  std::vector<int> spaced(const std::vector<int>& places) const {
    std::vector<int> result{places.front()};
    for (const int place : places)
      if (place == places.back()
              ? place > result.back()
              : length(result.back(), place) >= options_.shortest && length(place, places.back()) >= options_.shortest)
        result.push_back(place);
    return result;
  }

  // Which of the places to cut at, by the shortest path from the first to the last one.
  std::vector<int> cheapest_chain(const std::vector<int>& places) const {
    const int n = static_cast<int>(places.size());
    std::vector<double> best(at(n), std::numeric_limits<double>::infinity());
    std::vector<int> from(at(n), -1);
    best[0] = 0;
    for (int i = 0; i + 1 < n; ++i)
      for (int j = i + 1, failed = 0; j < n && failed < 2; ++j) {
        const auto [value, within] = cost(places[at(i)], places[at(j)]);
        if (best[at(i)] + value < best[at(j)]) best[at(j)] = best[at(i)] + value, from[at(j)] = i;
        failed = within ? 0 : failed + 1;
      }
    std::vector<int> chain;
    for (int i = n - 1; i >= 0; i = from[at(i)]) chain.push_back(i);
    std::ranges::reverse(chain);
    return chain;
  }

  // The cuts, one in each bracket, of least cost.
  std::vector<int> best_cuts(const std::vector<Bracket>& brackets) const {
    struct Choice {
      double cost = std::numeric_limits<double>::infinity();
      int before = -1;
    };
    std::vector<std::vector<int>> places{places_in(brackets[0])};
    std::vector<std::vector<Choice>> choices{{{0.0, -1}}};
    for (std::size_t k = 1; k < brackets.size(); ++k) {
      places.push_back(places_in(brackets[k]));
      choices.emplace_back(places[k].size());
      for (std::size_t j = 0; j < places[k].size(); ++j)
        for (std::size_t i = 0; i < places[k - 1].size(); ++i) {
          if (places[k - 1][i] >= places[k][j]) continue;
          const double value = choices[k - 1][i].cost + cost(places[k - 1][i], places[k][j]).value;
          if (value < choices[k][j].cost) choices[k][j] = {value, static_cast<int>(i)};
        }
    }
    std::vector<int> cuts(brackets.size());
    int chosen = 0;
    for (std::size_t k = brackets.size(); k-- > 0;) {
      cuts[k] = places[k][at(chosen)];
      chosen = choices[k][at(chosen)].before;
    }
    return cuts;
  }

  const Samples& samples_;
  const CutOptions options_;
};

std::vector<int> even_cuts(int first, int last, int pieces) {
  std::vector<int> cuts;
  for (int k = 0; k <= pieces; ++k) cuts.push_back(first + static_cast<int>(static_cast<long>(last - first) * k / pieces));
  return cuts;
}

}  // namespace

Samples two_turns(const Samples& samples) {
  Samples twice = samples;
  for (std::size_t i = 1; i < samples.points.size(); ++i) {
    twice.points.push_back(samples.points[i]);
    twice.arc.push_back(samples.arc.back() + samples.arc[i]);
  }
  return twice;
}

SpanFit fit_span(const Samples& samples, int first, int last) {
  const Vec2 a = samples.points[at(first)], b = samples.points[at(last)];
  if (last - first < 2) return {{a, lerp(a, b, 1.0 / 3), lerp(a, b, 2.0 / 3), b}, 0, 0};
  Thinned thinned = thin(samples, first, last);
  SpanFit fit{fit_by_arc(thinned), 0, 0};
  for (int round = 0; thinned.count > 4 && round < 3; ++round) {
    move_parameters(thinned, fit.cubic);
    improve(fit.cubic, thinned);
  }
  move_parameters(thinned, fit.cubic);
  double sum = 0;
  for (int k = 0; k < thinned.count; ++k) {
    const double d2 = norm2(point_on(fit.cubic, thinned.t[at(k)]) - thinned.points[at(k)]);
    fit.largest = std::max(fit.largest, d2);
    sum += d2;
  }
  fit.largest = std::sqrt(fit.largest);
  fit.squares = sum / thinned.count * (samples.arc[at(last)] - samples.arc[at(first)]);
  return fit;
}

std::vector<int> cut_into_spans(const Samples& samples, const CutOptions& options) {
  const int last = static_cast<int>(samples.points.size()) - 1;
  if (!samples.closed) return Cutter(samples, options).cut(0, last);
  const Samples twice = two_turns(samples);
  const Cutter cutter(twice, options);
  const std::vector<int> rough = cutter.cut(0, last);
  // The arbitrary first point was a cut; a chosen one is not arbitrary.
  const int seam = rough[rough.size() / 2] % last;
  const std::vector<int> best = cutter.cut(seam, seam + last);
  return static_cast<int>(best.size()) > options.least
             ? best
             : even_cuts(best.front(), best.front() + last, std::min(options.least, last));
}

}  // namespace inkgrid
