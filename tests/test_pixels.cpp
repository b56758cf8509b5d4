#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "base/index_raster.h"

namespace inkgrid {
namespace {

constexpr std::size_t kFew = 1000, kMany = std::size_t{16} << 20;

// Memory that the process holds, bytes.
std::size_t held() {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word && word != "VmRSS:") {
  }
  std::size_t kilobytes = 0;
  file >> kilobytes;
  return 1024 * kilobytes;
}

class Sizes : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Sizes, AreZeroUntilTheyAreWritten) {
  Pixels<float> pixels(GetParam());
  ASSERT_EQ(pixels.size(), GetParam());
  pixels[GetParam() / 2] = 2.5F;
  float sum = 0;
  for (const float value : pixels) sum += value;
  EXPECT_EQ(sum, 2.5F);
}

TEST_P(Sizes, CopiesHoldTheSameAndAreApart) {
  Pixels<std::uint16_t> pixels(GetParam());
  for (std::size_t i = 0; i < pixels.size(); i += 7777) pixels[i] = static_cast<std::uint16_t>(i % 1000 + 1);
  pixels[pixels.size() - 1] = 9;
  Pixels<std::uint16_t> copy = pixels;
  EXPECT_EQ(copy, pixels);
  copy[1] = 5;
  EXPECT_EQ(pixels[1], 0);
  copy = Pixels<std::uint16_t>(3, 4);
  EXPECT_EQ(copy.size(), 3u);
  EXPECT_EQ(copy[2], 4);
  const Pixels<std::uint16_t> moved = std::move(pixels);
  EXPECT_EQ(moved[moved.size() - 1], 9);
  EXPECT_TRUE(pixels.empty());  // NOLINT: that it is
}

INSTANTIATE_TEST_SUITE_P(Pixels, Sizes, ::testing::Values(kFew, kMany));

TEST(Pixels, WhatIsNotWrittenTakesNoMemory) {
  const std::size_t before = held();
  Pixels<float> pixels(kMany);
  for (std::size_t i = 0; i < 10; ++i) pixels[i * kMany / 10] = 1;
  const Pixels<float> copy = pixels;
  double sum = 0;
  for (const float value : copy) sum += static_cast<double>(value);
  EXPECT_EQ(sum, 10);
  EXPECT_LT(held(), before + kMany * sizeof(float) / 10);
}

TEST(IndexRaster, HoldsNoneUntilItIsSet) {
  IndexRaster indices(3, 2);
  indices.set(1, 1, 0);
  indices.set(indices.place(2, 0), 7);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const int expected = x == 1 && y == 1 ? 0 : x == 2 && y == 0 ? 7 : -1;
      EXPECT_EQ(indices(x, y), expected);
      EXPECT_EQ(indices.at({x + 0.5, y + 0.5}), expected);
    }
  EXPECT_EQ(indices.at({-0.5, 0.5}), -1);
}

}  // namespace
}  // namespace inkgrid
