// Sliding windows, against windows looked at one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "base/filters.h"

namespace inkgrid {
namespace {

std::vector<float> random_line(int length, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> line;
  for (int i = 0; i < length; ++i) line.push_back(static_cast<float>(random() % 1000));
  return line;
}

TEST(Filters, ExtremesAreThoseOfEachWindow) {
  for (const int length : {1, 2, 7, 40, 101})
    for (const int radius : {0, 1, 3, 20, 150}) {
      const std::vector<float> line = random_line(length, static_cast<unsigned>(length + radius));
      std::vector<float> largest = line, smallest = line;
      slide_extreme(largest, radius, std::greater<>());
      slide_extreme(smallest, radius, std::less<>());
      for (int i = 0; i < length; ++i) {
        const auto first = line.begin() + std::max(0, i - radius), last = line.begin() + std::min(length, i + radius + 1);
        ASSERT_EQ(largest[at(i)], *std::max_element(first, last)) << length << " " << radius << " " << i;
        ASSERT_EQ(smallest[at(i)], *std::min_element(first, last)) << length << " " << radius << " " << i;
      }
    }
}

TEST(Filters, RowsAndColumnsAreVisitedOnce) {
  Raster<float> raster(37, 21);
  filter_lines(raster, [](std::vector<float>& line) {
    for (std::size_t i = 0; i < line.size(); ++i) line[i] = 100 * line[i] + static_cast<float>(i + 1);
  });
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) ASSERT_EQ(raster(x, y), 100 * (x + 1) + y + 1);
}

// Each pixel knows how many come before it on both of its diagonals.
TEST(Filters, DiagonalsAreVisitedOnce) {
  for (const auto& [w, h] : {std::pair{37, 21}, std::pair{5, 40}, std::pair{1, 3}, std::pair{33, 33}}) {
    Raster<float> raster(w, h);
    filter_diagonals(raster, [](std::vector<float>& line) {
      for (std::size_t i = 0; i < line.size(); ++i) line[i] = 100 * line[i] + static_cast<float>(i + 1);
    });
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) ASSERT_EQ(raster(x, y), 100 * (std::min(x, y) + 1) + std::min(w - 1 - x, y) + 1);
  }
}

}  // namespace
}  // namespace inkgrid
