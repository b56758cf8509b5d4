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

// Of strokes that were not slimmed.
CornerInk plain(const Raster<std::uint8_t>& ink) {
  return {ink, ink};
}

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
    const auto mended = open_corners(cut_corner(degrees, 10), {kTip}, plain(all_ink()), {25, 3.6});
    ASSERT_EQ(mended.size(), 1u) << degrees;
    EXPECT_EQ(mended[0].chain.start_junction, -1);
    EXPECT_EQ(mended[0].chain.end_junction, -1);
    EXPECT_EQ(mended[0].sections.size(), mended[0].chain.points.size());
    EXPECT_LT(distance_to_tip(mended[0].chain), 0.5) << degrees;
    EXPECT_NEAR(lengths_along(mended[0].chain.points).back(), 160, 1) << degrees;
  }
}

TEST(Corners, ALongTipIsABranch) {
  EXPECT_EQ(open_corners(cut_corner(30, 10), {kTip}, plain(all_ink()), {8, 3.6}).size(), 3u);
}

TEST(Corners, ATeeKeepsItsShortArm) {
  const auto tee = [] {
    return std::vector{ridge_along({{100, 160}, {100, 100}}, -1, 0, 0, 3), ridge_along({{140, 100}, {100, 100}}, -1, 0, 0, 3),
                       ridge_along({{100, 100}, {97, 100}}, 0, -1, 3, 3)};
  };
  EXPECT_EQ(open_corners(tee(), {kTip}, plain(all_ink()), {15, 3.6}).size(), 3u);
}

TEST(Corners, AJunctionOfFourStays) {
  auto ridges = cut_corner(30, 10);
  ridges.push_back(ridge_along({{160, 100}, {91, 102}}, -1, 0, 0, 3));
  EXPECT_EQ(open_corners(ridges, {kTip}, plain(all_ink()), {15, 3.6}).size(), 4u);
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
    const auto sharp = open_corners({rounded_corner(degrees, 10)}, {}, plain(all_ink()), {20, 3.6});
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
  EXPECT_TRUE(open_corners({before}, {}, plain(ink), {20, 3.6})[0].chain.points == before.chain.points);
}

TEST(Corners, AConfirmedBendStays) {
  RidgeChain bend = rounded_corner(60, 10);
  for (auto& section : bend.sections) section.weight = 1;
  EXPECT_TRUE(open_corners({bend}, {}, plain(all_ink()), {20, 3.6})[0].chain.points == bend.chain.points);
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
    const auto joined = join_arms(open_arms(degrees), {}, plain(fork_ink(degrees, 0)), {40, 3.6});
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
    const auto joined = join_arms(ridges, {}, plain(fork_ink(degrees, 60)), {40, 3.6});
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
  EXPECT_EQ(join_arms(ridges, {}, plain(all_ink()), {40, 3.6}).ridges.size(), 3u);
}

// The grid takes a blot for the end of one arm, and of the other nothing but what paper shows.
std::vector<RidgeChain> arm_through_blot(double degrees, double from) {
  const double half = 0.5 * degrees;
  RidgeChain through = ridge_along({side(half, 90), side(half, from), kTip - Vec2{0.6 * from, 0}, kTip}, -1, -1, 0, 0);
  const auto lengths = lengths_along(through.chain.points);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const double to_tip = lengths.back() - lengths[k];
    if (to_tip < from && !(to_tip > 3 && to_tip < from - 3)) through.sections[k].weight = 0;
  }
  RidgeChain other = ridge_along({side(-half, 90), side(-half, from)}, -1, -1, 0, 0);
  through.chain.confirmed = other.chain.confirmed = 60;
  return {through, other};
}

TEST(Corners, AnArmThatGoesOnThroughTheBlotOfAnAcuteCornerIsLedByItsSide) {
  for (const double degrees : {12.0, 20.0, 30.0}) {
    const Raster<std::uint8_t> ink = fork_ink(degrees, 0);
    const double blot = 1.1 * kWidth / (2 * std::sin(degrees * std::numbers::pi / 360));
    const auto joined = join_arms(arm_through_blot(degrees, blot), {}, plain(ink), {44, 3.6, 16, kWidth});
    ASSERT_EQ(joined.ridges.size(), 1u) << degrees;
    EXPECT_LT(distance_to_tip(joined.ridges[0].chain), 1) << degrees;
    if (degrees > 12) continue;  // the blot is short enough for lines beyond it to be seen
    EXPECT_EQ(join_arms(arm_through_blot(degrees, blot), {}, plain(ink), {44, 3.6, 0, kWidth}).ridges.size(), 2u)
        << "where acute corners do not count";
  }
}

TEST(Corners, WhatHangsTogetherInABlotGoesWithIt) {
  constexpr double kDegrees = 20;
  const Raster<std::uint8_t> ink = fork_ink(kDegrees, 0);
  const Vec2 centre = kTip - Vec2{9, 0};
  auto ridges = open_arms(kDegrees);
  ridges.push_back(ridge_along({kTip - Vec2{15, 0}, centre}, -1, 0, 10, 10));
  ridges.push_back(ridge_along({kTip - Vec2{13, 1.5}, centre}, -1, 0, 10, 10));
  ridges.push_back(ridge_along({centre, kTip}, 0, -1, 10, 10));
  EXPECT_EQ(join_arms(ridges, {centre}, plain(ink), {40, 3.6, 16, kWidth}).ridges.size(), 1u);
  ridges.push_back(ridge_along({centre, centre - Vec2{0, 40}}, 0, -1, 0, 0));
  EXPECT_EQ(join_arms(ridges, {centre}, plain(ink), {40, 3.6, 16, kWidth}).ridges.size(), 5u) << "one of them leads out";
}

// Slimming hollows blots out.
TEST(Corners, ArmsMeetOverInkThatSlimmingTook) {
  const Raster<std::uint8_t> drawn = fork_ink(20, 0);
  Raster<std::uint8_t> slim = drawn;
  for (int y = 0; y < 200; ++y)
    for (int x = 70; x < 92; ++x)
      if (std::abs(y + 0.5 - kTip.y) > 0.5) slim(x, y) = 0;
  EXPECT_EQ(join_arms(open_arms(20), {}, {slim, drawn}, {40, 3.6}).ridges.size(), 1u);
  EXPECT_EQ(join_arms(open_arms(20), {}, {slim, slim}, {40, 3.6}).ridges.size(), 2u);
}

TEST(Corners, ArmsEndInTheJunctionThatTheirForkHas) {
  const Vec2 fork = kTip + Vec2{1, 1};
  auto ridges = open_arms(20);
  ridges.push_back(ridge_along({kTip + Vec2{60, 0}, fork}, -1, 0, 0, 5));
  ridges.push_back(ridge_along({kTip + Vec2{0, 60}, fork}, -1, 0, 0, 5));
  ridges.push_back(ridge_along({fork, kTip - Vec2{12, 0}}, 0, -1, 0, 12));
  const auto joined = join_arms(ridges, {fork}, plain(fork_ink(20, 60)), {40, 3.6, 16, kWidth});
  EXPECT_EQ(joined.junctions.size(), 1u);
  ASSERT_EQ(joined.ridges.size(), 4u) << "what led into the blot is gone";
  for (const auto& ridge : joined.ridges) EXPECT_EQ(ridge.chain.end_junction, 0);
}

TEST(Corners, WhatIsConfirmedUpToTheTipIsNoSideOfAnAcuteCorner) {
  const Raster<std::uint8_t> ink = fork_ink(20, 0);
  auto ridges = open_arms(20);
  ridges[0] = ridge_along({side(-10, 80), kTip}, -1, -1, 0, 0);
  ridges[0].chain.confirmed = 80;
  EXPECT_EQ(join_arms(ridges, {}, plain(ink), {40, 3.6, 16, kWidth}).ridges.size(), 2u);
}

TEST(Corners, WhatFacesTheEndOfAnotherChainIsNoTip) {
  auto ridges = cut_corner(30, 10);
  ridges.push_back(ridge_along({kTip + Vec2{6, 0}, kTip + Vec2{60, 0}}, -1, -1, 0, 0));
  EXPECT_EQ(open_corners(ridges, {kTip}, plain(all_ink()), {25, 3.6}).size(), 4u);
}

// A tip that an end of the ink settles beyond a slit of the slimmed ink is none: there is no junction that a fork could end in.
TEST(Corners, CornersMakeNoJunctions) {
  const auto with_slits = [](std::initializer_list<int> columns) {
    Raster<std::uint8_t> ink = all_ink();
    for (const int x : columns)
      for (int y = 0; y < 200; ++y) ink(x, y) = 0;
    return ink;
  };
  const Raster<std::uint8_t> slim = with_slits({103, 104, 105, 113}), drawn = with_slits({113});
  auto ridges = open_arms(30);
  ridges.push_back(ridge_along({kTip + Vec2{80, 0}, kTip + Vec2{9, 0}}, -1, -1, 0, 0));
  ridges.back().chain.confirmed = 71;
  for (const auto& ridge : open_corners(ridges, {}, {slim, drawn}, {40, 3.6, 16, kWidth})) {
    EXPECT_EQ(ridge.chain.start_junction, -1);
    EXPECT_EQ(ridge.chain.end_junction, -1);
  }
}

// Round ends that touch are narrower there than slimming leaves.
TEST(Corners, EndsThatTouchAtAWideAngleStayApart) {
  const Raster<std::uint8_t> drawn = fork_ink(130, 0);
  Raster<std::uint8_t> slim = drawn;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      if (const double away = norm(Vec2{x + 0.5, y + 0.5} - kTip); away > 6 && away < 12) slim(x, y) = 0;
  EXPECT_EQ(open_corners(open_arms(130), {}, {slim, drawn}, {60, 3.6}).size(), 2u);
  EXPECT_EQ(open_corners(open_arms(130), {}, {drawn, drawn}, {60, 3.6}).size(), 1u);
}

Arrival arrival_along(Vec2 point, Vec2 direction) {
  return {true, point, unit(direction), 0, {}};
}

TEST(Tips, RoundEndsSayWhereTheyAreAndPointedOnesDoNot) {
  const Arrival a = arrival_along(side(12, 40), kTip - side(12, 40)), b = arrival_along(side(-12, 40), kTip - side(-12, 40));
  const CornerOptions options{60, 3.6, 16, kWidth};
  const Raster<std::uint8_t> round = fork_ink(24, 0), beyond = fork_ink(24, 3);
  EXPECT_LT(norm(settled_tip(kTip, a, b, kWidth, plain(round), options) - kTip), 0.5);
  EXPECT_LT(norm(settled_tip(kTip, a, b, kWidth, plain(beyond), options) - (kTip + Vec2{3, 0})), 0.5);
  Raster<std::uint8_t> mitre(200, 200, 0);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 120; ++x) mitre(x, y) = std::abs(y + 0.5 - kTip.y) < (110 - x - 0.5) * std::tan(0.21);
  EXPECT_TRUE(settled_tip(kTip, a, b, kWidth, plain(mitre), options) == kTip);
}

TEST(Tips, BentSidesMeetWhereTheirCurvesDo) {
  constexpr double kRadius = 250;
  for (const double degrees : {15.0, 30.0, 50.0}) {
    std::vector<Arrival> sides;
    for (const double sign : {-1.0, 1.0}) {
      const double start = sign * 0.5 * degrees * std::numbers::pi / 180;
      std::vector<Vec2> arc;
      for (double t = 0.7; t >= 0; t -= 0.005) {
        const double turn = start + sign * t;
        arc.push_back(kTip - kRadius * sign * Vec2{std::sin(turn) - std::sin(start), std::cos(start) - std::cos(turn)});
      }
      sides.push_back(arrival_at(ridge_along(arc, -1, -1, 0, 25), false));
    }
    const auto bent = bent_meeting_of(sides[0], sides[1], 80), straight = meeting_of(sides[0], sides[1], 0);
    ASSERT_TRUE(bent && straight) << degrees;
    EXPECT_LT(norm(*bent - kTip), 0.8) << degrees;
    EXPECT_GT(norm(*straight - kTip), 3 * norm(*bent - kTip)) << "of lines";
  }
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
  const auto found = open_corners({ridge}, {}, plain(ink), {25, 3.6});
  for (const Vec2 p : found[0].chain.points) EXPECT_LT(std::abs(norm(p - centre) - kRadius), 0.5);
}

}  // namespace
}  // namespace inkgrid
