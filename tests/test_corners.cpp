#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "corners.h"
#include "polyline.h"

namespace inkgrid {
namespace {

constexpr double kWidth = 6;

RidgeChain ridge_along(const std::vector<Vec2>& points, int start, int end, double unknown_start, double unknown_end) {
  RidgeChain ridge;
  ridge.chain.points = resampled(points, 1);
  ridge.chain.start_junction = start;
  ridge.chain.end_junction = end;
  ridge.chain.width = kWidth;
  const auto lengths = lengths_along(ridge.chain.points);
  for (const double s : lengths) {
    const bool known = s >= unknown_start && lengths.back() - s >= unknown_end;
    ridge.sections.push_back({0, kWidth, known ? 1.0 : 0.0});
  }
  return ridge;
}

// Two sides of a corner of this angle at the origin, joined `cut` px before its tip, and the tip.
std::vector<RidgeChain> cut_corner(double degrees, double cut) {
  const double half = 0.5 * degrees * std::numbers::pi / 180;
  const Vec2 a{-std::cos(half), std::sin(half)}, b{-std::cos(half), -std::sin(half)};
  const double hidden = cut + norm(cut * a - cut * b);
  return {ridge_along({80 * a, cut * a}, -1, 0, 0, 1), ridge_along({80 * b, cut * b, cut * a}, -1, 0, 0, hidden),
          ridge_along({cut * a, {0, 0}}, 0, -1, cut, cut)};
}

TEST(Corners, TheTipOfAnAcuteCornerIsNoBranch) {
  for (const double degrees : {20.0, 30.0, 45.0, 60.0}) {
    const auto mended = open_corners(cut_corner(degrees, 10), 1, 15, 3.6);
    ASSERT_EQ(mended.size(), 2u) << degrees;
    for (const auto& ridge : mended) EXPECT_EQ(ridge.chain.end_junction, 0);
  }
}

TEST(Corners, ALongTipIsABranch) {
  EXPECT_EQ(open_corners(cut_corner(30, 10), 1, 8, 3.6).size(), 3u);
}

TEST(Corners, ATeeKeepsItsShortArm) {
  const auto tee = [] {
    return std::vector{ridge_along({{0, 60}, {0, 0}}, -1, 0, 0, 3), ridge_along({{40, 0}, {0, 0}}, -1, 0, 0, 3),
                       ridge_along({{0, 0}, {-3, 0}}, 0, -1, 3, 3)};
  };
  EXPECT_EQ(open_corners(tee(), 1, 15, 3.6).size(), 3u);
}

TEST(Corners, AJunctionOfFourStays) {
  auto ridges = cut_corner(30, 10);
  ridges.push_back(ridge_along({{60, 0}, {-9, 2}}, -1, 0, 0, 3));
  EXPECT_EQ(open_corners(ridges, 1, 15, 3.6).size(), 4u);
}

}  // namespace
}  // namespace inkgrid
