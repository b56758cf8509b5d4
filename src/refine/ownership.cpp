#include "refine/ownership.h"

#include <algorithm>
#include <array>
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
  Spread(const std::vector<Chain>& chains, const Ink& ink, double reach)
      : gap_(ink.gap), reach_(static_cast<float>(reach)), claim_(ink.width(), ink.height()) {
    for (const Chain& chain : chains) positions_.insert(positions_.end(), chain.points.begin(), chain.points.end());
  }

  // Per pixel the nearest sample.
  IndexRaster run() {
    for (int s = 0; s < static_cast<int>(positions_.size()); ++s) {
      const Vec2 from = position(s);
      const int x = static_cast<int>(std::floor(from.x)), y = static_cast<int>(std::floor(from.y));
      if (claim_.contains(x, y)) offer({x, y}, square(from.x - (x + 0.5)) + square(from.y - (y + 0.5)), s);
    }
    for (std::size_t k = 0; k < queue_.size(); ++k) offer_around(queue_[k]);
    for (const Claim& claim : claims_) claim_.set(claim.pixel.x, claim.pixel.y, claim.sample);
    return std::move(claim_);
  }

 private:
  struct Pixel {
    int x, y;
  };
  // The sample nearest to the centre of a pixel so far.
  struct Claim {
    double distance2;  // px^2
    int sample;
    bool waiting;  // in the queue, where the claim may become a better one
    Pixel pixel;
  };

  Vec2 position(int s) const { return positions_[static_cast<std::size_t>(s)]; }
  static double square(double x) { return x * x; }

  void offer_around(int claim) {
    claims_[static_cast<std::size_t>(claim)].waiting = false;
    const auto [x0, y0] = claims_[static_cast<std::size_t>(claim)].pixel;
    const int s = claims_[static_cast<std::size_t>(claim)].sample;
    const Vec2 from = position(s);
    const int left = std::max(0, x0 - 1), right = std::min(claim_.width() - 1, x0 + 1);
    std::array<double, 3> across;
    for (int x = left; x <= right; ++x) across[static_cast<std::size_t>(x - left)] = square(from.x - (x + 0.5));
    for (int y = std::max(0, y0 - 1); y <= std::min(claim_.height() - 1, y0 + 1); ++y) {
      const double along = square(from.y - (y + 0.5));
      for (int x = left; x <= right; ++x) offer({x, y}, across[static_cast<std::size_t>(x - left)] + along, s);
    }
  }

  // The smaller number where two samples are as near.
  void offer(Pixel p, double distance2, int s) {
    const std::size_t place = claim_.place(p.x, p.y);
    const int index = claim_[place];
    if (index < 0) {
      if (gap_.data[place] > reach_) return;
      claim_.set(place, static_cast<int>(claims_.size()));
      queue_.push_back(static_cast<int>(claims_.size()));
      claims_.push_back({distance2, s, true, p});
      return;
    }
    Claim& claim = claims_[static_cast<std::size_t>(index)];
    if (distance2 > claim.distance2 || (distance2 == claim.distance2 && s >= claim.sample)) return;
    claim.distance2 = distance2;
    claim.sample = s;
    if (!claim.waiting) queue_.push_back(index);
    claim.waiting = true;
  }

  const Raster<float>& gap_;
  float reach_;
  std::vector<Vec2> positions_;  // of the samples
  IndexRaster claim_;            // per pixel: index of its claim
  std::vector<Claim> claims_;
  std::vector<int> queue_;  // of claims
};

}  // namespace

Ownership assign_ink(const std::vector<Chain>& chains, const Ink& ink, double reach) {
  Ownership result;
  for (int c = 0; c < static_cast<int>(chains.size()); ++c) {
    result.first.push_back(static_cast<int>(result.samples.size()));
    for (int k = 0; k < static_cast<int>(chains[static_cast<std::size_t>(c)].points.size()); ++k)
      result.samples.push_back({c, k});
  }
  result.owner = Spread(chains, ink, reach).run();
  return result;
}

}  // namespace inkgrid
