// Where polylines cross, and which points of two sets belong together.
#include <gtest/gtest.h>

#include <algorithm>

#include "compare/branch_points.h"
#include "compare/crossings.h"
#include "drawings.h"

namespace inkgrid {
namespace {

using Polyline = std::vector<Vec2>;

TEST(Matches, EachPointCountsOnce) {
  const PointAgreement twice = match_points({{0, 0}, {1, 0}}, {{0.4, 0}}, 2);
  EXPECT_EQ(twice.precision, 0.5);
  EXPECT_EQ(twice.recall, 1);
  const PointAgreement half = match_points({{0.4, 0}}, {{0, 0}, {1, 0}}, 2);
  EXPECT_EQ(half.precision, 1);
  EXPECT_EQ(half.recall, 0.5);
}

TEST(Matches, TheNearestCountFirst) {
  const PointAgreement chain = match_points({{0, 0}, {3, 0}}, {{2, 0}, {4.5, 0}}, 2);
  EXPECT_EQ(chain.f1, 0.5) << "3 belongs to 2, which leaves none for 0";
}

TEST(Matches, OfNothingToBeFoundEverythingIsFound) {
  EXPECT_EQ(match_points({}, {}, 2).f1, 1);
  EXPECT_EQ(match_points({{0, 0}}, {}, 2).precision, 0);
  EXPECT_EQ(match_points({}, {{0, 0}}, 2).recall, 0);
}

TEST(Crossings, AreWhereLinesCrossAndNowhereElse) {
  const Polyline across{{-50, 3}, {50, 3}}, up{{7, -20}, {7, 90}}, beside{{8, 3.5}, {8, 40}};
  const auto found = crossings({across, up, beside});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(norm(found[0] - Vec2{7, 3}), 1e-9);
  EXPECT_TRUE(crossings({across, {{-50, 3}, {20, 3}}}).empty()) << "lines on each other";
}

TEST(Crossings, AnEndOnALineIsOne) {
  EXPECT_EQ(crossings({{{-50, 3}, {50, 3}}, {{7, 3}, {7, 90}}}).size(), 1u);
}

TEST(Crossings, NeighboursOnOneLineAreNone) {
  EXPECT_TRUE(crossings({{{0, 0}, {10, 0}, {10, 10}, {20, 5}}}).empty());
  EXPECT_TRUE(crossings({{{0, 0}, {10, 0}, {10, 10}, {0, 0}}}).empty()) << "over the seam";
  EXPECT_EQ(crossings({{{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, -10}}}).size(), 1u) << "a loop";
}

TEST(Thinned, StepsAreAboutOneAndAHalfPixelsAndCornersStay) {
  const Polyline round = thinned(testing::arc({0, 0}, 50, 0, 3, 2000));
  for (std::size_t k = 1; k < round.size(); ++k) {
    EXPECT_LE(norm(round[k] - round[k - 1]), 1.5 + 1e-9);
    EXPECT_GE(norm(round[k] - round[k - 1]), 1.4);
  }
  const auto keeps_corner = [](double rise) {
    const Polyline line = thinned({{0, 0}, {10.3, 0}, {20.3, rise}});
    return std::find(line.begin(), line.end(), Vec2{10.3, 0}) != line.end();
  };
  EXPECT_TRUE(keeps_corner(2.9)) << "16 degrees";
  EXPECT_FALSE(keeps_corner(2.4)) << "13.5 degrees";
  const Polyline tiny{{0, 0}, {1, 0.1}, {2, 0}, {2.5, 0.1}};
  EXPECT_EQ(thinned(tiny), tiny);
}

}  // namespace
}  // namespace inkgrid
