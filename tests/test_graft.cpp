// New chains in the place of old ones, cut where both agree.
#include <gtest/gtest.h>

#include "chain_checks.h"
#include "scribbles/graft.h"

namespace inkgrid {
namespace {

using testing::chain_along;
using testing::circle;

constexpr double kWidth = 4;
constexpr int kSize = 200;

// Distances from a vertical scribble at x = 100.
TouchedPart around_the_middle() {
  TouchedPart part{{0, 0, kSize, kSize}, Raster<float>(kSize, kSize), kSize, kSize};
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) part.distance(x, y) = static_cast<float>(std::abs(x + 0.5 - 100));
  return part;
}

std::optional<Chains> grafted(const Chains& old_chains, const Chains& new_chains) {
  const TouchedPart part = around_the_middle();
  return graft(old_chains, new_chains, {part, 20, 60}, {0.4, kWidth});
}

// A chain with points every pixel from x = 10 to 190 at the heights that `height` gives.
template <class Height>
Chain across(Height height) {
  std::vector<Vec2> line;
  for (int x = 10; x <= 190; ++x) line.push_back({static_cast<double>(x), height(static_cast<double>(x))});
  Chain chain;
  chain.points = line;
  chain.width = kWidth;
  return chain;
}

// A bump in the middle, nothing beyond 15 px from it.
double bump(double x) {
  const double d = std::abs(x - 100) / 15;
  return d < 1 ? 8 * (1 - d) * (1 - d) : 0;
}

double height_at(const Chain& chain, double x) {
  for (std::size_t k = 0; k + 1 < chain.points.size(); ++k) {
    const Vec2 a = chain.points[k], b = chain.points[k + 1];
    if ((a.x - x) * (b.x - x) <= 0 && a.x != b.x) return lerp(a, b, (x - a.x) / (b.x - a.x)).y;
  }
  ADD_FAILURE() << "the chain does not come by " << x;
  return 0;
}

TEST(Graft, TakesTheNewChainInsideAndKeepsTheOldOneOutside) {
  const Chain old_chain = across([](double) { return 80.0; });
  const Chain new_chain = across([](double x) { return 80.2 + bump(x); });
  const auto result = grafted({{}, {old_chain}}, {{}, {new_chain}});
  ASSERT_TRUE(result);
  ASSERT_EQ(result->chains.size(), 1u);
  const Chain& chain = result->chains[0];
  for (double x = 80; x <= 120; ++x) EXPECT_NEAR(height_at(chain, x), 80.2 + bump(x), 1e-9) << x;
  for (std::size_t k = 0; k < 30; ++k) {
    EXPECT_TRUE(chain.points[k] == old_chain.points[k]);
    EXPECT_TRUE(chain.points[chain.points.size() - 1 - k] == old_chain.points[old_chain.points.size() - 1 - k]);
  }
  // No step where the two meet.
  for (std::size_t k = 0; k + 1 < chain.points.size(); ++k) EXPECT_LT(norm(chain.points[k + 1] - chain.points[k]), 1.6);
  for (double x = 30; x < 75; ++x) EXPECT_LT(std::abs(height_at(chain, x + 1) - height_at(chain, x)), 0.1);
}

TEST(Graft, TheDirectionOfTheNewChainDoesNotMatter) {
  const Chain old_chain = across([](double) { return 80.0; });
  Chain new_chain = across([](double x) { return 80 + bump(x); });
  const auto forward = grafted({{}, {old_chain}}, {{}, {new_chain}});
  std::reverse(new_chain.points.begin(), new_chain.points.end());
  const auto backward = grafted({{}, {old_chain}}, {{}, {new_chain}});
  ASSERT_TRUE(forward && backward);
  ASSERT_EQ(backward->chains[0].points.size(), forward->chains[0].points.size());
  for (std::size_t k = 0; k < forward->chains[0].points.size(); ++k)
    EXPECT_LT(norm(forward->chains[0].points[k] - backward->chains[0].points[k]), 1e-9);
}

TEST(Graft, ChainsOutsideAreTheSameToTheLastDigitAndInOrder) {
  const auto outside = [](double x) { return chain_along({{x, 10}, {x, 190}}, kWidth); };
  const Chains old_chains{{}, {outside(20), across([](double) { return 80.0; }), outside(180), outside(30)}};
  const Chains new_chains{{}, {across([](double x) { return 80 + bump(x); }), outside(30.2)}};
  const auto result = grafted(old_chains, new_chains);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->chains.size(), 4u);
  for (const std::size_t i : {0u, 2u, 3u}) EXPECT_TRUE(result->chains[i].points == old_chains.chains[i].points) << i;
}

// A cross whose middle moves, and gets a branch more.
TEST(Graft, JunctionsInsideAreTheNewOnes) {
  const auto star = [](Vec2 middle, bool branch) {
    Chains chains{{middle}, {}};
    for (const Vec2 tip : {Vec2{15, 100}, Vec2{185, 100}}) {
      const double bend = tip.x < 100 ? 75 : 125;
      chains.chains.push_back(chain_along({tip, {bend, 100}, middle}, kWidth, -1, 0));
    }
    for (const Vec2 tip : {Vec2{100, 60}, Vec2{100, 140}}) chains.chains.push_back(chain_along({tip, middle}, kWidth, -1, 0));
    if (branch) chains.chains.push_back(chain_along({{112, 88}, middle}, kWidth, -1, 0));
    return chains;
  };
  Chains old_chains = star({100, 100}, false);
  old_chains.junctions.push_back({5, 5});
  for (const Vec2 tip : {Vec2{5, 15}, Vec2{15, 5}, Vec2{15, 15}})
    old_chains.chains.push_back(chain_along({{5, 5}, tip}, kWidth, 1));
  const auto result = grafted(old_chains, star({103, 102}, true));
  ASSERT_TRUE(result);
  ASSERT_EQ(result->junctions.size(), 2u);
  EXPECT_TRUE(result->junctions[0] == (Vec2{5, 5}));
  EXPECT_TRUE(result->junctions[1] == (Vec2{103, 102}));
  int at_far = 0, at_middle = 0;
  for (const Chain& chain : result->chains) {
    for (const bool start : {true, false}) {
      const int j = start ? chain.start_junction : chain.end_junction;
      if (j < 0) continue;
      EXPECT_TRUE((start ? chain.points.front() : chain.points.back()) == result->junctions[static_cast<std::size_t>(j)]);
      ++(j == 0 ? at_far : at_middle);
    }
  }
  EXPECT_EQ(at_far, 3);
  EXPECT_EQ(at_middle, 5);
}

TEST(Graft, ALoopStaysClosed) {
  Chain old_loop = chain_along(circle({130, 100}, 50), kWidth), new_loop = chain_along(circle({130, 100}, 50.1), kWidth);
  old_loop.closed = new_loop.closed = true;
  const auto result = grafted({{}, {old_loop}}, {{}, {new_loop}});
  ASSERT_TRUE(result);
  ASSERT_EQ(result->chains.size(), 1u);
  const Chain& loop = result->chains[0];
  EXPECT_TRUE(loop.closed);
  EXPECT_TRUE(loop.points.front() == loop.points.back());
  for (const Vec2 p : loop.points) EXPECT_NEAR(norm(p - Vec2{130, 100}), p.x < 115 ? 50.1 : 50.0, 0.11);
  EXPECT_NEAR(lengths_along(loop.points).back(), 100 * 3.14159, 1);
}

TEST(Graft, WhatIsOnlyInsideIsReplaced) {
  const Chains old_chains{{}, {chain_along({{95, 50}, {105, 50}}, kWidth), chain_along({{95, 60}, {105, 60}}, kWidth)}};
  const Chains new_chains{{}, {chain_along({{92, 55}, {108, 55}}, kWidth)}};
  const auto result = grafted(old_chains, new_chains);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->chains.size(), 1u);
  EXPECT_TRUE(result->chains[0].points == new_chains.chains[0].points);
}

// What the window sees of the world beyond its rim is of no use.
TEST(Graft, NewChainsThatNeverComeInsideAreDropped) {
  const Chains old_chains{{}, {across([](double) { return 80.0; })}};
  const Chains new_chains{{}, {across([](double) { return 80.0; }), chain_along({{45, 20}, {45, 40}}, kWidth)}};
  const auto result = grafted(old_chains, new_chains);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->chains.size(), 1u);
}

TEST(Graft, DisagreementOnTheWayOutIsNoResult) {
  const Chain old_chain = across([](double) { return 80.0; });
  EXPECT_FALSE(grafted({{}, {old_chain}}, {{}, {across([](double) { return 82.0; })}}));
  EXPECT_FALSE(grafted({{}, {old_chain}}, {{}, {}}));
  EXPECT_FALSE(grafted({{}, {}}, {{}, {old_chain}}));
  EXPECT_FALSE(grafted({{}, {old_chain}}, {{}, {old_chain, across([](double) { return 120.0; })}}));
}

TEST(Graft, AgreementOverLessThanAStrokeIsNone) {
  const Chain old_chain = across([](double) { return 80.0; });
  const auto near_for = [&](double length) {  // from 40 px beyond the scribble on
    return across([&](double x) { return 80 + 0.4 * std::max(0.0, std::abs(std::abs(x - 100) - 40) - length / 2); });
  };
  EXPECT_FALSE(grafted({{}, {old_chain}}, {{}, {near_for(0)}}));
  EXPECT_TRUE(grafted({{}, {old_chain}}, {{}, {near_for(4)}}));
}

TEST(Graft, WidthsAreThoseOfThePieces) {
  Chain old_chain = across([](double) { return 80.0; }), new_chain = old_chain;
  new_chain.width = 2 * kWidth;
  const auto result = grafted({{}, {old_chain}}, {{}, {new_chain}});
  ASSERT_TRUE(result);
  EXPECT_GT(result->chains[0].width, 1.3 * kWidth);
  EXPECT_LT(result->chains[0].width, 1.6 * kWidth);
}

}  // namespace
}  // namespace inkgrid
