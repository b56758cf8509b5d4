// Ruled and squared paper: its lines are no ink where the drawing is darker, and lines that were drawn are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ink/ruling.h"
#include "ink/threshold.h"
#include "inkgrid/inkgrid.h"
#include "lit_pages.h"
#include "same_ink.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::circle;
using testing::drawn_page;
using testing::expect_same_ink;
using testing::in_light;
using testing::ink_in;
using testing::kPageHeight;
using testing::kPageWidth;
using testing::Light;
using testing::paint;

// With lines along and across those of the paper.
Image drawing() {
  Image image = drawn_page();
  paint(image, {{280, 200}, {380, 200}}, 4, 50);
  paint(image, {{300, 220}, {300, 300}}, 4, 50);
  return image;
}

// Light on paper whose lines are `distance` px apart where their places along the page are `place`.
double on_line(double place, double distance, double depth) {
  const double from_line = std::abs(std::remainder(place, distance));
  return 1 - depth * std::clamp(1.25 - from_line, 0.0, 1.0);
}

double in_rows(double, double y) {
  return on_line(y, 22, 0.3);
}

double in_columns(double x, double) {
  return on_line(x, 17, 0.2);
}

double in_squares(double x, double y) {
  return on_line(x, 15, 0.25) * on_line(y, 15, 0.25);
}

double in_turned_rows(double x, double y) {
  return on_line(y + 0.035 * x, 22, 0.3);
}

double in_bent_rows(double x, double y) {
  return on_line(y + 5 * std::sin(x / 90), 22, 0.3);
}

// As a camera sees them: closer together at the far end.
double in_rows_seen_aslant(double x, double y) {
  return on_line(y * (1 + 0.12 * x / kPageWidth), 22, 0.3);
}

double in_rows_with_a_margin(double x, double y) {
  return y < 60 ? 1 : in_rows(x, y);
}

class RuledPaper : public ::testing::TestWithParam<Light> {};

TEST_P(RuledPaper, IsNoInk) {
  const Binarisation plain = binarise(drawing(), std::nullopt), b = binarise(in_light(drawing(), GetParam()), std::nullopt);
  EXPECT_TRUE(b.ruled);
  expect_same_ink(b, plain, 160);
}

TEST_P(RuledPaper, IsNoInkWithGrainEither) {
  const Binarisation plain = binarise(drawing(), std::nullopt), b = binarise(in_light(drawing(), GetParam(), 2.5), std::nullopt);
  EXPECT_TRUE(b.ruled);
  expect_same_ink(b, plain, 200);
}

TEST_P(RuledPaper, StaysWhereItIsAskedFor) {
  const Binarisation plain = binarise(drawing(), std::nullopt),
                     b = binarise(in_light(drawing(), GetParam()), std::nullopt, 1, 0.1);
  EXPECT_FALSE(b.ruled);
  EXPECT_GT(ink_in(b, 0, 0, kPageWidth, kPageHeight), ink_in(plain, 0, 0, kPageWidth, kPageHeight) + 2000);
}

INSTANTIATE_TEST_SUITE_P(Ruling, RuledPaper,
                         ::testing::Values(in_rows, in_columns, in_squares, in_turned_rows, in_bent_rows, in_rows_seen_aslant,
                                           in_rows_with_a_margin));

// Strokes of a soft pencil are as dark as the shadow, and must not be taken for one.
TEST(Ruling, InAShadowIsNoInkEither) {
  Image image = blank(kPageWidth, kPageHeight, 240);
  paint(image, circle({150, 150}, 90), 11, 120);
  paint(image, {{20, 300}, {400, 30}}, 11, 120);
  const Light light = [](double x, double y) {
    return in_rows(x, y) * (1 - 0.45 / (1 + std::exp((std::hypot(x - 330, y - 300) - 140) / 2)));
  };
  const Binarisation plain = binarise(image, std::nullopt), b = binarise(in_light(image, light, 4), std::nullopt);
  EXPECT_TRUE(b.ruled);
  expect_same_ink(b, plain, 700);
}

TEST(Ruling, ItsDarknessIsThatOfItsLines) {
  Raster<float> darkness(kPageWidth, kPageHeight);
  for (int y = 0; y < kPageHeight; ++y)
    for (int x = 0; x < kPageWidth; ++x) darkness(x, y) = static_cast<float>(1 - in_rows(x + 0.5, y + 0.5));
  EXPECT_NEAR(ruling_of(darkness, 0.1).usual, 0.3 * 0.75, 0.01);  // half a pixel beside the middle
  EXPECT_EQ(ruling_of(Raster<float>(kPageWidth, kPageHeight, 0.05f), 0.1).usual, 0);
  EXPECT_EQ(ruling_of(Raster<float>(kPageWidth, kPageHeight, 0.5f), 0.1).usual, 0);
}

// Squares drawn with the pen of the drawing, and squares alone.
TEST(Ruling, NetsThatWereDrawnAreInk) {
  Image net = blank(kPageWidth, kPageHeight, 240);
  for (int x = 20; x < kPageWidth; x += 20) paint(net, {{x + 0.5, -5}, {x + 0.5, kPageHeight + 5}}, 3, 60);
  for (int y = 20; y < kPageHeight; y += 20) paint(net, {{-5, y + 0.5}, {kPageWidth + 5, y + 0.5}}, 3, 60);
  const long alone = ink_in(binarise(net, std::nullopt), 0, 0, kPageWidth, kPageHeight);
  EXPECT_GT(alone, 30000);
  paint(net, circle({150, 150}, 90), 4, 60);
  const Binarisation b = binarise(net, std::nullopt);
  EXPECT_FALSE(b.ruled);
  EXPECT_GT(ink_in(b, 0, 0, kPageWidth, kPageHeight), alone);
}

// Pale rungs of a ladder: lines at one distance, but over a part of the page.
TEST(Ruling, PaleHatchingIsInk) {
  Image image = drawing();
  const Binarisation plain = binarise(image, std::nullopt);
  for (int y = 20; y < 300; y += 14) paint(image, {{300, y + 0.5}, {400, y + 0.5}}, 3, 170);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_FALSE(b.ruled);
  EXPECT_GT(ink_in(b, 300, 0, 400, kPageHeight), ink_in(plain, 300, 0, 400, kPageHeight) + 20 * 100 * 2);
}

// Five lines and a space, again and again: staves, and half as dark as what stands on them.
TEST(Ruling, StavesAreInk) {
  Image image = blank(kPageWidth, kPageHeight, 240);
  for (int staff = 0; staff < 4; ++staff)
    for (int line = 0; line < 5; ++line)
      paint(image, {{10, 20.5 + 76 * staff + 8 * line}, {kPageWidth - 10.0, 20.5 + 76 * staff + 8 * line}}, 2, 150);
  const long bare = ink_in(binarise(image, std::nullopt), 0, 0, kPageWidth, kPageHeight);
  for (int note = 0; note < 24; ++note) paint(image, {{30.0 + 16 * note, 30}, {30.0 + 16 * note, 60}}, 3, 20);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_FALSE(b.ruled);
  EXPECT_GT(ink_in(b, 0, 0, kPageWidth, kPageHeight), bare);
}

TEST(Faintest, PalerLinesAreNoInk) {
  Image both = drawing();
  const Binarisation plain = binarise(drawing(), std::nullopt);
  paint(both, {{20, 40}, {400, 310}}, 4, 180);
  EXPECT_GT(ink_in(binarise(both, std::nullopt), 0, 0, kPageWidth, kPageHeight),
            ink_in(plain, 0, 0, kPageWidth, kPageHeight) + 1500);
  expect_same_ink(binarise(both, std::nullopt, 1, 0.4), plain, 100);
}

}  // namespace
}  // namespace inkgrid
