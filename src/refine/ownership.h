// What:   for each pixel of ink, the chain that it is nearest to, and where on it.
// Source: section 6.3, "we assign each stroke pixel to the nearest chain".
// Differs: distances go from pixel to pixel, so a chain does not own ink that it cannot be reached from.
// Cost:   linear in the pixels of ink.
#pragma once

#include <vector>

#include "base/at.h"
#include "base/index_raster.h"
#include "graph/chains.h"

namespace inkgrid {

// The pixels of the ink and those nearer than `reach` px to it, numbered row by row.
class InkBand {
 public:
  struct Pixel {
    int x, y;
  };

  InkBand(const Ink& ink, double reach);

  const std::vector<Pixel>& pixels() const { return pixels_; }
  int number(int x, int y) const { return numbers_.contains(x + 1, y + 1) ? numbers_(x + 1, y + 1) : -1; }  // -1 off the band

  // Calls visit(number, column, row) for pixels of the band among the 3 x 3 around one of it, which are columns and rows 0 to 2.
  template <class Visit>
  void for_each_around(int number, const Visit& visit) const {
    const Pixel centre = pixels_[at(number)];
    std::size_t place = numbers_.place(centre.x, centre.y);
    for (std::size_t row = 0; row < 3; ++row, place += static_cast<std::size_t>(numbers_.width()))
      for (std::size_t column = 0; column < 3; ++column)
        if (const int other = numbers_[place + column]; other >= 0) visit(other, column, row);
  }

 private:
  std::vector<Pixel> pixels_;
  IndexRaster numbers_;  // with a margin of one pixel
};

// Where a sample of a chain stands: chain index and index of its point.
struct ChainSample {
  int chain = -1;
  int point = -1;
};

struct Ownership {
  const InkBand& band;
  std::vector<ChainSample> samples;  // all points of all chains, in order
  std::vector<int> first;            // per chain: its first sample
  std::vector<int> owners;           // per pixel of the band: the nearest sample, -1 where no chain gets

  // Of any pixel.
  int owner(int x, int y) const {
    const int number = band.number(x, y);
    return number < 0 ? -1 : owners[at(number)];
  }
};

// `band` must live as long as the result.
Ownership assign_ink(const std::vector<Chain>& chains, const InkBand& band);

}  // namespace inkgrid
