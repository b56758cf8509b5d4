// Shadows with an edge, stains and toned areas: paper where strokes run through them, ink where none do.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/at.h"
#include "ink/threshold.h"
#include "inkgrid/inkgrid.h"
#include "lit_pages.h"
#include "same_ink.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::drawn_page;
using testing::expect_same_ink;
using testing::in_light;
using testing::ink_in;
using testing::kPageHeight;
using testing::kPageWidth;
using testing::Light;
using testing::paint;

Image drawing(double grey = 50) {
  Image image = drawn_page(grey);
  paint(image, {{330, 220}, {380, 290}}, 4, grey);
  return image;
}

// 1 left of the edge, `inside` right of it.
double past(double distance, double inside, double blur) {
  return 1 - (1 - inside) / (1 + std::exp(-distance / blur));
}

double half_the_page(double x, double y) {
  return past(0.8 * (x - 200) + 0.6 * (y - 160), 0.55, 0.3);
}

double half_of_it_a_little(double x, double y) {
  return past(0.8 * (x - 200) + 0.6 * (y - 160), 0.75, 0.3);
}

double a_hand(double x, double y) {
  return past(140 - std::hypot(x - 330, y - 300), 0.5, 2);
}

double a_dark_one(double x, double) {
  return past(x - 180, 0.35, 1);
}

double a_stain(double x, double y) {
  return past(50 + 12 * std::cos(5 * std::atan2(y - 110, x - 250)) - std::hypot(x - 250, y - 110), 0.75, 1);
}

// Two, through one of which no stroke runs.
double finger_tips(double x, double y) {
  return past(34 - std::hypot(x - 350, y - 140), 0.6, 1) * past(60 - std::hypot(x - 100, y - 240), 0.6, 1);
}

class Shades : public ::testing::TestWithParam<Light> {};

TEST_P(Shades, AreNoInkAndLeaveTheInkAsItIs) {
  const Binarisation plain = binarise(drawing(), std::nullopt);
  expect_same_ink(binarise(in_light(drawing(), GetParam()), std::nullopt), plain);
}

TEST_P(Shades, OnGrainyPaperToo) {
  const Binarisation plain = binarise(drawing(), std::nullopt);
  expect_same_ink(binarise(in_light(drawing(), GetParam(), 2), std::nullopt), plain, 140);
}

INSTANTIATE_TEST_SUITE_P(Shade, Shades, ::testing::Values(half_the_page, a_hand, a_dark_one, a_stain, finger_tips));

TEST(Shade, OverAPencilDrawing) {
  const Binarisation plain = binarise(drawing(150), std::nullopt);
  expect_same_ink(binarise(in_light(drawing(150), half_of_it_a_little), std::nullopt), plain);
}

// A blot in the shadow.
TEST(Shade, APatchOfInkInItStaysInk) {
  Image image = drawing();
  paint(image, {{300, 250}, {301, 250}}, 60, 50);
  const Binarisation plain = binarise(image, std::nullopt);
  ASSERT_GT(ink_in(plain, 270, 220, 330, 280), 2800);
  expect_same_ink(binarise(in_light(image, half_the_page), std::nullopt), plain);
}

TEST(Shade, AGreyPatchThatNoStrokeRunsThroughIsInk) {
  Image image = drawing();
  const Binarisation plain = binarise(image, std::nullopt);
  paint(image, {{290, 50}, {291, 50}}, 70, 140);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_NEAR(static_cast<double>(ink_in(b, 0, 0, kPageWidth, kPageHeight) - ink_in(plain, 0, 0, kPageWidth, kPageHeight)),
              std::numbers::pi * 35 * 35 + 70, 40);
}

// Strokes through the tone of a marker are strokes, and the tone is none.
TEST(Shade, ToneUnderStrokesIsNoInk) {
  const Light toned = [](double x, double y) { return x > 100 && x < 300 && y > 80 && y < 280 ? 0.6 : 1.0; };
  const Binarisation plain = binarise(drawing(), std::nullopt);
  expect_same_ink(binarise(in_light(drawing(), toned), std::nullopt), plain);
}

// A broad pen over ruled paper, on which the lines can be seen through the ink.
TEST(Shade, FaintLinesThroughABroadStrokeDoNotMakeItPaper) {
  Image image = blank(kPageWidth, kPageHeight, 240);
  paint(image, {{80, 60}, {340, 260}}, 40, 60);
  const Light ruled = [](double, double y) { return std::fmod(y, 24.0) < 1 ? 0.85 : 1.0; };
  const long inside = ink_in(binarise(in_light(image, ruled), std::nullopt), 150, 120, 260, 205),
             whole = ink_in(binarise(image, std::nullopt), 150, 120, 260, 205);
  EXPECT_GE(inside, whole);
}

TEST(Shade, TurningThePictureTurnsWhatIsFound) {
  const Image image = in_light(drawing(), a_hand);
  Image turned = blank(kPageHeight, kPageWidth);
  for (int y = 0; y < kPageHeight; ++y)
    for (int x = 0; x < kPageWidth; ++x)
      turned.grey[at(x) * kPageHeight + at(kPageHeight - 1 - y)] = image.grey[at(y) * kPageWidth + at(x)];
  const Binarisation a = binarise(image, std::nullopt), b = binarise(turned, std::nullopt);
  long n = 0;
  for (int y = 0; y < kPageHeight; ++y)
    for (int x = 0; x < kPageWidth; ++x) n += a.ink(x, y) != b.ink(kPageHeight - 1 - y, x);
  EXPECT_LE(n, 8);
}

}  // namespace
}  // namespace inkgrid
