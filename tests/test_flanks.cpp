// Chains that run side by side: what is seen of them, against distances and ends that are known.
#include <gtest/gtest.h>

#include <cmath>

#include "drawings.h"
#include "refine/flanks.h"

namespace inkgrid {
namespace {

constexpr double kWidth = 5;
constexpr FlankOptions kOptions{40, kWidth};

Chain line(Vec2 a, Vec2 b, int start = -1, int end = -1) {
  Chain chain;
  chain.points = {a, b};
  chain.start_junction = start;
  chain.end_junction = end;
  return chain;
}

std::vector<Flank> flanks_of(const std::vector<Chain>& chains) {
  return find_flanks(chains, 300, 300, kOptions);
}

TEST(Flanks, TwoLinesSeeEachOtherAtTheirDistance) {
  for (const double gap : {6.0, 12.0, 30.0}) {
    const auto flanks = flanks_of({line({50, 100}, {250, 100}), line({50, 100 + gap}, {250, 100 + gap})});
    ASSERT_EQ(flanks.size(), 2u) << gap;
    for (const Flank& f : flanks) {
      EXPECT_NEAR(f.gap, gap, 1) << gap;
      EXPECT_NEAR(f.length, 200, 3);
      EXPECT_EQ(f.other, 1 - f.chain);
      EXPECT_EQ(f.own_ends + f.other_ends, 0);  // both end there
      EXPECT_TRUE(std::isinf(f.clearance));
    }
  }
}

TEST(Flanks, WhatIsFurtherOffIsNoNeighbour) {
  EXPECT_TRUE(flanks_of({line({50, 100}, {250, 100}), line({50, 142}, {250, 142})}).empty());
}

TEST(Flanks, ALineThatCrossesOrStandsAcrossIsNoNeighbour) {
  EXPECT_TRUE(flanks_of({line({50, 100}, {250, 100}), line({150, 20}, {150, 90})}).empty());
  EXPECT_TRUE(flanks_of({line({50, 100}, {250, 100}), line({100, 50}, {200, 150})}).empty());
}

TEST(Flanks, AShortLineBesideALongOneEndsTwice) {
  for (const Flank& f : flanks_of({line({40, 100}, {260, 100}), line({120, 112}, {180, 112})})) {
    EXPECT_EQ(f.own_ends, f.chain == 1 ? 2 : 0);
    EXPECT_EQ(f.other_ends, f.chain == 1 ? 0 : 2);
  }
}

TEST(Flanks, StaggeredLinesEndOneAfterTheOther) {
  const auto flanks = flanks_of({line({40, 100}, {180, 100}), line({120, 112}, {260, 112})});
  ASSERT_EQ(flanks.size(), 2u);
  for (const Flank& f : flanks) {
    EXPECT_NEAR(f.length, 60, 3);
    EXPECT_EQ(f.own_ends, 1);
    EXPECT_EQ(f.other_ends, 1);
  }
}

TEST(Flanks, ChainsThatPartInAJunctionMeetThere) {
  const auto flanks = flanks_of({line({50, 100}, {250, 95}, 0), line({50, 100}, {250, 120}, 0)});
  ASSERT_EQ(flanks.size(), 2u);
  for (const Flank& f : flanks) {
    EXPECT_EQ(f.meetings, 1);
  }
}

TEST(Flanks, TheMiddleOfThreeHasTheOthersBehind) {
  const auto flanks = flanks_of({line({50, 100}, {250, 100}), line({50, 110}, {250, 110}), line({50, 130}, {250, 130})});
  ASSERT_EQ(flanks.size(), 4u);
  for (const Flank& f : flanks) {
    if (f.chain == 1) {
      EXPECT_NEAR(f.clearance, f.other == 0 ? 20 : 10, 1);
    } else {
      EXPECT_TRUE(std::isinf(f.clearance));
    }
  }
}

TEST(Flanks, TurningTheDrawingChangesNothing) {
  const auto turned = [](Vec2 p, double a) {
    const Vec2 d = p - Vec2{150, 150};
    return Vec2{150 + d.x * std::cos(a) - d.y * std::sin(a), 150 + d.x * std::sin(a) + d.y * std::cos(a)};
  };
  for (const double a : {0.3, 0.8, 1.4, 2.2}) {
    const auto flanks =
        flanks_of({line(turned({60, 140}, a), turned({180, 140}, a)), line(turned({120, 155}, a), turned({240, 155}, a))});
    ASSERT_EQ(flanks.size(), 2u) << a;
    for (const Flank& f : flanks) {
      EXPECT_NEAR(f.gap, 15, 1.2) << a;
      EXPECT_NEAR(f.length, 60, 4) << a;
    }
  }
}

TEST(Flanks, ACircleIsNoNeighbourOfItselfButOfOneInside) {
  Chain outer, inner;
  outer.closed = inner.closed = true;
  outer.points = testing::circle({150, 150}, 100);
  inner.points = testing::circle({150, 150}, 85);
  EXPECT_TRUE(flanks_of({outer}).empty());
  const auto flanks = flanks_of({outer, inner});
  ASSERT_GE(flanks.size(), 2u);
  for (const Flank& f : flanks) {
    EXPECT_NEAR(f.gap, 15, 1);
    EXPECT_EQ(f.own_ends + f.other_ends, 0);
  }
}

}  // namespace
}  // namespace inkgrid
