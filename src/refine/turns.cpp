#include "refine/turns.h"

#include <algorithm>
#include <cmath>

#include "base/sample.h"
#include "ink/ink.h"
#include "refine/ridge.h"
#include "refine/tips.h"

namespace inkgrid {
namespace {

constexpr double kWidest = 0.17;    // cosine of the widest angle between the sides, 80 degrees
constexpr double kFarthest = 2.5;   // pens between the sides
constexpr double kLeast = 0.8;      // pens of ink, along and across
constexpr double kOpen = 0.5;       // pens of paper between parallel sides, half a pen before their ink is one: more is a bend
constexpr double kOpening = 0.8;    // pens by which it is wider for the sine of half the angle between them
constexpr double kSideways = 0.4;   // pens that the ink around a turn may be wider than its two ways
constexpr double kAside = 0.4;      // pens from the middle of a round end where its ink does not yet end
constexpr double kFlat = 0.2;       // pens by which the end of the ink may be hollow
constexpr double kAhead = 0.5;      // cosine of the angle between a side and the way from its end to the turn
constexpr double kPaper = 1;        // px that rough rims may leave on the way
constexpr double kWalkStep = 0.25;  // px

double paper_ahead(const Raster<std::uint8_t>& ink, Vec2 from, Vec2 direction, double farthest) {
  double t = 0;
  while (t < farthest && !nearest(ink, from + t * direction, std::uint8_t{0})) t += kWalkStep;
  return t;
}

class Turn {
 public:
  Turn(const Arrival& a, const Arrival& b, const Raster<std::uint8_t>& drawn, double pen, double longest)
      : a_(a), b_(b), drawn_(drawn), pen_(pen), longest_(longest), outward_(unit(a.direction + b.direction)) {}

  std::optional<Vec2> tip() const {
    const double apart = std::abs(dot(b_.point - a_.point, across_));
    if (apart > kFarthest * pen_) return std::nullopt;
    const Vec2 start = notch();
    const double thick = ink(start, outward_, longest_);
    if (thick < kLeast * pen_ || thick >= longest_ || is_open(start)) return std::nullopt;
    const Vec2 found = start + (thick - 0.5 * pen_) * outward_;
    const double left = ink(found, across_, 2 * longest_), right = ink(found, -across_, 2 * longest_);
    if (left + right < kLeast * pen_ || left + right > apart + (1 + kSideways) * pen_) return std::nullopt;
    const Vec2 centre = found + 0.5 * (left - right) * across_;
    return !is_hollow(centre) && leads_to(a_, centre) && leads_to(b_, centre) ? std::optional(centre) : std::nullopt;
  }

 private:
  double ink(Vec2 from, Vec2 direction, double farthest) const { return ink_ahead(drawn_, from, direction, kWalkStep, farthest); }

  // Where the ink of the two sides becomes one.
  Vec2 notch() const {
    const Vec2 middle = 0.5 * (a_.point + b_.point), before = middle - ink(middle, -outward_, longest_) * outward_;
    return before + paper_ahead(drawn_, before, outward_, longest_) * outward_;
  }

  // Whether there is that much paper between the sides that the pen only bent.
  bool is_open(Vec2 notch) const {
    const Vec2 between = notch - 0.5 * pen_ * outward_;
    const double paper = paper_ahead(drawn_, between, across_, longest_) + paper_ahead(drawn_, between, -across_, longest_);
    return paper > (kOpen + kOpening * half_sine(a_, b_)) * pen_;
  }

  // Whether the ink goes on at both sides, as between the ends of strokes that cross.
  bool is_hollow(Vec2 tip) const {
    const auto goes_on = [&](double aside) { return ink(tip + aside * across_, outward_, pen_) > (0.5 + kFlat) * pen_; };
    return goes_on(kAside * pen_) && goes_on(-kAside * pen_);
  }

  bool leads_to(const Arrival& side, Vec2 tip) const {
    const Vec2 way = tip - side.point;
    return norm(way) < longest_ && dot(way, side.direction) > kAhead * norm(way) && over_ink(drawn_, side.point, tip, kPaper);
  }

  const Arrival &a_, &b_;
  const Raster<std::uint8_t>& drawn_;
  double pen_, longest_;
  Vec2 outward_, across_ = quarter_turn(outward_);
};

}  // namespace

std::optional<Vec2> turn_of(const Arrival& a, const Arrival& b, const Raster<std::uint8_t>& drawn, double pen, double longest) {
  if (!a.known || !b.known || dot(a.direction, b.direction) < kWidest) return std::nullopt;
  return Turn(a, b, drawn, pen, longest).tip();
}

}  // namespace inkgrid
