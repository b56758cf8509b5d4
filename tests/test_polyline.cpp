#include <gtest/gtest.h>

#include <numbers>

#include "base/polyline.h"
#include "drawings.h"

namespace inkgrid {
namespace {

const std::vector<Vec2> kHook{{1.1, 2.3}, {31.1, 2.3}, {31.1, 2.3}, {31.1, 42.3}};

TEST(Polyline, LengthsAddUpAndAPointHasNone) {
  const auto lengths = lengths_along(kHook);
  ASSERT_EQ(lengths.size(), kHook.size());
  EXPECT_EQ(lengths[0], 0);
  EXPECT_NEAR(lengths[1], 30, 1e-12);
  EXPECT_NEAR(lengths[2], 30, 1e-12);
  EXPECT_NEAR(lengths[3], 70, 1e-12);
  EXPECT_EQ(lengths_along({{5, 5}}), std::vector<double>{0});
}

TEST(Polyline, PointAtInterpolatesAndStopsAtTheEnds) {
  const auto lengths = lengths_along(kHook);
  EXPECT_NEAR(norm(point_at(kHook, lengths, 12) - Vec2{13.1, 2.3}), 0, 1e-12);
  EXPECT_NEAR(norm(point_at(kHook, lengths, 30) - Vec2{31.1, 2.3}), 0, 1e-12);
  EXPECT_NEAR(norm(point_at(kHook, lengths, 45) - Vec2{31.1, 17.3}), 0, 1e-12);
  EXPECT_TRUE(point_at(kHook, lengths, -1) == kHook.front());
  EXPECT_TRUE(point_at(kHook, lengths, 71) == kHook.back());
}

TEST(Polyline, ResampledKeepsItsEndsAndHasEvenSteps) {
  const auto spiral = testing::arc({50.3, 40.7}, 33.3, 0.2, 4.1, 977);
  for (const double step : {0.3, 1.0, 7.0}) {
    const auto points = resampled(spiral, step);
    EXPECT_TRUE(points.front() == spiral.front());
    EXPECT_TRUE(points.back() == spiral.back());
    const double length = lengths_along(spiral).back();
    const double even = length / static_cast<double>(points.size() - 1);
    EXPECT_NEAR(even, step, 0.1 * step);
    // A chord is shorter than its arc by even^3 / (24 r^2).
    for (std::size_t i = 1; i < points.size(); ++i)
      EXPECT_NEAR(norm(points[i] - points[i - 1]), even, even * even * even / (24 * 33.3 * 33.3) + 1e-4);
  }
}

TEST(Polyline, ResampledHasTwoPointsAtLeast) {
  EXPECT_EQ(resampled({{0, 0}, {0.1, 0}}, 5).size(), 2u);
  EXPECT_EQ(resampled({{3, 4}}, 1).size(), 2u);
}

TEST(Polyline, TangentOfACircleIsSquareToItsRadius) {
  const Vec2 centre{30, 40};
  auto circle = testing::circle(centre, 20);
  circle.back() = circle.front();
  const int n = static_cast<int>(circle.size());
  for (int k = 0; k < n; ++k) {
    const Vec2 expected = unit(quarter_turn(circle[static_cast<std::size_t>(k)] - centre));
    EXPECT_NEAR(norm(tangent_at(circle, k, 5, true) - expected), 0, 1e-9) << k;
  }
}

TEST(Polyline, TangentsAtTheEndsOfAnOpenPathAreOneSided) {
  const std::vector<Vec2> corner{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}};
  EXPECT_NEAR(norm(tangent_at(corner, 0, 2, false) - Vec2{1, 0}), 0, 1e-12);
  EXPECT_NEAR(norm(tangent_at(corner, 4, 2, false) - Vec2{0, 1}), 0, 1e-12);
  EXPECT_NEAR(norm(tangent_at(corner, 2, 2, false) - unit({1, 1})), 0, 1e-12);
}

TEST(Polyline, TangentLooksFartherWherePointsCoincide) {
  const std::vector<Vec2> stuck{{0, 0}, {3, 3}, {3, 3}, {3, 3}, {6, 6}};
  EXPECT_NEAR(norm(tangent_at(stuck, 2, 1, false) - unit({1, 1})), 0, 1e-12);
}

}  // namespace
}  // namespace inkgrid
