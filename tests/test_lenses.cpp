// Lines that part and meet again.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/polyline.h"
#include "refine/lenses.h"

namespace inkgrid {
namespace {

constexpr double kStroke = 4;  // px

// From (x0, 100) to (x1, 100), `bulge` px beside the straight line in its middle.
Chain bow(double x0, double x1, double bulge, int start_junction, int end_junction, double width = kStroke) {
  Chain chain;
  for (int k = 0; k <= 60; ++k) {
    const double t = k / 60.0;
    chain.points.push_back({x0 + t * (x1 - x0), 100 + bulge * std::pow(std::sin(t * std::numbers::pi), 2)});
  }
  chain.points.front() = {x0, 100};
  chain.points.back() = {x1, 100};
  chain.start_junction = start_junction;
  chain.end_junction = end_junction;
  chain.width = width;
  return chain;
}

// A line that parts between 100 and 160, by as much on both sides.
Chains parted(double bulge) {
  return {{{100, 100}, {160, 100}},
          {bow(20, 100, 0, -1, 0), bow(100, 160, bulge, 0, 1), bow(100, 160, -bulge, 0, 1), bow(160, 240, 0, 1, -1)}};
}

TEST(Lenses, ALineThatPartsAndMeetsAgainIsOne) {
  for (const bool turned : {false, true}) {
    Chains chains = parted(4);
    if (turned) {
      std::reverse(chains.chains[2].points.begin(), chains.chains[2].points.end());
      std::swap(chains.chains[2].start_junction, chains.chains[2].end_junction);
    }
    const Chains result = join_lenses(chains, kStroke);
    ASSERT_EQ(result.chains.size(), 1u);
    EXPECT_TRUE(result.junctions.empty());
    for (const Vec2 p : result.chains[0].points) EXPECT_NEAR(p.y, 100, 0.05);
    EXPECT_NEAR(lengths_along(result.chains[0].points).back(), 220, 0.1);
  }
}

TEST(Lenses, ThatFollowEachOtherAreOneLine) {
  Chains chains = parted(4);
  chains.junctions.push_back({220, 100});
  chains.chains.back() = bow(160, 220, 3, 1, 2);
  chains.chains.push_back(bow(160, 220, -3, 1, 2));
  chains.chains.push_back(bow(220, 300, 0, 2, -1));
  EXPECT_EQ(join_lenses(chains, kStroke).chains.size(), 1u);
}

TEST(Lenses, TheWiderStrokeSaysMore) {
  Chains chains = parted(4);
  chains.chains[1].width = 3 * kStroke;
  const Chains result = join_lenses(chains, kStroke);
  ASSERT_EQ(result.chains.size(), 1u);
  double highest = 0;
  for (const Vec2 p : result.chains[0].points) highest = std::max(highest, p.y - 100);
  EXPECT_NEAR(highest, 4 * 0.75 - 4 * 0.25, 0.05);
}

TEST(Lenses, WideOnesAreShapes) {
  EXPECT_EQ(join_lenses(parted(1.9 * kStroke), kStroke).chains.size(), 1u) << "half of the bulge on both sides";
  EXPECT_EQ(join_lenses(parted(2.15 * kStroke), kStroke).chains.size(), 4u);
}

Chain half_circle(Vec2 centre, double radius, double side) {
  Chain chain = bow(0, 1, 0, 0, 1);
  for (std::size_t k = 0; k < chain.points.size(); ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(chain.points.size() - 1);
    chain.points[k] = centre + radius * Vec2{-std::cos(angle), side * std::sin(angle)};
  }
  return chain;
}

TEST(Lenses, ABeadOnALineStays) {
  const double radius = 1.1 * kStroke;
  const Chain left = bow(20, 130 - radius, 0, -1, 0), right = bow(130 + radius, 240, 0, 1, -1);
  const Chains chains{{left.points.back(), right.points.front()},
                      {left, half_circle({130, 100}, radius, 1), half_circle({130, 100}, radius, -1), right}};
  EXPECT_EQ(join_lenses(chains, kStroke).chains.size(), 4u);
}

// A line that parts in corners at both sides, `apex` px after it parts, for 14 px.
std::size_t lines_of_diamond(double apex, double height) {
  Chains chains = parted(0);
  chains.junctions[1] = {114, 100};
  for (std::size_t c : {1u, 2u}) {
    const double side = c == 1 ? height : -height;
    chains.chains[c].points = resampled({{100, 100}, {100 + apex, 100 + side}, {114, 100}}, 0.5);
  }
  chains.chains[3] = bow(114, 240, 0, 1, -1);
  return join_lenses(chains, kStroke).chains.size();
}

TEST(Lenses, OfLinesThatPartOrMeetAtMoreThanSeventyDegreesStay) {
  EXPECT_EQ(lines_of_diamond(7, 7 * std::tan(std::numbers::pi / 6)), 1u) << "60 degrees";
  EXPECT_EQ(lines_of_diamond(7, 7 * std::tan(42 * std::numbers::pi / 180)), 4u) << "84 degrees";
  EXPECT_EQ(lines_of_diamond(11.5, 5), 4u) << "meet at more";
  EXPECT_EQ(lines_of_diamond(2.5, 5), 4u) << "part at more";
}

TEST(Lenses, WhereAnotherLineMeetsThemTheyStay) {
  for (const int junction : {0, 1}) {
    Chains chains = parted(4);
    const Vec2 place = chains.junctions[static_cast<std::size_t>(junction)];
    Chain branch = bow(160, 200, 0, junction, -1);
    for (Vec2& p : branch.points) p = place + Vec2{0, p.x - 160};
    chains.chains.push_back(branch);
    EXPECT_EQ(join_lenses(chains, kStroke).chains.size(), 5u) << junction;
  }
}

TEST(Lenses, OfEqualStrokesTheLineIsInTheMiddle) {
  Chains chains = parted(0);
  for (std::size_t c : {1u, 2u}) chains.chains[c].width = 0;
  for (Vec2& p : chains.chains[1].points) p.y += p.x > 100 && p.x < 160 ? 2 : 0;
  const Chains result = join_lenses(chains, kStroke);
  ASSERT_EQ(result.chains.size(), 1u);
  double highest = 0;
  for (const Vec2 p : result.chains[0].points) highest = std::max(highest, p.y);
  EXPECT_NEAR(highest, 101, 1e-6) << "of unknown width";
}

TEST(Lenses, AnAlmondWithoutALineStays) {
  Chains chains{{{100, 100}, {160, 100}}, {bow(100, 160, 4, 0, 1), bow(100, 160, -4, 0, 1)}};
  for (const Chain& chain : join_lenses(chains, kStroke).chains) EXPECT_TRUE(chain.closed);
}

}  // namespace
}  // namespace inkgrid
