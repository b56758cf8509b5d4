#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "drawings.h"
#include "ink/preset.h"
#include "ink/slim.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::circle;
using testing::paint;

using Mask = Raster<std::uint8_t>;

Ink ink_of(const Image& image) {
  return measure_ink(binarise(image, 128));
}

// Connected pieces of the pixels with a value, over corners too or over sides alone.
int pieces(const Mask& mask, std::uint8_t value, bool over_corners) {
  Mask seen(mask.width, mask.height);
  int count = 0;
  for (int y0 = 0; y0 < mask.height; ++y0)
    for (int x0 = 0; x0 < mask.width; ++x0) {
      if (mask(x0, y0) != value || seen(x0, y0)) continue;
      ++count;
      std::vector<std::pair<int, int>> stack{{x0, y0}};
      seen(x0, y0) = 1;
      while (!stack.empty()) {
        const auto [x, y] = stack.back();
        stack.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            if ((dx && dy && !over_corners) || !mask.contains(x + dx, y + dy)) continue;
            if (mask(x + dx, y + dy) != value || seen(x + dx, y + dy)) continue;
            seen(x + dx, y + dy) = 1;
            stack.emplace_back(x + dx, y + dy);
          }
      }
    }
  return count;
}

// First and last ink of a column, as a middle and a width.
std::pair<double, double> cut_down(const Mask& mask, int x, int from, int to) {
  int first = to, last = from;
  for (int y = from; y < to; ++y)
    if (mask(x, y)) {
      first = std::min(first, y);
      last = y;
    }
  return {0.5 * (first + last + 1), last + 1 - first};
}

Ink line_of(double width) {
  Image image = blank(80, 80);
  paint(image, {{10, 40}, {70, 40}}, width);
  return ink_of(image);
}

TEST(Slim, ASpacingOfACellOrMoreKeepsThePen) {
  const Ink ink = line_of(12);
  EXPECT_EQ(slim_share(ink, 2), 1);
  EXPECT_EQ(slim_share(ink, 0.7), 1);
  EXPECT_EQ(slim_ink(ink, 1).mask.data, ink.mask.data);
}

TEST(Slim, TheUsualSpacingIsACellOfTheSlimPen) {
  for (const double width : {3.0, 5.0, 6.0, 7.0, 12.0}) {
    const Ink ink = line_of(width);
    const double usual = preset_values(Preset::clean, ink.stroke_width).spacing;
    EXPECT_EQ(slim_share(ink, usual), usual / 0.7) << width;
    EXPECT_NEAR(slim_share(ink, usual / 2), usual / 1.4, 1e-12) << width;
  }
}

// As a slider is dragged: few steps, each not far from what the spacing alone would ask for.
TEST(Slim, TheShareFollowsTheSpacingInSteps) {
  const Ink ink = line_of(6);
  std::set<double> shares;
  for (int k = 100; k <= 700; ++k) {
    const double spacing = 0.001 * k, share = slim_share(ink, spacing);
    EXPECT_GE(share, shares.empty() ? 0 : *shares.rbegin()) << spacing;
    EXPECT_NEAR(std::log2(share), std::log2(spacing / 0.7), 1.0 / 6 + 1e-9) << spacing;
    shares.insert(share);
  }
  EXPECT_LE(shares.size(), 10u);
  const double usual = preset_values(Preset::clean, ink.stroke_width).spacing;
  EXPECT_TRUE(same_slimming(ink, usual, 0.9 * usual));
  EXPECT_TRUE(same_slimming(ink, usual, 1.1 * usual));
  EXPECT_FALSE(same_slimming(ink, usual, 0.8 * usual));
}

TEST(Slim, AStrokeKeepsItsMiddleAndItsEnds) {
  for (const double share : {0.4, 0.5, 0.7}) {
    Image image = blank(200, 100);
    paint(image, {{40, 50.5}, {160, 50.5}}, 20);
    const Ink slim = slim_ink(ink_of(image), share);
    const auto [middle, width] = cut_down(slim.mask, 100, 0, 100);
    EXPECT_NEAR(middle, 50.5, 0.51);
    EXPECT_NEAR(width, 20 * share, 1.1);
    int leftmost = 200;
    for (int x = 199; x >= 0; --x)
      for (int y = 0; y < 100; ++y)
        if (slim.mask(x, y)) leftmost = x;
    EXPECT_NEAR(leftmost, 40 - 10 * share, 1.1) << "the end of the pen's path stays half a pen inside the ink";
  }
}

TEST(Slim, NothingBreaksVanishesOrOpens) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(5, 155), width(1.5, 24);
    Image image = blank(160, 160);
    for (int k = 0; k < 9; ++k)
      paint(image, {{place(random), place(random)}, {place(random), place(random)}, {place(random), place(random)}},
            width(random));
    const Ink ink = ink_of(image), slim = slim_ink(ink, 0.5);
    EXPECT_EQ(pieces(slim.mask, 1, true), pieces(ink.mask, 1, true)) << seed;
    EXPECT_EQ(pieces(slim.mask, 0, false), pieces(ink.mask, 0, false)) << seed;
    EXPECT_LT(slim.pixels, ink.pixels) << seed;
    for (std::size_t i = 0; i < ink.mask.data.size(); ++i) ASSERT_LE(slim.mask.data[i], ink.mask.data[i]);
  }
}

TEST(Slim, AHoleSmallerThanThePenGrows) {
  Image image = blank(160, 160);
  paint(image, circle({80, 80}, 16), 24);
  const Ink slim = slim_ink(ink_of(image), 0.5);
  const auto hole = [](const Mask& mask) { return std::count(mask.data.begin(), mask.data.end(), std::uint8_t{0}); };
  EXPECT_EQ(pieces(slim.mask, 0, false), 2);
  EXPECT_GT(hole(slim.mask), hole(ink_of(image).mask));
  int inside = 0;
  while (!slim.mask(80 + inside, 80)) ++inside;
  EXPECT_NEAR(inside, 16 - 6, 1.1) << "the radius of the hole: that of the circle less half the slim pen";
}

TEST(Slim, ThinStrokesStayBesideThickOnes) {
  Image image = blank(300, 200);
  for (const double y : {20.0, 40.0, 60.0, 80.0}) paint(image, {{20, y}, {280, y}}, 5);
  paint(image, {{20, 140}, {280, 140}}, 30);
  const Ink slim = slim_ink(ink_of(image), 0.6);
  EXPECT_NEAR(cut_down(slim.mask, 150, 10, 30).second, 3, 1.1);
  EXPECT_NEAR(cut_down(slim.mask, 150, 110, 170).second, 3, 1.1) << "more than twice as wide as the pen: as slim as the others";
  EXPECT_NEAR(cut_down(slim.mask, 150, 110, 170).first, 140, 1.1);
}

TEST(Slim, ABroadPenIsSlimmedBesideAFineOneWhereTheGridIsAsFineAsThat) {
  Image image = blank(300, 200);
  for (const double y : {20.0, 40.0, 60.0}) paint(image, {{20, y}, {280, y}}, 4);
  EXPECT_FALSE(is_slimmed(ink_of(image), 0.7));
  paint(image, {{20, 140}, {280, 140}}, 8);
  const Ink ink = ink_of(image), slim = slim_ink(ink, 1);
  EXPECT_TRUE(is_slimmed(ink, 0.7));
  EXPECT_TRUE(is_slimmed(ink, 0.77));
  EXPECT_TRUE(same_slimming(ink, 0.7, 0.77));
  EXPECT_FALSE(is_slimmed(ink, 0.8));
  EXPECT_NEAR(cut_down(slim.mask, 150, 110, 170).second, 4, 1.1);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 300; ++x) ASSERT_EQ(slim.mask(x, y), ink.mask(x, y));
}

TEST(Slim, WhereStrokesMeetIsNoBroadPen) {
  Image image = blank(300, 300);
  for (int k = 0; k < 6; ++k)
    paint(image, {{150, 150}, Vec2{150, 150} + 120.0 * Vec2{std::cos(k * 1.05), std::sin(k * 1.05)}}, 6);
  paint(image, circle({150, 150}, 60), 6);
  EXPECT_FALSE(is_slimmed(ink_of(image), 0.7));
}

TEST(Slim, ABlotDoesNotChangeTheOthers) {
  Image image = blank(300, 300);
  for (const double y : {20.0, 45.0, 70.0, 95.0}) paint(image, {{20, y}, {280, y + 10}}, 8);
  const Ink without = slim_ink(ink_of(image), 0.5);
  paint(image, {{150, 210}, {150.1, 210}}, 120);
  const Ink with = slim_ink(ink_of(image), 0.5);
  for (int y = 0; y < 130; ++y)
    for (int x = 0; x < 300; ++x) ASSERT_EQ(with.mask(x, y), without.mask(x, y)) << x << ' ' << y;
}

TEST(Slim, StrokesGoOnBeyondTheBorder) {
  Image image = blank(100, 100);
  paint(image, {{-30, 50.5}, {130, 50.5}}, 16);
  const Ink slim = slim_ink(ink_of(image), 0.5);
  EXPECT_EQ(cut_down(slim.mask, 0, 0, 100), cut_down(slim.mask, 50, 0, 100));
  EXPECT_EQ(cut_down(slim.mask, 99, 0, 100), cut_down(slim.mask, 50, 0, 100));
}

}  // namespace
}  // namespace inkgrid
