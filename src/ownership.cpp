#include "ownership.h"

#include <algorithm>
#include <cmath>

namespace inkgrid {

int Ownership::chain_at(Vec2 p) const {
  const int sample = owner.at(p);
  return sample < 0 ? -1 : samples[static_cast<std::size_t>(sample)].chain;
}

namespace {

// Spreads the samples over the band, nearer ones driving out farther ones.
class Spread {
 public:
  Spread(Ownership& result, const std::vector<Chain>& chains, const Ink& ink, double reach)
      : owner_(result.owner), gap_(ink.gap), reach_(static_cast<float>(reach)), waiting_(ink.width(), ink.height()) {
    for (const Chain& chain : chains) positions_.insert(positions_.end(), chain.points.begin(), chain.points.end());
  }

  void run() {
    for (int s = 0; s < static_cast<int>(positions_.size()); ++s) {
      const int x = static_cast<int>(std::floor(position(s).x)), y = static_cast<int>(std::floor(position(s).y));
      if (owner_.contains(x, y)) offer({x, y}, s);
    }
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      const auto [x, y] = queue_[k];
      waiting_(x, y) = 0;
      const int s = owner_(x, y);
      const int left = std::max(0, x - 1), right = std::min(owner_.width() - 1, x + 1);
      for (int v = std::max(0, y - 1); v <= std::min(owner_.height() - 1, y + 1); ++v)
        for (int u = left; u <= right; ++u) offer({u, v}, s);
    }
  }

 private:
  struct Pixel {
    int x, y;
  };

  Vec2 position(int s) const { return positions_[static_cast<std::size_t>(s)]; }

  void offer(Pixel p, int s) {
    const std::size_t place = owner_.place(p.x, p.y);
    const int owner = owner_[place];
    if (owner == s || gap_.data[place] > reach_) return;
    if (owner >= 0) {
      const Vec2 centre{p.x + 0.5, p.y + 0.5};
      const double now = norm2(position(owner) - centre), then = norm2(position(s) - centre);
      if (then > now || (then == now && s > owner)) return;
    }
    owner_.set(place, s);
    if (waiting_.data[place]) return;
    waiting_.data[place] = 1;
    queue_.push_back(p);
  }

  IndexRaster& owner_;
  const Raster<float>& gap_;
  float reach_;
  std::vector<Vec2> positions_;   // of the samples
  Raster<std::uint8_t> waiting_;  // per pixel: 1 in the queue, where what it will be owned by then is written already
  std::vector<Pixel> queue_;
};

}  // namespace

Ownership assign_ink(const std::vector<Chain>& chains, const Ink& ink, double reach) {
  Ownership result;
  result.owner = IndexRaster(ink.width(), ink.height());
  for (int c = 0; c < static_cast<int>(chains.size()); ++c) {
    result.first.push_back(static_cast<int>(result.samples.size()));
    for (int k = 0; k < static_cast<int>(chains[static_cast<std::size_t>(c)].points.size()); ++k)
      result.samples.push_back({c, k});
  }
  Spread(result, chains, ink, reach).run();
  return result;
}

}  // namespace inkgrid
