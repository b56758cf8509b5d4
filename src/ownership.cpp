#include "ownership.h"

#include <algorithm>
#include <cmath>

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
      : owner_(result.owner), state_(static_cast<std::size_t>(ink.width()) * static_cast<std::size_t>(ink.height()), kOutside) {
    for (const Chain& chain : chains) positions_.insert(positions_.end(), chain.points.begin(), chain.points.end());
    for (std::size_t i = 0; i < state_.size(); ++i)
      if (ink.gap.data[i] <= static_cast<float>(reach)) state_[i] = kSettled;
  }

  void run() {
    for (int s = 0; s < static_cast<int>(positions_.size()); ++s) {
      const int x = static_cast<int>(std::floor(position(s).x)), y = static_cast<int>(std::floor(position(s).y));
      if (owner_.contains(x, y)) offer({x, y}, s);
    }
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      const auto [x, y] = queue_[k];
      state_[place({x, y})] = kSettled;
      const int s = owner_(x, y);
      const int left = std::max(0, x - 1), right = std::min(owner_.width - 1, x + 1);
      for (int v = std::max(0, y - 1); v <= std::min(owner_.height - 1, y + 1); ++v)
        for (int u = left; u <= right; ++u) offer({u, v}, s);
    }
  }

 private:
  struct Pixel {
    int x, y;
  };
  enum State : std::uint8_t { kOutside, kSettled, kWaiting };  // waiting: in the queue, with what will be its owner by then

  Vec2 position(int s) const { return positions_[static_cast<std::size_t>(s)]; }
  std::size_t place(Pixel p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(owner_.width) + static_cast<std::size_t>(p.x);
  }

  void offer(Pixel p, int s) {
    std::uint8_t& state = state_[place(p)];
    if (state == kOutside) return;
    int& owner = owner_.data[place(p)];
    if (owner == s) return;
    if (owner >= 0) {
      const Vec2 centre{p.x + 0.5, p.y + 0.5};
      const double now = norm2(position(owner) - centre), then = norm2(position(s) - centre);
      if (then > now || (then == now && s > owner)) return;
    }
    owner = s;
    if (state == kWaiting) return;
    state = kWaiting;
    queue_.push_back(p);
  }

  Raster<int>& owner_;
  std::vector<Vec2> positions_;  // of the samples
  std::vector<std::uint8_t> state_;
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
