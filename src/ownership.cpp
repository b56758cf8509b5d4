#include "ownership.h"

#include <cmath>
#include <utility>

#include "base/sample.h"

namespace inkgrid {

int Ownership::chain_at(Vec2 p) const {
  const int sample = nearest(owner, p, -1);
  return sample < 0 ? -1 : samples[static_cast<std::size_t>(sample)].chain;
}

namespace {

// Spreads the samples over the band, nearer ones driving out farther ones.
class Spread {
 public:
  Spread(Ownership& result, const std::vector<Chain>& chains, const Ink& ink, double reach)
      : result_(result), ink_(ink), reach_(static_cast<float>(reach)), waiting_(ink.width(), ink.height(), 0) {
    for (const Chain& chain : chains) positions_.insert(positions_.end(), chain.points.begin(), chain.points.end());
  }

  void run() {
    for (int s = 0; s < static_cast<int>(result_.samples.size()); ++s) {
      const Vec2 p = positions_[static_cast<std::size_t>(s)];
      offer(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)), s);
    }
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      const auto [x, y] = queue_[k];
      waiting_(x, y) = 0;
      const int s = result_.owner(x, y);
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) offer(x + dx, y + dy, s);
    }
  }

 private:
  struct Pixel {
    int x, y;
  };

  void offer(int x, int y, int s) {
    if (!ink_.gap.contains(x, y) || ink_.gap(x, y) > reach_) return;
    int& owner = result_.owner(x, y);
    if (owner == s) return;
    if (owner >= 0) {
      const Vec2 centre{x + 0.5, y + 0.5};
      const double now = norm2(positions_[static_cast<std::size_t>(owner)] - centre),
                   then = norm2(positions_[static_cast<std::size_t>(s)] - centre);
      if (then > now || (then == now && s > owner)) return;
    }
    owner = s;
    if (!std::exchange(waiting_(x, y), std::uint8_t{1})) queue_.push_back({x, y});
  }

  Ownership& result_;
  std::vector<Vec2> positions_;  // of the samples
  const Ink& ink_;
  float reach_;
  Raster<std::uint8_t> waiting_;  // in the queue, with what will be its owner by then
  std::vector<Pixel> queue_;
};

}  // namespace

Ownership assign_ink(const std::vector<Chain>& chains, const Ink& ink, double reach) {
  Ownership result;
  result.owner = Raster<int>(ink.width(), ink.height(), -1);
  for (int c = 0; c < static_cast<int>(chains.size()); ++c) {
    result.first.push_back(static_cast<int>(result.samples.size()));
    for (int k = 0; k < static_cast<int>(chains[static_cast<std::size_t>(c)].points.size()); ++k)
      result.samples.push_back({c, k});
  }
  Spread(result, chains, ink, reach).run();
  return result;
}

}  // namespace inkgrid
