#include "fit_span.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fit_spline.h"

namespace inkgrid {
namespace {

constexpr int kMostPoints = 24;     // that a span is fitted to
constexpr int kCandidates = 7;      // places tried for each cut
constexpr double kAlong = 0.05;     // weight of the distance along the curve against the one across it
constexpr double kTooShort = 1e2;   // cost of a span that is too short
constexpr double kOverLimit = 1e3;  // cost of a span beyond the limit, against a whole curve at the limit

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

struct Thinned {
  std::array<Vec2, kMostPoints> points;
  std::array<double, kMostPoints> t;
  int count = 0;
};

Thinned thin(const Samples& samples, int first, int last) {
  Thinned thinned;
  thinned.count = std::min(last - first + 1, kMostPoints);
  const double start = samples.arc[index(first)], length = samples.arc[index(last)] - start;
  for (int k = 0; k < thinned.count; ++k) {
    const int i = first + static_cast<int>((static_cast<long>(last - first) * k + (thinned.count - 1) / 2) / (thinned.count - 1));
    thinned.points[index(k)] = samples.points[index(i)];
    thinned.t[index(k)] = (samples.arc[index(i)] - start) / length;
  }
  return thinned;
}

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

std::array<double, 4> weights_at(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

Cubic fit_by_arc(const Thinned& thinned) {
  Eigen::Matrix4d matrix = 1e-9 * Eigen::Matrix4d::Identity();
  Eigen::Matrix<double, 4, 2> right = Eigen::Matrix<double, 4, 2>::Zero();
  const Vec2 origin = thinned.points[0];
  for (int k = 0; k < thinned.count; ++k) {
    const auto b = weights_at(thinned.t[index(k)]);
    const Eigen::Vector4d row(b[0], b[1], b[2], b[3]);
    const Vec2 p = thinned.points[index(k)] - origin;
    matrix += row * row.transpose();
    right += row * Eigen::RowVector2d(p.x, p.y);
  }
  const Eigen::Matrix<double, 4, 2> c = matrix.llt().solve(right);
  const auto control = [&](int i) { return origin + Vec2{c(i, 0), c(i, 1)}; };
  return {control(0), control(1), control(2), control(3)};
}

void move_parameters(Thinned& thinned, const Cubic& c) {
  for (int k = 1; k + 1 < thinned.count; ++k) {
    double& t = thinned.t[index(k)];
    const Vec2 gap = point_on(c, t) - thinned.points[index(k)], velocity = velocity_on(c, t);
    const double speed2 = norm2(velocity), curve = std::max(speed2 + dot(gap, acceleration_on(c, t)), 0.3 * speed2);
    if (curve > 0) t = std::clamp(t - std::clamp(dot(gap, velocity) / curve, -0.2, 0.2), 0.0, 1.0);
  }
}

// One Gauss-Newton step on the distances across the curve.
void improve(Cubic& c, const Thinned& thinned) {
  Matrix8 matrix = Matrix8::Zero();
  Vector8 right = Vector8::Zero();
  for (int k = 0; k < thinned.count; ++k) {
    const double t = thinned.t[index(k)];
    const auto b = weights_at(t);
    const Vec2 gap = point_on(c, t) - thinned.points[index(k)], along = unit(velocity_on(c, t)), across = quarter_turn(along);
    const double w = k == 0 || k + 1 == thinned.count ? 1 : kAlong;
    Vector8 row, second;
    for (int i = 0; i < 4; ++i) {
      row[2 * i] = b[index(i)] * across.x, row[2 * i + 1] = b[index(i)] * across.y;
      second[2 * i] = w * b[index(i)] * along.x, second[2 * i + 1] = w * b[index(i)] * along.y;
    }
    matrix += row * row.transpose() + second * second.transpose();
    right += row * dot(gap, across) + second * (w * dot(gap, along));
  }
  matrix.diagonal().array() += 1e-9 * thinned.count;
  const Vector8 step = matrix.llt().solve(right);
  if (!step.allFinite()) return;
  const auto moved = [&](Vec2 p, int i) { return p - Vec2{step[2 * i], step[2 * i + 1]}; };
  c = {moved(c.p0, 0), moved(c.p1, 1), moved(c.p2, 2), moved(c.p3, 3)};
}

struct Bracket {
  int low, high;
};

class Cutter {
 public:
  Cutter(const Samples& samples, const CutOptions& options)
      : samples_(samples), limit_(options.limit), shortest_(options.shortest) {}

  // Cuts from `first` to `last` by brackets and dynamic programming.
  std::vector<int> cut(int first, int last) const {
    const std::vector<int> forward = greedy(first, last, 1), backward = greedy(last, first, -1);
    const std::size_t n = std::min(forward.size(), backward.size()) - 1;
    std::vector<Bracket> brackets{{first, first}};
    for (std::size_t k = 1; k < n; ++k) {
      const int a = forward[std::min(k, forward.size() - 1)], b = backward[std::min(n - k, backward.size() - 1)];
      brackets.push_back({std::min(a, b), std::max(a, b)});
    }
    brackets.push_back({last, last});
    const std::vector<int> cuts = best_cuts(brackets);
    return cuts.empty() ? forward : cuts;
  }

 private:
  // The cuts, one in each bracket, of least cost; none where no choice is in order.
  std::vector<int> best_cuts(const std::vector<Bracket>& brackets) const;

  SpanFit fit(int a, int b) const { return fit_span(samples_, std::min(a, b), std::max(a, b)); }

  double length(int a, int b) const { return std::abs(samples_.arc[index(b)] - samples_.arc[index(a)]); }

  // The longest span from `from` in direction `sign`, not beyond `to`.
  int reach(int from, int to, int sign) const {
    const int most = std::abs(to - from);
    int good = 1, bad = most + 1;
    while (good < most && length(from, from + sign * good) < shortest_) ++good;
    for (int step = 8; good < most && bad > most; step *= 2) {
      const int next = std::min(most, std::max(good + 1, step));
      (fit(from, from + sign * next).largest <= limit_ ? good : bad) = next;
    }
    while (bad - good > 1 + good / 64) {
      const int middle = (good + bad) / 2;
      (fit(from, from + sign * middle).largest <= limit_ ? good : bad) = middle;
    }
    return from + sign * good;
  }

  std::vector<int> greedy(int from, int to, int sign) const {
    std::vector<int> cuts{from};
    while (cuts.back() != to) cuts.push_back(reach(cuts.back(), to, sign));
    return cuts;
  }

  const Samples& samples_;
  double limit_, shortest_;
};

std::vector<int> candidates(const Bracket& bracket) {
  std::vector<int> places;
  for (int i = 0; i < kCandidates; ++i) {
    const int place = bracket.low + ((bracket.high - bracket.low) * i + (kCandidates - 1) / 2) / (kCandidates - 1);
    if (places.empty() || place > places.back()) places.push_back(place);
  }
  return places;
}

std::vector<int> Cutter::best_cuts(const std::vector<Bracket>& brackets) const {
  struct Choice {
    double cost = std::numeric_limits<double>::infinity();
    int before = -1;
  };
  const double whole = limit_ * limit_ * (samples_.arc[index(brackets.back().high)] - samples_.arc[index(brackets.front().low)]);
  std::vector<std::vector<int>> places{candidates(brackets[0])};
  std::vector<std::vector<Choice>> choices{{{0.0, -1}}};
  for (std::size_t k = 1; k < brackets.size(); ++k) {
    places.push_back(candidates(brackets[k]));
    choices.emplace_back(places[k].size());
    for (std::size_t j = 0; j < places[k].size(); ++j)
      for (std::size_t i = 0; i < places[k - 1].size(); ++i) {
        if (places[k - 1][i] >= places[k][j] || !std::isfinite(choices[k - 1][i].cost)) continue;
        const SpanFit span = fit(places[k - 1][i], places[k][j]);
        const double over = span.largest > limit_ ? kOverLimit * (span.largest / limit_) : 0;
        const double brief = length(places[k - 1][i], places[k][j]) < shortest_ ? kTooShort : 0;
        const double cost = choices[k - 1][i].cost + span.squares / whole + over + brief;
        if (cost < choices[k][j].cost) choices[k][j] = {cost, static_cast<int>(i)};
      }
  }
  std::vector<int> cuts(brackets.size());
  int chosen = 0;
  for (std::size_t k = brackets.size(); k-- > 0;) {
    if (chosen < 0) return {};
    cuts[k] = places[k][index(chosen)];
    chosen = choices[k][index(chosen)].before;
  }
  return cuts;
}

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
  const Vec2 a = samples.points[index(first)], b = samples.points[index(last)];
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
    const double d2 = norm2(point_on(fit.cubic, thinned.t[index(k)]) - thinned.points[index(k)]);
    fit.largest = std::max(fit.largest, d2);
    sum += d2;
  }
  fit.largest = std::sqrt(fit.largest);
  fit.squares = sum / thinned.count * (samples.arc[index(last)] - samples.arc[index(first)]);
  return fit;
}

std::vector<int> cut_into_spans(const Samples& samples, const CutOptions& options) {
  const int last = static_cast<int>(samples.points.size()) - 1;
  if (!samples.closed) return Cutter(samples, options).cut(0, last);
  const Samples twice = two_turns(samples);
  const Cutter cutter(twice, options);
  std::vector<int> best = cutter.cut(0, last);
  for (int turn = 0; turn < 2 && static_cast<int>(best.size()) > 2; ++turn) {
    const int seam = best[best.size() / 2] % last;
    const std::vector<int> cuts = cutter.cut(seam, seam + last);
    if (!cuts.empty() && cuts.size() <= best.size()) best = cuts;
  }
  return static_cast<int>(best.size()) > options.least
             ? best
             : even_cuts(best.front(), best.front() + last, std::min(options.least, last));
}

}  // namespace inkgrid
