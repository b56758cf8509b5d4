#include "refine/tips.h"

#include <algorithm>
#include <cmath>

#include "base/sample.h"
#include "ink/ink.h"

namespace inkgrid {
namespace {

constexpr double kSharp = 0.87;      // cosine of the least turn of a corner, 30 degrees
constexpr double kAcute = 0.82;      // cosine of 35 degrees
constexpr double kPointed = 0.5;     // cosine of the widest angle of a point, 60 degrees: its mitre is no round end
constexpr double kSideError = 0.06;  // strokes by which the line of a side may miss
constexpr double kMitre = 2;         // strokes
constexpr double kPaper = 1;         // px that rough rims may leave on the way to a tip
constexpr double kFarthestEnd = 3;   // pens from where the sides meet to the end of the ink
constexpr double kRound = 0.8;       // pens across a round end, half a pen inside
constexpr double kWalkStep = 0.25;   // px

bool is_pointed(const Arrival& a, const Arrival& b) {
  return dot(a.direction, b.direction) > kPointed;
}

}  // namespace

double half_sine(const Arrival& a, const Arrival& b) {
  return std::sqrt(std::max(1e-3, 0.5 * (1 - dot(a.direction, b.direction))));
}

bool is_acute(const Arrival& a, const Arrival& b) {
  return dot(a.direction, b.direction) > kAcute;
}

double miss_of(const Arrival& a, const Arrival& b, double width, const CornerOptions& options) {
  return options.miss + kSideError * width / half_sine(a, b);
}

std::vector<Vec2> meetings_of_sides(const Arrival& a, const Arrival& b, double passed, const CornerOptions& options) {
  std::vector<Vec2> meetings;
  if (options.hidden > 0 && is_pointed(a, b))
    if (const auto bent = bent_meeting_of(a, b, options.longest + options.hidden)) meetings.push_back(*bent);
  if (const auto straight = meeting_of(a, b, passed)) meetings.push_back(*straight);
  return meetings;
}

std::optional<Vec2> corner_of(const Arrival& a, const Arrival& b, double width, const Raster<std::uint8_t>& ink,
                              const CornerOptions& options, double longest) {
  if (dot(a.direction, b.direction) < -kSharp) return std::nullopt;
  for (const Vec2 meeting : meetings_of_sides(a, b, 0.5 * width, options)) {
    const bool near = std::max(norm(meeting - a.point), norm(meeting - b.point)) <= longest;
    if (near && nearest(ink, meeting, std::uint8_t{0}) && over_ink(ink, a.point, meeting, kPaper) &&
        over_ink(ink, b.point, meeting, kPaper))
      return meeting;
  }
  return std::nullopt;
}

bool ends_behind(Vec2 tip, const Arrival& a, const Arrival& b, double width, const Raster<std::uint8_t>& ink,
                 const CornerOptions& options) {
  const Vec2 outward = unit(a.direction + b.direction);
  const double farthest = std::min(kMitre, 0.5 / half_sine(a, b)) * width + miss_of(a, b, width, options);
  return !over_ink(ink, tip, tip + farthest * outward, kPaper);
}

Vec2 settled_tip(Vec2 tip, const Arrival& a, const Arrival& b, double width, const CornerInk& ink, const CornerOptions& options) {
  if (!is_pointed(a, b) || !ends_behind(tip, a, b, width, ink.slim, options)) return tip;
  const double pen = options.pen, farthest = kFarthestEnd * pen;
  const Vec2 outward = unit(a.direction + b.direction), across = quarter_turn(outward);
  const double end = ink_ahead(ink.drawn, tip, outward, kWalkStep, farthest);
  if (end <= 0.5 * pen || end >= farthest) return tip;
  const Vec2 centre = tip + (end - 0.5 * pen) * outward;
  const double left = ink_ahead(ink.drawn, centre, across, kWalkStep, pen),
               right = ink_ahead(ink.drawn, centre, -across, kWalkStep, pen);
  return left + right < kRound * pen ? tip : centre + 0.5 * (left - right) * across;
}

}  // namespace inkgrid
