// What:   for each pixel of ink, the chain that it is nearest to, and where on it.
// Source: section 6.3, "we assign each stroke pixel to the nearest chain".
// Differs: distances go from pixel to pixel, so a chain does not own ink that it cannot be reached from.
// Cost:   linear in the pixels of ink.
#pragma once

#include <map>
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

  // Calls visit(number, column, row) for pixels of the band beside one of it, row by row: columns and rows 0 to 2 of the 3 x 3
  // around it.
  template <class Visit>
  void for_each_around(int number, const Visit& visit) const {
    const Around& around = around_[at(number)];
    if (around.places == kAll) {
      for (std::size_t k = 0; k < 3; ++k) visit(around.above + static_cast<int>(k), k, std::size_t{0});
      visit(number - 1, std::size_t{0}, std::size_t{1});
      visit(number + 1, std::size_t{2}, std::size_t{1});
      for (std::size_t k = 0; k < 3; ++k) visit(around.below + static_cast<int>(k), k, std::size_t{2});
      return;
    }
    visit_row(around.above, around.places, 0, visit);
    if (around.places & kLeft) visit(number - 1, std::size_t{0}, std::size_t{1});
    if (around.places & kRight) visit(number + 1, std::size_t{2}, std::size_t{1});
    visit_row(around.below, around.places >> kBelow, 2, visit);
  }

 private:
  // Which places around a pixel belong to the band: three bits for the row above, two for those beside, three for the row below.
  // Those of a row have consecutive numbers.
  struct Around {
    int above, below;  // the first number in the row
    unsigned places;
  };
  static constexpr unsigned kLeft = 8, kRight = 16, kAll = 255;
  static constexpr int kBelow = 5;

  template <class Visit>
  static void visit_row(int first, unsigned places, std::size_t row, const Visit& visit) {
    if (places & 1) visit(first++, std::size_t{0}, row);
    if (places & 2) visit(first++, std::size_t{1}, row);
    if (places & 4) visit(first, std::size_t{2}, row);
  }

  Around around(std::size_t place) const;

  std::vector<Pixel> pixels_;
  std::vector<Around> around_;
  IndexRaster numbers_;  // with a margin of one pixel
};

// The bands of some ink, each built when it is first asked for; not for several threads at once.
class InkBands {
 public:
  InkBands(const Ink& ink) : ink_(ink) {}  // implicit, for what is done once

  const Ink& ink() const { return ink_; }
  const InkBand& of(double reach) const { return bands_.try_emplace(reach, ink_, reach).first->second; }

 private:
  const Ink& ink_;
  mutable std::map<double, InkBand> bands_;  // by reach, px
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
