#include "needles.h"

#include <algorithm>

#include "polyline.h"

namespace inkgrid {
namespace {

constexpr double kTurnsBack = -0.5;  // cosine of the turn
constexpr double kSide = 0.75;       // px to either side of a turn

class Needles {
 public:
  Needles(const std::vector<Vec2>& points, double distance, double longest)
      : points_(points), lengths_(lengths_along(points)), distance2_(distance * distance), longest_(longest) {
    double sharpest = kTurnsBack;
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      const double cosine = cosine_at(k);
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

  double cosine_at(std::size_t k) const {
    std::size_t before = k - 1, after = k + 1;
    while (before > 0 && lengths_[k] - lengths_[before] < kSide) --before;
    while (after + 1 < points_.size() && lengths_[after] - lengths_[k] < kSide) ++after;
    return dot(unit(points_[k] - points_[before]), unit(points_[after] - points_[k]));
  }

  // The last turn that may follow this one right away; or this one.
  std::size_t farthest_return(std::size_t turn) const {
    const std::size_t first = turns_[turn];
    std::size_t found = first;
    for (std::size_t t = turn + 1; t < turns_.size() && lengths_[turns_[t]] - lengths_[first] <= longest_; ++t)
      if (norm2(points_[turns_[t]] - points_[first]) <= distance2_ && rest_covers(first, turns_[t])) found = turns_[t];
    return found;
  }

  bool rest_covers(std::size_t first, std::size_t last) const {
    return std::all_of(at(first), at(last + 1), [&](Vec2 p) {
      const auto near = [&](Vec2 q) { return norm2(p - q) <= distance2_; };
      return std::any_of(points_.begin(), at(first + 1), near) || std::any_of(at(last + 1), points_.end(), near);
    });
  }

  const std::vector<Vec2>& points_;
  std::vector<double> lengths_;
  double distance2_, longest_;  // px^2, px
  std::vector<std::size_t> turns_;
};

}  // namespace

Chains drop_needles(Chains chains, double distance, double longest) {
  for (Chain& chain : chains.chains) chain.points = Needles(chain.points, distance, longest).dropped();
  return chains;
}

}  // namespace inkgrid
