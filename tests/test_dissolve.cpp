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
    testing::expect_consistent(after);
    EXPECT_EQ(steps_of(after), steps_of(before));
    EXPECT_EQ(forks_of(after), forks_of(before));
    EXPECT_EQ(after.junctions.size(), forks_of(after).size());
    EXPECT_EQ(dissolve_junctions(after).chains.size(), after.chains.size());
  }
}

TEST(Dissolve, TwoChainsFromOneJunctionAreALine) {
  Chain left, right;
  left.points = {{1, 0}, {0, 0}};
  right.points = {{1, 0}, {2, 0}};
  left.start_junction = right.start_junction = 0;
  const Chains line = dissolve_junctions({{{1, 0}}, {left, right}});
  ASSERT_EQ(line.chains.size(), 1U);
  EXPECT_EQ(line.chains[0].points, (std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}}));
  EXPECT_FALSE(line.chains[0].closed);
}

TEST(Dissolve, ChainFromAJunctionToItselfIsClosed) {
  Chain round;
  round.points = {{0, 0}, {1, 0}, {0, 1}, {0, 0}};
  round.start_junction = round.end_junction = 0;
  const Chains closed = dissolve_junctions({{{0, 0}}, {round}});
  ASSERT_EQ(closed.chains.size(), 1U);
  EXPECT_TRUE(closed.chains[0].closed);
  EXPECT_TRUE(closed.junctions.empty());
}

}  // namespace
}  // namespace inkgrid
