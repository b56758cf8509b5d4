#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "chain_checks.h"
#include "refine/strokes.h"

namespace inkgrid {
namespace {

using testing::chain_along;

constexpr Vec2 kMiddle{100, 100};
constexpr double kSpan = 12;

Vec2 towards(double degrees) {
  return {std::cos(degrees / 180 * std::numbers::pi), std::sin(degrees / 180 * std::numbers::pi)};
}

// Chains of this length that leave one junction; every second one runs towards it.
std::vector<Chain> star(const std::vector<double>& degrees, double length = 50) {
  std::vector<Chain> arms;
  for (const double d : degrees) {
    const Vec2 tip = kMiddle + length * towards(d);
    arms.push_back(arms.size() % 2 == 0 ? chain_along({kMiddle, tip}, 6, 0, -1) : chain_along({tip, kMiddle}, 6, -1, 0));
  }
  return arms;
}

// Chains of each stroke, the lowest first, and strokes by their first chain.
std::vector<std::vector<int>> grouped(const std::vector<Chain>& chains) {
  std::vector<std::vector<int>> groups;
  for (const auto& stroke : strokes_of(chains, kSpan)) {
    groups.emplace_back();
    for (const StrokePart& part : stroke) groups.back().push_back(part.chain);
    std::sort(groups.back().begin(), groups.back().end());
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

using Groups = std::vector<std::vector<int>>;

TEST(Strokes, GoStraightOnThroughACrossing) {
  EXPECT_EQ(grouped(star({0, 70, 180, 250})), (Groups{{0, 2}, {1, 3}}));
  EXPECT_EQ(grouped(star({0, 30, 175, 215})), (Groups{{0, 2}, {1, 3}}));
}

TEST(Strokes, AStemEndsAtItsBar) {
  EXPECT_EQ(grouped(star({0, 90, 180})), (Groups{{0, 2}, {1}}));
}

TEST(Strokes, BendsOfMoreThanTwentyDegreesEndThem) {
  EXPECT_EQ(grouped(star({0, 90, 164})), (Groups{{0, 2}, {1}}));
  EXPECT_EQ(grouped(star({0, 90, 156})), (Groups{{0}, {1}, {2}}));
}

TEST(Strokes, WhatIsShorterThanTheSpanGoesOnIntoNone) {
  auto arms = star({0, 90, 180});
  arms[2] = chain_along({kMiddle, kMiddle + 0.9 * kSpan * towards(180)}, 6, 0, -1);
  EXPECT_EQ(grouped(arms), (Groups{{0}, {1}, {2}}));
}

TEST(Strokes, WithoutASpanEveryChainIsOne) {
  EXPECT_EQ(strokes_of(star({0, 90, 180, 270}), 0).size(), 4u);
}

TEST(Strokes, PartsFollowEachOtherEndToEnd) {
  std::vector<Chain> chains = {chain_along({{100, 50}, {50, 50}}, 6, 0, -1), chain_along({{100, 50}, {150, 50}}, 6, 0, 1),
                               chain_along({{200, 50}, {150, 50}}, 6, -1, 1), chain_along({{100, 50}, {100, 90}}, 6, 0, -1),
                               chain_along({{150, 50}, {150, 90}}, 6, 1, -1)};
  const auto strokes = strokes_of(chains, kSpan);
  const auto longest = *std::max_element(strokes.begin(), strokes.end(), [](auto& a, auto& b) { return a.size() < b.size(); });
  ASSERT_EQ(longest.size(), 3u);
  std::vector<Vec2> ends;
  for (const StrokePart& part : longest) {
    const auto& points = chains[static_cast<std::size_t>(part.chain)].points;
    ends.push_back(part.reversed ? points.back() : points.front());
    ends.push_back(part.reversed ? points.front() : points.back());
  }
  EXPECT_TRUE(ends[1] == ends[2] && ends[3] == ends[4]);
  EXPECT_NEAR(norm(ends[5] - ends[0]), 150, 1e-9);
}

TEST(Strokes, ARoundOfChainsIsOneStrokeAndAllChainsArePartOfOne) {
  std::vector<Chain> chains;
  for (int k = 0; k < 3; ++k) {
    std::vector<Vec2> arc;
    for (int d = 0; d <= 120; d += 4) arc.push_back(kMiddle + 60.0 * towards(120.0 * k + d));
    chains.push_back(chain_along(arc, 6, k, (k + 1) % 3));
    chains.push_back(chain_along({arc.front(), kMiddle + 100.0 * towards(120.0 * k)}, 6, k, -1));
  }
  EXPECT_EQ(grouped(chains), (Groups{{0, 2, 4}, {1}, {3}, {5}}));
}

}  // namespace
}  // namespace inkgrid
