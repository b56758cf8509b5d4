// Crossings, forks, corners, tips and stars that are known to go wrong, each on a small drawing of its own with known curves.
#include <gtest/gtest.h>

#include <numbers>

#include "known_curves.h"

namespace inkgrid {
namespace {

using namespace testing;
using std::numbers::pi;

class EachAngle : public ::testing::TestWithParam<std::tuple<double, int>> {};

// A stem that forks into two arms.
TEST_P(EachAngle, AForkIsOneJunctionWhereTheStrokesMeet) {
  const auto [pen, degrees] = GetParam();
  const double arm = 40 * pen;
  const Vec2 fork{20 + 12 * pen, 20 * pen + 20};
  const std::vector<Line> truth{{fork - Vec2{10 * pen, 0}, fork},
                                {fork, fork + polar(arm, degrees * kDegree / 2)},
                                {fork, fork + polar(arm, -degrees * kDegree / 2)}};
  const Drawing drawing = traced(painted(truth, pen, static_cast<int>(fork.x + arm + 20), static_cast<int>(2 * fork.y)));
  EXPECT_EQ(drawing.curves.size(), 3u);
  ASSERT_EQ(drawing.junctions.size(), 1u);
  EXPECT_LT(norm(drawing.junctions[0] - fork), pen * std::max(0.5, 15.0 / degrees)) << "of " << pen;
  EXPECT_LT(distance_between(lines_of(drawing), truth), 0.35 * pen + 0.3);
}

INSTANTIATE_TEST_SUITE_P(ThinForks, EachAngle, ::testing::Combine(::testing::Values(3.0), ::testing::Range(15, 65, 5)));
INSTANTIATE_TEST_SUITE_P(Forks, EachAngle, ::testing::Combine(::testing::Values(6.0), ::testing::Range(15, 65, 5)));

class EachCrossing : public ::testing::TestWithParam<std::tuple<double, int>> {};

TEST_P(EachCrossing, StrokesGoOnThroughOneJunction) {
  const auto [pen, degrees] = GetParam();
  for (const double turn : {0.0, 17.0, 40.0, 73.0}) {
    const double arm = 40 * pen, size = 2 * arm + 4 * pen;
    const Vec2 centre{0.5 * size + 0.3, 0.5 * size - 0.3};
    std::vector<Line> truth;
    for (const double side : {-0.5, 0.5}) {
      const Vec2 along = polar(arm, (turn + side * degrees) * kDegree);
      truth.push_back({centre - along, centre + along});
    }
    const Drawing drawing = traced(painted(truth, pen, static_cast<int>(size), static_cast<int>(size)), Preset::clean);
    EXPECT_EQ(drawing.curves.size(), 4u) << turn;
    EXPECT_EQ(free_ends(drawing), 4) << turn;
    ASSERT_EQ(drawing.junctions.size(), 1u) << turn;
    EXPECT_LT(norm(drawing.junctions[0] - centre), pen * 15 / degrees) << turn;
    EXPECT_LT(distance_between(lines_of(drawing), truth), 0.35 * pen + 0.3) << turn;
  }
}

INSTANTIATE_TEST_SUITE_P(ThinCrossings, EachCrossing,
                         ::testing::Combine(::testing::Values(4.5), ::testing::Values(15, 20, 25, 40)));
INSTANTIATE_TEST_SUITE_P(Crossings, EachCrossing,
                         ::testing::Combine(::testing::Values(6.0, 10.0), ::testing::Values(12, 15, 20, 25, 40)));

// Two forks whose arms are in line with no arm of the other.
TEST(Crossings, TwoForksWithALineBetweenThemAreNone) {
  const double pen = 6, arm = 30 * pen;
  const Vec2 left{20 + arm, 20 + arm}, right = left + Vec2{6 * pen, 0};
  std::vector<Line> truth{{left, right}};
  for (const double side : {-1.0, 1.0}) {
    truth.push_back({left, left - polar(arm, side * 15 * kDegree)});
    truth.push_back({right, right + polar(arm, side * 15 * kDegree)});
  }
  const Drawing drawing =
      traced(painted(truth, pen, static_cast<int>(right.x + arm + 20), static_cast<int>(2 * left.y)), Preset::clean);
  EXPECT_EQ(drawing.curves.size(), 5u);
  EXPECT_EQ(drawing.junctions.size(), 2u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 0.35 * pen + 0.3);
}

class EachCorner : public ::testing::TestWithParam<std::tuple<double, int>> {};

TEST_P(EachCorner, AnAcuteCornerIsSharpAndHasNoSpur) {
  const auto [pen, degrees] = GetParam();
  const double arm = 40 * pen;
  const Vec2 tip{20 + 2 * pen, 20 * pen + 20};
  const Line truth{tip + polar(arm, degrees * kDegree / 2), tip, tip + polar(arm, -degrees * kDegree / 2)};
  const Drawing drawing =
      traced(painted({truth}, pen, static_cast<int>(tip.x + arm + 20), static_cast<int>(2 * tip.y)), Preset::clean);
  EXPECT_EQ(drawing.curves.size(), 1u);
  EXPECT_EQ(free_ends(drawing), 2);
  EXPECT_LT(distance(tip, lines_of(drawing)), 0.5 * pen) << "of " << pen;
  EXPECT_LT(distance_between(lines_of(drawing), {truth}), 0.5 * pen + 0.3);
}

INSTANTIATE_TEST_SUITE_P(ThinCorners, EachCorner, ::testing::Combine(::testing::Values(3.0), ::testing::Range(25, 65, 5)));
INSTANTIATE_TEST_SUITE_P(Corners, EachCorner, ::testing::Combine(::testing::Values(6.0), ::testing::Range(15, 65, 5)));

// Lines around the middle of a picture, in a ring of the same pen, which says how wide it is.
struct Ringed {
  std::vector<Line> truth;
  Drawing drawing;

  Ringed(const std::vector<Line>& lines, double pen) {
    const double size = 64 * pen;
    const Vec2 centre{size / 2, size / 2};
    Line ring;
    for (int k = 0; k <= 120; ++k) ring.push_back(polar(29 * pen, 3 * k * kDegree));
    truth = lines;
    truth.push_back(ring);
    for (Line& line : truth)
      for (Vec2& p : line) p += centre;
    drawing = traced(painted(truth, pen, static_cast<int>(size), static_cast<int>(size)), Preset::clean);
  }

  bool is_right(double pen) const { return distance_between(lines_of(drawing), truth) < 0.5 * pen + 0.5; }
};

// In how many of eight directions, degrees, something holds.
template <class Holds>
int directions(const Holds& holds) {
  int count = 0;
  for (const double turn : {0.0, 17.0, 35.0, 52.0, 71.0, 90.0, 113.0, 148.0}) count += holds(turn);
  return count;
}

class EachPoint : public ::testing::TestWithParam<std::tuple<double, int>> {
 protected:
  // One curve with a sharp tip, if its sides have this curvature, 1/pens.
  static bool is_sharp(double turn, double curvature) {
    const auto [pen, degrees] = GetParam();
    const Vec2 tip = polar(-12 * pen, turn * kDegree);
    Line line;
    for (const double side : {-1.0, 1.0})
      for (int k = 0; k <= 40; ++k) {
        const double length = 25.0 * (side < 0 ? 40 - k : k) / 40;
        const double angle = side * (0.5 * degrees * kDegree + 0.5 * curvature * length);
        line.push_back(tip + polar(length * pen, turn * kDegree + angle));
      }
    const Ringed ringed({line}, pen);
    return ringed.drawing.curves.size() == 2 && free_ends(ringed.drawing) == 2 && ringed.is_right(pen) &&
           distance(ringed.truth[0][40], lines_of(ringed.drawing)) < 0.5 * pen + 0.5;
  }
};

TEST_P(EachPoint, OfStraightSidesIsSharp) {
  EXPECT_GE(directions([](double turn) { return is_sharp(turn, 0); }), 6);
}

using EachBentPoint = EachPoint;

TEST_P(EachBentPoint, IsSharp) {
  EXPECT_GE(directions([](double turn) { return is_sharp(turn, 0.02); }), 6);
}

INSTANTIATE_TEST_SUITE_P(Points, EachPoint,
                         ::testing::Combine(::testing::Values(2.0, 4.0, 6.0), ::testing::Values(12, 15, 20, 25)));
INSTANTIATE_TEST_SUITE_P(FinestPoints, EachPoint, ::testing::Combine(::testing::Values(4.0, 8.0), ::testing::Values(10)));
INSTANTIATE_TEST_SUITE_P(BentPoints, EachBentPoint, ::testing::Combine(::testing::Values(5.0), ::testing::Values(15, 25)));

// Waves and zigzags in which the pen turns back beside its own way.
class EachTurn : public ::testing::TestWithParam<std::tuple<double, int>> {
 protected:
  static bool is_one_curve(Line line, double turn, double pen) {
    Vec2 middle;
    for (const Vec2 p : line) middle += (1.0 / static_cast<double>(line.size())) * p;
    for (Vec2& p : line) p = rotated(p - middle, turn);
    const Ringed ringed({line}, pen);
    return ringed.drawing.curves.size() == 2 && free_ends(ringed.drawing) == 2 && ringed.is_right(pen);
  }

 private:
  static Vec2 rotated(Vec2 p, double degrees) {
    const Vec2 along = polar(1, degrees * kDegree);
    return p.x * along + p.y * quarter_turn(along);
  }
};

using EachWave = EachTurn;

// Periods in pens; the waves are ten pens high.
TEST_P(EachWave, IsOneCurve) {
  const auto [pen, period] = GetParam();
  Line wave;
  for (int k = 0; k <= 200; ++k) wave.push_back(pen * Vec2{0.02 * k * period, 5 * std::sin(0.04 * k * pi)});
  EXPECT_GE(directions([&, pen = pen](double turn) { return is_one_curve(wave, turn, pen); }), 6);
}

using EachZigzag = EachTurn;

TEST_P(EachZigzag, IsOneCurve) {
  const auto [pen, degrees] = GetParam();
  Line zigzag;
  for (int k = 0; k <= 6; ++k) zigzag.push_back(pen * Vec2{12 * k * std::tan(0.5 * degrees * kDegree), k % 2 == 0 ? 0.0 : 12.0});
  EXPECT_GE(directions([&, pen = pen](double turn) { return is_one_curve(zigzag, turn, pen); }), 6);
}

INSTANTIATE_TEST_SUITE_P(Waves, EachWave, ::testing::Combine(::testing::Values(6.0, 10.0), ::testing::Values(5, 6, 8)));
INSTANTIATE_TEST_SUITE_P(DenseWaves, EachWave, ::testing::Combine(::testing::Values(10.0), ::testing::Values(3, 4)));
INSTANTIATE_TEST_SUITE_P(Zigzags, EachZigzag, ::testing::Combine(::testing::Values(6.0, 10.0), ::testing::Values(20, 30, 45)));

class EachThinCrossing : public ::testing::TestWithParam<std::tuple<double, int>> {};

// Over as many pens as a corner's, and paper that is too narrow to show.
TEST_P(EachThinCrossing, IsOneJunction) {
  const auto [pen, degrees] = GetParam();
  const auto is_one = [pen = pen, degrees = degrees](double turn) {
    std::vector<Line> lines;
    for (const double side : {-0.5, 0.5}) {
      const Vec2 along = polar(24 * pen, (turn + side * degrees) * kDegree);
      lines.push_back({-along, along});
    }
    const Ringed ringed(lines, pen);
    return ringed.drawing.curves.size() == 5 && ringed.drawing.junctions.size() == 1 && free_ends(ringed.drawing) == 4 &&
           ringed.is_right(pen);
  };
  EXPECT_GE(directions(is_one), 6);
}

INSTANTIATE_TEST_SUITE_P(Crossings, EachThinCrossing, ::testing::Combine(::testing::Values(2.0), ::testing::Values(12, 20)));
INSTANTIATE_TEST_SUITE_P(BroaderCrossings, EachThinCrossing, ::testing::Combine(::testing::Values(3.0), ::testing::Values(20)));

class EachRounding : public ::testing::TestWithParam<std::tuple<double, int>> {};

// The inner rim of a corner of half a pen's radius is as sharp as that of a corner.
TEST_P(EachRounding, ACornerIsAsRoundAsItWasDrawn) {
  const auto [pen, degrees] = GetParam();
  const double size = 24 * pen;
  for (const double radius : {0.0, 0.5 * pen, pen}) {
    SCOPED_TRACE(radius);
    Line truth;
    for (int k = 0; k < 4; ++k) {
      const Vec2 out = polar(1, (90 * k + 45 + degrees) * kDegree) * std::sqrt(2.0) * (6 * pen - radius);
      for (int i = 0; i <= 12; ++i)
        truth.push_back(Vec2{size / 2, size / 2} + out + polar(radius, (90 * k + degrees + 7.5 * i) * kDegree));
    }
    truth.push_back(truth.front());
    const Drawing drawing = traced(painted({truth}, pen, static_cast<int>(size), static_cast<int>(size)), Preset::clean);
    ASSERT_EQ(drawing.curves.size(), 1u);
    EXPECT_TRUE(drawing.curves[0].closed);
    EXPECT_LT(distance_between(lines_of(drawing), {truth}), 0.13 * pen) << "a sharp corner in place of an arc is off by .21 pens";
  }
}

INSTANTIATE_TEST_SUITE_P(Corners, EachRounding,
                         ::testing::Combine(::testing::Values(8.0, 12.0, 20.0, 40.0), ::testing::Values(0, 17, 40)));

class EachTail : public ::testing::TestWithParam<std::tuple<double, int>> {};

// Of a speech bubble: its sides are short.
TEST_P(EachTail, EndsInASharpTip) {
  const auto [pen, degrees] = GetParam();
  const double radius = 80, half = 0.5 * degrees * kDegree, length = pen < 6 ? 24 : 40;
  for (const double turn : {0.0, 13.0, 31.0}) {
    const Vec2 centre{150, 150}, out = polar(1, (90 + turn) * kDegree), tip = centre + (radius + length) * out;
    Line truth{tip};
    // Where a side meets the circle, by the sine rule.
    const double at_circle = std::asin((radius + length) / radius * std::sin(half)) - half;
    for (double a = at_circle; a <= 2 * pi - at_circle; a += 0.01)
      truth.push_back(centre + polar(radius, (90 + turn) * kDegree + a));
    truth.push_back(tip);
    const Drawing drawing = traced(painted({truth}, pen, 300, 300), Preset::clean);
    EXPECT_LT(distance(tip, lines_of(drawing)), 0.25 * pen) << turn;
    EXPECT_LT(distance_between(lines_of(drawing), {truth}), 0.35 * pen) << turn;
  }
}

INSTANTIATE_TEST_SUITE_P(ThinTips, EachTail, ::testing::Combine(::testing::Values(3.0), ::testing::Values(45, 60)));
INSTANTIATE_TEST_SUITE_P(ThickTips, EachTail, ::testing::Combine(::testing::Values(8.0), ::testing::Values(35, 45, 60)));

class EachStar : public ::testing::TestWithParam<std::tuple<double, int>> {};

TEST_P(EachStar, ManyStrokesMeetInOneJunction) {
  const auto [pen, arms] = GetParam();
  const int size = static_cast<int>(60 * pen);
  const Vec2 centre{size / 2.0 + 0.2, size / 2.0 - 0.3};
  std::vector<Line> truth;
  for (int k = 0; k < arms; ++k) truth.push_back({centre, centre + polar(25 * pen, 0.13 + 2 * pi * k / arms)});
  const Drawing drawing = traced(painted(truth, pen, size, size));
  EXPECT_EQ(drawing.curves.size(), static_cast<std::size_t>(arms));
  ASSERT_EQ(drawing.junctions.size(), 1u);
  EXPECT_LT(norm(drawing.junctions[0] - centre), 0.4 * pen);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 0.3 * pen + 0.3);
}

INSTANTIATE_TEST_SUITE_P(Stars, EachStar, ::testing::Combine(::testing::Values(3.0, 5.0, 8.0), ::testing::Range(3, 9)));

}  // namespace
}  // namespace inkgrid
