// Filled areas: found where a person would say so, outlined where they end, and nowhere else.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "fit/fit_outlines.h"
#include "known_curves.h"

namespace inkgrid {
namespace {

using namespace testing;
using std::numbers::pi;

void paint_disc(Image& image, Vec2 centre, double radius, double grey = 0) {
  paint(image, {centre, centre}, 2 * radius, grey);
}

Line star(Vec2 centre, double outer, double inner, int points) {
  Line line;
  for (int k = 0; k < 2 * points; ++k) {
    const double angle = pi * k / points - pi / 2, radius = k % 2 ? inner : outer;
    line.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return line;
}

Fills fills_of(const Image& image) {
  return find_fills(binarise(image, std::nullopt));
}

long area_of(const Fills& fills, int fill) {
  return std::count(fills.region.data.begin(), fills.region.data.end(), fill);
}

// Of the points from the polygon's sides, px.
double farthest_from(const Line& points, const Line& polygon) {
  double most = 0;
  for (const Vec2 p : points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i)
      least = std::min(least, distance_to_segment(p, polygon[i], polygon[(i + 1) % polygon.size()]));
    most = std::max(most, least);
  }
  return most;
}

// A filled circle on a stem, over a line.
Image stemmed(double radius, double pen) {
  Image image = blank(200, 200);
  paint_disc(image, {100, 80}, radius);
  paint(image, {{100, 80}, {112, 170}}, pen);
  paint(image, {{20, 180}, {180, 176}}, pen);
  return image;
}

TEST(Fills, ACircleOnAStemIsFilledAndTheStemIsNot) {
  for (const double pen : {2.0, 4.0, 7.0}) {
    SCOPED_TRACE(pen);
    const double radius = 10 + 3 * pen;
    const Image image = stemmed(radius, pen);
    const Fills fills = fills_of(image);
    ASSERT_EQ(fills.count, 1);
    EXPECT_NEAR(static_cast<double>(area_of(fills, 0)), pi * radius * radius, 0.02 * pi * radius * radius);
    EXPECT_NEAR(fills.stroke_width, pen, 0.1 * pen);
    ASSERT_EQ(fills.outlines[0].size(), 1u);
    // But for a fillet where the stem begins.
    for (const Vec2 p : fills.outlines[0][0]) {
      const bool at_stem = std::abs(p.x - 103) < pen + 3 && p.y > 80;
      EXPECT_NEAR(norm(p - Vec2{100, 80}), radius, at_stem ? 0.3 * pen + 1 : 0.15);
    }
  }
}

TEST(Fills, HaveTwoAndAHalfTimesTheWidthOfTheirStrokeAndMoreWhereTheInkIsUneven) {
  const double pen = 8;
  const auto count_of = [&](double times, bool uneven) {
    Image image = stemmed(times * pen / 2, pen);
    if (uneven) {
      image = blank(200, 200);
      paint_disc(image, {100, 80}, times * pen / 2, 90);
      paint(image, {{100, 80}, {112, 170}}, pen);
      paint(image, {{20, 180}, {180, 176}}, pen);
    }
    return fills_of(image).count;
  };
  EXPECT_EQ(count_of(2.6, false), 0);
  EXPECT_EQ(count_of(4, false), 1);
  EXPECT_EQ(count_of(3.6, true), 0);
  EXPECT_EQ(count_of(5, true), 1);
}

TEST(Fills, WhatIsLeftIsTheDrawingWithoutThem) {
  const Image image = stemmed(25, 4);
  const Binarisation ink = binarise(image, std::nullopt);
  const Fills fills = find_fills(ink);
  const Binarisation left = without_fills(ink, fills);
  for (std::size_t i = 0; i < left.ink.data.size(); ++i) {
    EXPECT_EQ(left.ink.data[i], ink.ink.data[i] && fills.region.data[i] < 0);
    if (left.ink.data[i]) {
      EXPECT_EQ(left.darkness.data[i], ink.darkness.data[i]);
    } else if (fills.region.data[i] >= 0) {
      EXPECT_EQ(left.darkness.data[i], 0);
    }
  }
  // Nothing is left of the circle's rim, which is grey.
  for (double angle = -pi; angle < 0; angle += 0.01) {
    const Vec2 p = Vec2{100, 80} + 25.5 * Vec2{std::cos(angle), std::sin(angle)};
    EXPECT_EQ(left.darkness(static_cast<int>(p.x), static_cast<int>(p.y)), 0);
  }
}

TEST(Fills, AStarIsFilledToItsTips) {
  const Line truth = star({100.3, 104.6}, 80, 32, 5);
  Image image = blank(200, 200);
  fill(image, truth);
  for (const bool with_line : {false, true}) {
    if (with_line) paint(image, {{10, 10}, {190, 14}}, 3);
    const Fills fills = fills_of(image);
    ASSERT_EQ(fills.count, 1);
    const std::vector<Fill> fitted = fit_outlines(fills, Options{}.tolerance);
    ASSERT_EQ(fitted.size(), 1u);
    ASSERT_EQ(fitted[0].outlines.size(), 1u);
    const Curve& outline = fitted[0].outlines[0];
    EXPECT_TRUE(outline.closed);
    EXPECT_TRUE(outline.segments.front().p0 == outline.segments.back().p3);
    EXPECT_LT(farthest_from(points_of(outline), truth), 0.3);
    for (const Vec2 tip : truth) {
      double least = 1e9;
      for (const Cubic& c : outline.segments) least = std::min(least, norm(c.p0 - tip));
      EXPECT_LT(least, 0.3);
    }
    EXPECT_LE(outline.segments.size(), 11u);
  }
}

TEST(Fills, APupilIsFilledAndItsHighlightIsAHole) {
  Image image = blank(240, 200);
  paint(image, arc({120, 180}, 130, -2.3, -0.84), 4);
  paint(image, arc({120, 20}, 130, 0.84, 2.3), 4);
  paint(image, circle({120, 100}, 40), 4);
  paint_disc(image, {120, 100}, 20);
  ASSERT_EQ(fills_of(image).count, 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (norm(Vec2{x + 0.5, y + 0.5} - Vec2{110, 105}) < 1.5) image.grey[static_cast<std::size_t>(y * image.width + x)] = 255;
  ASSERT_EQ(fills_of(image).count, 1);
  EXPECT_EQ(fills_of(image).outlines[0].size(), 1u) << "half a stroke squared is filled";
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (norm(Vec2{x + 0.5, y + 0.5} - Vec2{125, 95}) < 6) image.grey[static_cast<std::size_t>(y * image.width + x)] = 255;
  const Fills fills = fills_of(image);
  ASSERT_EQ(fills.count, 1);
  ASSERT_EQ(fills.outlines[0].size(), 2u);
  EXPECT_LT(farthest_from(fills.outlines[0][0], circle({120, 100}, 20)), 0.3);
  EXPECT_LT(farthest_from(fills.outlines[0][1], circle({125, 95}, 6)), 0.6);
}

TEST(Fills, BlobsMuchWiderThanTheStrokesAreFilledAndDotsAreNot) {
  const double pen = 4;
  Image image = blank(480, 320);
  for (int k = 0; k < 4; ++k) paint(image, {{20, 220.0 + 25 * k}, {460, 215.0 + 27 * k}}, pen);
  const double radii[] = {1.5, 2, 3, 5, 5.6, 6.6, 10, 14, 20, 28};
  for (int k = 0; k < 10; ++k) paint_disc(image, {50.0 + 90 * (k % 5), 50.0 + 90 * (k / 5)}, radii[k]);
  const Fills fills = fills_of(image);
  EXPECT_EQ(fills.count, 5);
  for (int k = 0; k < 10; ++k)
    EXPECT_EQ(fills.region(50 + 90 * (k % 5), 50 + 90 * (k / 5)) >= 0, 2 * radii[k] > 3 * pen) << radii[k];
}

TEST(Fills, HairIsFilledAndTheStrokesThatComeOutOfItAreNot) {
  Image image = blank(300, 300);
  Line mass = arc({150, 190}, 110, -3.0, -0.14);
  const Line inner = arc({150, 225}, 90, -0.3, -2.84);
  mass.insert(mass.end(), inner.begin(), inner.end());
  fill(image, mass);
  std::vector<Line> hairs;
  for (int k = 0; k < 9; ++k) {
    const double angle = -2.5 + 0.23 * k;
    const Vec2 out{std::cos(angle), std::sin(angle)};
    hairs.push_back({Vec2{150, 190} + 100 * out, Vec2{150, 190} + 145 * out});
    paint(image, hairs.back(), 3);
  }
  paint(image, circle({150, 215}, 60), 3);
  const Fills fills = fills_of(image);
  ASSERT_EQ(fills.count, 1);
  EXPECT_GE(fills.region(150, 100), 0);
  for (const Line& hair : hairs) {
    const Vec2 root = lerp(hair[0], hair[1], 0.4), tip = lerp(hair[0], hair[1], 0.9);
    for (const Vec2 p : {root, tip}) EXPECT_EQ(fills.region(static_cast<int>(p.x), static_cast<int>(p.y)), -1);
  }
}

TEST(Fills, WidePensAreStrokes) {
  Image image = blank(700, 560);
  double y = 30;
  for (const double pen : {1.5, 3.0, 6.0, 12.0, 20.0, 30.0, 40.0}) {
    paint(image, {{40, y}, {660, y + 8}}, pen);
    y += 0.5 * pen + 42;
  }
  paint(image, {{90, 20}, {120, 420}}, 40);
  paint(image, {{560, 30}, {380, 400}}, 20);
  paint(image, circle({350, 480}, 50), 16);
  EXPECT_EQ(fills_of(image).count, 0);
}

TEST(Fills, ARingOfAWidePenIsAStroke) {
  for (const double pen : {12.0, 20.0, 30.0}) {
    Image image = blank(300, 300);
    paint(image, circle({150, 160}, 90), pen);
    paint(image, {{20, 15}, {280, 20}}, 3);
    EXPECT_EQ(fills_of(image).count, 0) << pen;
  }
}

TEST(Fills, StrokesThatMeetAreNone) {
  for (const double pen : {3.0, 6.0, 10.0})
    for (int n = 2; n <= 12; ++n) {
      SCOPED_TRACE(std::to_string(pen) + " px, " + std::to_string(n));
      Image image = blank(240, 240);
      for (int k = 0; k < n; ++k) {
        const double angle = 0.1 + 2 * pi * k / n;
        paint(image, {{120, 120}, Vec2{120, 120} + 100 * Vec2{std::cos(angle), std::sin(angle)}}, pen);
      }
      EXPECT_EQ(fills_of(image).count, 0);
    }
}

TEST(Fills, AcuteCornersAreNone) {
  for (const double pen : {3.0, 6.0, 10.0})
    for (const double degrees : {3.0, 6.0, 10.0, 15.0, 20.0, 30.0, 45.0, 70.0}) {
      SCOPED_TRACE(std::to_string(pen) + " px, " + std::to_string(degrees));
      Image image = blank(300, 240);
      const Vec2 arm = 240 * Vec2{std::cos(degrees * pi / 180), std::sin(degrees * pi / 180)};
      paint(image, {{260, 25}, {20, 25}, Vec2{20, 25} + arm}, pen);
      EXPECT_EQ(fills_of(image).count, 0);
    }
}

// Strokes of unequal opacity drawn over each other, with hand-like wobble.
TEST(Fills, OverdrawnLinesAreNone) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> around(-1, 1);
  Image image = blank(400, 300);
  for (int k = 0; k < 60; ++k) {
    const double base = 50 + 70 * (k % 4), shift = 3 * around(random), bend = 3 * around(random), phase = 3 * around(random);
    Line line;
    for (double x = 30 + 30 * std::abs(around(random)); x < 370 - 30 * std::abs(around(random)); x += 3)
      line.push_back({x, base + shift + bend * std::sin(x / 60 + phase) + 12 * std::sin(x / 50)});
    paint(image, line, 4, 60 + 50 * around(random));
  }
  EXPECT_EQ(fills_of(image).count, 0);
}

TEST(Fills, HatchingIsNone) {
  Image image = blank(300, 200);
  for (int k = 0; k < 30; ++k) paint(image, {{20.0 + 8 * k, 40}, {50.0 + 8 * k, 160}}, 4);
  EXPECT_EQ(fills_of(image).count, 0);
}

// Its cells are as large as specks of paper in a fill may be.
TEST(Fills, CrossedHatchingIsNone) {
  for (const double apart : {10, 12, 13}) {
    Image image = blank(300, 300);
    for (double x = 40; x <= 260; x += apart) {
      paint(image, {{x, 30}, {x + 8, 270}}, 3.5);
      paint(image, {{30, x}, {270, x - 8}}, 3.5);
    }
    EXPECT_EQ(fills_of(image).count, 0) << apart;
  }
}

TEST(Fills, InkAtTheBorderIsOutlinedAlongIt) {
  Image image = blank(200, 160);
  fill(image, {{-10, -10}, {60, -10}, {60, 50}, {-10, 50}});
  paint(image, {{20, 120}, {180, 100}}, 3);
  const Fills fills = fills_of(image);
  ASSERT_EQ(fills.count, 1);
  const std::vector<Fill> fitted = fit_outlines(fills, Options{}.tolerance);
  EXPECT_LT(farthest_from(points_of(fitted[0].outlines[0]), {{0, 0}, {60, 0}, {60, 50}, {0, 50}}), 0.7);
}

// As in a scan of a marker's work.
TEST(Fills, PaperThatShowsThroughDoesNotMakeStrokesOfAFill) {
  Image image = blank(300, 260);
  fill(image, {{40, 40}, {260, 40}, {260, 200}, {40, 200}});
  paint(image, {{20, 240}, {280, 230}}, 4);
  std::mt19937 random(5);
  for (int k = 0; k < 60; ++k) {
    const std::size_t x = 50 + random() % 200, y = 50 + random() % 140;
    for (std::size_t i = 0; i < 6; ++i) image.grey[(y + i / 3) * 300 + x + i % 3] = 255;
  }
  const Fills fills = fills_of(image);
  ASSERT_EQ(fills.count, 1);
  EXPECT_NEAR(static_cast<double>(area_of(fills, 0)), 220 * 160, 250);
  EXPECT_EQ(fills.outlines[0].size(), 1u) << "specks are no holes";
}

TEST(Fills, TheEyeOfALoopIsNoSpeck) {
  Image image = blank(200, 120);
  for (int k = 0; k < 8; ++k) {
    paint(image, circle({20.0 + 22 * k, 30}, 3.2 + 0.3 * k), 3);
    paint(image, {{23.2 + 22.3 * k, 30}, {20.0 + 22 * k, 100}}, 3);
  }
  EXPECT_EQ(fills_of(image).count, 0);
}

TEST(Fills, UniformImagesAreSound) {
  for (const int grey : {0, 128, 255})
    for (const FillMode mode : {FillMode::layer, FillMode::drop, FillMode::trace}) {
      Options options;
      options.fills = mode;
      options.threshold = 200;
      const Result result = vectorize(blank(60, 40, static_cast<std::uint8_t>(grey)), options);
      EXPECT_EQ(result.report.fills, grey < 200 && mode != FillMode::trace) << grey;
      EXPECT_EQ(result.drawing.fills.size(), grey < 200 && mode == FillMode::layer) << grey;
    }
}

TEST(Fills, TwoTonesAreOutlinedWithoutSteps) {
  Image image = stemmed(25, 4);
  for (auto& g : image.grey) g = g < 128 ? 0 : 255;
  const std::vector<Fill> fitted = fit_outlines(fills_of(image), Options{}.tolerance);
  ASSERT_EQ(fitted.size(), 1u);
  EXPECT_LE(fitted[0].outlines[0].segments.size(), 16u);
  for (const Vec2 p : points_of(fitted[0].outlines[0])) {
    const bool at_stem = p.y > 90 && std::abs(p.x - 103) < 7;
    EXPECT_NEAR(norm(p - Vec2{100, 80}), 25, at_stem ? 2 : 0.5);
  }
}

// ---- the whole program

std::vector<Line> lines_of(const Drawing& drawing) {
  std::vector<Line> lines;
  for (const Curve& curve : drawing.curves) lines.push_back(points_of(curve));
  return lines;
}

// Lines that bend, meet and end; room for a blot on the right.
Image some_lines() {
  Image image = blank(360, 200);
  paint(image, {{20, 40}, {180, 60}}, 4);
  paint(image, {{110, 20}, {90, 120}}, 4);
  paint(image, arc({110, 140}, 40, 0.2, 2.6), 4);
  paint(image, {{25, 80}, {40, 180}}, 4);
  return image;
}

TEST(FillsOfADrawing, ABlobLeavesWidthAndOtherCurvesAsTheyAre) {
  const Result without = vectorize(some_lines());
  Image image = some_lines();
  paint_disc(image, {270, 100}, 70);
  const Result with = vectorize(image);
  EXPECT_EQ(with.report.fills, 1);
  EXPECT_NEAR(with.report.stroke_width, without.report.stroke_width, 0.03 * without.report.stroke_width);
  EXPECT_EQ(with.drawing.junctions.size(), without.drawing.junctions.size());
  ASSERT_EQ(with.drawing.curves.size(), without.drawing.curves.size());
  const auto found = lines_of(with.drawing), expected = lines_of(without.drawing);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_LT(farthest_from(found[k], expected[k]), 0.3);
}

TEST(FillsOfADrawing, StrokesEndAtTheOutline) {
  const Result result = vectorize(stemmed(25, 4));
  ASSERT_EQ(result.drawing.fills.size(), 1u);
  ASSERT_EQ(result.drawing.curves.size(), 2u);
  const Curve& stem = result.drawing.curves[0].segments[0].p0.y < 175 && result.drawing.curves[0].segments.back().p3.y < 175
                          ? result.drawing.curves[0]
                          : result.drawing.curves[1];
  Vec2 top = stem.segments.front().p0, foot = stem.segments.back().p3;
  if (top.y > foot.y) std::swap(top, foot);
  EXPECT_NEAR(norm(top - Vec2{100, 80}), 25, 1.5);
  EXPECT_LT(norm(foot - Vec2{112, 170}), 1);
}

TEST(FillsOfADrawing, LightOnDarkIsTheSame) {
  const Image image = stemmed(25, 4);
  Image turned = image;
  for (auto& g : turned.grey) g = static_cast<std::uint8_t>(255 - g);
  const Drawing dark = vectorize(image).drawing, light = vectorize(turned).drawing;
  ASSERT_EQ(light.fills.size(), 1u);
  EXPECT_LT(farthest_from(points_of(light.fills[0].outlines[0]), points_of(dark.fills[0].outlines[0])), 0.05);
  EXPECT_EQ(light.curves.size(), dark.curves.size());
}

TEST(FillsOfADrawing, AreDroppedOrTracedWhereAskedFor) {
  const Image image = stemmed(25, 4);
  Options options;
  const Drawing layer = vectorize(image, options).drawing;
  options.fills = FillMode::drop;
  const Drawing dropped = vectorize(image, options).drawing;
  EXPECT_TRUE(dropped.fills.empty());
  EXPECT_TRUE(lines_of(dropped) == lines_of(layer));
  options.fills = FillMode::trace;
  const Result traced = vectorize(image, options);
  EXPECT_TRUE(traced.drawing.fills.empty());
  EXPECT_EQ(traced.report.fills, 0);
  double highest = 200;
  for (const Line& line : lines_of(traced.drawing))
    for (const Vec2 p : line) highest = std::min(highest, p.y);
  EXPECT_LT(highest, 90) << "curves in the circle";
}

}  // namespace
}  // namespace inkgrid
