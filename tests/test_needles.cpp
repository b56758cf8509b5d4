#include <gtest/gtest.h>

#include "needles.h"
#include "polyline.h"

namespace inkgrid {
namespace {

Chains one_chain(const std::vector<Vec2>& corners) {
  Chains chains;
  chains.chains.push_back({});
  chains.chains[0].points = resampled(corners, 0.75);
  return chains;
}

double length_of(const Chains& chains) {
  return lengths_along(chains.chains[0].points).back();
}

double farthest_from(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  double farthest = 0;
  for (const Vec2 p : from) {
    double least = 1e9;
    for (const Vec2 q : to) least = std::min(least, norm(p - q));
    farthest = std::max(farthest, least);
  }
  return farthest;
}

TEST(Needles, ATipThatIsWalkedTwiceIsWalkedOnce) {
  const Chains before = one_chain({{0, 60}, {10, 20}, {10, 10}, {10.2, 18}, {10.4, 10.3}, {20, 60}});
  const Chains after = drop_needles(before, 2, 80);
  EXPECT_NEAR(length_of(after), length_of(before) - 15.7, 2);
  EXPECT_LT(farthest_from(before.chains[0].points, after.chains[0].points), 2);
  EXPECT_EQ(after.chains[0].points.front(), before.chains[0].points.front());
  EXPECT_EQ(after.chains[0].points.back(), before.chains[0].points.back());
}

TEST(Needles, AcuteCornersAndHatchingStay) {
  for (const double half : {1.0, 3.0, 10.0}) {
    const Chains corner = one_chain({{0, 60}, {half, 0}, {2 * half, 60}});
    EXPECT_EQ(drop_needles(corner, 2, 80).chains[0].points, corner.chains[0].points) << half;
    const Chains hatching = one_chain({{0, 60}, {half, 0}, {half + 3, 60}, {half + 6, 0}, {half + 9, 60}});
    EXPECT_EQ(drop_needles(hatching, 2, 80).chains[0].points, hatching.chains[0].points) << half;
  }
}

TEST(Needles, WhatTheRestDoesNotCoverStays) {
  const Chains star = one_chain({{0, 0}, {30, 0}, {40, 30}, {30.5, 0.5}, {60, 0}});
  EXPECT_EQ(drop_needles(star, 2, 200).chains[0].points, star.chains[0].points);
}

TEST(Needles, LongWaysStay) {
  const Chains there_and_back = one_chain({{0, 60}, {10, 10}, {10.2, 60}, {10.4, 10.3}, {20, 60}});
  EXPECT_EQ(drop_needles(there_and_back, 2, 80).chains[0].points, there_and_back.chains[0].points);
}

}  // namespace
}  // namespace inkgrid
