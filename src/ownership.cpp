#include "ownership.h"

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
  Spread(Ownership& result, const std::vector<Chain>& chains, const Ink& ink, double reach)
      : owner_(result.owner), gap_(ink.gap), reach_(static_cast<float>(reach)), claims_(ink.width(), ink.height()) {
    for (const Chain& chain : chains) positions_.insert(positions_.end(), chain.points.begin(), chain.points.end());
  }

  void run() {
    for (int s = 0; s < static_cast<int>(positions_.size()); ++s) {
      const int x = static_cast<int>(std::floor(position(s).x)), y = static_cast<int>(std::floor(position(s).y));
      if (!claims_.contains(x, y)) continue;
      const double distance2 = square(position(s).x - (x + 0.5)) + square(position(s).y - (y + 0.5));
      if (is_better(distance2, s + 1, claims_(x, y))) take({x, y}, distance2, s + 1);
    }
    for (std::size_t k = 0; k < queue_.size(); ++k) offer_around(queue_[k]);
  }

 private:
  struct Pixel {
    int x, y;
  };
  // Of a pixel: the sample nearest to its centre so far.
  struct Claim {
    double distance2 = 0;  // px^2
    int number = 0;        // of the sample, from 1; 0: none
    int waiting = 0;       // 1 in the queue, where the claim may become a better one

    friend bool operator==(const Claim&, const Claim&) = default;
  };

  Vec2 position(int s) const { return positions_[static_cast<std::size_t>(s)]; }

  void offer_around(Pixel p) {
    claims_(p.x, p.y).waiting = 0;
    const int number = claims_(p.x, p.y).number;
    const Vec2 from = position(number - 1);
    const int left = std::max(0, p.x - 1), right = std::min(claims_.width - 1, p.x + 1);
    std::array<double, 3> across;
    for (int x = left; x <= right; ++x) across[static_cast<std::size_t>(x - left)] = square(from.x - (x + 0.5));
    for (int y = std::max(0, p.y - 1); y <= std::min(claims_.height - 1, p.y + 1); ++y) {
      const double along = square(from.y - (y + 0.5));
      const Claim* const row = &claims_(left, y);
      for (int x = left; x <= right; ++x) {
        const double distance2 = across[static_cast<std::size_t>(x - left)] + along;
        if (is_better(distance2, number, row[x - left])) take({x, y}, distance2, number);
      }
    }
  }

  static double square(double x) { return x * x; }

  // The smaller number where two are as near.
  static bool is_better(double distance2, int number, const Claim& claim) {
    return distance2 < claim.distance2 || (distance2 == claim.distance2 && number < claim.number) || claim.number == 0;
  }

  void take(Pixel p, double distance2, int number) {
    const std::size_t place = claims_.index(p.x, p.y);
    if (gap_.data[place] > reach_) return;
    Claim& claim = claims_.data[place];
    claim.distance2 = distance2;
    claim.number = number;
    owner_.set(place, number - 1);
    if (claim.waiting) return;
    claim.waiting = 1;
    queue_.push_back(p);
  }

  IndexRaster& owner_;
  const Raster<float>& gap_;
  float reach_;
  std::vector<Vec2> positions_;  // of the samples
  Raster<Claim> claims_;
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
