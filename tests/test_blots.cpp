#include <gtest/gtest.h>

#include <numbers>

#include "base/polyline.h"
#include "chain_checks.h"
#include "drawn_bands.h"
#include "refine/blots.h"

namespace inkgrid {
namespace {

constexpr double kPen = 6;
constexpr Vec2 kCentre{100.3, 99.6};
const BlotOptions kOptions{7 * kPen, kPen, 1};

Vec2 polar(double radius, double angle) {
  return radius * Vec2{std::cos(angle), std::sin(angle)};
}

// A chain along the points, of which those nearer to the centre than `blot` are not confirmed.
RidgeChain ridge_along(const std::vector<Vec2>& points, double blot) {
  RidgeChain ridge;
  ridge.chain.points = resampled(points, 1);
  ridge.chain.width = kPen;
  for (const Vec2 p : ridge.chain.points)
    ridge.sections.push_back(norm(p - kCentre) < blot ? CrossSection{} : CrossSection{0, kPen, 1});
  return ridge;
}

struct Star {
  Blots chains;
  Ink ink;
};

// Arms at these angles, whose chains lose their way in the blot and end or join there.
Star star(const std::vector<double>& angles, double blot) {
  Star star;
  Image image = testing::blank(200, 200);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    testing::paint(image, {kCentre, kCentre + polar(80, angles[k])}, kPen);
    const Vec2 inside = kCentre + polar(0.4 * blot, angles[k] + 1.1);
    star.chains.ridges.push_back(ridge_along({kCentre + polar(80, angles[k]), kCentre + polar(blot, angles[k]), inside}, blot));
    star.chains.ridges.back().chain.end_junction = 0;
  }
  star.chains.junctions = {kCentre + Vec2{3, -4}};
  star.ink = testing::drawn_ink(image);
  return star;
}

Blots met(const Star& star) {
  return meet_in_blots(star.chains.ridges, star.chains.junctions, star.ink, star.ink.mask, kOptions);
}

bool same(const Blots& a, const Blots& b) {
  if (a.ridges.size() != b.ridges.size() || a.junctions.size() != b.junctions.size()) return false;
  for (std::size_t k = 0; k < a.ridges.size(); ++k)
    if (a.ridges[k].chain.points != b.ridges[k].chain.points || a.ridges[k].chain.end_junction != b.ridges[k].chain.end_junction)
      return false;
  return true;
}

class EachStar : public ::testing::TestWithParam<std::vector<double>> {};

TEST_P(EachStar, MeetsInOnePointAlongStraightArms) {
  const Blots blots = met(star(GetParam(), 11));
  ASSERT_EQ(blots.ridges.size(), GetParam().size());
  for (std::size_t k = 0; k < blots.ridges.size(); ++k) {
    const RidgeChain& arm = blots.ridges[k];
    ASSERT_GE(arm.chain.end_junction, 1) << "a new junction";
    const Vec2 meeting = blots.junctions[static_cast<std::size_t>(arm.chain.end_junction)];
    EXPECT_LT(norm(meeting - kCentre), 0.3);
    EXPECT_EQ(arm.chain.points.back(), meeting);
    EXPECT_EQ(arm.sections.size(), arm.chain.points.size());
    const Vec2 direction = polar(1, GetParam()[k]);
    for (const Vec2 p : arm.chain.points) EXPECT_LT(std::abs(cross(direction, p - kCentre)), 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(Blots, EachStar,
                         ::testing::Values(std::vector{0.1, 2.3, 4.0}, std::vector{0.3, 1.9, 3.4, 5.1},
                                           std::vector{0.0, 1.2, 2.4, 3.6, 5.0}, std::vector{0.2, 1.3, 2.2, 3.3, 4.3, 5.4}));

TEST(Blots, AHollowThatSlimmingMadeIsNoPaper) {
  Star hollow = star({0.1, 2.3, 4.0}, 11);
  const Raster<std::uint8_t> drawn = hollow.ink.mask;
  for (int y = 95; y < 105; ++y)
    for (int x = 95; x < 105; ++x) hollow.ink.mask(x, y) = 0;
  EXPECT_TRUE(same(met(hollow), hollow.chains)) << "paper in the middle";
  EXPECT_EQ(meet_in_blots(hollow.chains.ridges, hollow.chains.junctions, hollow.ink, drawn, kOptions).junctions.size(), 2u);
}

// The ink of two arms at an acute angle is that of one stroke for long: the third one's chain goes on into it.
TEST(Blots, TheStemOfASharpForkMayHavePassedIt) {
  const std::vector<double> arms{-0.13, 0.13, std::numbers::pi};
  Image image = testing::blank(200, 200);
  std::vector<RidgeChain> ridges;
  for (const double angle : arms) {
    testing::paint(image, {kCentre, kCentre + polar(90, angle)}, kPen);
    ridges.push_back(ridge_along({kCentre + polar(90, angle), kCentre + polar(angle < 1 ? 24 : -5, angle)}, angle < 1 ? 28 : 0));
  }
  const Ink ink = testing::drawn_ink(image);
  const Blots blots = meet_in_blots(ridges, {}, ink, ink.mask, kOptions);
  ASSERT_EQ(blots.junctions.size(), 1u);
  EXPECT_LT(norm(blots.junctions[0] - kCentre), 0.5);
  EXPECT_NEAR(lengths_along(blots.ridges[2].chain.points).back(), 90, 0.6) << "not past the junction and back";
}

TEST(Blots, TwoArmsStayAsTheyAre) {
  const Star pair = star({0.2, 2.9}, 11);
  EXPECT_TRUE(same(met(pair), pair.chains));
}

TEST(Blots, LinesThatMissEachOtherStayAsTheyAre) {
  Star missing = star({0.1, 2.3, 4.0}, 11);
  for (Vec2& p : missing.chains.ridges[1].chain.points) p += Vec2{4, 4};
  EXPECT_TRUE(same(met(missing), missing.chains));
}

TEST(Blots, ArmsInOneLineMeetNowhereInParticular) {
  const Star line = star({0.1, 0.1 + std::numbers::pi, 0.1}, 11);
  EXPECT_TRUE(same(met(line), line.chains));
}

TEST(Blots, WhatLeadsFarFromTheMeetingIsNotLost) {
  Star longer = star({0.1, 2.3, 4.0}, 11);
  Image image = testing::blank(200, 200);
  for (const double angle : {0.1, 2.3, 4.0}) testing::paint(image, {kCentre, kCentre + polar(80, angle)}, kPen);
  testing::paint(image, {kCentre, kCentre + polar(20, 1.2)}, kPen);
  longer.ink = testing::drawn_ink(image);
  RidgeChain stub = ridge_along({kCentre, kCentre + polar(20, 1.2)}, 100);
  stub.chain.start_junction = 0;
  longer.chains.ridges.push_back(stub);
  EXPECT_TRUE(same(met(longer), longer.chains));
}

TEST(Blots, AClosedChainThatIsCutKeepsAllButItsBlot) {
  Image image = testing::blank(200, 240);
  const std::vector<Vec2> loop = testing::circle(kCentre + Vec2{0, 60}, 60);
  testing::paint(image, loop, kPen);
  testing::paint(image, {kCentre, kCentre - Vec2{0, 80}}, kPen);
  RidgeChain round = ridge_along(loop, 9);
  round.chain.closed = true;
  RidgeChain stem = ridge_along({kCentre - Vec2{0, 80}, kCentre - Vec2{0, 4}}, 9);
  const Ink ink = testing::drawn_ink(image);
  const Blots blots = meet_in_blots({round, stem}, {}, ink, ink.mask, kOptions);
  ASSERT_EQ(blots.junctions.size(), 1u);
  EXPECT_LT(norm(blots.junctions[0] - kCentre), 1);
  double length = 0;
  for (const RidgeChain& ridge : blots.ridges) {
    EXPECT_FALSE(ridge.chain.closed);
    length += lengths_along(ridge.chain.points).back();
  }
  EXPECT_NEAR(length, 2 * std::numbers::pi * 60 + 80, 4);
}

}  // namespace
}  // namespace inkgrid
