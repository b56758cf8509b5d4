#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "refine/crossings.h"

namespace inkgrid {
namespace {

Chain chain_of(std::vector<Vec2> points, bool closed = false) {
  Chain chain;
  chain.points = std::move(points);
  chain.closed = closed;
  return chain;
}

// Every end that names a junction lies on it, and as many ends as expected do.
void expect_ends_on_junctions(const Chains& chains, int ends) {
  int found = 0;
  for (const Chain& c : chains.chains) {
    ASSERT_GE(c.points.size(), 2u);
    const auto lies_on = [&](int j, Vec2 end) { return j < 0 || chains.junctions[static_cast<std::size_t>(j)] == end; };
    EXPECT_TRUE(lies_on(c.start_junction, c.points.front()));
    EXPECT_TRUE(lies_on(c.end_junction, c.points.back()));
    found += (c.start_junction >= 0) + (c.end_junction >= 0);
  }
  EXPECT_EQ(found, ends);
}

double length(const Chains& chains) {
  double sum = 0;
  for (const Chain& c : chains.chains)
    for (std::size_t k = 0; k + 1 < c.points.size(); ++k) sum += norm(c.points[k + 1] - c.points[k]);
  return sum;
}

TEST(Crossings, TwoLinesBecomeFourBranches) {
  const Chains crossed = join_crossings({{}, {chain_of({{0, 0}, {10, 10}}), chain_of({{0, 10}, {4, 6}, {10, 0}})}}, 1);
  ASSERT_EQ(crossed.junctions.size(), 1u);
  EXPECT_NEAR(norm(crossed.junctions[0] - Vec2{5, 5}), 0, 1e-12);
  EXPECT_EQ(crossed.chains.size(), 4u);
  expect_ends_on_junctions(crossed, 4);
}

TEST(Crossings, ALoopOpensItsLine) {
  const Chains crossed = join_crossings({{}, {chain_of({{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, -10}})}}, 1);
  ASSERT_EQ(crossed.junctions.size(), 1u);
  EXPECT_TRUE((crossed.junctions[0] == Vec2{10, 0}));
  EXPECT_EQ(crossed.chains.size(), 3u);
  expect_ends_on_junctions(crossed, 4);
}

TEST(Crossings, AFigureOfEightIsTwoLobes) {
  const Chains eight{{}, {chain_of({{0, 0}, {10, 10}, {14, 5}, {10, 0}, {0, 10}, {-4, 5}, {0, 0}}, true)}};
  const Chains crossed = join_crossings(eight, 1);
  ASSERT_EQ(crossed.chains.size(), 2u);
  for (const Chain& c : crossed.chains) {
    EXPECT_FALSE(c.closed);
    EXPECT_TRUE(c.points.front() == c.points.back());
  }
  expect_ends_on_junctions(crossed, 4);
  EXPECT_NEAR(length(crossed), length(eight), 1e-9);
}

TEST(Crossings, ChainsThatMeetNearbyStay) {
  Chains chains{{{0, 0}}, {chain_of({{0, 0}, {3, 1}, {10, 0}}), chain_of({{0, 0}, {3, 0}, {5, 2}, {10, 8}})}};
  for (Chain& c : chains.chains) c.start_junction = 0;
  EXPECT_EQ(join_crossings(chains, 5).chains.size(), 2u);
  EXPECT_EQ(join_crossings(chains, 1).chains.size(), 4u);
}

TEST(Crossings, AsManyAsEachPairOfSegmentsHas) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 40);
    Chains chains;
    for (int c = 0; c < 4; ++c) {
      std::vector<Vec2> points;
      for (int k = 0; k < 6; ++k) points.push_back({place(random), place(random)});
      chains.chains.push_back(chain_of(points));
    }
    std::vector<std::pair<Vec2, Vec2>> segments;
    int expected = 0;
    for (const Chain& c : chains.chains)
      for (std::size_t k = 0; k + 1 < c.points.size(); ++k) segments.emplace_back(c.points[k], c.points[k + 1]);
    const auto apart = [](Vec2 a, Vec2 b, Vec2 p, Vec2 q) { return cross(b - a, p - a) * cross(b - a, q - a) < 0; };
    for (std::size_t i = 0; i < segments.size(); ++i)
      for (std::size_t k = i + 1; k < segments.size(); ++k)
        expected += apart(segments[i].first, segments[i].second, segments[k].first, segments[k].second) &&
                    apart(segments[k].first, segments[k].second, segments[i].first, segments[i].second);
    const Chains crossed = join_crossings(chains, 2);
    EXPECT_EQ(static_cast<int>(crossed.junctions.size()), expected) << seed;
    EXPECT_EQ(static_cast<int>(crossed.chains.size()), 4 + 2 * expected) << seed;
    expect_ends_on_junctions(crossed, 4 * expected);
    EXPECT_NEAR(length(crossed), length(chains), 1e-6);
    EXPECT_EQ(join_crossings(crossed, 0.1).junctions.size(), crossed.junctions.size()) << "crossings that are joined are none";
  }
}

std::vector<Vec2> dense(const std::vector<Vec2>& vertices) {
  std::vector<Vec2> points{vertices.front()};
  for (std::size_t v = 0; v + 1 < vertices.size(); ++v) {
    const int pieces = static_cast<int>(norm(vertices[v + 1] - vertices[v]));
    for (int k = 1; k <= pieces; ++k) points.push_back(lerp(vertices[v], vertices[v + 1], static_cast<double>(k) / pieces));
  }
  return points;
}

// A line from left to right, and a corner whose tip is `gap` px above its middle.
Chains corner_above_line(double gap, double half_opening) {
  return {{},
          {chain_of(dense({{0, 50}, {100, 50}})),
           chain_of(dense({{50 - half_opening, 10}, {50, 50 - gap}, {50 + half_opening, 10}}))}};
}

TEST(Crossings, ACornerThatTouchesALineIsJoinedWithIt) {
  for (const double gap : {0.5, 2.0, 3.5}) {
    const Chains joined = join_touching_corners(corner_above_line(gap, 20), 4);
    ASSERT_EQ(joined.junctions.size(), 1u) << gap;
    EXPECT_NEAR(norm(joined.junctions[0] - Vec2{50, 50}), 0, 1e-9);
    EXPECT_EQ(joined.chains.size(), 4u);
    expect_ends_on_junctions(joined, 4);
  }
}

TEST(Crossings, WhatIsFartherAndWhatIsBluntIsNone) {
  EXPECT_TRUE(join_touching_corners(corner_above_line(4.5, 20), 4).junctions.empty());
  EXPECT_TRUE(join_touching_corners(corner_above_line(2, 60), 4).junctions.empty());
  Chains ends = corner_above_line(2, 20);
  ends.chains[0].points = dense({{0, 50}, {53, 50}});
  EXPECT_TRUE(join_touching_corners(ends, 4).junctions.empty());
  Chains marked = corner_above_line(2, 20);
  marked.chains[0].mark = true;
  EXPECT_TRUE(join_touching_corners(marked, 4).junctions.empty());
}

TEST(Crossings, TwoCornersTipToTipAreOneCrossing) {
  const Chains tips{{}, {chain_of(dense({{30, 10}, {50, 49}, {70, 10}})), chain_of(dense({{30, 90}, {50, 51}, {70, 90}}))}};
  const Chains joined = join_touching_corners(tips, 4);
  EXPECT_EQ(joined.junctions.size(), 1u);
  EXPECT_EQ(joined.chains.size(), 4u);
  expect_ends_on_junctions(joined, 4);
}

}  // namespace
}  // namespace inkgrid
