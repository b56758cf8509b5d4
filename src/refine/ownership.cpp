#include "refine/ownership.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/at.h"
#include "base/sample.h"

namespace inkgrid {

namespace {

// Calls visit(x) for the places of a row where the distance to the ink is at most `farthest`; it is more nearly everywhere.
template <class Visit>
void for_each_near(const float* gaps, int width, float farthest, const Visit& visit) {
  constexpr int kBlock = 16;
  for (int first = 0; first < width; first += kBlock) {
    const int end = std::min(width, first + kBlock);
    int near = 0;
    if (end - first == kBlock)
      for (int k = 0; k < kBlock; ++k) near += gaps[first + k] <= farthest;
    else
      near = 1;
    for (int x = first; x < end && near > 0; ++x)
      if (gaps[x] <= farthest) visit(x);
  }
}

}  // namespace

InkBand::InkBand(const Ink& ink, double reach) : numbers_(ink.width() + 2, ink.height() + 2) {
  const auto farthest = static_cast<float>(reach);
  const int width = ink.width();
  for (int y = 0; y < ink.height(); ++y) {
    const float* const gaps = &ink.gap(0, y);
    const std::size_t row = numbers_.place(1, y + 1);
    for_each_near(gaps, width, farthest, [&](int x) {
      numbers_.set(row + static_cast<std::size_t>(x), static_cast<int>(pixels_.size()));
      pixels_.push_back({x, y});
    });
  }
}

namespace {

// Spreads the samples over the band, nearer ones driving out farther ones.
class Spread {
 public:
  Spread(const std::vector<Chain>& chains, const InkBand& band) : band_(band), claims_(band.pixels().size()) {
    for (const Chain& chain : chains) positions_.insert(positions_.end(), chain.points.begin(), chain.points.end());
  }

  // Per pixel of the band the nearest sample.
  std::vector<int> run() {
    for (int s = 0; s < static_cast<int>(positions_.size()); ++s) {
      const Vec2 from = positions_[at(s)];
      const int x = floor_of(from.x), y = floor_of(from.y), number = band_.number(x, y);
      if (number >= 0) offer(number, square(from.x - (x + 0.5)) + square(from.y - (y + 0.5)), s);
    }
    for (std::size_t k = 0; k < queue_.size(); ++k) offer_around(queue_[k]);
    std::vector<int> owners;
    owners.reserve(claims_.size());
    for (const Claim& claim : claims_) owners.push_back(claim.sample);
    return owners;
  }

 private:
  // The sample nearest to the centre of a pixel so far.
  struct Claim {
    double distance2 = std::numeric_limits<double>::infinity();  // px^2
    int sample = -1;
    bool waiting = false;  // in the queue, where the claim may become a better one
  };

  static double square(double x) { return x * x; }

  void offer_around(int number) {
    Claim& own = claims_[at(number)];
    own.waiting = false;
    const int s = own.sample;
    const Vec2 from = positions_[at(s)];
    const InkBand::Pixel pixel = band_.pixels()[at(number)];
    std::array<double, 3> across, along;
    for (std::size_t k = 0; k < 3; ++k) {
      across[k] = square(from.x - (pixel.x - 0.5 + static_cast<double>(k)));
      along[k] = square(from.y - (pixel.y - 0.5 + static_cast<double>(k)));
    }
    band_.for_each_around(number,
                          [&](int other, std::size_t column, std::size_t row) { offer(other, across[column] + along[row], s); });
  }

  // The smaller number where two samples are as near.
  void offer(int number, double distance2, int s) {
    Claim& claim = claims_[at(number)];
    if (distance2 > claim.distance2 || (distance2 == claim.distance2 && s >= claim.sample)) return;
    claim.distance2 = distance2;
    claim.sample = s;
    if (!claim.waiting) queue_.push_back(number);
    claim.waiting = true;
  }

  const InkBand& band_;
  std::vector<Vec2> positions_;  // of the samples
  std::vector<Claim> claims_;    // per pixel of the band
  std::vector<int> queue_;       // of pixels of the band
};

}  // namespace

Ownership assign_ink(const std::vector<Chain>& chains, const InkBand& band) {
  Ownership result{band, {}, {}, Spread(chains, band).run()};
  for (int c = 0; c < static_cast<int>(chains.size()); ++c) {
    result.first.push_back(static_cast<int>(result.samples.size()));
    for (int k = 0; k < static_cast<int>(chains[at(c)].points.size()); ++k) result.samples.push_back({c, k});
  }
  return result;
}

}  // namespace inkgrid
