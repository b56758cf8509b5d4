// Turns of a pen that leave no paper between its two ways, on ink painted along known lines.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/polyline.h"
#include "chain_checks.h"
#include "refine/blots.h"
#include "refine/confirmed.h"
#include "refine/turns.h"

namespace inkgrid {
namespace {

constexpr double kPen = 8, kLongest = 60;
constexpr Vec2 kTip{100, 100};

Raster<std::uint8_t> ink_along(const std::vector<std::vector<Vec2>>& lines) {
  Image image = testing::blank(200, 200);
  for (const auto& line : lines) testing::paint(image, line, kPen);
  return testing::ink_of(image).mask;
}

// From the left to the tip, so many px beside the middle at `ahead` px before it, and as far from there on.
std::vector<Vec2> side(double beside, double ahead) {
  return {kTip + Vec2{-80, beside * 80 / ahead}, kTip};
}

Arrival arrival(Vec2 point, Vec2 direction) {
  return {true, point, unit(direction), 0, {}};
}

// Of a side that is seen up to `ahead` px before the tip.
Arrival arrival_on(const std::vector<Vec2>& line, double ahead) {
  const Vec2 direction = unit(line[1] - line[0]);
  return arrival(kTip - ahead * direction, direction);
}

TEST(Turns, AreHalfAPenBeforeTheRoundEndOfTheInk) {
  for (const double degrees : {10.0, 25.0, 45.0, 70.0}) {
    const double slope = std::tan(0.5 * degrees * std::numbers::pi / 180);
    const auto up = side(-20 * slope, 20), down = side(20 * slope, 20);
    const Raster<std::uint8_t> ink = ink_along({up, down});
    const double ahead = std::min(55.0, 1.2 * kPen / (2 * std::sin(0.5 * degrees * std::numbers::pi / 180)));
    const auto found = turn_of(arrival_on(up, ahead), arrival_on(down, ahead), ink, kPen, kLongest);
    ASSERT_TRUE(found) << degrees;
    EXPECT_LT(norm(*found - kTip), 1) << degrees;
  }
}

// Two parallel ways, their middles so many pens apart, around half a circle.
std::vector<Vec2> hairpin(double pens) {
  std::vector<Vec2> line{kTip + Vec2{-60, -0.5 * pens * kPen}};
  for (int k = 0; k <= 30; ++k) {
    const double angle = (k / 30.0 - 0.5) * std::numbers::pi;
    line.push_back(kTip + 0.5 * pens * kPen * Vec2{std::cos(angle), std::sin(angle)});
  }
  line.push_back(kTip + Vec2{-60, 0.5 * pens * kPen});
  return line;
}

std::optional<Vec2> turn_of_hairpin(double pens, const Raster<std::uint8_t>& ink) {
  const Vec2 up{-10, -0.5 * pens * kPen}, down{-10, 0.5 * pens * kPen};
  return turn_of(arrival(kTip + up, {1, 0}), arrival(kTip + down, {1, 0}), ink, kPen, kLongest);
}

TEST(Turns, OfParallelWaysAreAtTheirBend) {
  for (const double pens : {1.2, 1.35}) {
    const auto found = turn_of_hairpin(pens, ink_along({hairpin(pens)}));
    ASSERT_TRUE(found) << pens;
    EXPECT_LT(norm(*found - (kTip + Vec2{0.5 * pens * kPen, 0})), 1) << pens;
  }
}

TEST(Turns, WithPaperInsideAreBends) {
  EXPECT_FALSE(turn_of_hairpin(2, ink_along({hairpin(2)})));
}

TEST(Turns, EndNoSidesOfALineThatGoesOnAcross) {
  EXPECT_FALSE(turn_of_hairpin(1.3, ink_along({hairpin(1.3), {kTip + Vec2{4, -70}, kTip + Vec2{4, 70}}})));
}

TEST(Turns, LieNotWhereAnotherStrokeBegins) {
  EXPECT_FALSE(turn_of_hairpin(1.3, ink_along({hairpin(1.3), {kTip, kTip + Vec2{90, 0}}})));
}

TEST(Turns, LieNotBetweenTheEndsOfStrokesThatCross) {
  const auto up = side(-12, 40), down = side(12, 40);
  const auto beyond = [](const std::vector<Vec2>& line) { return std::vector{line[0], kTip + 14.0 * unit(line[1] - line[0])}; };
  EXPECT_TRUE(turn_of(arrival_on(up, 18), arrival_on(down, 18), ink_along({up, down}), kPen, kLongest));
  EXPECT_FALSE(turn_of(arrival_on(up, 18), arrival_on(down, 18), ink_along({beyond(up), beyond(down)}), kPen, kLongest));
}

TEST(Turns, NeedSidesThatAreKnownAndLeadThere) {
  const auto up = side(-12, 40), down = side(12, 40);
  const Raster<std::uint8_t> ink = ink_along({up, down});
  const Arrival a = arrival_on(up, 18), b = arrival_on(down, 18);
  EXPECT_FALSE(turn_of(Arrival{}, b, ink, kPen, kLongest));
  EXPECT_FALSE(turn_of(a, b, ink, kPen, 15)) << "further away";
  EXPECT_FALSE(turn_of(arrival(a.point, -a.direction), arrival(b.point, -b.direction), ink, kPen, kLongest)) << "the other way";
}

RidgeChain confirmed_along(const std::vector<Vec2>& line, double weight = 1) {
  RidgeChain ridge;
  ridge.chain.points = resampled(line, 1);
  ridge.chain.width = kPen;
  ridge.sections.assign(ridge.chain.points.size(), {0, kPen, weight});
  return ridge;
}

TEST(SlenderPoints, AreWhereTheInkIsOnePenWide) {
  const auto up = side(-12, 40), down = side(12, 40);
  const auto slender = slender_points(confirmed_along(up), ink_along({up, down}), kPen);
  const auto lengths = lengths_along(confirmed_along(up).chain.points);
  // The sides are 1.2 pens wide together where their middles are .2 pens apart: less than that is not told from one pen.
  for (std::size_t k = 3; k < lengths.size(); ++k) {
    const double to_tip = lengths.back() - lengths[k];
    if (to_tip > 22) {
      EXPECT_TRUE(slender[k]) << to_tip;
    } else if (to_tip < 14) {
      EXPECT_FALSE(slender[k]) << to_tip << ", of which the last ones are but a stub";
    }
  }
}

TEST(SlenderPoints, AreNotWhereNothingIsConfirmed) {
  const std::vector<Vec2> line{{20, 100}, {180, 100}};
  const auto slender = slender_points(confirmed_along(line, 0), ink_along({line}), kPen);
  EXPECT_EQ(std::count(slender.begin(), slender.end(), 1), 0);
}

// What the grid leaves in such a blot: sides that meet in a Y, with a stem.
TEST(TurnInBlots, AStemBetweenTwoSidesIsNoBranch) {
  const auto up = side(-12, 40), down = side(12, 40);
  Image image = testing::blank(200, 200);
  for (const auto& line : {up, down}) testing::paint(image, line, kPen);
  const Ink ink = testing::ink_of(image);
  const Vec2 fork = kTip - Vec2{16, 0};
  std::vector<RidgeChain> ridges{confirmed_along({up[0], kTip - Vec2{26, 7.8}, fork}),
                                 confirmed_along({down[0], kTip + Vec2{-26, 7.8}, fork}), confirmed_along({fork, kTip}, 0)};
  for (RidgeChain& side : {std::ref(ridges[0]), std::ref(ridges[1])})
    for (std::size_t k = side.sections.size() - 15; k < side.sections.size(); ++k) side.sections[k] = {};
  ridges[0].chain.end_junction = ridges[1].chain.end_junction = ridges[2].chain.start_junction = 0;
  const auto turned = [&](double longest) { return turn_in_blots(ridges, {fork}, InkBands(ink), ink.mask, {longest, kPen, 1}); };
  const Blots found = turned(kLongest);
  ASSERT_EQ(found.ridges.size(), 2u);
  ASSERT_EQ(found.junctions.size(), 2u);
  EXPECT_LT(norm(found.junctions[1] - kTip), 1);
  for (const RidgeChain& ridge : found.ridges) {
    EXPECT_EQ(ridge.chain.end_junction, 1);
    EXPECT_TRUE(ridge.chain.points.back() == found.junctions[1]);
    EXPECT_EQ(ridge.sections.size(), ridge.chain.points.size());
  }
  EXPECT_EQ(turned(10).ridges.size(), 3u) << "too far away";
}

}  // namespace
}  // namespace inkgrid
