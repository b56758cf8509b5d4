#include "refine/ownership.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

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
  around_.reserve(pixels_.size());
  for (const Pixel pixel : pixels_) around_.push_back(around(numbers_.place(pixel.x, pixel.y)));
}

// `place` is that of the corner above on the left.
InkBand::Around InkBand::around(std::size_t place) const {
  Around result{-1, -1, 0};
  const auto row_bits = [&](std::size_t from, int& first) {
    unsigned bits = 0;
    for (unsigned column = 3; column-- > 0;)
      if (const int number = numbers_[from + column]; number >= 0) first = number, bits |= 1U << column;
    return bits;
  };
  const auto width = static_cast<std::size_t>(numbers_.width());
  result.places = row_bits(place, result.above) | row_bits(place + 2 * width, result.below) << kBelow;
  if (numbers_[place + width] >= 0) result.places |= kLeft;
  if (numbers_[place + width + 2] >= 0) result.places |= kRight;
  return result;
}

namespace {

// Spreads the samples over the band, nearer ones driving out farther ones.
class Spread {
 public:
  Spread(const std::vector<Chain>& chains, const InkBand& band)
      : band_(band),
        distances_(band.pixels().size(), std::numeric_limits<double>::infinity()),
        owners_(band.pixels().size(), -1),
        waiting_(band.pixels().size(), 0) {
    queue_.reserve(2 * band.pixels().size());
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
    return std::move(owners_);
  }

 private:
  static double square(double x) { return x * x; }

  void offer_around(int number) {
    waiting_[at(number)] = 0;
    const int s = owners_[at(number)];
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
    double& nearest = distances_[at(number)];
    int& owner = owners_[at(number)];
    if (distance2 > nearest || (distance2 == nearest && s >= owner)) return;
    nearest = distance2;
    owner = s;
    if (!waiting_[at(number)]) queue_.push_back(number);
    waiting_[at(number)] = 1;
  }

  const InkBand& band_;
  std::vector<Vec2> positions_;  // of the samples
  // Per pixel of the band; of the sample nearest to its centre so far:
  std::vector<double> distances_;  // px^2
  std::vector<int> owners_;
  std::vector<std::uint8_t> waiting_;  // in the queue, where the claim may become a better one
  std::vector<int> queue_;             // of pixels of the band
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
