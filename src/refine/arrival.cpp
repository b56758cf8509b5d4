#include "refine/arrival.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/at.h"

namespace inkgrid {
namespace {

constexpr double kLongest = 4;        // strokes of which the line is told
constexpr double kLongStraight = 14;  // strokes over which a line may be so straight that it is told of all of them
constexpr double kStaircase = 0.3;    // px, by which the pixels move the ridge of such a line
constexpr double kShrink = 0.7;       // of the length that no parabola explained
constexpr double kBent = 0.35;        // strokes: beside what is not confirmed the ridge is bent by it
constexpr double kStraight = 0.02;    // strokes: lesser sagittas are straight
constexpr double kNoise = 0.2;        // px, of points from a parabola
constexpr double kUnsure = 6;         // strokes that may have paper on one side only, as beside the other arm of a fork
constexpr double kStraightOn = 0.94;  // cosine of 20 degrees: how straight such a part is
constexpr double kMarch = 0.5;        // px
constexpr double kParallel = 0.05;    // sine

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
    const Vec2 p = ridge.chain.points[at(i)] - origin;
    const double weight = ridge.sections[at(i)].weight;
    if (weight > 0) samples.push_back({dot(p, axis), cross(axis, p), weight});
  }
  return samples;
}

}  // namespace

namespace {

// A chain seen from one of its ends, or from a place on it.
class View {
 public:
  View(const RidgeChain& ridge, int first, bool forward)
      : ridge_(ridge), first_(first), step_(forward ? 1 : -1), width_(std::max(2.0, ridge.chain.width)) {}

  Arrival arrival() const {
    int k = first_;
    while (inside(k) && weight(k) <= 0) k += step_;
    if (!inside(k + 2 * step_)) return {};
    int sure = k;
    while (inside(sure) && weight(sure) < 1 && norm(point(sure) - point(k)) < kUnsure * width_) sure += step_;
    if (sure == k || !inside(sure + 2 * step_) || weight(sure) < 1) return line_from(k);
    const Arrival sure_line = line_from(sure);
    const bool straight = dot(sure_line.direction, unit(point(k) - point(sure))) > kStraightOn;
    return straight ? sure_line : line_from(k);
  }

 private:
  Vec2 point(int k) const { return ridge_.chain.points[at(k)]; }
  double weight(int k) const { return ridge_.sections[at(k)].weight; }
  bool inside(int k) const { return k >= 0 && k < static_cast<int>(ridge_.chain.points.size()); }

  int within(int from, double span) const {
    int far = from + step_;
    while (inside(far + step_) && norm(point(far) - point(from)) < span) far += step_;
    return far;
  }

  Arrival line_from(int last) const {
    Arrival arrival = line_at(last);
    arrival.bend = bend_at(last);
    return arrival;
  }

  // Told of as many strokes as a straight line.
  std::optional<Bend> bend_at(int last) const {
    const double span = kLongStraight * width_;
    const int bent = within(last, kBent * width_), far = within(last, span);
    const Vec2 axis = unit(point(last) - point(far));
    const auto samples = samples_of(ridge_, bent, far, step_, point(last), axis);
    if (samples.size() < 5 || norm(point(far) - point(last)) < kShrink * span) return std::nullopt;
    const auto curve = fitted_parabola(samples, false);
    if (spread_about(samples, curve) >= kStaircase) return std::nullopt;
    const Arrival tangent = led_by(curve, axis, {true, point(last), {}, 0, {}});
    return Bend{tangent.point, tangent.direction, 2 * curve[2] / std::pow(1 + curve[1] * curve[1], 1.5)};
  }

  Arrival line_at(int last) const {
    const int bent = within(last, kBent * width_), from = inside(bent + 2 * step_) ? bent : last;
    Arrival arrival{true, point(last), {}, std::abs(last - first_), {}};
    if (follow_straight(from, last, arrival)) return arrival;
    for (double span = kLongest * width_;; span *= kShrink) {
      const bool shortest = span <= width_;
      const int far = within(from, std::max(span, width_));
      const Vec2 axis = unit(point(last) - point(far));
      arrival.direction = axis;
      const auto samples = samples_of(ridge_, from, far, step_, point(last), axis);
      if (samples.size() < 5) return arrival;
      const double noise = kStraight * width_ + kNoise;
      auto curve = fitted_parabola(samples, false);
      if (!shortest && spread_about(samples, curve) > noise) continue;
      if (shortest || sagitta(samples, curve) < noise) curve = fitted_parabola(samples, true);
      return led_by(curve, axis, arrival);
    }
  }

  // A straight stroke says more the longer it is: the few pixels that slimming leaves across one that is all but level go up and
  // down slowly.
  bool follow_straight(int from, int last, Arrival& arrival) const {
    if (ridge_.slimmed <= 0) return false;
    const double span = kLongStraight * width_;
    const int far = within(from, span);
    const Vec2 axis = unit(point(last) - point(far));
    const auto samples = samples_of(ridge_, from, far, step_, point(last), axis);
    if (samples.size() < 5 || norm(point(far) - point(from)) < kShrink * span) return false;
    const auto line = fitted_parabola(samples, true);
    if (spread_about(samples, line) >= kStaircase || sagitta(samples, fitted_parabola(samples, false)) >= kStaircase)
      return false;
    arrival = led_by(line, axis, arrival);
    return true;
  }

  static double sagitta(const std::vector<Sample>& samples, const std::array<double, 3>& curve) {
    const double length = samples.front().x - samples.back().x;
    return std::abs(curve[2]) * length * length / 4;
  }

  static Arrival led_by(const std::array<double, 3>& curve, Vec2 axis, Arrival arrival) {
    arrival.point += curve[0] * quarter_turn(axis);
    arrival.direction = unit(axis + curve[1] * quarter_turn(axis));
    return arrival;
  }

  const RidgeChain& ridge_;
  int first_;
  int step_;
  double width_;
};

}  // namespace

Arrival arrival_from(const RidgeChain& ridge, int first, bool forward) {
  return View(ridge, first, forward).arrival();
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

std::optional<Vec2> bent_meeting_of(const Arrival& a, const Arrival& b, double longest) {
  if (!a.known || !b.known) return std::nullopt;
  const Bend from = a.bend.value_or(Bend{a.point, a.direction, 0}), to = b.bend.value_or(Bend{b.point, b.direction, 0});
  const auto at_length = [&](double t) {
    return from.point + t * from.direction + 0.5 * from.curvature * t * t * quarter_turn(from.direction);
  };
  const auto beside = [&](Vec2 p) {
    const double ahead = dot(p - to.point, to.direction);
    return dot(p - to.point, quarter_turn(to.direction)) - 0.5 * to.curvature * ahead * ahead;
  };
  double before = beside(from.point);
  for (double t = kMarch; t < longest; t += kMarch) {
    const double here = beside(at_length(t));
    if ((here < 0) != (before < 0)) {
      const Vec2 meeting = at_length(t - kMarch * here / (here - before));
      return dot(meeting - to.point, to.direction) > 0 ? std::optional(meeting) : std::nullopt;
    }
    before = here;
  }
  return std::nullopt;
}

}  // namespace inkgrid
