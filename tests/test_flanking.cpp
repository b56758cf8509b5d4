// Chains that were drawn for one line.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/polyline.h"
#include "refine/flanking.h"

namespace inkgrid {
namespace {

constexpr double kStroke = 4;      // px
constexpr double kSketchy = 0.45;  // as in a sketch where every other line is drawn over
constexpr double kNeat = 0.02;

Chain line(Vec2 a, Vec2 b, int start_junction = -1, int end_junction = -1) {
  Chain chain;
  chain.points = resampled({a, b}, 1);
  chain.start_junction = start_junction;
  chain.end_junction = end_junction;
  chain.width = kStroke;
  return chain;
}

Chain arc(Vec2 centre, double radius, double from, double to, double outwards) {
  Chain chain;
  for (double degrees = from; degrees <= to; degrees += 1) {
    const double angle = degrees * std::numbers::pi / 180;
    const double r = radius + outwards * (degrees - from) / (to - from);
    chain.points.push_back(centre + r * Vec2{std::cos(angle), std::sin(angle)});
  }
  chain.width = kStroke;
  return chain;
}

Chains joined(Chains chains, double sketchiness = kSketchy) {
  return join_flanking(std::move(chains), {400, 400, kStroke, sketchiness});
}

double distance_to(const Chain& chain, Vec2 p) {
  double nearest = 1e9;
  for (const Vec2 q : chain.points) nearest = std::min(nearest, norm(q - p));
  return nearest;
}

void expect_sound(const Chains& chains) {
  std::vector<int> ends(chains.junctions.size());
  for (const Chain& chain : chains.chains) {
    ASSERT_GE(chain.points.size(), 2u);
    EXPECT_EQ(chain.closed, chain.points.front() == chain.points.back() && chain.start_junction < 0);
    for (const auto& [junction, point] :
         {std::pair{chain.start_junction, chain.points.front()}, {chain.end_junction, chain.points.back()}})
      if (junction >= 0) {
        EXPECT_EQ(chains.junctions[static_cast<std::size_t>(junction)], point);
        ++ends[static_cast<std::size_t>(junction)];
      }
  }
  for (const int count : ends) EXPECT_GE(count, 3);
}

TEST(Flanking, AShortStrokeBesideALongOneIsPartOfIt) {
  const Chains result = joined({{}, {line({20, 100}, {320, 100}), line({120, 108}, {220, 108})}});
  ASSERT_EQ(result.chains.size(), 1u);
  expect_sound(result);
  EXPECT_LT(distance_to(result.chains[0], {170, 104}), 0.6) << "through the middle";
  EXPECT_EQ(result.chains[0].points.front(), (Vec2{20, 100}));
  EXPECT_EQ(result.chains[0].points.back(), (Vec2{320, 100}));
}

TEST(Flanking, InANeatDrawingBothStay) {
  const Chains before{{}, {line({20, 100}, {320, 100}), line({120, 108}, {220, 108})}};
  const Chains result = joined(before, kNeat);
  ASSERT_EQ(result.chains.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) EXPECT_EQ(result.chains[c].points, before.chains[c].points);
}

TEST(Flanking, StrokesThatRelieveEachOtherGoOnAsOne) {
  for (const bool turned : {false, true}) {
    Chain second = line({160, 108}, {340, 108});
    if (turned) std::reverse(second.points.begin(), second.points.end());
    const Chains result = joined({{}, {line({20, 100}, {220, 100}), second}});
    ASSERT_EQ(result.chains.size(), 1u);
    expect_sound(result);
    EXPECT_LT(distance_to(result.chains[0], {20, 100}), 0.01);
    EXPECT_LT(distance_to(result.chains[0], {340, 108}), 0.01);
    EXPECT_LT(distance_to(result.chains[0], {190, 104}), 0.6);
    const auto& points = result.chains[0].points;
    for (std::size_t i = 1; i < points.size(); ++i)
      EXPECT_GE(std::abs(points[i].x - points[i - 1].x), std::abs(points[i].y - points[i - 1].y));
  }
}

TEST(Flanking, ALineThatEndsBesideItsStartIsClosed) {
  const Chains result = joined({{}, {arc({200, 200}, 100, 0, 400, 9)}});
  ASSERT_EQ(result.chains.size(), 1u);
  expect_sound(result);
  EXPECT_TRUE(result.chains[0].closed);
  for (const Vec2 p : result.chains[0].points) EXPECT_NEAR(norm(p - Vec2{200, 200}), 104.5, 5.5);
}

TEST(Flanking, AStrokeThatComesFromElsewhereRunsIntoTheLine) {
  Chain branch = line({40, 250}, {140, 108});
  const Chain along = line({140, 108}, {230, 108});
  branch.points.insert(branch.points.end(), along.points.begin() + 1, along.points.end());
  const Chains result = joined({{}, {line({20, 100}, {360, 100}), branch}});
  ASSERT_EQ(result.chains.size(), 3u);
  ASSERT_EQ(result.junctions.size(), 1u);
  expect_sound(result);
  EXPECT_NEAR(result.junctions[0].y, 100, 0.6);
  EXPECT_NEAR(result.junctions[0].x, 160, 15);
}

TEST(Flanking, ASpurBesideItsOwnLineGoes) {
  const Chains before{
      {{100, 100}},
      {line({20, 100}, {100, 100}, -1, 0), line({100, 100}, {340, 100}, 0, -1), line({100, 100}, {170, 109}, 0, -1)}};
  const Chains result = joined(before);
  ASSERT_EQ(result.chains.size(), 1u);
  expect_sound(result);
  EXPECT_EQ(joined(before, kNeat).chains.size(), 3u);
}

TEST(Flanking, WhatSticksOutOfAWideBundleGoesWhereLinesAreDrawnOver) {
  const auto bundle = [](double width, double tail) {
    Chains chains{{{180, 100}}, {line({20, 100}, {180, 100}, -1, 0), line({180, 100}, {340, 100}, 0, -1)}};
    for (Chain& chain : chains.chains) chain.width = width;
    chains.chains.push_back(line({180, 100}, {180, 100 + tail}, 0, -1));
    return chains;
  };
  EXPECT_EQ(joined(bundle(4 * kStroke, 28)).chains.size(), 1u);
  EXPECT_EQ(joined(bundle(4 * kStroke, 36)).chains.size(), 3u) << "a branch";
  EXPECT_EQ(joined(bundle(2 * kStroke, 14)).chains.size(), 3u) << "no bundle";
  EXPECT_EQ(joined(bundle(4 * kStroke, 28), 0.2).chains.size(), 3u);
}

TEST(Flanking, LinesThatCrossOrEndTogetherStay) {
  EXPECT_EQ(joined({{}, {line({20, 100}, {320, 100}), line({150, 20}, {150, 300})}}).chains.size(), 2u);
  EXPECT_EQ(joined({{}, {line({20, 100}, {320, 100}), line({20, 116}, {320, 116})}}).chains.size(), 2u);
}

TEST(Flanking, NothingIsNothing) {
  EXPECT_TRUE(joined({}).chains.empty());
}

}  // namespace
}  // namespace inkgrid
