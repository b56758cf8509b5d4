// Lines along which a raster takes a value.
#include <gtest/gtest.h>

#include <numbers>

#include "base/contour.h"

namespace inkgrid {
namespace {

using std::numbers::pi;

template <class Value>
Raster<float> sampled(int width, int height, Value value) {
  Raster<float> values(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) values(x, y) = static_cast<float>(value(Vec2{x + 0.5, y + 0.5}));
  return values;
}

TEST(Contour, ADiscHasOneLineAroundIt) {
  const Vec2 centre{20.3, 18.8};
  const auto lines = contours_at(sampled(40, 40, [&](Vec2 p) { return -norm(p - centre); }), -11.2F);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].front() == lines[0].back());
  for (const Vec2 p : lines[0]) EXPECT_NEAR(norm(p - centre), 11.2, 0.02);
  EXPECT_NEAR(std::abs(enclosed_area(lines[0])), pi * 11.2 * 11.2, 2);
}

TEST(Contour, AHoleRunsTheOtherWay) {
  const Vec2 centre{25, 25};
  const auto lines = contours_at(sampled(50, 50, [&](Vec2 p) { return -std::abs(norm(p - centre) - 14); }), -4.0F);
  ASSERT_EQ(lines.size(), 2u);
  const double outer = enclosed_area(lines[0]), inner = enclosed_area(lines[1]);
  EXPECT_LT(outer * inner, 0);
  EXPECT_NEAR(std::abs(outer + inner), pi * (18 * 18 - 10 * 10), 2);
}

TEST(Contour, ClosesAlongTheBorder) {
  // A half-plane across the corner of the raster.
  const auto lines = contours_at(sampled(30, 20, [](Vec2 p) { return 12 - p.x; }), 0.0F);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(std::abs(enclosed_area(lines[0])), 12 * 20, 1);
  for (const Vec2 p : lines[0]) {
    EXPECT_GE(p.x, 0);
    EXPECT_LE(p.x, 12.001);
    EXPECT_GE(p.y, 0);
    EXPECT_LE(p.y, 20);
  }
}

TEST(Contour, ARasterAboveTheLevelIsOneRectangle) {
  const auto lines = contours_at(Raster<float>(7, 5, 1.0F), 0.5F);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(std::abs(enclosed_area(lines[0])), 35, 0.51);
  EXPECT_TRUE(contours_at(Raster<float>(7, 5, 0.0F), 0.5F).empty());
}

// Two pixels that touch in a corner: whether they are one piece, the mean says.
TEST(Contour, TheMeanDecidesASaddle) {
  Raster<float> values(4, 4, 0.0F);
  values(1, 1) = values(2, 2) = 1;
  EXPECT_EQ(contours_at(values, 0.4F).size(), 1u);
  EXPECT_EQ(contours_at(values, 0.6F).size(), 2u);
  Raster<float> mirrored(4, 4, 0.0F);
  mirrored(2, 1) = mirrored(1, 2) = 1;
  EXPECT_EQ(contours_at(mirrored, 0.4F).size(), 1u);
  EXPECT_EQ(contours_at(mirrored, 0.6F).size(), 2u);
}

TEST(Contour, EverySignChangeIsCrossedOnce) {
  // Every edge between neighbours on different sides holds exactly one point, and no other edge holds any.
  std::uint32_t state = 1;
  const auto values = sampled(23, 17, [&](Vec2) {
    state = state * 1664525 + 1013904223;
    return static_cast<double>(state >> 8) / (1 << 24);
  });
  std::size_t expected = 0;
  const auto above = [&](int x, int y) { return values.contains(x, y) && values(x, y) > 0.5F; };
  for (int y = -1; y < values.height; ++y)
    for (int x = -1; x < values.width; ++x) expected += (above(x, y) != above(x + 1, y)) + (above(x, y) != above(x, y + 1));
  std::size_t found = 0;
  for (const auto& line : contours_at(values, 0.5F)) found += line.size() - 1;
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace inkgrid
