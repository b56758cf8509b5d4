#include "refine/follow.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/index_raster.h"
#include "base/polyline.h"
#include "base/sample.h"

namespace inkgrid {
namespace {

constexpr double kStep = 0.25;   // of the stroke width
constexpr double kNear = 0.75;   // stroke widths from another chain
constexpr double kMeet = 3;      // stroke widths from its free end: further back it is not met, but run into
constexpr double kWidest = 1.4;  // stroke widths across: more is a crossing or a blot, where the way goes straight on
constexpr double kSpan = 1.5;    // stroke widths that tell the direction
constexpr double kOwnTail = 4;   // stroke widths of a chain before its end, which are not in its way
constexpr double kShift = 0.35;  // of a step, sideways: a stroke that bends more than that has a corner
constexpr float kWayOn = -1;     // in the place of a position along the chain: what was added to it

// Which chain passes nearby.  Of each pixel the last one painted counts.
class Territory {
 public:
  Territory(const Chains& chains, const Ink& ink) : chain_(ink.width(), ink.height()), position_(ink.width(), ink.height()) {
    for (int c = 0; c < static_cast<int>(chains.chains.size()); ++c) {
      const Chain& chain = chains.chains[at(c)];
      const auto points = resampled(chain.points, 1);
      for (std::size_t k = 0; k < points.size(); ++k) paint(points[k], kNear * chain.width, c, static_cast<float>(k));
      ends_.push_back({static_cast<double>(points.size() - 1), !chain.closed && chain.start_junction < 0,
                       !chain.closed && chain.end_junction < 0});
    }
  }

  // Whether a chain is here: another one, or a part of this one that is more than `tail` px from its start, or its end.
  bool taken(Vec2 p, int chain, bool from_start, double tail) const {
    const int owner = chain_.at(p);
    if (owner != chain) return owner >= 0;
    const double position = static_cast<double>(nearest(position_, p, 0.0F));
    return position < 0 || (from_start ? position : ends_[at(chain)].length - position) > tail;
  }

  // Whether the chain here has a free end within `farthest` px along it.
  bool free_end_within(Vec2 p, double farthest) const {
    const Ends& ends = ends_[at(chain_.at(p))];
    const double position = static_cast<double>(nearest(position_, p, 0.0F));
    return position >= 0 && ((ends.free_start && position < farthest) || (ends.free_end && ends.length - position < farthest));
  }

  void paint(Vec2 p, double radius, int chain, float position) {
    for (int y = floor_of(p.y - radius); y <= floor_of(p.y + radius); ++y)
      for (int x = floor_of(p.x - radius); x <= floor_of(p.x + radius); ++x) {
        if (!chain_.contains(x, y) || norm2(Vec2{x + 0.5, y + 0.5} - p) > radius * radius) continue;
        chain_.set(x, y, chain);
        position_(x, y) = position;
      }
  }

 private:
  struct Ends {
    double length;
    bool free_start, free_end;
  };

  IndexRaster chain_;
  Raster<float> position_;  // along that chain, px
  std::vector<Ends> ends_;
};

// How far the ink goes to one side, and whether paper ends it within `farthest`.
struct Extent {
  double length = 0;
  bool paper = false;
};

Extent extent_of(const Ink& ink, Vec2 p, Vec2 direction, double bridge, double farthest) {
  Extent extent;
  for (double t = 0; t < farthest; t += 0.25) {
    if (nearest(ink.mask, p + t * direction, std::uint8_t{0}))
      extent.length = t;
    else if (t - extent.length > bridge)
      return {extent.length, true};
  }
  return extent;
}

class Follower {
 public:
  Follower(const Ink& ink, const Territory& territory, double bridge) : ink_(ink), territory_(territory), bridge_(bridge) {}

  // The way on from the end of `points`, which are the chain's or, from its start, in reverse; empty if no free end is met.
  std::vector<Vec2> way(std::vector<Vec2> points, int chain, bool from_start, double width) const {
    const std::size_t known = points.size();
    const double step = kStep * width;
    double paper = 0;
    for (int k = 0; k < ink_.width() + ink_.height(); ++k) {
      const Vec2 direction = direction_at(points, kSpan * width);
      const Vec2 p = centred(points.back() + step * direction, direction, width, step);
      if (territory_.taken(p, chain, from_start, kOwnTail * width)) {
        if (!territory_.free_end_within(p, kMeet * width)) return {};
        return {points.begin() + static_cast<std::ptrdiff_t>(known), points.end()};
      }
      paper = nearest(ink_.mask, p, std::uint8_t{0}) ? 0 : paper + step;
      if (paper > bridge_ + step) return {};
      points.push_back(p);
    }
    return {};
  }

 private:
  static Vec2 direction_at(const std::vector<Vec2>& points, double span) {
    std::size_t k = points.size() - 1;
    while (k > 0 && norm(points.back() - points[k]) < span) --k;
    return unit(points.back() - points[k]);
  }

  Vec2 centred(Vec2 p, Vec2 direction, double width, double step) const {
    const Vec2 normal = quarter_turn(direction);
    const Extent left = extent_of(ink_, p, normal, bridge_, kWidest * width),
                 right = extent_of(ink_, p, -normal, bridge_, kWidest * width);
    if (!left.paper || !right.paper || left.length + right.length > kWidest * width) return p;
    return p + std::clamp(0.5 * (left.length - right.length), -kShift * step, kShift * step) * normal;
  }

  const Ink& ink_;
  const Territory& territory_;
  double bridge_;
};

}  // namespace

Chains follow_strokes(Chains chains, const Ink& ink, double bridge, double least) {
  Territory territory(chains, ink);
  const Follower follower(ink, territory, bridge);
  for (int c = 0; c < static_cast<int>(chains.chains.size()); ++c) {
    Chain& chain = chains.chains[at(c)];
    for (const bool at_start : {true, false}) {
      if (chain.closed || junction_at(chain, at_start) >= 0) continue;
      if (at_start) std::reverse(chain.points.begin(), chain.points.end());
      const auto way = follower.way(chain.points, c, at_start, chain.width);
      if (static_cast<double>(way.size()) * kStep * chain.width >= least) {
        chain.points.insert(chain.points.end(), way.begin(), way.end());
        for (const Vec2 p : way) territory.paint(p, kNear * chain.width, c, kWayOn);
      }
      if (at_start) std::reverse(chain.points.begin(), chain.points.end());
    }
  }
  return chains;
}

}  // namespace inkgrid
