// Where ink is a stroke of a pen, and where it is not.
#include <gtest/gtest.h>

#include <numbers>

#include "drawings.h"
#include "ink/pen_strokes.h"
#include "ink/threshold.h"

namespace inkgrid {
namespace {

using namespace testing;
using std::numbers::pi;

PenStrokes strokes_of(const Image& image) {
  const Binarisation binarisation = binarise(image, 128.0);
  return find_pen_strokes(binarisation.ink, binarisation.darkness);
}

// The part of the deep centres that belong to strokes.
double stroke_share(const PenStrokes& strokes, double least_depth) {
  double all = 0, of_strokes = 0;
  for (const CentrePixel& c : strokes.centres) {
    if (static_cast<double>(c.depth) < least_depth) continue;
    ++all;
    of_strokes += c.of_stroke;
  }
  return of_strokes / all;
}

class EachPen : public ::testing::TestWithParam<double> {};

TEST_P(EachPen, ALongLineIsAStrokeAtAnyAngle) {
  const double pen = GetParam(), length = 7 * pen + 20;
  const int size = static_cast<int>(length + pen + 20);
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(15 * k + 3);
    Image image = blank(size, size);
    const Vec2 along = 0.5 * length * Vec2{std::cos((15 * k + 3) * pi / 180), std::sin((15 * k + 3) * pi / 180)};
    const Vec2 middle{0.5 * size + 0.2, 0.5 * size - 0.3};
    paint(image, {middle - along, middle + along}, pen);
    const PenStrokes strokes = strokes_of(image);
    EXPECT_NEAR(strokes.width, pen, 0.1 * pen + 0.25);
    EXPECT_GT(stroke_share(strokes, 0.8 * pen / 2), 0.9);
  }
}

TEST_P(EachPen, ARingIsAStroke) {
  const double pen = GetParam(), radius = 1.5 * pen + 10;
  const int size = static_cast<int>(2 * radius + pen + 10);
  Image image = blank(size, size);
  paint(image, circle({0.5 * size, 0.5 * size + 0.4}, radius), pen);
  const PenStrokes strokes = strokes_of(image);
  EXPECT_NEAR(strokes.width, pen, 0.1 * pen + 0.25);
  EXPECT_GT(stroke_share(strokes, 0.8 * pen / 2), 0.95);
}

INSTANTIATE_TEST_SUITE_P(Pens, EachPen, ::testing::Values(1.5, 2, 3, 4.5, 7, 12, 20, 40));

TEST(PenStrokes, CompactShapesHaveNone) {
  for (int shape = 0; shape < 3; ++shape) {
    Image image = blank(200, 200);
    if (shape == 0) paint(image, {{100, 100}, {100.1, 100}}, 130);
    if (shape == 1) fill(image, {{40, 50}, {170, 50}, {170, 150}, {40, 150}});
    if (shape == 2) fill(image, {{100, 20}, {180, 170}, {20, 170}});
    EXPECT_DOUBLE_EQ(strokes_of(image).width, 0) << shape;
  }
}

// As in a sign that something is loading.
TEST(PenStrokes, SeveralShortTicksAreStrokesWhereNothingElseIs) {
  for (const int ticks : {3, 8}) {
    Image image = blank(300, 300);
    for (int k = 0; k < ticks; ++k) {
      const Vec2 out{std::cos(0.2 + 6.2832 * k / ticks), std::sin(0.2 + 6.2832 * k / ticks)};
      paint(image, {Vec2{150, 150} + 60 * out, Vec2{150, 150} + 90 * out}, 24);
    }
    EXPECT_NEAR(strokes_of(image).width, 24, 1.5);
  }
}

TEST(PenStrokes, TwoShortTicksAreNone) {
  Image image = blank(300, 300);
  for (const double x : {80.0, 200.0}) paint(image, {{x, 100}, {x + 20, 122}}, 24);
  EXPECT_DOUBLE_EQ(strokes_of(image).width, 0);
}

TEST(PenStrokes, SeveralCompactShapesAreNone) {
  Image image = blank(300, 300);
  for (const double x : {20.0, 120.0, 220.0}) {
    fill(image, {{x, 40}, {x + 60, 40}, {x + 60, 100}, {x, 100}});
    paint(image, {{x + 30, 200}, {x + 30, 201}}, 50);
  }
  EXPECT_DOUBLE_EQ(strokes_of(image).width, 0);
}

TEST(PenStrokes, TheirWidthIsThatOfMostOfTheLines) {
  Image image = blank(300, 300);
  for (const double y : {40.0, 80.0, 120.0}) paint(image, {{20, y}, {280, y + 3}}, 5);
  paint(image, {{150, 220}, {150.1, 220}}, 120);
  paint(image, {{30, 160}, {270, 160}}, 11);
  EXPECT_NEAR(strokes_of(image).width, 5, 0.3);
}

TEST(PenStrokes, PaperNowhereIsNoStroke) {
  const PenStrokes strokes = find_pen_strokes(Raster<std::uint8_t>(30, 20, 1), Raster<float>(30, 20, 1));
  for (const CentrePixel& c : strokes.centres) EXPECT_FALSE(c.of_stroke);
  EXPECT_TRUE(find_pen_strokes(Raster<std::uint8_t>(30, 20, 0), Raster<float>(30, 20, 0)).centres.empty());
}

}  // namespace
}  // namespace inkgrid
