#include "fit/fit_samples.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "base/at.h"

namespace inkgrid {
namespace {

constexpr double kCornerTurn = 39 * std::numbers::pi / 180;    // least turn of a corner
constexpr double kCornerExcess = 34 * std::numbers::pi / 180;  // of which the curvature on both sides explains all but this
constexpr double kSharpestArc = 100 * std::numbers::pi / 180;  // turn; tips are cut by more than corners
constexpr double kReach = 0.78;      // half widths: an arc of less than a quarter of the width is a corner
constexpr double kLongestTip = 1.5;  // spans that a chain may cut off
constexpr double kLeftOut = 1.5;     // of that to either side
constexpr double kBlur = 0.5;        // px
constexpr double kMostSamples = 50000;

// Points closer than `least` to their predecessor are dropped, but for the last one, which replaces it.
std::vector<Vec2> distinct_points(std::span<const Vec2> polyline, bool closed, double least) {
  std::vector<Vec2> finite;
  std::ranges::copy_if(polyline, std::back_inserter(finite), [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
  if (closed && !finite.empty() && !(finite.back() == finite.front())) finite.push_back(finite.front());
  std::vector<Vec2> points;
  for (const Vec2 p : finite)
    if (points.empty() || norm(p - points.back()) > least) points.push_back(p);
  if (points.size() > 1) points.back() = finite.back();
  return points;
}

// The polyline at equal steps, and what is measured on it.
class EvenLine {
 public:
  EvenLine(const Samples& samples, double span)
      : closed_(samples.closed),
        steps_(std::max(8, static_cast<int>(std::lround(samples.arc.back() / (span / 12))))),
        spacing_(samples.arc.back() / steps_),
        half_window_(std::max(1, static_cast<int>(std::lround(span / 3 / spacing_)))),
        offset_(std::max(1, static_cast<int>(std::lround(span / 2 / spacing_)))) {
    std::size_t edge = 0;
    for (int i = 0; i <= steps_; ++i) {
      const double s = i == steps_ ? samples.arc.back() : i * spacing_;
      while (edge + 2 < samples.arc.size() && samples.arc[edge + 1] < s) ++edge;
      const double t = (s - samples.arc[edge]) / (samples.arc[edge + 1] - samples.arc[edge]);
      points_.push_back(lerp(samples.points[edge], samples.points[edge + 1], t));
    }
    for (int i = 0; i <= steps_; ++i) directions_.push_back(regression_direction(i));
  }

  int steps() const { return steps_; }
  double spacing() const { return spacing_; }
  int offset() const { return offset_; }
  bool closed() const { return closed_; }
  int wrap(int i) const { return closed_ ? ((i % steps_) + steps_) % steps_ : std::clamp(i, 0, steps_); }
  Vec2 point(int i) const { return points_[at(wrap(i))]; }
  Vec2 direction(int i) const { return directions_[at(wrap(i))]; }
  double turn(int i, int j) const { return std::atan2(cross(direction(i), direction(j)), dot(direction(i), direction(j))); }

  // By how much the turn around i exceeds that of the two half windows next to it; 0: no corner.
  double excess(int i) const {
    const double middle = turn(i - offset_, i + offset_);
    if (std::abs(middle) < kCornerTurn) return 0;
    const double sign = middle < 0 ? -1 : 1;
    const double flanks =
        std::max(0.0, sign * turn(i + offset_, i + 2 * offset_)) + std::max(0.0, sign * turn(i - 2 * offset_, i - offset_));
    const double value = std::abs(middle) - flanks;
    return value < kCornerExcess ? 0 : value;
  }

 private:
  Vec2 regression_direction(int i) const {
    Vec2 sum;
    for (int k = 1; k <= half_window_; ++k) sum += static_cast<double>(k) * (point(i + k) - point(i - k));
    return unit(sum);
  }

  bool closed_;
  int steps_;
  double spacing_;
  int half_window_, offset_;
  std::vector<Vec2> points_, directions_;
};

// The middle of the best stretch of each run of corner-like places.
std::vector<int> corner_places(const EvenLine& line) {
  const int first = line.closed() ? 0 : line.offset(), last = line.closed() ? line.steps() - 1 : line.steps() - line.offset();
  std::vector<double> score(at(line.steps() + 1));
  for (int i = first; i <= last; ++i) score[at(i)] = line.excess(i);
  const auto score_at = [&](int i) { return score[at(line.wrap(i))]; };
  std::vector<int> places;
  for (int i = first; i <= last; ++i) {
    if (score_at(i) == 0) continue;
    bool best = true;
    for (int k = 1; k <= line.offset() && best; ++k) best = score_at(i) >= score_at(i + k) && score_at(i) > score_at(i - k);
    if (best) places.push_back(i);
  }
  return places;
}

struct Side {
  Vec2 point, direction;
  double error = 0;  // px: root mean square distance from the line
};

// The line along the places from `low` to `high`.
Side line_along(const EvenLine& line, int low, int high) {
  Vec2 sum, moment;
  for (int i = low; i <= high; ++i) sum += line.point(i);
  const Vec2 mean = sum / (high - low + 1);
  for (int i = low; i <= high; ++i) moment += (i - 0.5 * (low + high)) * (line.point(i) - mean);
  const Vec2 u = unit(moment);
  double squares = 0;
  for (int i = low; i <= high; ++i) squares += cross(u, line.point(i) - mean) * cross(u, line.point(i) - mean);
  return {mean, u, std::sqrt(squares / (high - low + 1))};
}

// The side of a corner towards `sign`, along as many of its first `room` places as are straight: the more, the less their noise
// matters.
Side straight_side(const EvenLine& line, int place, int sign, int room) {
  const auto along = [&](int near, int far) {
    return line_along(line, place + (sign > 0 ? near : -far), place + (sign > 0 ? far : -near));
  };
  const int half_span = line.offset();
  Side side = along(half_span / 3, half_span + 2 * half_span / 3);
  const double most = 1.25 * side.error + 0.02 * half_span * line.spacing();
  for (const int far : {3 * half_span, 5 * half_span, 8 * half_span, 12 * half_span}) {
    if (far > room - half_span) break;
    const Side longer = along(half_span, far);
    if (longer.error > most) break;
    side = longer;
  }
  return side;
}

struct Room {
  int before, after;  // places to the next corners or ends
};

struct Meeting {
  Vec2 point;
  double turn;  // from one side to the other
};

std::optional<Meeting> meeting_of_sides(const EvenLine& line, int place, Room room) {
  const Side a = straight_side(line, place, -1, room.before), b = straight_side(line, place, 1, room.after);
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) < 0.1) return std::nullopt;
  const Vec2 point = a.point + (cross(b.point - a.point, b.direction) / sine) * a.direction;
  return Meeting{point, std::atan2(std::abs(sine), dot(a.direction, b.direction))};
}

int nearest_place(const EvenLine& line, int place, Vec2 p) {
  int best = place;
  for (int i = place - line.offset(); i <= place + line.offset(); ++i)
    if (norm(line.point(i) - p) < norm(line.point(best) - p)) best = i;
  return best;
}

int sharpest_place(const EvenLine& line, int place) {
  const int reach = std::max(1, line.offset() / 3);
  int best = place;
  double least = 2;
  for (int i = place - line.offset(); i <= place + line.offset(); ++i) {
    const double cosine = dot(unit(line.point(i + reach) - line.point(i)), unit(line.point(i) - line.point(i - reach)));
    if (cosine < least - 1e-9) least = cosine, best = i;
  }
  return best;
}

// The vertex of the polyline nearest to a place on it.
Vec2 nearest_sample(const Samples& samples, double arc) {
  const auto above = std::lower_bound(samples.arc.begin(), samples.arc.end(), arc);
  auto i = static_cast<std::size_t>(above - samples.arc.begin());
  if (i == samples.arc.size() || (i > 0 && arc - samples.arc[i - 1] < samples.arc[i] - arc)) --i;
  return samples.points[i];
}

Room room_at(const EvenLine& line, const std::vector<int>& places, std::size_t i) {
  const int turn = line.closed() ? line.steps() : 0;
  const int before = i > 0 ? places[i - 1] : line.closed() ? places.back() - turn : -line.offset();
  const int after = i + 1 < places.size() ? places[i + 1] : line.closed() ? places.front() + turn : line.steps() + line.offset();
  return {places[i] - before, after - places[i]};
}

// Ink of one width reaches half of it beyond a corner, and less beyond the meeting of the sides of an arc.
bool reaches(const EvenLine& line, int place, Vec2 corner, const InkDepth& depth) {
  const double beside = std::max(depth(line.point(place - line.offset())), depth(line.point(place + line.offset())));
  return depth(corner) >= kReach * beside - kBlur;
}

// None where it is an arc.
std::optional<Corner> corner_at(const Samples& samples, const EvenLine& line, int place, Room room, double span,
                                const InkDepth& depth) {
  const double turn = std::abs(line.turn(place - line.offset(), place + line.offset()));
  if (const auto sides = meeting_of_sides(line, place, room)) {
    const int nearest = nearest_place(line, place, sides->point);
    const double gap = norm(line.point(nearest) - sides->point);
    const bool is_tip = sides->turn > kSharpestArc, drawn = depth && reaches(line, place, sides->point, depth);
    if (gap <= span / 2 && depth && !is_tip && !drawn) return std::nullopt;
    // An arc that touches both sides and passes the corner at `gap` has this tangent length.
    if (gap <= span / 2 || (is_tip && drawn && gap <= kLongestTip * span))
      return Corner{sides->point, line.wrap(nearest) * line.spacing(),
                    std::min(std::max(span, kLeftOut * gap), 1.3 * gap / std::tan(turn / 4))};
  }
  const double arc = line.wrap(sharpest_place(line, place)) * line.spacing();
  return Corner{nearest_sample(samples, arc), arc, 0};
}

}  // namespace

Samples sample_polyline(std::span<const Vec2> polyline, bool closed, double spacing) {
  const std::vector<Vec2> points = distinct_points(polyline, closed, 1e-6 * spacing);
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  const double step = std::max(spacing, length / kMostSamples);
  Samples samples;
  samples.closed = closed && points.size() > 2;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double edge = i > 0 ? norm(points[i] - points[i - 1]) : 0;
    const int pieces = std::max(1, static_cast<int>(std::ceil(edge / step)));
    const double start = i > 0 ? samples.arc.back() : 0;
    for (int k = i > 0 ? 1 : pieces; k <= pieces; ++k) {
      samples.points.push_back(k == pieces ? points[i] : lerp(points[i - 1], points[i], static_cast<double>(k) / pieces));
      samples.arc.push_back(start + edge * k / pieces);
    }
  }
  return samples;
}

std::vector<Corner> find_corners(const Samples& samples, double span, const InkDepth& depth) {
  std::vector<Corner> corners;
  if (samples.points.size() < 3 || samples.arc.back() < span) return corners;
  const EvenLine line(samples, span);
  const std::vector<int> places = corner_places(line);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const auto corner = corner_at(samples, line, places[i], room_at(line, places, i), span, depth))
      corners.push_back(*corner);
  // A crossing may lie beside the end of a short hook.
  const double ends = samples.closed ? 0 : span / 4;
  std::erase_if(corners, [&](const Corner& c) { return c.arc < ends || c.arc > samples.arc.back() - ends; });
  std::ranges::sort(corners, {}, &Corner::arc);
  const auto same = [&](const Corner& a, const Corner& b) { return b.arc - a.arc < span / 2; };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  if (samples.closed && corners.size() > 1 && corners.front().arc + samples.arc.back() - corners.back().arc < span / 2)
    corners.pop_back();
  return corners;
}

}  // namespace inkgrid
