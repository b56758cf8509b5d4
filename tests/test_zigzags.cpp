#include <gtest/gtest.h>

#include <algorithm>

#include "drawings.h"
#include "lines_to_fit.h"
#include "refine/zigzags.h"

namespace inkgrid {
namespace {

using testing::dense;
using testing::Line;

constexpr double kWidth = 6;

Line cleaned(const Line& line, bool closed = false) {
  Chains chains;
  chains.chains.push_back({line, closed, -1, -1, kWidth, 1});
  return drop_zigzags(std::move(chains), kWidth).chains.front().points;
}

double length(const Line& line) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) sum += norm(line[k + 1] - line[k]);
  return sum;
}

// From one stroke of a bundle back to the beginning of the other.
const Line kRelay = dense({{0, 0}, {60, 0}, {52, 4}, {120, 4}});

TEST(Zigzags, ALineThatTurnsBackGoesStraightOn) {
  const Line line = cleaned(kRelay);
  EXPECT_LT(length(line), 121);
  EXPECT_TRUE(line.front() == kRelay.front() && line.back() == kRelay.back());
  for (const Vec2 p : line) EXPECT_TRUE(p.y >= 0 && p.y <= 4);
}

TEST(Zigzags, TheOtherWayRoundTheSame) {
  const Line reversed(kRelay.rbegin(), kRelay.rend());
  EXPECT_NEAR(length(cleaned(reversed)), length(cleaned(kRelay)), 1);
}

TEST(Zigzags, AFlagOnALineGoes) {
  const Line line = cleaned(dense({{0, 0}, {50, 0}, {48, 5}, {44, 4}, {50, 0.2}, {100, 0}}));
  EXPECT_LT(length(line), 100.5);
}

TEST(Zigzags, AJogBeforeAJunctionGoesToo) {
  const Line line = cleaned(dense({{0, 0}, {60, 0}, {54, 5}, {64, 5}}));
  EXPECT_LT(length(line), 66);
  EXPECT_TRUE((line.back() == Vec2{64, 5}));
}

// A line that goes back by so much, a little beside itself.
Line relay(double back) {
  return dense({{0, 0}, {60, 0}, {60 - back, 1}, {120, 1}});
}

TEST(Zigzags, WhatIsHardlyLongerStays) {
  EXPECT_EQ(cleaned(relay(1.8)), relay(1.8)) << "half a width longer";
  EXPECT_LT(length(cleaned(relay(3))), 121) << "a width longer";
}

TEST(Zigzags, NoMoreThanSixWidthsAreLeftOut) {
  EXPECT_LT(length(cleaned(relay(15))), 121);
  EXPECT_EQ(cleaned(relay(20)), relay(20));
}

TEST(Zigzags, RoundsStay) {
  Line round = kRelay;
  const Line back = dense({{120, 4}, {60, 80}, {0, 0}});
  round.insert(round.end(), back.begin() + 1, back.end());
  EXPECT_LT(length(cleaned(round)), length(round) - 8);
  EXPECT_EQ(cleaned(round, true), round);
}

TEST(Zigzags, CornersStay) {
  for (const double rise : {5.0, 10.0, 40.0}) {
    const Line corner = dense({{0, 0}, {60, 0}, {0, rise}});
    EXPECT_EQ(cleaned(corner), corner) << rise;
  }
  const Line short_arm = dense({{0, 0}, {60, 0}, {54, 6}});
  EXPECT_EQ(cleaned(short_arm), short_arm);
}

TEST(Zigzags, WhatIsDrawnLargerThanTheWidthStays) {
  const Line teeth = dense({{0, 0}, {20, 20}, {18, -10}, {40, 20}, {38, -10}, {60, 0}});
  EXPECT_EQ(cleaned(teeth), teeth);
  const Line closed = testing::full_circle({50, 50}, 4);
  EXPECT_EQ(cleaned(closed, true), closed);
}

}  // namespace
}  // namespace inkgrid
