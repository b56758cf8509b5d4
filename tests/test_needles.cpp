#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/polyline.h"
#include "refine/needles.h"

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

// Its turns are apart, but the path comes by both again.
TEST(Needles, AWayThatIsGoneBackAndGoneAgainIsGoneOnce) {
  const Chains before = one_chain({{0, 0}, {40, 0}, {25, 1}, {90, 0}});
  const Chains after = drop_needles(before, 2, 80);
  EXPECT_NEAR(length_of(after), 90, 2);
  EXPECT_LT(farthest_from(before.chains[0].points, after.chains[0].points), 2);
}

std::vector<Vec2> with_loop(double radius) {
  std::vector<Vec2> path{{0, 0}};
  for (int k = 0; k <= 40; ++k) {
    const double angle = 2 * std::numbers::pi * k / 40;
    path.push_back({30 + 0.1 * k + radius * std::sin(angle), radius * (1 - std::cos(angle))});
  }
  path.push_back({64, 0});
  return path;
}

TEST(Knots, LoopsThatNoPaperFitsIntoAreUntied) {
  Chains chains = one_chain(with_loop(2));
  chains.chains[0].width = 3;
  const Chains after = drop_knots(chains, 2);
  EXPECT_NEAR(length_of(after), 64, 0.5);
  EXPECT_EQ(after.chains[0].points.front(), chains.chains[0].points.front());
  EXPECT_EQ(after.chains[0].points.back(), chains.chains[0].points.back());
}

TEST(Knots, WaysFromAJunctionBackToItGoAroundPaperOrAreNone) {
  for (const double half : {0.5, 8.0}) {
    Chains chains = one_chain({{0, 0}, {20, half}, {40, 0}, {20, -half}, {0, 0}});
    chains.junctions = {{0, 0}};
    chains.chains[0].start_junction = chains.chains[0].end_junction = 0;
    chains.chains[0].width = 6;
    EXPECT_EQ(drop_knots(chains, 0).chains.size(), half > 6 ? 1u : 0u) << half;
  }
}

TEST(Knots, LoopsAtAJunctionHoldNoLessThanAPensDot) {
  for (const double diameter : {0.9, 1.1}) {
    std::vector<Vec2> round;
    for (int k = 0; k <= 60; ++k)
      round.push_back(3 * diameter * Vec2{1 - std::cos(std::numbers::pi * k / 30), std::sin(std::numbers::pi * k / 30)});
    round.back() = round.front();
    Chains chains{{round.front()}, {{}}};
    chains.chains[0].points = round;
    chains.chains[0].start_junction = chains.chains[0].end_junction = 0;
    chains.chains[0].width = 4;
    EXPECT_EQ(drop_knots(chains, 2).chains.size(), diameter > 1 ? 1u : 0u) << diameter << " pens";
  }
}

TEST(Knots, TipsOfAcuteCornersStay) {
  Chains chains = one_chain({{100, 10}, {20, -0.3}, {16, 0}, {20, 0.3}, {100, -10}});
  chains.chains[0].width = 6;
  EXPECT_LT(farthest_from({{16, 0}}, drop_knots(chains, 0).chains[0].points), 0.8);
}

TEST(Knots, LoopsAroundPaperAndRingsStay) {
  Chains chains = one_chain(with_loop(4));
  chains.chains[0].width = 3;
  EXPECT_EQ(drop_knots(chains, 2).chains[0].points, chains.chains[0].points);
  std::vector<Vec2> ring;
  for (int k = 0; k <= 12; ++k)
    ring.push_back({30 + 2 * std::cos(std::numbers::pi * (k % 12) / 6), 30 + 2 * std::sin(std::numbers::pi * (k % 12) / 6)});
  Chains closed;
  closed.chains.push_back({});
  closed.chains[0].points = ring;
  closed.chains[0].closed = true;
  closed.chains[0].width = 5;
  EXPECT_EQ(drop_knots(closed, 0).chains[0].points, ring);
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
  const Chains thorn = one_chain({{0, 0}, {40, 0}, {10, 20}, {40.5, 0.5}, {80, -20}});
  EXPECT_EQ(drop_needles(thorn, 2, 200).chains[0].points, thorn.chains[0].points);
}

TEST(Needles, LongWaysStay) {
  const Chains there_and_back = one_chain({{0, 60}, {10, 10}, {10.2, 60}, {10.4, 10.3}, {20, 60}});
  EXPECT_EQ(drop_needles(there_and_back, 2, 80).chains[0].points, there_and_back.chains[0].points);
  const Chains thrice = one_chain({{0, 0}, {60, 0}, {0, 0.2}, {60, 0.4}, {60, 60}});
  EXPECT_EQ(drop_needles(thrice, 2, 80).chains[0].points, thrice.chains[0].points);
  EXPECT_NEAR(length_of(drop_needles(thrice, 2, 130)), 120, 2);
}

TEST(Hooks, AChainEndsInItsJunctionOnItsWay) {
  Chains chains = one_chain({{0, 0}, {50, 0}, {46.5, 0.8}});
  chains.chains[0].end_junction = 0;
  chains.chains.push_back(chains.chains[0]);
  std::reverse(chains.chains[1].points.begin(), chains.chains[1].points.end());
  std::swap(chains.chains[1].start_junction, chains.chains[1].end_junction);
  const Chains ended = drop_hooks(chains, 2, 8);
  for (const auto& [chain, first, last] :
       {std::tuple{ended.chains[0], Vec2{0, 0}, Vec2{46.5, 0.8}}, std::tuple{ended.chains[1], Vec2{46.5, 0.8}, Vec2{0, 0}}}) {
    EXPECT_EQ(chain.points.front(), first);
    EXPECT_EQ(chain.points.back(), last);
    for (std::size_t k = 1; k < chain.points.size(); ++k)
      EXPECT_GT((last.x - first.x) * (chain.points[k].x - chain.points[k - 1].x), 0);
  }
}

TEST(Hooks, AChainLeavesItsWayTwiceAsFarFromTheEndAsItMissedIt) {
  Chains chains = one_chain({{0, 0}, {50, 0}, {46.5, 0.8}});
  chains.chains[0].end_junction = 0;
  const auto points = drop_hooks(chains, 2, 8).chains[0].points;
  const double last_step = norm(points.back() - points[points.size() - 2]);
  EXPECT_GE(last_step, 2 * 0.8);
  EXPECT_LT(last_step, 2 * 0.8 + 0.75);
}

TEST(Hooks, OtherEndsStay) {
  Chains chains = one_chain({{0, 0}, {50, 0}, {46.5, 0.8}});
  EXPECT_EQ(drop_hooks(chains, 2, 8).chains[0].points, chains.chains[0].points) << "no junction";
  chains.chains[0].end_junction = 0;
  EXPECT_EQ(drop_hooks(chains, 0.5, 8).chains[0].points, chains.chains[0].points) << "passes it too far away";
  EXPECT_EQ(drop_hooks(chains, 2, 3).chains[0].points, chains.chains[0].points) << "turns back too far from it";
  Chains past = one_chain({{0, 0}, {50, 0}, {43.5, 0.8}});
  past.chains[0].end_junction = 0;
  EXPECT_EQ(drop_hooks(past, 2, 20).chains[0].points, past.chains[0].points) << "passes it by more than a blot";
  Chains tip = one_chain({{0, 0}, {50, 0}, {40, 0.8}});
  tip.chains[0].end_junction = 0;
  EXPECT_EQ(drop_hooks(tip, 2, 20).chains[0].points, tip.chains[0].points) << "the tip of a corner beside a junction";
  tip.chains.push_back(one_chain({{40, 0.8}, {60, -1}}).chains[0]);
  EXPECT_LT(drop_hooks(tip, 2, 20).chains[0].points.size(), tip.chains[0].points.size()) << "which another chain walks, too";
  Chains corner = one_chain({{0, 0}, {50, 0}, {50, 5}});
  corner.chains[0].end_junction = 0;
  EXPECT_EQ(drop_hooks(corner, 2, 8).chains[0].points, corner.chains[0].points);
}

}  // namespace
}  // namespace inkgrid
