#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/polyline.h"
#include "chain_checks.h"
#include "refine/arrival.h"
#include "refine/corners.h"

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

constexpr Vec2 kTip{100, 100};

Raster<std::uint8_t> all_ink() {
  return Raster<std::uint8_t>(200, 200, 1);
}

Vec2 side(double degrees, double length) {
  return kTip + length * Vec2{-std::cos(degrees * std::numbers::pi / 180), std::sin(degrees * std::numbers::pi / 180)};
}

// Two sides of a corner of this angle, joined `cut` px before its tip, and the tip.
std::vector<RidgeChain> cut_corner(double degrees, double cut) {
  const double half = 0.5 * degrees;
  const double hidden = cut + norm(side(half, cut) - side(-half, cut));
  return {ridge_along({side(half, 80), side(half, cut)}, -1, 0, 0, 1),
          ridge_along({side(-half, 80), side(-half, cut), side(half, cut)}, -1, 0, 0, hidden),
          ridge_along({side(half, cut), kTip}, 0, -1, cut, cut)};
}

double distance_to_tip(const Chain& chain) {
  double least = 1e9;
  for (const Vec2 p : chain.points) least = std::min(least, norm(p - kTip));
  return least;
}

TEST(Corners, TheTipOfAnAcuteCornerIsNoBranch) {
  for (const double degrees : {20.0, 30.0, 45.0, 60.0}) {
    const auto mended = open_corners(cut_corner(degrees, 10), {kTip}, all_ink(), {25, 3.6});
    ASSERT_EQ(mended.size(), 1u) << degrees;
    EXPECT_EQ(mended[0].chain.start_junction, -1);
    EXPECT_EQ(mended[0].chain.end_junction, -1);
    EXPECT_EQ(mended[0].sections.size(), mended[0].chain.points.size());
    EXPECT_LT(distance_to_tip(mended[0].chain), 0.5) << degrees;
    EXPECT_NEAR(lengths_along(mended[0].chain.points).back(), 160, 1) << degrees;
  }
}

TEST(Corners, ALongTipIsABranch) {
  EXPECT_EQ(open_corners(cut_corner(30, 10), {kTip}, all_ink(), {8, 3.6}).size(), 3u);
}

TEST(Corners, ATeeKeepsItsShortArm) {
  const auto tee = [] {
    return std::vector{ridge_along({{100, 160}, {100, 100}}, -1, 0, 0, 3), ridge_along({{140, 100}, {100, 100}}, -1, 0, 0, 3),
                       ridge_along({{100, 100}, {97, 100}}, 0, -1, 3, 3)};
  };
  EXPECT_EQ(open_corners(tee(), {kTip}, all_ink(), {15, 3.6}).size(), 3u);
}

TEST(Corners, AJunctionOfFourStays) {
  auto ridges = cut_corner(30, 10);
  ridges.push_back(ridge_along({{160, 100}, {91, 102}}, -1, 0, 0, 3));
  EXPECT_EQ(open_corners(ridges, {kTip}, all_ink(), {15, 3.6}).size(), 4u);
}

// One chain that cuts the corner.
RidgeChain rounded_corner(double degrees, double cut) {
  RidgeChain ridge = ridge_along(
      {side(0.5 * degrees, 80), side(0.5 * degrees, cut), side(-0.5 * degrees, cut), side(-0.5 * degrees, 80)}, -1, -1, 0, 0);
  const auto lengths = lengths_along(ridge.chain.points);
  for (std::size_t k = 0; k < lengths.size(); ++k)
    if (lengths[k] > 80 - cut - 1 && lengths.back() - lengths[k] > 80 - cut - 1) ridge.sections[k].weight = 0;
  return ridge;
}

TEST(Corners, AChainThatCutsACornerGoesToItsTip) {
  for (const double degrees : {30.0, 60.0, 90.0, 130.0}) {
    const auto sharp = open_corners({rounded_corner(degrees, 10)}, {}, all_ink(), {20, 3.6});
    ASSERT_EQ(sharp.size(), 1u);
    EXPECT_LT(distance_to_tip(sharp[0].chain), 0.5) << degrees;
    EXPECT_NEAR(lengths_along(sharp[0].chain.points).back(), 160, 1) << degrees;
  }
}

TEST(Corners, WithoutInkAtTheTipNothingIsSharpened) {
  Raster<std::uint8_t> ink = all_ink();
  for (int y = 95; y < 106; ++y)
    for (int x = 95; x < 106; ++x) ink(x, y) = 0;
  const RidgeChain before = rounded_corner(60, 10);
  EXPECT_TRUE(open_corners({before}, {}, ink, {20, 3.6})[0].chain.points == before.chain.points);
}

TEST(Corners, AConfirmedBendStays) {
  RidgeChain bend = rounded_corner(60, 10);
  for (auto& section : bend.sections) section.weight = 1;
  EXPECT_TRUE(open_corners({bend}, {}, all_ink(), {20, 3.6})[0].chain.points == bend.chain.points);
}

// The ink of two arms, and of a stem of this length.
Raster<std::uint8_t> fork_ink(double degrees, double stem) {
  Image image = testing::blank(200, 200);
  for (const double sign : {-1.0, 1.0}) testing::paint(image, {side(sign * 0.5 * degrees, 90), kTip}, kWidth);
  testing::paint(image, {kTip, kTip + Vec2{stem, 0}}, kWidth);
  return testing::ink_of(image).mask;
}

std::vector<RidgeChain> open_arms(double degrees) {
  std::vector<RidgeChain> arms;
  for (const double sign : {-1.0, 1.0}) {
    arms.push_back(ridge_along({side(sign * 0.5 * degrees, 80), side(sign * 0.5 * degrees, 20)}, -1, -1, 0, 0));
    arms.back().chain.confirmed = 60;
  }
  return arms;
}

TEST(Corners, OpenArmsMeetInASharpCorner) {
  for (const double degrees : {20.0, 40.0, 70.0}) {
    const auto joined = join_arms(open_arms(degrees), {}, fork_ink(degrees, 0), {40, 3.6});
    ASSERT_EQ(joined.ridges.size(), 1u) << degrees;
    EXPECT_LT(distance_to_tip(joined.ridges[0].chain), 0.5) << degrees;
    EXPECT_TRUE(joined.junctions.empty());
  }
}

TEST(Corners, ArmsAndTheStemThatPassedTheirForkShareAJunction) {
  for (const double degrees : {20.0, 40.0, 70.0}) {
    auto ridges = open_arms(degrees);
    ridges.push_back(ridge_along({kTip + Vec2{60, 0}, kTip - Vec2{12, 0}}, -1, -1, 0, 12));
    ridges.back().chain.confirmed = 60;
    const auto joined = join_arms(ridges, {}, fork_ink(degrees, 60), {40, 3.6});
    ASSERT_EQ(joined.junctions.size(), 1u) << degrees;
    EXPECT_LT(norm(joined.junctions[0] - kTip), 0.5) << degrees;
    ASSERT_EQ(joined.ridges.size(), 3u);
    for (const auto& ridge : joined.ridges) {
      EXPECT_EQ(ridge.chain.end_junction, 0);
      EXPECT_TRUE(ridge.chain.points.back() == joined.junctions[0]);
      EXPECT_EQ(ridge.sections.size(), ridge.chain.points.size());
    }
  }
}

TEST(Corners, ArmsOnALineThatGoesOnStayApart) {
  auto ridges = open_arms(70);
  ridges.push_back(ridge_along({{100, 10}, {100, 190}}, -1, -1, 0, 0));
  ridges.back().chain.confirmed = 180;
  EXPECT_EQ(join_arms(ridges, {}, all_ink(), {40, 3.6}).ridges.size(), 3u);
}

TEST(Arrival, FollowsArcsAndLines) {
  const RidgeChain line = ridge_along({{20, 30}, {120, 60}}, -1, -1, 0, 10);
  EXPECT_NEAR(cross(arrival_at(line, false).direction, unit(Vec2{100, 30})), 0, 1e-6);
  const auto points = testing::arc({100, 100}, 60, 0, 1.5);
  const Arrival arrival = arrival_at(ridge_along(points, -1, -1, 0, 8), false);
  const Vec2 radius = arrival.point - Vec2{100, 100};
  EXPECT_NEAR(norm(radius), 60, 0.1);
  EXPECT_LT(std::abs(dot(arrival.direction, unit(radius))), 0.03);
}

// The ridge of a line that is all but level goes up and down with the steps of its pixels.
TEST(Arrival, OfAStraightSlimmedLineIsToldOfMoreThanItsLastStep) {
  std::vector<Vec2> steps;
  for (int k = 0; k <= 120; ++k) steps.push_back({20.0 + k, 30 + 0.05 * k + 0.25 * std::sin(2 * std::numbers::pi * k / 20)});
  RidgeChain ridge = ridge_along(steps, -1, -1, 0, 4);
  ridge.slimmed = 3;
  const Arrival arrival = arrival_at(ridge, false);
  EXPECT_NEAR(cross(arrival.direction, unit(Vec2{1, 0.05})), 0, 0.02);
}

TEST(Corners, AnArcWhoseMiddleIsNotConfirmedStaysRound) {
  // Sides of an arc meet outside it: at its rim there is no ink beyond.
  const Vec2 centre{100, 60};
  constexpr double kRadius = 40;
  Raster<std::uint8_t> ink(200, 200, 0);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) ink(x, y) = std::abs(norm(Vec2{x + 0.5, y + 0.5} - centre) - kRadius) < 0.5 * kWidth + 0.6;
  std::vector<Vec2> bow;
  for (double a = 0.3; a < std::numbers::pi - 0.3; a += 0.02) bow.push_back(centre + kRadius * Vec2{std::cos(a), std::sin(a)});
  RidgeChain ridge = ridge_along(bow, -1, -1, 0, 0);
  const std::size_t middle = ridge.sections.size() / 2;
  for (std::size_t k = middle - 11; k < middle + 11; ++k) ridge.sections[k] = {};
  const auto found = open_corners({ridge}, {}, ink, {25, 3.6});
  for (const Vec2 p : found[0].chain.points) EXPECT_LT(std::abs(norm(p - centre) - kRadius), 0.5);
}

}  // namespace
}  // namespace inkgrid
