#include <gtest/gtest.h>

#include <numeric>

#include "chain_checks.h"
#include "refine/simplify.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::chain_along;
using testing::expect_consistent;
using testing::ink_of;
using testing::length_of;
using testing::paint;

constexpr double kWidth = 6;
constexpr double kDoubled = 0.35 * kWidth;
constexpr double kSpur = 0.35;

// Two halves of a line that meet at a junction, with a branch of this length square to them.
Chains line_with_branch(double branch) {
  return {{{100, 100}},
          {chain_along({{20, 100}, {100, 100}}, kWidth, -1, 0), chain_along({{100, 100}, {180, 100}}, kWidth, 0, -1),
           chain_along({{100, 100}, {100, 100 - branch}}, kWidth, 0, -1)}};
}

// Two junctions, `gap` apart, with two outer branches each.
Chains ladder(double gap, double confirmed) {
  const Vec2 a{100 - gap / 2, 100}, b{100 + gap / 2, 100};
  Chains chains{
      {a, b},
      {chain_along({{20, 40}, a}, kWidth, -1, 0), chain_along({a, {20, 160}}, kWidth, 0, -1), chain_along({a, b}, kWidth, 0, 1),
       chain_along({{180, 40}, b}, kWidth, -1, 1), chain_along({b, {180, 160}}, kWidth, 1, -1)}};
  chains.chains[2].confirmed = confirmed;
  return chains;
}

TEST(Simplify, OfTwoDoublesTheLongerStays) {
  for (const bool longer_first : {true, false}) {
    Chains chains{{}, {chain_along({{20, 50}, {180, 50}}, kWidth), chain_along({{160, 51.5}, {40, 51.5}}, kWidth)}};
    if (!longer_first) std::swap(chains.chains[0], chains.chains[1]);
    const Chains kept = drop_doubles(chains, kDoubled);
    ASSERT_EQ(kept.chains.size(), 1u);
    EXPECT_NEAR(length_of(kept.chains[0]), 160, 1e-9);
    EXPECT_NEAR(kept.chains[0].points.front().y, 50, 1e-12);
  }
}

TEST(Simplify, NeighboursThatAreNoDoublesStay) {
  // Farther away; across; close to each other for half of their length only.
  const Chains chains{{},
                      {chain_along({{20, 50}, {180, 50}}, kWidth), chain_along({{40, 53}, {160, 53}}, kWidth),
                       chain_along({{100, 49}, {100, 51}}, kWidth), chain_along({{170, 50.5}, {240, 120}}, kWidth)}};
  EXPECT_EQ(drop_doubles(chains, kDoubled).chains.size(), 4u);
}

TEST(Simplify, TwinsDoNotDropEachOther) {
  const Chains chains{{}, {chain_along({{20, 50}, {180, 50}}, kWidth), chain_along({{20, 51}, {180, 51}}, kWidth)}};
  EXPECT_EQ(drop_doubles(chains, kDoubled).chains.size(), 1u);
}

TEST(Simplify, ShortSpursGoAndTheLineIsWholeAgain) {
  const Chains kept = drop_spurs(line_with_branch(0.2 * kWidth), kSpur);
  ASSERT_EQ(kept.chains.size(), 1u);
  EXPECT_TRUE(kept.junctions.empty());
  EXPECT_NEAR(length_of(kept.chains[0]), 160, 1e-9);
  EXPECT_EQ(kept.chains[0].start_junction, -1);
  EXPECT_EQ(kept.chains[0].end_junction, -1);
}

TEST(Simplify, BranchesThatWereDrawnStay) {
  const Chains kept = drop_spurs(line_with_branch(2 * kWidth), kSpur);
  EXPECT_EQ(kept.chains.size(), 3u);
  ASSERT_EQ(kept.junctions.size(), 1u);
  expect_consistent(kept);
}

TEST(Simplify, AFreeChainInsideTheInkOfAnotherIsDropped) {
  const Chain line = chain_along({{20, 50}, {180, 50}}, kWidth);
  EXPECT_EQ(drop_spurs({{}, {line, chain_along({{90, 51}, {102, 49}}, kWidth)}}, kSpur).chains.size(), 1u);
  const double apart = 50 + 1.2 * kSpur * kWidth;
  EXPECT_EQ(drop_spurs({{}, {line, chain_along({{90, apart}, {92, apart}}, kWidth)}}, kSpur).chains.size(), 2u);
}

TEST(Simplify, OfChainsInOneStrokeTheLongestStaysHoweverTheyAreOrdered) {
  const Chain line = chain_along({{20, 50}, {180, 50}}, kWidth);
  const std::vector<Chain> parts{chain_along({{15, 51}, {75, 51}}, kWidth), chain_along({{74, 49}, {130, 49}}, kWidth),
                                 chain_along({{129, 51}, {185, 51}}, kWidth)};
  for (std::size_t place = 0; place <= parts.size(); ++place) {
    auto chains = parts;
    chains.insert(chains.begin() + static_cast<std::ptrdiff_t>(place), line);
    const Chains kept = drop_spurs({{}, chains}, kSpur);
    ASSERT_EQ(std::count_if(kept.chains.begin(), kept.chains.end(), [](const Chain& c) { return length_of(c) > 150; }), 1)
        << place;
    EXPECT_LT(kept.chains.size(), 4u) << place;
  }
}

TEST(Simplify, StrokesDrawnTooFarAreCutAtTheJunction) {
  const auto corner = [](Vec2 over) {
    Chains chains{{{100, 100}},
                  {chain_along({{20, 100}, {100, 100}}, kWidth), chain_along({{100, 100}, {100, 180}}, kWidth),
                   chain_along({{100, 100}, Vec2{100, 100} + over}, kWidth)}};
    chains.chains[0].end_junction = chains.chains[1].start_junction = chains.chains[2].start_junction = 0;
    return drop_overshoots(std::move(chains), 2 * kWidth).chains.size();
  };
  EXPECT_EQ(corner({1.8 * kWidth, 0}), 1u) << "the two others are one chain";
  EXPECT_EQ(corner({0, -1.8 * kWidth}), 1u);
  EXPECT_EQ(corner({2.2 * kWidth, 0}), 3u) << "long enough to be meant";
  EXPECT_EQ(corner({kWidth, -kWidth}), 3u) << "goes on from neither";
}

TEST(Simplify, WhatGoesStraightOnWhereNothingElseMeetsIsTheSameStroke) {
  const Chains chains{
      {{100, 100}},
      {chain_along({{20, 100}, {100, 100}}, kWidth, -1, 0), chain_along({{100, 100}, {100 + 1.8 * kWidth, 100}}, kWidth, 0, -1)}};
  const Chains kept = drop_overshoots(chains, 2 * kWidth);
  ASSERT_EQ(kept.chains.size(), 1u);
  EXPECT_NEAR(length_of(kept.chains[0]), 80 + 1.8 * kWidth, 1e-9);
}

TEST(Simplify, ALinkIsNoStrokeDrawnTooFar) {
  Chains chains{{{100, 100}, {100 + 1.8 * kWidth, 100}}, {}};
  chains.chains.push_back(chain_along({{20, 100}, chains.junctions[0]}, kWidth, -1, 0));
  chains.chains.push_back(chain_along({chains.junctions[0], {100, 180}}, kWidth, 0, -1));
  chains.chains.push_back(chain_along({chains.junctions[0], chains.junctions[1]}, kWidth, 0, 1));
  for (const double side : {-60.0, 60.0})
    chains.chains.push_back(chain_along({chains.junctions[1], chains.junctions[1] + Vec2{0, side}}, kWidth, 1, -1));
  EXPECT_EQ(drop_overshoots(chains, 2 * kWidth).chains.size(), 5u);
}

TEST(Simplify, RingsInOneStrokeAreNoSpurs) {
  const Vec2 centre{100, 100};
  Chains chains;
  for (const double radius : {40.0, 41.0}) {
    chains.chains.push_back(chain_along(testing::circle(centre, radius), kWidth));
    chains.chains.back().points.back() = chains.chains.back().points.front();
    chains.chains.back().closed = true;
  }
  EXPECT_EQ(drop_spurs(chains, 0.5).chains.size(), 2u);
}

TEST(Simplify, ALoopThatLeadsNowhereIsALink) {
  const auto looped = [](double size) {
    Chains chains{{{100, 100}}, {chain_along({{20, 100}, {100, 100}}, kWidth), chain_along({{100, 100}, {180, 100}}, kWidth)}};
    chains.chains[0].end_junction = chains.chains[1].start_junction = 0;
    chains.chains.push_back(chain_along({{100, 100}, {100 + size, 100 + size}, {100, 100 + size}, {100, 100}}, kWidth));
    chains.chains.back().start_junction = chains.chains.back().end_junction = 0;
    return merge_junctions(std::move(chains), kWidth, kWidth).chains.size();
  };
  EXPECT_EQ(looped(0.3 * kWidth), 1u);
  EXPECT_EQ(looped(2 * kWidth), 3u);
}

TEST(Simplify, JunctionsOfOneCrossingBecomeOne) {
  const Chains merged = merge_junctions(ladder(4, 0), kWidth, 2.5 * kWidth);
  EXPECT_EQ(merged.chains.size(), 4u);
  ASSERT_EQ(merged.junctions.size(), 1u);
  EXPECT_NEAR(norm(merged.junctions[0] - Vec2{100, 100}), 0, 1e-9);
  expect_consistent(merged);
}

TEST(Simplify, LongerLinksCountOnlyWithPaperBesideThem) {
  EXPECT_EQ(merge_junctions(ladder(12, 0), kWidth, 2.5 * kWidth).junctions.size(), 1u);
  const Chains apart = merge_junctions(ladder(12, 8), kWidth, 2.5 * kWidth);
  EXPECT_EQ(apart.junctions.size(), 2u);
  EXPECT_EQ(apart.chains.size(), 5u);
  expect_consistent(apart);
  EXPECT_EQ(merge_junctions(ladder(16, 0), kWidth, 2.5 * kWidth).junctions.size(), 2u);
}

TEST(Simplify, LinksInARowBecomeOneJunction) {
  Chains chains = ladder(4, 0);
  chains.junctions.push_back({106, 100});
  chains.chains.push_back(chain_along({{102, 100}, {106, 100}}, kWidth, 1, 2));
  chains.chains.push_back(chain_along({{106, 100}, {180, 90}}, kWidth, 2, -1));
  chains.chains.push_back(chain_along({{106, 100}, {180, 110}}, kWidth, 2, -1));
  const Chains merged = merge_junctions(chains, kWidth, 2.5 * kWidth);
  EXPECT_EQ(merged.chains.size(), 6u);
  ASSERT_EQ(merged.junctions.size(), 1u);
  EXPECT_NEAR(norm(merged.junctions[0] - Vec2{102, 100}), 0, 1e-9);
  expect_consistent(merged);
}

TEST(Simplify, JunctionsFurtherApartThanOneAndAHalfLinksStayTwoHoweverManyLieBetween) {
  Chains chains;
  for (int j = 0; j < 5; ++j) {
    const Vec2 here{100.0 + 5 * j, 100};
    chains.junctions.push_back(here);
    chains.chains.push_back(chain_along({here, here + Vec2{0, 60}}, kWidth, j, -1));
    chains.chains.push_back(chain_along({here, here - Vec2{0, 60}}, kWidth, j, -1));
    if (j > 0) chains.chains.push_back(chain_along({here - Vec2{5, 0}, here}, kWidth, j - 1, j));
  }
  const Chains merged = merge_junctions(chains, 6, 6);
  ASSERT_EQ(merged.junctions.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_NEAR(merged.junctions[j].x, 102.5 + 10 * static_cast<double>(j) - (j == 2 ? 2.5 : 0), 1e-9);
  expect_consistent(merged);
}

TEST(Simplify, AChainWithAQuarterOffTheInkIsDropped) {
  Image image = blank(200, 100);
  paint(image, {{20, 30}, {180, 30}}, kWidth);
  paint(image, {{20, 70}, {125, 70}}, kWidth);
  const Chains chains{{}, {chain_along({{20, 30}, {180, 30}}, kWidth), chain_along({{20, 70}, {180, 70}}, kWidth)}};
  const Chains kept = drop_uncovered(chains, ink_of(image), 4, 2);
  ASSERT_EQ(kept.chains.size(), 1u);
  EXPECT_EQ(kept.chains[0].points.front().y, 30);
}

// Isolines that cross a thin stroke every pixel or two leave the pieces between them no pixel of their own.
TEST(Simplify, ATinyLinkNeedsNoPixel) {
  Image image = blank(100, 100);
  paint(image, {{20, 50}, {80, 50}}, 2);
  Chains chains{{{50.5, 50}, {51.5, 50}}, {}};
  for (const int j : {0, 1})
    for (const double side : {-1.4, 1.4}) {
      const Vec2 at = chains.junctions[static_cast<std::size_t>(j)];
      chains.chains.push_back(chain_along({at, at + Vec2{0, side}}, 2, j, -1));
    }
  chains.chains.push_back(chain_along({{20, 50}, chains.junctions[0]}, 2, -1, 0));
  chains.chains.push_back(chain_along({chains.junctions[0], chains.junctions[1]}, 2, 0, 1));
  chains.chains.push_back(chain_along({chains.junctions[1], {80, 50}}, 2, 1, -1));
  const Chains kept = drop_spurs(drop_uncovered(chains, ink_of(image), 4, 1), 1);
  ASSERT_EQ(kept.chains.size(), 1u);
  EXPECT_NEAR(length_of(kept.chains[0]), 60, 1e-9);
}

TEST(Simplify, AChainBesideANearerOneHasNoInk) {
  Image image = blank(200, 100);
  paint(image, {{20, 50}, {180, 50}}, kWidth);
  const Chains chains{{}, {chain_along({{20, 50}, {180, 50}}, kWidth), chain_along({{20, 57}, {180, 57}}, kWidth)}};
  const Chains kept = drop_uncovered(chains, ink_of(image), 4, 5);
  ASSERT_EQ(kept.chains.size(), 1u);
  EXPECT_EQ(kept.chains[0].points.front().y, 50);
}

TEST(Simplify, DroppingAnUncoveredBranchDissolvesItsJunction) {
  Image image = blank(200, 200);
  paint(image, {{20, 100}, {180, 100}}, kWidth);
  const Chains kept = drop_uncovered(line_with_branch(40), ink_of(image), 4, 2);
  ASSERT_EQ(kept.chains.size(), 1u);
  EXPECT_TRUE(kept.junctions.empty());
  EXPECT_NEAR(length_of(kept.chains[0]), 160, 1e-9);
}

TEST(Simplify, RungsOverPaperGoAndLinksOverInkStay) {
  for (const bool linked : {false, true}) {
    Image image = blank(200, 200);
    const Vec2 a{100, 90}, b{100, 110};
    for (const double y : {90.0, 110.0}) paint(image, {{20, y}, {180, y}}, kWidth);
    if (linked) paint(image, {a, b}, kWidth);
    const Chains drawn{{a, b},
                       {chain_along({{20, 90}, a}, kWidth, -1, 0), chain_along({a, {180, 90}}, kWidth, 0, -1),
                        chain_along({{20, 110}, b}, kWidth, -1, 1), chain_along({b, {180, 110}}, kWidth, 1, -1),
                        chain_along({a, b}, kWidth, 0, 1)}};
    const Chains kept = drop_rungs(drawn, ink_of(image), {30, 1});
    EXPECT_EQ(kept.chains.size(), linked ? 5u : 2u);
    EXPECT_EQ(kept.junctions.size(), linked ? 2u : 0u);
    expect_consistent(kept);
  }
}

// An isoline goes on to the end of a cell, and slimming takes the ends of strokes.
TEST(Simplify, LongWaysOverPaperAndFreeOnesAreNoRungs) {
  const Ink ink = ink_of(blank(200, 200));
  const auto rungs = [&](double length, bool free) {
    Chains chains{{{100, 100}}, {chain_along({{100, 100}, {100 + length, 100}}, kWidth, free ? -1 : 0, -1)}};
    for (const double side : {-60.0, 60.0}) chains.chains.push_back(chain_along({{100, 100}, {40, 100 + side}}, kWidth, 0, -1));
    return drop_rungs(std::move(chains), ink, {30, 2}).chains.size();
  };
  EXPECT_EQ(rungs(29, false), 1u) << "the others are one chain";
  EXPECT_EQ(rungs(31, false), 3u);
  EXPECT_EQ(rungs(29, true), 2u);
}

TEST(Simplify, AShortStrokeIsNoRungThoughItsChainGoesOnOverPaper) {
  for (const double drawn : {0.0, 4.0, 20.0}) {
    Image image = blank(200, 200);
    const Vec2 a{100, 100}, end{100, 72};
    paint(image, {{20, 100}, {180, 100}}, kWidth);
    paint(image, {a, a - Vec2{0, drawn}}, kWidth);
    const Chains chains{{a},
                        {chain_along({{20, 100}, a}, kWidth, -1, 0), chain_along({a, {180, 100}}, kWidth, 0, -1),
                         chain_along({a, end}, kWidth, 0, -1)}};
    EXPECT_EQ(drop_rungs(chains, ink_of(image), {30, 1, 15}).chains.size(), drawn == 20 ? 3u : 1u) << drawn;
    Chains turned = chains;
    turned.chains[2] = reversed(turned.chains[2]);
    EXPECT_EQ(drop_rungs(turned, ink_of(image), {30, 1, 15}).chains.size(), drawn == 20 ? 3u : 1u) << drawn;
    EXPECT_EQ(drop_rungs(chains, ink_of(image), {30, 1}).chains.size(), 1u);
  }
}

TEST(Simplify, LoopsAroundPaperStayAndLoopsInABlotGo) {
  auto loop = chain_along(testing::circle({100, 100}, 10), kWidth);
  loop.points.back() = loop.points.front();
  loop.closed = true;
  Image ring = blank(200, 200), blot = blank(200, 200);
  paint(ring, loop.points, kWidth);
  paint(blot, {{100, 100}, {100, 100}}, 40);
  EXPECT_EQ(drop_blot_loops({{}, {loop}}, ink_of(ring)).chains.size(), 1u);
  EXPECT_EQ(drop_blot_loops({{}, {loop}}, ink_of(blot)).chains.size(), 0u);
}

TEST(Simplify, WhatRunsOverPaperIsTakenOut) {
  Image image = blank(200, 100);
  paint(image, {{20, 50}, {80, 50}}, kWidth);
  paint(image, {{120, 50}, {180, 50}}, kWidth);
  const Chains cut = cut_on_paper({{}, {chain_along({{20, 50}, {180, 50}}, kWidth)}}, ink_of(image), kWidth);
  ASSERT_EQ(cut.chains.size(), 2u);
  EXPECT_NEAR(length_of(cut.chains[0]) + length_of(cut.chains[1]), 126, 2);
  const Chain whole = chain_along({{20, 50}, {180, 50}}, kWidth);
  const Chains kept = cut_on_paper({{}, {whole}}, ink_of(image), 40);
  ASSERT_EQ(kept.chains.size(), 1u);
  EXPECT_EQ(kept.chains[0].points, whole.points);
}

}  // namespace
}  // namespace inkgrid
