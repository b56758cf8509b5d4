#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "ink/specks.h"

namespace inkgrid {
namespace {

// The pixels of the hole at (x, y), by spreading to all eight neighbours.
std::vector<std::pair<int, int>> hole_at(int x, int y, const Raster<std::uint8_t>& ink) {
  std::vector<std::pair<int, int>> hole{{x, y}};
  for (std::size_t k = 0; k < hole.size(); ++k)
    for (int j = hole[k].second - 1; j <= hole[k].second + 1; ++j)
      for (int i = hole[k].first - 1; i <= hole[k].first + 1; ++i)
        if (ink.contains(i, j) && !ink(i, j) && std::find(hole.begin(), hole.end(), std::pair(i, j)) == hole.end())
          hole.emplace_back(i, j);
  return hole;
}

// Per pixel the distance to the nearest paper, by looking at all of it.
Raster<float> depth_slowly(const Raster<std::uint8_t>& ink) {
  Raster<float> depth(ink.width, ink.height);
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x) {
      double least = std::numeric_limits<double>::infinity();
      for (int j = 0; j < ink.height; ++j)
        for (int i = 0; i < ink.width; ++i)
          if (!ink(i, j)) least = std::min(least, std::hypot(i - x, j - y));
      depth(x, y) = static_cast<float>(least);
    }
  return depth;
}

// The greatest in the box around the hole, widened by `margin`.
float greatest_around(const std::vector<std::pair<int, int>>& hole, int margin, const Raster<float>& depth) {
  const auto [left, right] = std::ranges::minmax(hole, {}, &std::pair<int, int>::first);
  const auto [top, bottom] = std::ranges::minmax(hole, {}, &std::pair<int, int>::second);
  float most = 0;
  for (int y = top.second - margin; y <= bottom.second + margin; ++y)
    for (int x = left.first - margin; x <= right.first + margin; ++x)
      if (depth.contains(x, y)) most = std::max(most, depth(x, y));
  return most;
}

Raster<std::uint8_t> closed_slowly(const Raster<std::uint8_t>& ink) {
  Raster<std::uint8_t> without = ink, closed = ink;
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x)
      if (!ink(x, y) && hole_at(x, y, ink).size() <= 100) without(x, y) = 1;
  const Raster<float> depth = depth_slowly(ink), deepest = depth_slowly(without);
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x) {
      if (ink(x, y) || !without(x, y)) continue;
      const auto hole = hole_at(x, y, ink);
      const float width = std::sqrt(static_cast<float>(hole.size()));
      const bool deep = std::any_of(hole.begin(), hole.end(), [&](auto p) { return deepest(p.first, p.second) > 3 * width; });
      closed(x, y) = deep && greatest_around(hole, static_cast<int>(2 * width), depth) > width;
    }
  return closed;
}

// Discs of ink on paper, and holes of all sizes in them.
Raster<std::uint8_t> random_ink(std::mt19937& random, int width, int height) {
  Raster<std::uint8_t> ink(width, height);
  std::uniform_int_distribution<int> column(0, width - 1), row(0, height - 1), large(4, 14), small(0, 6);
  const auto disc = [&](int radius, std::uint8_t value) {
    const int x = column(random), y = row(random);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        if (std::hypot(i - x, j - y) <= radius) ink(i, j) = value;
  };
  for (int k = 0; k < 6; ++k) disc(large(random), 1);
  for (int k = 0; k < 12; ++k) disc(small(random) / 2, 0);
  return ink;
}

TEST(Specks, AreThoseThatSpreadingFinds) {
  std::mt19937 random(1);
  int closed_pixels = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const auto ink = random_ink(random, 30 + trial % 7, 25 + trial % 5);
    const auto closed = close_specks(ink);
    EXPECT_EQ(closed.data, closed_slowly(ink).data) << trial;
    closed_pixels +=
        static_cast<int>(std::count(closed.data.begin(), closed.data.end(), 1) - std::count(ink.data.begin(), ink.data.end(), 1));
  }
  EXPECT_GT(closed_pixels, 10) << "no speck in all these";
}

TEST(Specks, PaperOrInkAloneStays) {
  for (const auto value : {std::uint8_t{0}, std::uint8_t{1}}) {
    const Raster<std::uint8_t> ink(40, 30, value);
    EXPECT_EQ(close_specks(ink).data, ink.data);
  }
}

TEST(Specks, TheSheetOfATinyDrawingIsNone) {
  for (const int side : {1, 2, 8}) {
    Raster<std::uint8_t> ink(side, side);
    for (int i = 2; i < side; ++i) ink(i, i) = 1;
    EXPECT_EQ(close_specks(ink).data, ink.data) << side;
  }
}

TEST(Specks, TheCellsOfAHatchingAreNone) {
  Raster<std::uint8_t> ink(90, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 90; ++x) ink(x, y) = x % 10 < 3 || y % 10 < 3;
  EXPECT_EQ(close_specks(ink).data, ink.data);
}

}  // namespace
}  // namespace inkgrid
