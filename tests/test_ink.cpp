#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "drawn_bands.h"
#include "ink/ink.h"

namespace inkgrid {
namespace {

using Mask = Raster<std::uint8_t>;

Mask random_mask(int width, int height, double part, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution ink(part);
  Mask mask(width, height);
  for (auto& m : mask.data) m = ink(random);
  return mask;
}

Ink measured(const Mask& mask) {
  Binarisation binarisation;
  binarisation.ink = mask;
  binarisation.darkness = Raster<float>(mask.width, mask.height);
  std::copy(mask.data.begin(), mask.data.end(), binarisation.darkness.data.begin());
  return measure_ink(binarisation);
}

// The ink of the rows in [first, last), over the whole width.
Mask rows(int width, int height, std::vector<std::pair<int, int>> bands) {
  Mask mask(width, height, 0);
  for (const auto& [first, last] : bands)
    for (int y = first; y < last; ++y)
      for (int x = 0; x < width; ++x) mask(x, y) = 1;
  return mask;
}

// The least distance(dx, dy) from (x, y) to a pixel of this value.
template <class Distance>
double nearest_pixel(const Mask& mask, int x, int y, int value, Distance distance) {
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < mask.height; ++j)
    for (int i = 0; i < mask.width; ++i)
      if (mask(i, j) == value) least = std::min(least, distance(i - x, j - y));
  return least;
}

struct RandomMask {
  int width, height;
  double part;

  friend void PrintTo(const RandomMask& m, std::ostream* out) { *out << m.width << "x" << m.height << ", " << m.part << " ink"; }
};

class RandomMasks : public ::testing::TestWithParam<RandomMask> {
 protected:
  Mask mask(unsigned seed) const { return random_mask(GetParam().width, GetParam().height, GetParam().part, seed); }
};

TEST_P(RandomMasks, DepthIsTheL1DistanceToTheNearestPaper) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Ink ink = measured(mask(seed));
    if (ink.pixels == 0) continue;
    for (int y = 0; y < ink.height(); ++y)
      for (int x = 0; x < ink.width(); ++x) {
        const double expected =
            nearest_pixel(ink.mask, x, y, 0, [](int dx, int dy) { return static_cast<double>(std::abs(dx) + std::abs(dy)); });
        if (std::isfinite(expected))
          ASSERT_EQ(ink.depth(x, y), expected) << x << ' ' << y;
        else
          ASSERT_GT(ink.depth(x, y), ink.width() + ink.height());
      }
  }
}

TEST_P(RandomMasks, DistanceToIsEuclidean) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Mask m = mask(seed);
    const Raster<float> distance = distance_to(m);
    for (int y = 0; y < m.height; ++y)
      for (int x = 0; x < m.width; ++x) {
        const double expected = nearest_pixel(m, x, y, 1, [](int dx, int dy) { return std::hypot(dx, dy); });
        if (std::isfinite(expected))
          ASSERT_NEAR(static_cast<double>(distance(x, y)), expected, 1e-5 * (1 + expected)) << x << ' ' << y;
        else
          ASSERT_GT(distance(x, y), static_cast<float>(m.width + m.height));
      }
  }
}

TEST_P(RandomMasks, CentreDistanceIsNoughtWhereNothingNearIsDeeperAndOneOnPaper) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Ink ink = measured(mask(seed));
    if (ink.pixels == 0) continue;
    for (int y = 0; y < ink.height(); ++y)
      for (int x = 0; x < ink.width(); ++x) {
        int deepest = 0;
        for (int j = std::max(0, y - 1); j <= std::min(ink.height() - 1, y + 1); ++j)
          for (int i = std::max(0, x - 1); i <= std::min(ink.width() - 1, x + 1); ++i)
            deepest = std::max<int>(deepest, ink.depth(i, j));
        const float d = ink.centre_distance(x, y);
        ASSERT_GE(d, 0.0f);
        ASSERT_LE(d, 1.0f);
        if (!ink.mask(x, y))
          ASSERT_EQ(d, 1.0f);
        else if (deepest == ink.depth(x, y))
          ASSERT_EQ(d, 0.0f) << x << ' ' << y;
        else
          ASSERT_GT(d, 0.0f) << x << ' ' << y;
      }
  }
}

// More rows than are looked at together.
TEST(Ink, ClosingATallDrawingIsThatOfItsParts) {
  constexpr int kWidth = 6, kHeight = 700;
  constexpr double kRadius = 3;
  const Ink ink = measured(random_mask(kWidth, kHeight, 0.02, 4));
  const Mask closed = closed_ink(ink, kRadius);
  for (int y = 50; y + 50 < kHeight; ++y) {
    Mask part(kWidth, 81);
    for (int j = 0; j < part.height; ++j)
      for (int x = 0; x < kWidth; ++x) part(x, j) = ink.mask(x, std::clamp(y + j - 40, 0, kHeight - 1));
    const Mask closed_part = closed_ink(measured(part), kRadius);
    for (int x = 0; x < kWidth; ++x) ASSERT_EQ(closed(x, y), closed_part(x, 40)) << x << ' ' << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Ink, RandomMasks,
                         ::testing::Values(RandomMask{31, 23, 0.5}, RandomMask{31, 23, 0.97}, RandomMask{31, 23, 0.02},
                                           RandomMask{1, 40, 0.8}, RandomMask{40, 1, 0.2}, RandomMask{24, 24, 0}));

TEST(Ink, StrokeWidthOfALineIsTwiceTheDepthOfItsMiddle) {
  for (int width = 1; width <= 12; ++width) {
    const Ink ink = measured(rows(50, 40, {{10, 10 + width}}));
    EXPECT_DOUBLE_EQ(ink.stroke_width, 2 * ((width + 1) / 2)) << width;
    EXPECT_EQ(ink.pixels, 50 * width);
  }
}

TEST(Ink, StrokeWidthAveragesOverTheCentrePixels) {
  // One row of middle pixels of depth 1, two of depth 2: (2 + 4 + 4) / 3.
  const Ink ink = measured(rows(50, 40, {{5, 6}, {20, 24}}));
  EXPECT_DOUBLE_EQ(ink.stroke_width, 10.0 / 3);
}

TEST(Ink, CentreDistanceFallsFromTheRimToTheMiddle) {
  const Ink ink = measured(rows(50, 40, {{10, 17}}));
  const float expected[] = {0.75f, 0.5f, 0.25f, 0.0f, 0.25f, 0.5f, 0.75f};
  for (int k = 0; k < 7; ++k) EXPECT_FLOAT_EQ(ink.centre_distance(25, 10 + k), expected[k]) << k;
}

TEST(Ink, StrokesOfDifferentWidthHaveTheirOwnCentre) {
  const Ink ink = measured(rows(50, 60, {{5, 8}, {20, 41}}));
  EXPECT_FLOAT_EQ(ink.centre_distance(25, 6), 0.0f);
  EXPECT_FLOAT_EQ(ink.centre_distance(25, 5), 0.5f);
  EXPECT_FLOAT_EQ(ink.centre_distance(25, 30), 0.0f);
  EXPECT_FLOAT_EQ(ink.centre_distance(25, 20), 1 - 1.0f / 11);
}

TEST(Ink, WidthOfARoundStrokeAtAnyAngle) {
  // The L1 distance across a stroke that runs at this angle is shorter than the Euclidean one by max(|cos|, |sin|).
  for (const double angle : {0.0, 20.0, 45.0, 70.0}) {
    const double a = angle * std::numbers::pi / 180;
    const Vec2 arm = 110 * Vec2{std::cos(a), std::sin(a)}, middle{150, 150};
    const Ink ink = testing::drawn_ink({{middle - arm, middle + arm}}, 16, 300);
    const double expected = 16 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
    EXPECT_NEAR(ink.stroke_width, expected, 0.1 * expected) << angle;
  }
}

TEST(Ink, ClosingFillsGapsUpToTwiceTheRadiusOnly) {
  for (const int radius : {1, 2, 3, 5})
    for (int gap = 1; gap <= 2 * radius + 3; ++gap) {
      const Mask mask = rows(40, 60, {{15, 20}, {20 + gap, 25 + gap}});
      const Mask closed = closed_ink(measured(mask), radius);
      const Mask expected = gap <= 2 * radius ? rows(40, 60, {{15, 25 + gap}}) : mask;
      EXPECT_EQ(closed.data, expected.data) << radius << ' ' << gap;
    }
}

TEST(Ink, ClosingLeavesPaperAtTheBorder) {
  Mask mask(60, 60);
  for (int y = 45; y < 55; ++y)
    for (int x = 0; x < 60; ++x) mask(x, y) = 1;
  EXPECT_EQ(closed_ink(measured(mask), 6).data, mask.data);
}

TEST(Ink, ClosingByNothingChangesNothing) {
  const Mask mask = random_mask(40, 30, 0.3, 7);
  EXPECT_EQ(closed_ink(measured(mask), 0).data, mask.data);
}

TEST(Ink, PaperAlone) {
  const Ink ink = measured(Mask(30, 20, 0));
  EXPECT_EQ(ink.pixels, 0);
  EXPECT_EQ(ink.stroke_width, 0);
  EXPECT_EQ(ink.width(), 30);
  EXPECT_EQ(ink.height(), 20);
}

TEST(Ink, InkAloneIsFinite) {
  const Ink ink = measured(Mask(30, 20, 1));
  EXPECT_EQ(ink.pixels, 600);
  EXPECT_GT(ink.stroke_width, 0);
  EXPECT_LE(ink.stroke_width, 30);
  for (std::size_t i = 0; i < 600; ++i) {
    EXPECT_EQ(ink.gap.data[i], 0.0f);
    EXPECT_EQ(ink.rise.data[i], 1.0f);
  }
}

TEST(Ink, TheBorderIsNoPaper) {
  const Ink inside = measured(rows(50, 40, {{10, 17}}));
  const Ink cropped = measured(rows(20, 40, {{10, 17}}));
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 20; ++x) ASSERT_EQ(cropped.depth(x, y), inside.depth(x + 15, y));
}

}  // namespace
}  // namespace inkgrid
