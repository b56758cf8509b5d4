// What people know goes wrong when line drawings are vectorised, each on a small drawing of its own with known curves.
#include <gtest/gtest.h>

#include <numbers>

#include "known_curves.h"

namespace inkgrid {
namespace {

using namespace testing;
using std::numbers::pi;

double length_of(const Line& line) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += norm(line[i + 1] - line[i]);
  return length;
}

// Signed and absolute angle that a line turns by, over chords of about `step` px, which pass over pixel noise.
struct Turning {
  double whole = 0, absolute = 0, sharpest = 0;  // rad; the sharpest between two chords
};

Turning turning_of(const Line& line, double step, bool closed) {
  Line chords{line.front()};
  for (const Vec2 p : dense(line))
    if (norm(p - chords.back()) >= step) chords.push_back(p);
  if (closed) chords.insert(chords.end(), {chords[0], chords[1]});
  Turning turning;
  for (std::size_t i = 1; i + 1 < chords.size(); ++i) {
    const Vec2 in = chords[i] - chords[i - 1], out = chords[i + 1] - chords[i];
    if (closed && norm(in) < 0.6 * step) continue;
    const double angle = std::atan2(cross(in, out), dot(in, out));
    turning.whole += angle;
    turning.absolute += std::abs(angle);
    turning.sharpest = std::max(turning.sharpest, std::abs(angle));
  }
  return turning;
}

// ---------------------------------------------------------------- ends

class EachPenAndAngle : public ::testing::TestWithParam<std::tuple<double, int>> {};

TEST_P(EachPenAndAngle, EndsAreNotCutBack) {
  const auto [pen, degrees] = GetParam();
  const double length = 40 + 12 * pen;
  const int size = static_cast<int>(length + 4 * pen + 20);
  const Vec2 middle{size / 2.0 + 0.3, size / 2.0 - 0.2}, half = polar(length / 2, (degrees + 7) * kDegree);
  const Line truth{middle - half, middle + half};
  const Drawing drawing = traced(painted({truth}, pen, size, size));
  ASSERT_EQ(drawing.curves.size(), 1u);
  const Line found = points_of(drawing.curves[0]);
  for (const Vec2 end : truth)
    EXPECT_LT(std::min(norm(found.front() - end), norm(found.back() - end)), 0.15 * pen + 0.35) << "of " << pen;
  EXPECT_LT(distance_between({found}, {truth}), 0.15 * pen + 0.35);
}

INSTANTIATE_TEST_SUITE_P(Ends, EachPenAndAngle,
                         ::testing::Combine(::testing::Values(2.0, 5.0, 12.0), ::testing::Range(0, 180, 15)));

// ---------------------------------------------------------------- round shapes

class EachRadius : public ::testing::TestWithParam<double> {};

TEST_P(EachRadius, ACircleIsOneClosedCurveWithoutKinks) {
  const double pen = 4, radius = GetParam() * pen;
  const int size = static_cast<int>(2 * radius + 40);
  const Line truth = circle({size / 2.0 + 0.3, size / 2.0 - 0.2}, radius);
  const Drawing drawing = traced(painted({truth}, pen, size, size));
  ASSERT_EQ(drawing.curves.size(), 1u);
  EXPECT_TRUE(drawing.curves[0].closed);
  EXPECT_LT(distance_between(lines_of(drawing), {truth}), 0.4);
  const Turning turning = turning_of(points_of(drawing.curves[0]), 0.5 * pen, true);
  EXPECT_NEAR(std::abs(turning.whole), 2 * pi, 0.4);
  EXPECT_LT(turning.absolute, 1.1 * 2 * pi);
  EXPECT_LT(turning.sharpest, 2.5 * 0.5 / GetParam());
}

INSTANTIATE_TEST_SUITE_P(Round, EachRadius, ::testing::Values(2, 2.5, 3, 5, 8, 15));

TEST(Round, ASpiralIsOneCurveWithoutKinks) {
  for (const double pen : {2.0, 4.0, 7.0}) {
    SCOPED_TRACE(pen);
    const double pitch = 4 * pen, turns = 3.25, first = 2.5 * pen;
    const int size = static_cast<int>(2 * (first + pitch * turns) + 30);
    Line truth;
    for (int k = 0; k <= 400; ++k) {
      const double angle = 2 * pi * turns * k / 400;
      truth.push_back(Vec2{size / 2.0, size / 2.0} + polar(first + pitch * angle / (2 * pi), angle));
    }
    const Drawing drawing = traced(painted({truth}, pen, size, size));
    EXPECT_EQ(drawing.curves.size(), 1u);
    EXPECT_TRUE(drawing.junctions.empty());
    EXPECT_LT(distance_between(lines_of(drawing), {truth}), 0.15 * pen + 0.35);
    if (drawing.curves.size() != 1) continue;
    const Turning turning = turning_of(points_of(drawing.curves[0]), pen, false);
    EXPECT_NEAR(std::abs(turning.whole), 2 * pi * turns, 0.8);
    EXPECT_LT(turning.absolute, 1.1 * 2 * pi * turns);
    EXPECT_LT(turning.sharpest, 0.8);
  }
}

// ---------------------------------------------------------------- close strokes

class EachGap : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(EachGap, CloseStrokesHaveNoRungs) {
  const auto [pen, gap] = GetParam();
  const double apart = (1 + gap) * pen;
  std::vector<Line> truth;
  for (int k = 0; k < 3; ++k) {
    Line line;
    for (double t = 0; t <= 1; t += 0.02)
      line.push_back({20 + 60 * pen * t, 20 + k * apart + 4 * pen * std::sin(3 * t) + 3 * pen});
    truth.push_back(line);
  }
  const Drawing drawing =
      traced(painted(truth, pen, static_cast<int>(60 * pen + 40), static_cast<int>(40 + 3 * apart + 8 * pen)), Preset::clean);
  EXPECT_EQ(drawing.curves.size(), 3u) << "of " << pen << " px, " << gap << " apart";
  EXPECT_TRUE(drawing.junctions.empty());
  EXPECT_LT(distance_between(lines_of(drawing), truth), 0.25 * pen + 0.4);
}

INSTANTIATE_TEST_SUITE_P(Gaps, EachGap, ::testing::Combine(::testing::Values(4.0, 7.0), ::testing::Values(0.7, 1.0)));
INSTANTIATE_TEST_SUITE_P(ThinGaps, EachGap, ::testing::Combine(::testing::Values(2.0), ::testing::Values(0.7, 1.5)));

INSTANTIATE_TEST_SUITE_P(FineGaps, EachGap, ::testing::Combine(::testing::Values(2.5, 3.0), ::testing::Values(0.5, 0.7)));

TEST(Gaps, HairsSideBySideAreKept) {
  std::vector<Line> truth;
  for (int k = 0; k < 8; ++k) {
    Line hair;
    for (double t = 0; t <= 1; t += 0.02) hair.push_back({20 + 4.0 * k + 30 * t * t, 15 + 150 * t});
    truth.push_back(hair);
  }
  const Drawing drawing = traced(painted(truth, 1.5, 100, 180));
  EXPECT_EQ(drawing.curves.size(), 8u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 1);
}

// Five rings of 2.5 px with as little as 1.75 px of paper between them, and a hatching of 1.5 px.
TEST(Gaps, RingsOfAFinePenAreRings) {
  std::vector<Line> truth;
  for (int k = 1; k <= 5; ++k) truth.push_back(circle({40.3, 39.8}, 4.25 * k + 4));
  const Drawing drawing = traced(painted(truth, 2.5, 80, 80));
  EXPECT_EQ(drawing.curves.size(), 5u);
  for (const Curve& curve : drawing.curves) EXPECT_TRUE(curve.closed);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 0.35);
}

TEST(Hatching, OfAFinePenIsAsManyStrokes) {
  std::vector<Line> truth;
  for (int k = 0; k < 16; ++k) truth.push_back({{20 + 4.15 * k, 15}, {30 + 4.15 * k, 90}});
  const Drawing drawing = traced(painted(truth, 1.5, 120, 105));
  EXPECT_EQ(drawing.curves.size(), truth.size());
  EXPECT_TRUE(drawing.junctions.empty());
  EXPECT_LT(distance_between(lines_of(drawing), truth), 0.8);
}

// Of such slits pixels show two or four in places of three.
TEST(Hatching, WithSlitsHalfAsWideAsThePenIsAsManyStrokes) {
  for (const double pen : {3.0, 4.0})
    for (const double angle : {0.0, 20.0, 45.0}) {
      SCOPED_TRACE(::testing::Message() << pen << " px, " << angle << " degrees");
      const Vec2 along = polar(1, angle * kDegree), across = quarter_turn(along);
      std::vector<Line> truth;
      for (int k = -5; k <= 5; ++k)
        truth.push_back(
            {Vec2{70, 70} + 1.5 * pen * k * across - 40.0 * along, Vec2{70, 70} + 1.5 * pen * k * across + 40.0 * along});
      const Drawing drawing = traced(painted(truth, pen, 140, 140));
      EXPECT_EQ(drawing.curves.size(), truth.size());
      EXPECT_LT(distance_between(lines_of(drawing), truth), 1);
    }
}

// Half of the ink is blots.
TEST(Hatching, CrossedWithLittleMorePaperThanInkIsNoSketch) {
  std::vector<Line> truth;
  for (int k = 0; k < 7; ++k) {
    truth.push_back({{20, 30.0 + 10 * k}, {112, 30.0 + 10 * k}});
    truth.push_back({{30.0 + 10 * k, 20}, {30.0 + 10 * k, 112}});
  }
  const Drawing drawing = traced(painted(truth, 4, 132, 132));
  EXPECT_TRUE(drawing.fills.empty());
  EXPECT_EQ(drawing.junctions.size(), 49u);
  EXPECT_EQ(drawing.curves.size(), 112u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 1);
}

TEST(Hatching, CrossedHasItsCrossingsOnly) {
  const double pen = 3;
  std::vector<Line> truth;
  for (int k = 0; k < 5; ++k) {
    truth.push_back({{20, 40.0 + 18 * k}, {140, 36.0 + 18 * k}});
    truth.push_back({{40.0 + 18 * k, 20}, {44.0 + 18 * k, 140}});
  }
  const Drawing drawing = traced(painted(truth, pen, 160, 160));
  EXPECT_EQ(drawing.junctions.size(), 25u);
  EXPECT_EQ(drawing.curves.size(), 60u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 1);
}

// Its cells are small enough to be specks of paper in a fill.
TEST(Hatching, CrossedCloselyIsNoFill) {
  for (const double apart : {9.0, 12.0}) {
    SCOPED_TRACE(apart);
    std::vector<Line> truth;
    for (int k = 0; k < 10; ++k) {
      truth.push_back({{20, 40 + apart * k}, {60 + apart * 10, 32 + apart * k}});
      truth.push_back({{36 + apart * k, 20}, {44 + apart * k, 60 + apart * 10}});
    }
    const int size = static_cast<int>(80 + apart * 10);
    const Drawing drawing = traced(painted(truth, 3, size, size));
    EXPECT_TRUE(drawing.fills.empty());
    EXPECT_NEAR(static_cast<double>(drawing.junctions.size()), 100, 3);
    double found = 0, drawn = 0;
    for (const Line& line : truth) drawn += length_of(line);
    for (const Line& line : lines_of(drawing)) {
      found += length_of(line);
      for (const Vec2 p : line) EXPECT_LT(distance(p, truth), 1.5) << "beside the ink";
    }
    EXPECT_NEAR(found, drawn, 0.02 * drawn);
  }
}

// ---------------------------------------------------------------- tiny details

TEST(TinyDetails, DotsStayDotsBesideLines) {
  for (const double pen : {2.0, 4.0, 7.0}) {
    SCOPED_TRACE(pen);
    std::vector<Line> lines{{{20, 20}, {20 + 60 * pen, 24}}, {{20, 20 + 12 * pen}, {20 + 60 * pen, 18 + 12 * pen}}};
    Image image = painted(lines, pen, static_cast<int>(40 + 60 * pen), static_cast<int>(40 + 14 * pen));
    std::vector<Vec2> dots;
    for (int k = 0; k < 6; ++k) {
      dots.push_back({20 + (5 + 9 * k) * pen, 20 + 6 * pen + k * 0.3});
      paint(image, {dots.back(), dots.back()}, (1 + 0.15 * k) * pen);
    }
    const Drawing drawing = traced(image);
    EXPECT_EQ(drawing.curves.size(), 8u);
    for (const Vec2 dot : dots) EXPECT_LT(distance(dot, lines_of(drawing)), 0.5 * pen);
    for (const Line& line : lines_of(drawing)) EXPECT_TRUE(length_of(line) < pen || length_of(line) > 40 * pen);
  }
}

// ---------------------------------------------------------------- pens

TEST(Pens, ThickAndThinOnesComeOutRightTogether) {
  std::vector<Line> truth;
  std::vector<double> pens{1.5, 3, 6, 12, 24, 40};
  Image image = blank(560, 360);
  double y = 20;
  for (const double pen : pens) {
    y += pen / 2;
    truth.push_back({{40, y}, {520, y + 12}});
    paint(image, truth.back(), pen);
    y += pen / 2 + 26;
  }
  const Drawing drawing = traced(image);
  EXPECT_EQ(drawing.curves.size(), pens.size());
  EXPECT_EQ(drawing.fills.size(), 0u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 3);
  for (std::size_t k = 0; k < pens.size(); ++k) {
    double width = 0;
    for (const Curve& curve : drawing.curves)
      if (farthest({points_of(curve)}, {truth[k]}) < 6) width = curve.width;
    EXPECT_NEAR(width, pens[k], 0.15 * pens[k] + 0.3);
  }
}

TEST(Pens, AThinStrokeCrossesAThickOne) {
  const std::vector<Line> thin{{{20, 100}, {300, 110}}}, thick{{{160, 20}, {150, 190}}};
  Image image = painted(thin, 3, 320, 210);
  paint(image, thick[0], 15);
  const Drawing drawing = traced(image);
  EXPECT_EQ(drawing.junctions.size(), 1u);
  EXPECT_EQ(drawing.curves.size(), 4u);
  EXPECT_LT(distance_between(lines_of(drawing), {thin[0], thick[0]}), 2);
}

TEST(Pens, ABroadOneBesideAFineOneIsOneLine) {
  for (const auto& [fine, broad] : {std::pair{2.0, 4.0}, std::pair{2.0, 5.0}, std::pair{2.0, 8.0}, std::pair{8.0, 14.0}})
    for (const double angle : {0.03, 0.43, 0.78}) {
      SCOPED_TRACE(std::to_string(fine) + " and " + std::to_string(broad) + " px, " + std::to_string(angle));
      const std::vector<Line> fines{{{20, 20}, {200, 22}}, {{20, 40}, {200, 45}}, {{20, 60}, {200, 65}}};
      const std::vector<Line> broads{{{30, 90}, Vec2{30, 90} + polar(120, angle)}, circle({240, 140}, 25)};
      Image image = painted(fines, fine, 290, 200);
      for (const Line& line : broads) paint(image, line, broad);
      const Drawing drawing = traced(image);
      EXPECT_EQ(drawing.curves.size(), 5u);
      EXPECT_TRUE(drawing.junctions.empty());
      EXPECT_LT(distance_between(lines_of(drawing), {fines[0], fines[1], fines[2], broads[0], broads[1]}), 0.15 * broad + 0.5);
    }
}

TEST(Details, AnEyeInASketchIsALoop) {
  const Line eye = circle({60.3, 60.2}, 7);
  Image image = blank(240, 200);
  paint(image, eye, 5);
  paint(image, {{20, 150}, {220, 140}}, 5, 60);
  paint(image, {{24, 153}, {216, 144}}, 5, 120);
  const Drawing drawing = traced(image, Preset::rough);
  ASSERT_EQ(drawing.curves.size(), 2u);
  EXPECT_TRUE(drawing.curves[0].closed);
  EXPECT_LT(distance_between({points_of(drawing.curves[0])}, {eye}), 0.8);
}

// ---------------------------------------------------------------- gaps

// A stroke with paper in its middle, px.
Image broken_stroke(double pen, double gap) {
  Image image = blank(260, 80);
  paint(image, {{20, 30}, {240, 50}}, pen);
  for (std::size_t y = 0; y < 80; ++y)
    for (std::size_t x = 0; x < 260; ++x)
      if (std::abs(static_cast<double>(x) + 0.5 - 130) < gap / 2) image.grey[y * 260 + x] = 255;
  return image;
}

TEST(GapsInAStroke, AreBridged) {
  for (const double pen : {3.0, 5.0})
    for (double gap = 1; gap <= pen; ++gap)
      EXPECT_EQ(traced(broken_stroke(pen, gap)).curves.size(), 1u) << pen << " px, gap " << gap;
}

TEST(GapsInAStroke, AreBridgedAsFarAsIsAsked) {
  const auto pieces = [](double pen, double gap, double allowed) {
    Options options;
    options.gap = allowed;
    return vectorize(broken_stroke(pen, gap * pen), options).drawing.curves.size();
  };
  for (const double pen : {4.0, 6.0, 12.0}) {
    SCOPED_TRACE(std::to_string(pen) + " px");
    EXPECT_EQ(pieces(pen, 1, 0), 2u);
    EXPECT_EQ(pieces(pen, 2.5, 1), 2u);
    EXPECT_EQ(pieces(pen, 2.5, 3), 1u);
    EXPECT_EQ(pieces(pen, 6, 3), 2u);
    EXPECT_EQ(pieces(pen, 6, 7), 1u);
  }
}

// ---------------------------------------------------------------- border

TEST(Border, StrokesReachIt) {
  for (const double pen : {2.0, 5.0, 9.0}) {
    SCOPED_TRACE(pen);
    const Line across{{-20, 60}, {220, 100}}, corner{{-20, -20}, {90, 40}};
    const Drawing drawing = traced(painted({across, corner}, pen, 200, 160));
    EXPECT_EQ(drawing.curves.size(), 2u);
    const auto found = lines_of(drawing);
    for (const Vec2 exit : {Vec2{0, 60 + 20.0 / 6}, Vec2{200, 60 + 220.0 / 6}, Vec2{50.0 / 3, 0}}) {
      EXPECT_LT(distance(exit, found), 0.5 * pen + 0.5) << exit.x << ',' << exit.y;
    }
    EXPECT_LT(farthest(found, {across, corner}), 0.25 * pen + 0.3);
  }
}

TEST(Border, AStrokeAlongItIsFollowed) {
  for (const double y : {1.0, 2.0, 3.0}) {
    SCOPED_TRACE(y);
    const Line along{{30, y}, {170, y}};
    const Drawing drawing = traced(painted({along}, 4, 200, 60));
    ASSERT_EQ(drawing.curves.size(), 1u);
    EXPECT_LT(distance_between(lines_of(drawing), {along}), 2.2);
  }
}

TEST(Border, AFrameIsOneClosedCurve) {
  const Line frame{{2, 2}, {158, 2}, {158, 118}, {2, 118}, {2, 2}}, inside{{30, 30}, {120, 90}};
  for (const bool alone : {true, false}) {
    Image image = painted({frame}, 4, 160, 120);
    if (!alone) paint(image, inside, 4);
    const Drawing drawing = traced(image);
    ASSERT_EQ(drawing.curves.size(), alone ? 1u : 2u);
    EXPECT_TRUE(std::any_of(drawing.curves.begin(), drawing.curves.end(), [](const Curve& c) { return c.closed; }));
    EXPECT_LT(distance_between(lines_of(drawing), alone ? std::vector<Line>{frame} : std::vector<Line>{frame, inside}), 1);
  }
}

}  // namespace
}  // namespace inkgrid
