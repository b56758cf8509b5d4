#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "base/at.h"
#include "chain_checks.h"
#include "graph/dissolve.h"

namespace inkgrid {
namespace {

using namespace testing;

constexpr double kWidth = 6;  // px

// Chains of some points, each between two junctions out of `junctions`, or free, or closed.
Chains random_network(int junctions, int chains, unsigned seed) {
  std::mt19937 random(seed);
  Chains network;
  for (int j = 0; j < junctions; ++j) network.junctions.push_back({100.0 * j, 0});
  for (int c = 0; c < chains; ++c) {
    Chain chain;
    const auto any_junction = [&] { return static_cast<int>(random() % at(junctions + 2)) - 2; };
    chain.start_junction = std::max(-1, any_junction());
    chain.end_junction = std::max(-1, any_junction());
    for (int k = 0; k < 4; ++k) chain.points.push_back({10.0 * c + k, 1.0 + c});
    if (chain.start_junction >= 0) chain.points.front() = network.junctions[at(chain.start_junction)];
    if (chain.end_junction >= 0) chain.points.back() = network.junctions[at(chain.end_junction)];
    network.chains.push_back(chain);
  }
  return network;
}

// Each step between points, whichever way it is walked.
std::multiset<std::tuple<double, double, double, double>> steps_of(const Chains& chains) {
  std::multiset<std::tuple<double, double, double, double>> steps;
  for (const Chain& chain : chains.chains)
    for (std::size_t k = 0; k + 1 < chain.points.size(); ++k) {
      auto [a, b] = std::pair(chain.points[k], chain.points[k + 1]);
      if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
      steps.insert({a.x, a.y, b.x, b.y});
    }
  return steps;
}

// The places of the junctions where three or more ends meet.
std::set<std::pair<double, double>> forks_of(const Chains& chains) {
  std::map<int, int> ends;
  for (const Chain& chain : chains.chains)
    for (const int junction : {chain.start_junction, chain.end_junction}) ++ends[junction];
  std::set<std::pair<double, double>> forks;
  for (const auto& [junction, count] : ends)
    if (junction >= 0 && count > 2) forks.insert({chains.junctions[at(junction)].x, chains.junctions[at(junction)].y});
  return forks;
}

TEST(Dissolve, RandomNetworksKeepTheirForksAndWhatIsDrawn) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Chains before = random_network(6, 8, seed), after = dissolve_junctions(before);
    expect_consistent(after);
    EXPECT_EQ(steps_of(after), steps_of(before));
    EXPECT_EQ(forks_of(after), forks_of(before));
    EXPECT_EQ(after.junctions.size(), forks_of(after).size());
    EXPECT_EQ(dissolve_junctions(after).chains.size(), after.chains.size());
  }
}

TEST(Dissolve, JoinsTwoChainsWhicheverWayTheyRun) {
  const Vec2 a{10, 10}, middle{50, 20}, b{90, 70};
  for (const bool first_reversed : {false, true})
    for (const bool second_reversed : {false, true}) {
      const Chain first = first_reversed ? chain_along({middle, a}, kWidth, 0, -1) : chain_along({a, middle}, kWidth, -1, 0);
      const Chain second = second_reversed ? chain_along({b, middle}, kWidth, -1, 0) : chain_along({middle, b}, kWidth, 0, -1);
      const Chains whole = dissolve_junctions({{middle}, {first, second}});
      ASSERT_EQ(whole.chains.size(), 1u);
      EXPECT_TRUE(whole.junctions.empty());
      const auto& points = whole.chains[0].points;
      EXPECT_EQ(points.size(), first.points.size() + second.points.size() - 1);
      EXPECT_TRUE((points.front() == a && points.back() == b) || (points.front() == b && points.back() == a));
      EXPECT_NEAR(length_of(whole.chains[0]), norm(middle - a) + norm(b - middle), 1e-9);
      EXPECT_LT(farthest_from(points, {a, middle, b}), 1e-9);
      EXPECT_EQ(whole.chains[0].start_junction, -1);
      EXPECT_EQ(whole.chains[0].end_junction, -1);
    }
}

TEST(Dissolve, ClosesARingAndKeepsTrueJunctions) {
  const Vec2 a{10, 10}, b{50, 10}, c{30, 50};
  const Chains ring = dissolve_junctions(
      {{a, b, c}, {chain_along({a, b}, kWidth, 0, 1), chain_along({c, b}, kWidth, 2, 1), chain_along({c, a}, kWidth, 2, 0)}});
  ASSERT_EQ(ring.chains.size(), 1u);
  EXPECT_TRUE(ring.chains[0].closed);
  expect_consistent(ring);
  EXPECT_NEAR(length_of(ring.chains[0]), norm(b - a) + norm(c - b) + norm(a - c), 1e-9);

  const Chains star = dissolve_junctions(
      {{{0, 0}, a},
       {chain_along({a, b}, kWidth, 1, -1), chain_along({a, c}, kWidth, 1, -1), chain_along({{90, 90}, a}, kWidth, -1, 1)}});
  EXPECT_EQ(star.chains.size(), 3u);
  ASSERT_EQ(star.junctions.size(), 1u);
  expect_consistent(star);
}

TEST(Dissolve, AJunctionWithOneBranchIsAFreeEnd) {
  const Chains lone = dissolve_junctions({{{10, 10}}, {chain_along({{10, 10}, {90, 10}}, kWidth, 0, -1)}});
  EXPECT_TRUE(lone.junctions.empty());
  EXPECT_EQ(lone.chains[0].start_junction, -1);
}

}  // namespace
}  // namespace inkgrid
