// Junctions of chains whose arrival is known by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "base/polyline.h"
#include "refine/junctions.h"

namespace inkgrid {
namespace {

constexpr double kWidth = 6;
constexpr int kBlot = 10;  // points that no ink confirms, from the junction
const Raster<std::uint8_t> kNoInk(200, 200, 0), kAllInk(200, 200, 1);
const CornerInk kPaper{kNoInk, kNoInk}, kInk{kAllInk, kAllInk};

// From the junction, number 0, at `start`; confirmed on a line from `centre` on, `wave` px beside it before that.
RidgeChain arm(Vec2 start, Vec2 centre, Vec2 direction, double wave = 0) {
  RidgeChain arm;
  arm.chain.width = kWidth;
  arm.chain.start_junction = 0;
  arm.chain.points = {start};
  for (int k = 1; k <= 60; ++k) {
    const double aside = k >= kBlot ? 0 : k % 2 == 0 ? wave : -wave;
    arm.chain.points.push_back(centre + static_cast<double>(k) * direction + aside * quarter_turn(direction));
  }
  for (int k = 0; k <= 60; ++k) arm.sections.push_back(k < kBlot ? CrossSection{} : CrossSection{0, kWidth, 1});
  return arm;
}

const Vec2 kCentre{100, 100};
constexpr Vec2 kEast{1, 0}, kWest{-1, 0}, kNorth{0, -1}, kSouth{0, 1};

TEST(LocatedJunctions, BetweenTwoArmsInLineStayWhereTheyWereAlongTheLine) {
  const Vec2 old{102, 99};
  const Vec2 found = locate_junctions({arm(old, kCentre, kEast), arm(old, kCentre, kWest)}, {old}, kInk, {10, 10}).junctions[0];
  EXPECT_NEAR(found.x, 102, 1e-9);
  EXPECT_NEAR(found.y, 100, 0.003) << "the old place weighs next to nothing";
}

TEST(LocatedJunctions, ArmsOfWhichNothingIsKnownSayNothing) {
  const Vec2 old{102, 99};
  RidgeChain unknown = arm(old, kCentre, kSouth);
  for (CrossSection& section : unknown.sections) section = {};
  EXPECT_EQ(locate_junctions({arm(old, kCentre, kEast), unknown}, {old}, kInk, {10, 10}).junctions[0], old) << "one arm";
  const Vec2 met =
      locate_junctions({arm(old, kCentre, kEast), unknown, arm(old, kCentre, kNorth)}, {old}, kInk, {10, 10}).junctions[0];
  EXPECT_LT(norm(met - kCentre), 0.02);
}

TEST(LocatedJunctions, MoveFurtherOverInkThanOverPaper) {
  const Vec2 old{110, 100};
  const auto located = [&](const CornerInk& ink, JunctionOptions options) {
    return locate_junctions({arm(old, kCentre, kNorth), arm(old, kCentre, kWest), arm(old, kCentre, kSouth)}, {old}, ink, options)
        .junctions[0];
  };
  EXPECT_LT(norm(located(kInk, {4, 20}) - kCentre), 0.05);
  EXPECT_LT(norm(located(kPaper, {4, 20}) - Vec2{106, 100}), 0.01);
  EXPECT_LT(norm(located(kInk, {4, 8}) - Vec2{106, 100}), 0.01) << "over more ink than strokes share";
  EXPECT_LT(norm(located(kPaper, {12, 12}) - kCentre), 0.05) << "near enough";
}

// Lines of bent sides meet far beyond the ink of a sharp bend.
TEST(LocatedJunctions, OnInkDoNotLeaveIt) {
  const auto located = [](int first_paper) {
    Raster<std::uint8_t> ink = kAllInk;
    for (int y = 0; y < ink.height; ++y)
      for (int x = 0; x < first_paper; ++x) ink(x, y) = 0;
    const Vec2 old{110, 100};
    return locate_junctions({arm(old, kCentre, kNorth), arm(old, kCentre, kSouth)}, {old}, {ink, ink}, {12, 5}).junctions[0];
  };
  EXPECT_LT(norm(located(103) - kCentre), 0.05) << "but by a third of how far they may move";
  EXPECT_EQ(located(105), (Vec2{110, 100}));
}

// How far the points in the blot are from the straight way between the last point that is confirmed and the junction.
double wave_left(double beside) {
  const Vec2 junction = kCentre + Vec2{0, beside};
  const Chain chain = locate_junctions({arm(junction, kCentre, kEast, 0.8)}, {junction}, kInk, {0, 0}).chains[0];
  EXPECT_EQ(chain.points.front(), junction);
  double farthest = 0;
  for (int k = 0; k < kBlot; ++k)
    farthest = std::max(farthest, distance_to_segment(chain.points[static_cast<std::size_t>(k)], junction, chain.points[kBlot]));
  return farthest;
}

TEST(LocatedJunctions, OnTheLineOfAnArmItsUnconfirmedPointsGoStraightThere) {
  EXPECT_LT(wave_left(0.25 * kWidth), 1e-9);
  EXPECT_GT(wave_left(0.35 * kWidth), 0.5) << "beside the line they are bent there";
}

}  // namespace
}  // namespace inkgrid
