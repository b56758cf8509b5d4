#include <gtest/gtest.h>

#include "base/polyline.h"
#include "drawn_bands.h"
#include "refine/leftovers.h"
#include "run_report.h"

namespace inkgrid {
namespace {

using testing::drawn_ink;

Chain chain_along(Vec2 a, Vec2 b) {
  Chain chain;
  chain.points = resampled({a, b}, 1);
  return chain;
}

TEST(Leftovers, ADotBecomesAShortMarkAtItsCentre) {
  const Ink ink = drawn_ink({{{20, 50}, {180, 50}}, {{100, 120}, {100.1, 120}}}, 6, 200);
  const Chains left = mark_leftovers({{}, {chain_along({20, 50}, {180, 50})}}, ink, 2);
  ASSERT_EQ(left.chains.size(), 2u);
  EXPECT_TRUE(left.chains.back().mark);
  EXPECT_EQ(count_dashes(left, ink.stroke_width), 0);
  const auto& mark = left.chains.back();
  EXPECT_LT(norm(lerp(mark.points.front(), mark.points.back(), 0.5) - Vec2{100.05, 120}), 0.3);
  EXPECT_LT(lengths_along(mark.points).back(), 2);
  EXPECT_NEAR(mark.width, 6, 1.5);
}

TEST(Leftovers, AStrokeThatNoChainFollowsIsADash) {
  const Ink ink = drawn_ink({{{40, 60}, {160, 120}}}, 6, 200);
  const Chains left = mark_leftovers({}, ink, 2);
  ASSERT_EQ(left.chains.size(), 1u);
  EXPECT_EQ(count_dashes(left, ink.stroke_width), 1);
  const auto& points = left.chains.front().points;
  const Vec2 a = points.front().x < points.back().x ? points.front() : points.back();
  const Vec2 b = points.front().x < points.back().x ? points.back() : points.front();
  EXPECT_LT(norm(a - Vec2{40, 60}), 1.5);
  EXPECT_LT(norm(b - Vec2{160, 120}), 1.5);
}

TEST(Leftovers, InkWithAChainIsLeftAlone) {
  const Ink ink = drawn_ink({{{20, 50}, {180, 50}}}, 6, 200);
  const Chains left = mark_leftovers({{}, {chain_along({30, 51}, {90, 51})}}, ink, 2);
  EXPECT_EQ(left.chains.size(), 1u);
  EXPECT_FALSE(left.chains.front().mark);
}

TEST(Leftovers, AreCountedInWarnings) {
  Report report;
  report_leftovers({}, 6, report);
  EXPECT_TRUE(report.warnings.empty());
  report.fallback_components = 1;
  report_leftovers({}, 6, report);
  Chain mark = chain_along({20, 20}, {60, 20});
  mark.mark = true;
  report.fallback_components = 2;
  report_leftovers({{}, {mark}}, 6, report);
  EXPECT_EQ(report.warnings,
            (std::vector<std::string>{"1 part of the drawing could not be solved", "2 parts of the drawing could not be solved",
                                      "1 piece of ink became a straight mark, because no isoline follows it"}));
}

}  // namespace
}  // namespace inkgrid
