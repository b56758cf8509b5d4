#include "ownership.h"

#include <cmath>
#include <deque>

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
      : result_(result), chains_(chains), ink_(ink), reach_(static_cast<float>(reach)) {}

  void run() {
    for (int s = 0; s < static_cast<int>(result_.samples.size()); ++s) {
      const Vec2 p = position(s);
      offer(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)), s);
    }
    while (!queue_.empty()) {
      const auto i = queue_.front();
      queue_.pop_front();
      const auto w = static_cast<std::size_t>(ink_.width());
      const int x = static_cast<int>(i % w), y = static_cast<int>(i / w), s = result_.owner.data[i];
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) offer(x + dx, y + dy, s);
    }
  }

 private:
  Vec2 position(int s) const {
    const auto& sample = result_.samples[static_cast<std::size_t>(s)];
    return chains_[static_cast<std::size_t>(sample.chain)].points[static_cast<std::size_t>(sample.point)];
  }

  void offer(int x, int y, int s) {
    if (!ink_.gap.contains(x, y) || ink_.gap(x, y) > reach_) return;
    int& owner = result_.owner(x, y);
    const Vec2 centre{x + 0.5, y + 0.5};
    if (owner >= 0) {
      const double now = norm2(position(owner) - centre), then = norm2(position(s) - centre);
      if (then > now || (then == now && s >= owner)) return;
    }
    owner = s;
    queue_.push_back(result_.owner.index(x, y));
  }

  Ownership& result_;
  const std::vector<Chain>& chains_;
  const Ink& ink_;
  float reach_;
  std::deque<std::size_t> queue_;
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
