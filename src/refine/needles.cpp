#include "refine/needles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/contour.h"
#include "base/polyline.h"

namespace inkgrid {
namespace {

constexpr double kTurnsBack = -0.5;  // cosine of the turn
constexpr double kSide = 0.75;       // px to either side of a turn
constexpr double kBlot = 2.5;        // distances around a junction that its own ink covers
constexpr double kLongestKnot = 3;   // pens: it takes pi of them to go around a hole
constexpr double kNoHole = 0.78;     // squared pens: the area of a circle of one pen, which has no hole
constexpr double kTip = -0.8;        // cosine between ways that cross: the sides of an acute corner cross before its tip
constexpr double kTouch = 1e-3;      // px between segments that may cross by rounding
constexpr double kBlend = 2;         // misses before the end, the path leaves for it

// Of the turn at point k.
double cosine_at(const std::vector<Vec2>& points, const std::vector<double>& lengths, std::size_t k) {
  std::size_t before = k - 1, after = k + 1;
  while (before > 0 && lengths[k] - lengths[before] < kSide) --before;
  while (after + 1 < points.size() && lengths[after] - lengths[k] < kSide) ++after;
  return dot(unit(points[k] - points[before]), unit(points[after] - points[k]));
}

class Needles {
 public:
  Needles(const std::vector<Vec2>& points, double distance, double longest)
      : points_(points), lengths_(lengths_along(points)), distance2_(distance * distance), longest_(longest) {
    double sharpest = kTurnsBack;
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      const double cosine = cosine_at(points, lengths_, k);
      if (cosine >= kTurnsBack) continue;
      const bool same = !turns_.empty() && lengths_[k] - lengths_[turns_.back()] < kSide;
      if (same && cosine >= sharpest) continue;
      if (same) turns_.pop_back();
      turns_.push_back(k);
      sharpest = cosine;
    }
  }

  std::vector<Vec2> dropped() const {
    std::vector<Vec2> kept;
    std::size_t from = 0;
    for (std::size_t t = 0; t < turns_.size(); ++t) {
      const std::size_t after = turns_[t] < from ? turns_[t] : farthest_return(t);
      if (after <= turns_[t]) continue;
      kept.insert(kept.end(), at(from), at(turns_[t] + 1));
      from = after + 1;
    }
    kept.insert(kept.end(), at(from), points_.end());
    return kept;
  }

 private:
  std::vector<Vec2>::const_iterator at(std::size_t k) const { return points_.begin() + static_cast<std::ptrdiff_t>(k); }

  // The last point, in a turn or beyond one, that may follow this turn right away; or the turn.
  std::size_t farthest_return(std::size_t turn) const {
    const std::size_t first = turns_[turn];
    std::size_t found = first;
    const auto try_point = [&](std::size_t k) {
      if (lengths_[k] - lengths_[first] <= longest_ && norm2(points_[k] - points_[first]) <= distance2_ && rest_covers(first, k))
        found = k;
    };
    for (std::size_t t = turn + 1; t < turns_.size() && lengths_[turns_[t]] - lengths_[first] <= longest_; ++t) {
      try_point(turns_[t]);
      try_point(nearest_after(t, points_[first]));
    }
    return found;
  }

  // Up to the next turn.
  std::size_t nearest_after(std::size_t turn, Vec2 p) const {
    const std::size_t end = turn + 1 < turns_.size() ? turns_[turn + 1] : points_.size() - 1;
    const auto nearer = [&](Vec2 a, Vec2 b) { return norm2(a - p) < norm2(b - p); };
    return static_cast<std::size_t>(std::min_element(at(turns_[turn]), at(end), nearer) - points_.begin());
  }

  bool rest_covers(std::size_t first, std::size_t last) const {
    return std::all_of(at(first), at(last + 1),
                       [&](Vec2 p) { return passes(p, 0, first) || passes(p, last + 1, points_.size() - 1); });
  }

  // Whether the path from one point to another does.
  bool passes(Vec2 p, std::size_t from, std::size_t to) const {
    for (std::size_t k = from; k < to; ++k) {
      const Vec2 a = points_[k], b = points_[k + 1];
      if (norm2(p - lerp(a, b, nearest_parameter(p, a, b))) <= distance2_) return true;
    }
    return false;
  }

  const std::vector<Vec2>& points_;
  std::vector<double> lengths_;
  double distance2_, longest_;  // px^2, px
  std::vector<std::size_t> turns_;
};

std::vector<double> steps_of(const std::vector<Vec2>& points) {
  std::vector<double> steps(points.size(), 0);
  for (std::size_t k = 1; k < points.size(); ++k) steps[k] = norm(points[k] - points[k - 1]);
  return steps;
}

void untie(std::vector<Vec2>& points, double longest) {
  std::vector<Vec2> kept;
  const std::vector<double> steps = steps_of(points);  // to each point
  const auto far_apart = [&](std::size_t k, std::size_t j) {
    const double farthest = steps[k + 1] + steps[j + 1] + kTouch;
    return norm2(points[j] - points[k]) > farthest * farthest;
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    kept.push_back(points[k]);
    double length = 0;
    std::size_t last = k;
    Vec2 place;
    for (std::size_t j = k + 1; j + 1 < points.size() && (length += steps[j]) <= longest; ++j) {
      const bool share_a_point = j == k + 1 || points[j + 1] == points[k];
      if (share_a_point || far_apart(k, j)) continue;
      const Vec2 in = points[k + 1] - points[k], out = points[j + 1] - points[j];
      if (dot(in, out) < kTip * steps[k + 1] * steps[j + 1]) continue;
      if (const auto crossed = crossing(points[k], points[k + 1], points[j], points[j + 1]))
        last = j, place = lerp(points[k], points[k + 1], crossed->first);
    }
    if (last == k) continue;
    kept.push_back(place);
    k = last;
  }
  points = std::move(kept);
}

// The first point from the end at which the path turns back on its last `longest` px; its last point where there is none.
std::size_t hook_at_end(const std::vector<Vec2>& points, const std::vector<double>& lengths, double longest) {
  std::size_t found = points.size() - 1;
  for (std::size_t k = points.size() - 2; k > 0 && lengths.back() - lengths[k] <= longest; --k)
    if (cosine_at(points, lengths, k) < kTurnsBack) found = k;
  return found;
}

struct Box {
  Vec2 low{1e30, 1e30}, high{-1e30, -1e30};

  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  bool is_near(Vec2 p, double distance) const {
    return p.x > low.x - distance && p.x < high.x + distance && p.y > low.y - distance && p.y < high.y + distance;
  }
};

class Hooks {
 public:
  Hooks(Chains chains, double distance, double longest)
      : chains_(std::move(chains)), boxes_(chains_.chains.size()), distance_(distance), longest_(longest) {
    for (std::size_t c = 0; c < boxes_.size(); ++c)
      for (const Vec2 p : chains_.chains[c].points) boxes_[c].add(p);
  }

  Chains dropped() {
    for (std::size_t c = 0; c < boxes_.size(); ++c) {
      Chain& chain = chains_.chains[c];
      if (chain.closed) continue;
      if (chain.end_junction >= 0) straighten(c);
      if (chain.start_junction < 0) continue;
      std::reverse(chain.points.begin(), chain.points.end());
      straighten(c);
      std::reverse(chain.points.begin(), chain.points.end());
    }
    return std::move(chains_);
  }

 private:
  // The path goes straight to its last point from where it is on the way there, rather than past it and back.
  void straighten(std::size_t chain) {
    std::vector<Vec2>& points = chains_.chains[chain].points;
    if (points.size() < 3) return;
    const Vec2 end = points.back();
    const auto lengths = lengths_along(points);
    const std::size_t turn = hook_at_end(points, lengths, longest_);
    if (turn + 1 == points.size()) return;
    std::size_t foot = turn;
    for (std::size_t k = turn; k-- > 0 && lengths[turn] - lengths[k] <= longest_;)
      if (norm(points[k] - end) < norm(points[foot] - end)) foot = k;
    const double miss = norm(points[foot] - end);
    if (foot == turn || miss > distance_) return;
    if (norm(points[turn] - end) > kBlot * distance_ && !others_cover(chain, points[turn])) return;
    while (foot > 0 && norm(points[foot] - end) < kBlend * miss) --foot;
    points.resize(foot + 1);
    points.push_back(end);
  }

  bool others_cover(std::size_t chain, Vec2 p) const {
    for (std::size_t c = 0; c < boxes_.size(); ++c) {
      if (c == chain || !boxes_[c].is_near(p, distance_)) continue;
      const auto& points = chains_.chains[c].points;
      if (std::any_of(points.begin(), points.end(), [&](Vec2 q) { return norm2(p - q) <= distance_ * distance_; })) return true;
    }
    return false;
  }

  Chains chains_;
  std::vector<Box> boxes_;     // of the chains
  double distance_, longest_;  // px
};

}  // namespace

Chains drop_knots(Chains chains, double slimmed) {
  for (Chain& chain : chains.chains) untie(chain.points, kLongestKnot * (chain.width + slimmed));
  std::erase_if(chains.chains, [&](const Chain& chain) {
    const double pen = chain.width + slimmed;
    return chain.start_junction >= 0 && chain.start_junction == chain.end_junction &&
           std::abs(enclosed_area(chain.points)) < kNoHole * pen * pen;
  });
  return chains;
}

Chains drop_hooks(Chains chains, double distance, double longest) {
  return Hooks(std::move(chains), distance, longest).dropped();
}

Chains drop_needles(Chains chains, double distance, double longest) {
  for (Chain& chain : chains.chains) chain.points = Needles(chain.points, distance, longest).dropped();
  return chains;
}

}  // namespace inkgrid
