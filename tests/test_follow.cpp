#include <gtest/gtest.h>

#include <numbers>

#include "base/polyline.h"
#include "drawn_bands.h"
#include "refine/follow.h"

namespace inkgrid {
namespace {

constexpr double kPen = 6;
constexpr Vec2 kCentre{150, 150};
constexpr double kRadius = 90;

std::vector<Vec2> bow(double from, double to) {
  return testing::arc(kCentre, kRadius, from, to);
}

Chain chain_along(std::vector<Vec2> points) {
  Chain chain;
  chain.points = resampled(std::move(points), 1);
  chain.width = kPen;
  return chain;
}

double length_of(const Chain& chain) {
  return lengths_along(chain.points).back();
}

TEST(Follow, AnEndGoesOnAlongTheMiddleUpToTheNextChain) {
  const Ink ink = testing::drawn_ink({bow(0, 3)}, kPen, 300);
  const Chains chains = follow_strokes({{}, {chain_along(bow(0, 0.8)), chain_along(bow(2.2, 3))}}, ink, 1, 2 * kPen);
  ASSERT_EQ(chains.chains.size(), 2u);
  const auto& points = chains.chains[0].points;
  for (const Vec2 p : points) EXPECT_NEAR(norm(p - kCentre), kRadius, 0.2 * kPen);
  EXPECT_LT(norm(points.back() - chains.chains[1].points.front()), 1.2 * kPen);
  EXPECT_EQ(chains.chains[1].points.size(), chain_along(bow(2.2, 3)).points.size());
}

TEST(Follow, AStrokeThatJustEndsIsNotFollowed) {
  const Ink ink = testing::drawn_ink({bow(0, 3)}, kPen, 300);
  const Chain half = chain_along(bow(0, 1.5));
  const Chains chains = follow_strokes({{}, {half}}, ink, 1, 2 * kPen);
  EXPECT_EQ(chains.chains[0].points, half.points);
}

TEST(Follow, PaperEndsAStrokeUnlessItIsBridged) {
  const Ink ink = testing::drawn_ink({bow(0, 1.5), bow(1.6, 3)}, kPen, 300);
  const Chain first = chain_along(bow(0, 0.8)), second = chain_along(bow(2.2, 3));
  const double gap = 0.1 * kRadius - kPen;
  EXPECT_EQ(follow_strokes({{}, {first, second}}, ink, 0.25 * gap, 2 * kPen).chains[0].points, first.points);
  EXPECT_GT(length_of(follow_strokes({{}, {first, second}}, ink, 1.3 * gap, 2 * kPen).chains[0]), 2 * length_of(first));
}

TEST(Follow, ClosedChainsHaveNoEnds) {
  const Ink ink = testing::drawn_ink({bow(0, 3)}, kPen, 300);
  Chain first = chain_along(bow(0, 0.8));
  first.closed = true;
  EXPECT_EQ(follow_strokes({{}, {first, chain_along(bow(2.2, 3))}}, ink, 1, 2 * kPen).chains[0].points, first.points);
}

TEST(Follow, IntoTheMiddleOfAnotherChainIsNoWayOn) {
  const std::vector<Vec2> across{{60, 20}, {60, 280}};
  const Ink ink = testing::drawn_ink({bow(0, std::numbers::pi), across}, kPen, 300);
  const Chain half = chain_along(bow(0, 1.5));
  const Chains chains = follow_strokes({{}, {half, chain_along(across)}}, ink, 1, 2 * kPen);
  EXPECT_EQ(length_of(chains.chains[0]), length_of(half));
}

TEST(Follow, ARingIsClosedByItsOwnOtherEnd) {
  const Ink ink = testing::drawn_ink({testing::circle(kCentre, kRadius)}, kPen, 300);
  const Chains chains = follow_strokes({{}, {chain_along(bow(0, 4.5))}}, ink, 1, 2 * kPen);
  EXPECT_LT(norm(chains.chains[0].points.back() - chains.chains[0].points.front()), 1.2 * kPen);
  EXPECT_NEAR(length_of(chains.chains[0]), 2 * std::numbers::pi * kRadius, 2 * kPen);
}

TEST(Follow, EndsAtJunctionsStay) {
  const Ink ink = testing::drawn_ink({bow(0, 3)}, kPen, 300);
  Chain first = chain_along(bow(0, 0.8));
  first.end_junction = 0;
  const Chains chains = follow_strokes({{first.points.back()}, {first, chain_along(bow(2.2, 3))}}, ink, 1, 2 * kPen);
  EXPECT_EQ(chains.chains[0].points, first.points);
}

}  // namespace
}  // namespace inkgrid
