#include <gtest/gtest.h>

#include <numbers>

#include "chain_checks.h"
#include "refine/ends.h"
#include "refine/junctions.h"

namespace inkgrid {
namespace {

using std::numbers::pi;
using testing::blank;
using testing::chain_along;
using testing::expect_consistent;
using testing::ink_of;
using testing::length_of;
using testing::paint;

constexpr double kWidth = 6;
constexpr RidgeOptions kRidge{1, 1.8, 3};
constexpr EndOptions kEnds{1.5 * kWidth, 1.5 * kWidth, 1, 1, 0};

Vec2 towards(double degrees) {
  return {std::cos(degrees * pi / 180), std::sin(degrees * pi / 180)};
}

// Paints a star of strokes, 70 px long, at these angles; traces it a pixel beside its lines with the junction 3 px off, and
// locates that.
Chains located_star(Vec2 centre, const std::vector<double>& degrees) {
  Image image = blank(200, 200);
  const Vec2 guess = centre + Vec2{2, -2};
  std::vector<Chain> chains;
  for (const double angle : degrees) {
    const Vec2 tip = centre + 70.0 * towards(angle);
    paint(image, {centre, tip}, kWidth);
    chains.push_back(chain_along({guess, tip + quarter_turn(towards(angle))}, kWidth, 0, -1));
    if (chains.size() % 2 == 0) {
      std::reverse(chains.back().points.begin(), chains.back().points.end());
      std::swap(chains.back().start_junction, chains.back().end_junction);
    }
  }
  const Ink ink = ink_of(image);
  return locate_junctions(follow_ridges(chains, ink, kRidge), {guess}, {ink.mask, ink.mask}, {1.5 * kWidth, 1.5 * kWidth});
}

void expect_located(const std::vector<double>& degrees, double tolerance) {
  for (const Vec2 centre : {Vec2{100, 100}, Vec2{100.4, 99.3}}) {
    const Chains chains = located_star(centre, degrees);
    ASSERT_EQ(chains.junctions.size(), 1u);
    ASSERT_EQ(chains.chains.size(), degrees.size());
    EXPECT_LT(norm(chains.junctions[0] - centre), tolerance) << centre.x;
    expect_consistent(chains);
  }
}

TEST(Junctions, TeesAreWhereTheStrokesMeet) {
  expect_located({0, 90, 180}, 0.3);
}

TEST(Junctions, EvenForksAreWhereTheStrokesMeet) {
  expect_located({30, 150, 270}, 0.3);
}

TEST(Junctions, NoneMovesFartherThanAllowed) {
  Image image = blank(200, 200);
  std::vector<Chain> chains;
  const Vec2 centre{100, 100}, guess{108, 100};
  for (const double angle : {90.0, 180.0, 270.0}) {
    paint(image, {centre, centre + 70.0 * towards(angle)}, kWidth);
    chains.push_back(chain_along({guess, centre + 70.0 * towards(angle)}, kWidth, 0, -1));
  }
  const Ink ink = ink_of(image);
  const Chains held = locate_junctions(follow_ridges(chains, ink, kRidge), {guess}, {ink.mask, ink.mask}, {0.5, 0.5});
  EXPECT_LE(norm(held.junctions[0] - guess), 0.5 + 1e-9);
  expect_consistent(held);
}

TEST(Ends, FreeEndsReachTheEndOfTheirInk) {
  for (const double degrees : {0.0, 45.0, 90.0}) {
    const Vec2 axis = towards(degrees), a = Vec2{100.3, 100.8} - 60.0 * axis, b = Vec2{100.3, 100.8} + 60.0 * axis;
    Image image = blank(200, 200);
    paint(image, {a, b}, kWidth);
    const Ink ink = ink_of(image);
    for (const double excess : {-8.0, -3.0, 0.0, 2.0, 5.0}) {
      const Chains reached = reach_ends({{}, {chain_along({a - excess * axis, b + excess * axis}, kWidth)}}, ink, kEnds);
      ASSERT_EQ(reached.chains.size(), 1u);
      EXPECT_LT(norm(reached.chains[0].points.front() - a), 0.6) << degrees << " " << excess;
      EXPECT_LT(norm(reached.chains[0].points.back() - b), 0.6) << degrees << " " << excess;
      EXPECT_NEAR(length_of(reached.chains[0]), 120, 1.2) << degrees << " " << excess;
    }
  }
}

TEST(Ends, TheLastStrokeOfABundleEndsHalfItsOwnWidthInside) {
  for (const double degrees : {0.0, 30.0}) {
    const Vec2 axis = towards(degrees), a = Vec2{100.3, 100.8} - 60.0 * axis, b = Vec2{100.3, 100.8} + 60.0 * axis;
    Image image = blank(200, 200);
    paint(image, {a, b}, 4);
    paint(image, {a, b - 30.0 * axis}, 12);
    const Chains reached = reach_ends({{}, {chain_along({a, b}, 12)}}, ink_of(image), kEnds);
    EXPECT_LT(norm(reached.chains[0].points.back() - b), 1.05) << degrees;
  }
}

TEST(Ends, AnEndThatTurnsBackInItsStrokeEndsAtTheTurn) {
  Image image = blank(160, 60);
  paint(image, {{20, 30}, {140, 30}}, kWidth);
  Chain folded = chain_along({{20, 30}, {138, 29}, {131, 30.5}, {135, 31}}, kWidth);
  for (const bool at_start : {false, true}) {
    const Chains reached = reach_ends({{}, {folded}}, ink_of(image), kEnds);
    const auto& points = reached.chains[0].points;
    EXPECT_NEAR(length_of(reached.chains[0]), 120, 1.5) << at_start;
    for (std::size_t k = 1; k < points.size(); ++k)
      EXPECT_GT((points[k].x - points[k - 1].x) * (at_start ? -1 : 1), 0) << at_start;
    std::reverse(folded.points.begin(), folded.points.end());
  }
}

TEST(Ends, AHookThatWasDrawnStays) {
  const std::vector<Vec2> hook{{20, 30}, {130, 30}, {136, 36}, {130, 42}, {118, 42}};
  Image image = blank(160, 80);
  paint(image, hook, kWidth);
  const Chain drawn = chain_along(hook, kWidth);
  EXPECT_NEAR(length_of(reach_ends({{}, {drawn}}, ink_of(image), kEnds).chains[0]), length_of(drawn), 3);
}

TEST(Ends, EndsAtJunctionsAndClosedChainsAreLeftAlone) {
  Image image = blank(200, 200);
  paint(image, {{20, 100}, {180, 100}}, kWidth);
  Chain loop = chain_along(testing::circle({100, 100}, 20), kWidth);
  loop.points.back() = loop.points.front();
  loop.closed = true;
  const Chains before{{{60, 100}}, {chain_along({{60, 100}, {20, 100}}, kWidth, 0, -1), loop}};
  const Chains after = reach_ends(before, ink_of(image), kEnds);
  EXPECT_TRUE(after.chains[0].points.front() == before.junctions[0]);
  EXPECT_TRUE(after.chains[1].points == loop.points);
}

// A bar with a stem on it, and the stem's chain ending this far (px) above the bar's.
Chains bar_and_stem(Image& image, double apart) {
  paint(image, {{20, 120}, {180, 120}}, kWidth);
  paint(image, {{97, 20}, {97, 120}}, kWidth);
  return {{}, {chain_along({{20, 120}, {180, 120}}, kWidth), chain_along({{97, 20}, {97, 120 - apart}}, kWidth)}};
}

TEST(Ends, AnEndThatInkLinksToAChainIsAttached) {
  Image image = blank(200, 200);
  const Chains traced = bar_and_stem(image, 0.8 * kWidth);
  const Chains attached = attach_ends(traced, ink_of(image), kEnds);
  ASSERT_EQ(attached.junctions.size(), 1u);
  EXPECT_EQ(attached.chains.size(), 3u);
  EXPECT_LT(norm(attached.junctions[0] - Vec2{97, 120}), 1.0);
  expect_consistent(attached);
  double length = 0;
  for (const auto& chain : attached.chains) length += length_of(chain);
  EXPECT_NEAR(length, 260, 0.5);
}

TEST(Ends, AnEndWithPaperBeforeItStaysFree) {
  Image image = blank(200, 200);
  paint(image, {{20, 120}, {180, 120}}, kWidth);
  paint(image, {{97, 20}, {97, 109}}, kWidth);
  const Chains traced{{}, {chain_along({{20, 120}, {180, 120}}, kWidth), chain_along({{97, 20}, {97, 112}}, kWidth)}};
  const Chains kept = attach_ends(traced, ink_of(image), kEnds);
  EXPECT_TRUE(kept.junctions.empty());
  EXPECT_EQ(kept.chains.size(), 2u);
}

// The nearest chain to the ink ahead may lie beyond a slit that the reach of the ink closes.
TEST(Ends, OneThatStopsDeepInTheInkIsAttached) {
  Image image = blank(200, 200);
  const Chains traced = bar_and_stem(image, 20);
  EXPECT_EQ(attach_ends(traced, ink_of(image), kEnds).junctions.size(), 0u);
  const Chains attached = attach_ends(traced, ink_of(image), deep_ends(kWidth));
  ASSERT_EQ(attached.junctions.size(), 1u);
  EXPECT_EQ(attached.chains.size(), 3u);
  EXPECT_LT(norm(attached.junctions[0] - Vec2{97, 120}), 1);
  expect_consistent(attached);
}

TEST(Ends, CapsAreNotDeepInTheInk) {
  Image image = blank(200, 200);
  const Chains traced = bar_and_stem(image, 2);
  EXPECT_EQ(attach_ends(traced, ink_of(image), deep_ends(kWidth)).junctions.size(), 0u);
}

TEST(Ends, AnEndIsNotAttachedOverASlit) {
  Image image = blank(100, 200);
  paint(image, {{40, 20}, {40, 180}}, 2);
  paint(image, {{44, 20}, {44, 180}}, 2);
  const Chains traced{{}, {chain_along({{40, 28}, {40, 180}}, 2), chain_along({{44, 20}, {44, 180}}, 2)}};
  const Chains kept = attach_ends(traced, ink_of(image), {3, 14, 1, 1, 0});
  EXPECT_TRUE(kept.junctions.empty());
  EXPECT_EQ(kept.chains.size(), 2u);
}

TEST(Ends, TwoEndsInOneStrokeBecomeOneChain) {
  Image image = blank(200, 100);
  paint(image, {{20, 50}, {180, 50}}, kWidth);
  const Chains traced{{}, {chain_along({{20, 50}, {98, 50}}, kWidth), chain_along({{180, 50}, {102, 50}}, kWidth)}};
  const Chains joined = attach_ends(traced, ink_of(image), kEnds);
  ASSERT_EQ(joined.chains.size(), 1u);
  EXPECT_TRUE(joined.junctions.empty());
  EXPECT_NEAR(length_of(joined.chains[0]), 160, 1e-6);
}

// Two strokes in line, but for `aside` px and `gap` px of paper between them.
Chains gapped(Image& image, double gap, double aside) {
  const double half = 0.5 * (gap + kWidth);
  const std::vector<Vec2> a{{20, 50}, {100 - half, 50}}, b{{180, 50 + aside}, {100 + half, 50 + aside}};
  paint(image, a, kWidth);
  paint(image, b, kWidth);
  return {{}, {chain_along(a, kWidth), chain_along(b, kWidth)}};
}

TEST(Ends, EndsThatPassedEachOtherInOneStrokeMeetAndArmsOfATeeDoNot) {
  Image image = blank(200, 100);
  paint(image, {{20, 50}, {180, 50}}, kWidth);
  const Ink ink = ink_of(image);
  const EndOptions options{1.5 * kWidth, 5 * kWidth, 1, 1, 0};
  const Chains passed{{}, {chain_along({{20, 49}, {112, 49}}, kWidth), chain_along({{92, 51}, {180, 51}}, kWidth)}};
  EXPECT_EQ(join_facing_ends(passed, ink, options).chains.size(), 1u);
  Chains tee{{{100, 50}},
             {chain_along({{100, 50}, {112, 50}}, kWidth), chain_along({{100, 50}, {92, 50}}, kWidth),
              chain_along({{100, 50}, {100, 20}}, kWidth)}};
  for (Chain& arm : tee.chains) arm.start_junction = 0;
  EXPECT_EQ(join_facing_ends(tee, ink, options).chains.size(), 3u);
}

TEST(Ends, GapsInALineAreBridgedAndOthersAreNot) {
  const auto count = [](double gap, double aside, double allowed) {
    Image image = blank(200, 100);
    const Chains apart = gapped(image, gap, aside);
    EndOptions options = kEnds;
    options.gap = allowed;
    return join_facing_ends(apart, ink_of(image), options).chains.size();
  };
  for (const double gap : {2.0, 3.0, 4.0}) EXPECT_EQ(count(gap, 0, 5), 1u) << gap;
  EXPECT_EQ(count(4, 0, 0), 2u);
  EXPECT_EQ(count(9, 0, 5), 2u);
  EXPECT_EQ(count(4, 5, 5), 2u);
}

TEST(Ends, WhatTheInkDoesNotConfirmOfAnEndIsCutOff) {
  Image image = blank(200, 100);
  paint(image, {{20, 50}, {120, 50}}, kWidth);
  const auto ridges = follow_ridges({chain_along({{20, 50}, {118, 50}, {128, 58}}, kWidth)}, ink_of(image), kRidge);
  const Chains straight = straightened_ends(ridges, {}, 30);
  ASSERT_EQ(straight.chains.size(), 1u);
  EXPECT_LT(straight.chains[0].points.back().x, 126);
  for (const Vec2 p : straight.chains[0].points) EXPECT_NEAR(p.y, 50, 1);
}

TEST(Ends, AnEndOnALoopLeavesTheLoopWhole) {
  Image image = blank(200, 200);
  auto circle = testing::circle({100, 100}, 40);
  circle.back() = circle.front();
  paint(image, circle, kWidth);
  paint(image, {{20, 100}, {60, 100}}, kWidth);
  Chain loop = chain_along(circle, kWidth);
  loop.closed = true;
  const Chains attached = attach_ends({{}, {loop, chain_along({{20, 100}, {55, 100}}, kWidth)}}, ink_of(image), kEnds);
  ASSERT_EQ(attached.junctions.size(), 1u);
  ASSERT_EQ(attached.chains.size(), 2u);
  expect_consistent(attached);
  EXPECT_NEAR(std::max(length_of(attached.chains[0]), length_of(attached.chains[1])), length_of(loop), 0.5);
}

}  // namespace
}  // namespace inkgrid
