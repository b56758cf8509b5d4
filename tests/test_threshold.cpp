#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drawings.h"
#include "ink/threshold.h"
#include "inkgrid/inkgrid.h"
#include "spoiled_pictures.h"

namespace inkgrid {
namespace {

using testing::arc;
using testing::blank;
using testing::circle;
using testing::distance_to_segment;
using testing::paint;
using testing::pixel;
using testing::spoil;

void add_grain(Image& image, double grain, unsigned seed = 1) {
  spoil(
      image, [](int, int) { return 0.92; }, grain, seed);
}

Image complement(Image image) {
  for (auto& g : image.grey) g = static_cast<std::uint8_t>(255 - g);
  return image;
}

long ink_pixels(const Binarisation& b) {
  return std::count(b.ink.data.begin(), b.ink.data.end(), 1);
}

// Ink further than `reach` from the segment.
long stray_pixels(const Binarisation& b, Vec2 from, Vec2 to, double reach) {
  long n = 0;
  for (int y = 0; y < b.ink.height; ++y)
    for (int x = 0; x < b.ink.width; ++x) n += b.ink(x, y) && distance_to_segment({x + 0.5, y + 0.5}, from, to) > reach;
  return n;
}

// The part of the segment whose pixels are ink.
double covered(const Binarisation& b, Vec2 from, Vec2 to) {
  int on = 0;
  const int samples = 500;
  for (int i = 0; i < samples; ++i) {
    const Vec2 p = lerp(from, to, (i + 0.5) / samples);
    on += b.ink(static_cast<int>(p.x), static_cast<int>(p.y));
  }
  return static_cast<double>(on) / samples;
}

// The part of the segment with ink in its pixel or next to it.
double followed(Binarisation b, Vec2 from, Vec2 to) {
  const Raster<std::uint8_t> ink = b.ink;
  for (int y = 1; y + 1 < ink.height; ++y)
    for (int x = 1; x + 1 < ink.width; ++x)
      b.ink(x, y) = ink(x, y) || ink(x - 1, y) || ink(x + 1, y) || ink(x, y - 1) || ink(x, y + 1);
  return covered(b, from, to);
}

// Area of the ink over the length of the segment, away from its ends.
double mean_width(const Binarisation& b, Vec2 from, Vec2 to) {
  const Vec2 along = unit(to - from);
  long n = 0;
  double length = 0.8 * norm(to - from);
  for (int y = 0; y < b.ink.height; ++y)
    for (int x = 0; x < b.ink.width; ++x) {
      const double t = dot(Vec2{x + 0.5, y + 0.5} - from, along);
      n += b.ink(x, y) && std::abs(t - length / 1.6) < length / 2;
    }
  return static_cast<double>(n) / length;
}

const Vec2 kFrom{30.3, 40.1}, kTo{370.2, 250.7};

TEST(Threshold, NumberMeansExactlyBelow) {
  Image image = blank(16, 16);
  for (int i = 0; i < 256; ++i) image.grey[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i);
  for (const double threshold : {0.0, 1.0, 99.5, 128.0, 255.0, 256.0}) {
    const Binarisation b = binarise(image, threshold);
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(b.ink.data[i], static_cast<double>(i) < threshold) << i << " < " << threshold;
    EXPECT_EQ(b.threshold, threshold);
    EXPECT_FALSE(b.inverted);
    EXPECT_FLOAT_EQ(b.darkness.data[0], 1);
    EXPECT_FLOAT_EQ(b.darkness.data[255], 0);
  }
}

TEST(Threshold, NumberNeverInverts) {
  Image image = blank(60, 60, 10);
  paint(image, {{5, 5}, {50, 40}}, 3, 0);
  EXPECT_EQ(ink_pixels(binarise(image, 128.0)), 3600);
}

TEST(Threshold, EmptyImageIsAnError) {
  EXPECT_THROW(binarise(Image{}, std::nullopt), Error);
  EXPECT_THROW(binarise(Image{}, 128.0), Error);
}

TEST(Threshold, WidthOfCleanLinesIsUnbiased) {
  for (const double width : {2.0, 3.0, 4.5, 8.0, 15.0})
    for (const double grey : {0.0, 90.0, 170.0}) {
      Image image = blank(400, 300);
      paint(image, {kFrom, kTo}, width, grey);
      const Binarisation b = binarise(image, std::nullopt);
      EXPECT_NEAR(mean_width(b, kFrom, kTo), width, 0.12) << width << " px, grey " << grey;
      EXPECT_EQ(stray_pixels(b, kFrom, kTo, width / 2 + 0.75), 0);
      EXPECT_NEAR(b.threshold, (255 + grey) / 2, 30);
    }
}

TEST(Threshold, AgreesWithMidGreyOnCleanInk) {
  Image image = blank(300, 300);
  paint(image, circle({150, 150}, 100.3), 4);
  paint(image, {{20, 30}, {280, 260}}, 6);
  const Binarisation automatic = binarise(image, std::nullopt), half = binarise(image, 127.5);
  long different = 0;
  for (std::size_t i = 0; i < half.ink.data.size(); ++i) different += half.ink.data[i] != automatic.ink.data[i];
  EXPECT_LE(different, ink_pixels(half) / 500);
}

TEST(Threshold, HairlineIsNotBroken) {
  Image image = blank(400, 300);
  paint(image, {kFrom, kTo}, 1);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_EQ(followed(b, kFrom, kTo), 1);
  EXPECT_EQ(stray_pixels(b, kFrom, kTo, 1.5), 0);
}

TEST(Threshold, BlackAndWhiteIsTakenAsItIs) {
  Image image = blank(90, 70);
  paint(image, circle({40, 35}, 20), 3);
  for (auto& g : image.grey) g = g < 128 ? 0 : 255;
  pixel(image, 80, 60) = 0;  // a single pixel counts
  const Binarisation b = binarise(image, std::nullopt);
  for (std::size_t i = 0; i < image.grey.size(); ++i) {
    ASSERT_EQ(b.ink.data[i], image.grey[i] == 0);
    ASSERT_EQ(b.darkness.data[i], image.grey[i] == 0 ? 1.0f : 0.0f);
  }
  EXPECT_DOUBLE_EQ(b.threshold, 127.5);
}

TEST(Threshold, LightOnDarkEqualsItsComplement) {
  Image image = blank(400, 300);
  paint(image, {kFrom, kTo}, 4, 60);
  paint(image, circle({200, 150}, 90), 3, 140);
  add_grain(image, 3);
  const Binarisation dark = binarise(image, std::nullopt), light = binarise(complement(image), std::nullopt);
  EXPECT_FALSE(dark.inverted);
  EXPECT_TRUE(light.inverted);
  EXPECT_EQ(dark.ink.data, light.ink.data);
  EXPECT_EQ(dark.darkness.data, light.darkness.data);
  EXPECT_DOUBLE_EQ(dark.threshold, 255 - light.threshold);
}

TEST(Threshold, ThickPenOnLightPaperIsNotTurnedOver) {
  Image image = blank(300, 300);
  for (const double radius : {30.0, 95.0, 125.0}) paint(image, circle({150, 150}, radius), 28, 20);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_FALSE(b.inverted);
  EXPECT_NEAR(static_cast<double>(ink_pixels(b)), static_cast<double>(ink_pixels(binarise(image, 137.0))), 200);
}

TEST(Threshold, FilledPatchIsInkToItsMiddle) {
  Image image = blank(400, 400);
  paint(image, {{200, 200}, {210, 200}}, 220, 25);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_FALSE(b.inverted);
  EXPECT_NEAR(static_cast<double>(ink_pixels(b)), std::numbers::pi * 110 * 110 + 10 * 220, 150);
}

// Its middle is so far from paper that the light of that says nothing of it.
TEST(Threshold, APatchThatFillsMostOfThePictureIsInkToItsMiddle) {
  Image image = blank(700, 700);
  paint(image, {{350, 350}, {351, 350}}, 600, 25);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_FALSE(b.inverted);
  EXPECT_NEAR(static_cast<double>(ink_pixels(b)), std::numbers::pi * 300 * 300 + 600, 700);
}

TEST(Threshold, ShadeOfThePaperIsDividedOut) {
  for (const double depth : {0.3, 0.6}) {
    Image image = blank(400, 300);
    paint(image, {kFrom, kTo}, 4, 40);
    spoil(
        image, [&](int x, int y) { return 1 - depth * (x + 0.5 * y) / 550; }, 0);
    const Binarisation b = binarise(image, std::nullopt);
    EXPECT_FALSE(b.inverted);
    EXPECT_NEAR(mean_width(b, kFrom, kTo), 4, 0.15);
    EXPECT_EQ(stray_pixels(b, kFrom, kTo, 3), 0);
    EXPECT_GT(covered(b, kFrom, kTo), 0.999);
  }
}

TEST(Threshold, DarkRimOfThePaperIsNoInk) {
  Image image = blank(400, 300);
  paint(image, {kFrom, kTo}, 4, 40);
  spoil(
      image, [](int x, int y) { return 1 - 0.65 * (std::pow((x - 200) / 200.0, 2) + std::pow((y - 150) / 150.0, 2)) / 2; }, 2);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_FALSE(b.inverted);
  EXPECT_EQ(stray_pixels(b, kFrom, kTo, 3.5), 0);
  EXPECT_GT(covered(b, kFrom, kTo), 0.995);
}

TEST(Threshold, GrainOfThePaperIsNoInk) {
  for (const double grain : {2.0, 6.0, 12.0}) {
    Image image = blank(400, 300);
    paint(image, {kFrom, kTo}, 4, 60);
    add_grain(image, grain);
    const Binarisation b = binarise(image, std::nullopt);
    EXPECT_EQ(stray_pixels(b, kFrom, kTo, 4), 0) << grain;
    EXPECT_GT(covered(b, kFrom, kTo), 0.995) << grain;
    EXPECT_NEAR(mean_width(b, kFrom, kTo), 4, 0.4) << grain;
  }
}

TEST(Threshold, BlankPaperHasNoInk) {
  EXPECT_EQ(ink_pixels(binarise(blank(1, 1, 0), std::nullopt)), 0);
  for (const int grey : {0, 7, 128, 255})
    EXPECT_EQ(ink_pixels(binarise(blank(120, 80, static_cast<std::uint8_t>(grey)), std::nullopt)), 0);
  for (const double grain : {0.5, 1.0, 3.0, 10.0, 25.0})
    for (const unsigned seed : {1u, 2u, 3u}) {
      Image image = blank(300, 200, 230);
      add_grain(image, grain, seed);
      EXPECT_EQ(ink_pixels(binarise(image, std::nullopt)), 0) << grain;
      EXPECT_EQ(ink_pixels(binarise(complement(image), std::nullopt)), 0) << grain;
    }
  Image shaded = blank(300, 200, 240);
  spoil(
      shaded, [](int x, int y) { return 1 - 0.5 * x / 300 - 0.2 * y / 200; }, 1.5);
  EXPECT_EQ(ink_pixels(binarise(shaded, std::nullopt)), 0);
}

TEST(Threshold, PureNoiseIsHarmless) {
  std::mt19937 random(5);
  for (const int side : {1, 2, 3, 17, 200}) {
    Image image = blank(side, 2 * side);
    for (auto& g : image.grey) g = static_cast<std::uint8_t>(random() & 255);
    const Binarisation b = binarise(image, std::nullopt);
    EXPECT_EQ(b.ink.data.size(), image.grey.size());
    for (const float d : b.darkness.data) ASSERT_TRUE(d >= 0 && d <= 1);
  }
}

TEST(Threshold, FaintLineNextToAStrongOneIsKept) {
  for (const double distance : {7.0, 12.0, 100.0}) {
    Image image = blank(400, 400);
    const Vec2 shift{0, distance};
    paint(image, {kFrom, kTo}, 4, 10);
    paint(image, {kFrom + shift, kTo + shift}, 3, 195);
    const Binarisation b = binarise(image, std::nullopt);
    EXPECT_GT(covered(b, kFrom + shift, kTo + shift), 0.97) << distance;
    EXPECT_GT(covered(b, kFrom, kTo), 0.999);
  }
}

TEST(Threshold, FaintLineReachesTheStrongOneItLeaves) {
  Image image = blank(300, 300);
  paint(image, {{30, 150}, {270, 150}}, 5, 10);
  paint(image, {{150.5, 150}, {150.5, 280}}, 4, 185);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_GT(covered(b, {150.5, 150}, {150.5, 279}), 0.999);
}

TEST(Threshold, PencilOnGrainIsNotBrokenIntoDashes) {
  Image image = blank(400, 300);
  paint(image, {kFrom, kTo}, 4, 190);
  paint(image, {{20, 280}, {380, 270}}, 4, 120);
  add_grain(image, 4);
  const Binarisation b = binarise(image, std::nullopt);
  EXPECT_GT(covered(b, kFrom, kTo), 0.98);
}

TEST(Threshold, DotsSurvive) {
  for (const double grain : {0.0, 6.0}) {
    Image image = blank(300, 200);
    paint(image, {{150.2, 90.6}, {150.2, 90.6}}, 4, 30);
    paint(image, {{40, 20}, {40, 180}}, 4, 30);
    if (grain > 0) add_grain(image, grain);
    const Binarisation b = binarise(image, std::nullopt);
    long dot = 0;
    for (int y = 80; y < 100; ++y)
      for (int x = 140; x < 160; ++x) dot += b.ink(x, y);
    EXPECT_NEAR(static_cast<double>(dot), 4 * std::numbers::pi, 4) << grain;
  }
}

TEST(Threshold, ASpeckOfFourPixelsIsADotOnEvenPaperOnly) {
  for (const double grain : {0.0, 4.0}) {
    Image image = blank(300, 200);
    paint(image, {{40, 20}, {40, 180}}, 4, 30);
    for (const int x : {150, 151})
      for (const int y : {90, 91}) pixel(image, x, y) = 30;
    pixel(image, 280, 100) = 200;  // so that there are more than two tones
    if (grain > 0) add_grain(image, grain);
    const Binarisation b = binarise(image, std::nullopt);
    long speck = 0;
    for (int y = 80; y < 100; ++y)
      for (int x = 140; x < 160; ++x) speck += b.ink(x, y);
    if (grain > 0)
      EXPECT_EQ(speck, 0);
    else
      EXPECT_EQ(speck, 4);
  }
}

// Below half of the ink around it, but darker than paper.
TEST(Threshold, APinholeThroughWhichNoPaperIsSeenIsFilled) {
  for (const int grey : {150, 250}) {
    Image image = blank(200, 100);
    paint(image, {{30, 50}, {170, 50}}, 16, 20);
    for (const int x : {100, 101})
      for (const int y : {49, 50}) pixel(image, x, y) = static_cast<std::uint8_t>(grey);
    EXPECT_EQ(binarise(image, std::nullopt).ink(100, 49), grey == 150) << grey;
  }
}

TEST(Threshold, AFaintPatchWithoutADarkPixelIsNoInk) {
  for (const int grey : {207, 190}) {
    Image image = blank(200, 100);
    paint(image, {{30, 20}, {170, 20}}, 5, 0);
    for (int y = 60; y < 70; ++y)
      for (int x = 90; x < 100; ++x) pixel(image, x, y) = static_cast<std::uint8_t>(grey);
    EXPECT_EQ(binarise(image, std::nullopt).ink(95, 65), grey == 190) << grey;
  }
}

TEST(Threshold, RingingOfAnEncoderIsNoInk) {
  Image image = blank(300, 200);
  paint(image, {{150, 20}, {150, 180}}, 5);
  for (int y = 20; y < 180; ++y)
    for (int i = 4; i < 12; ++i)  // what a block transform leaves beside an edge
      for (const int side : {-1, 1}) {
        auto& g = pixel(image, 150 + side * i, y);
        g = static_cast<std::uint8_t>(std::min<int>(g, 255 - ((i + y / 3) % 3 == 0 ? 22 : 3)));
      }
  EXPECT_EQ(stray_pixels(binarise(image, std::nullopt), {150, 20}, {150, 180}, 3.6), 0);
}

TEST(Threshold, DarknessIsOneInTheInkAndNothingOnThePaper) {
  Image image = blank(400, 300);
  paint(image, {kFrom, kTo}, 6, 110);
  spoil(
      image, [](int x, int) { return 1 - 0.4 * x / 400; }, 0);
  const Binarisation b = binarise(image, std::nullopt);
  const Vec2 middle = lerp(kFrom, kTo, 0.5);
  EXPECT_NEAR(b.darkness(static_cast<int>(middle.x), static_cast<int>(middle.y)), 1, 0.08);
  for (const int x : {3, 200, 396}) EXPECT_NEAR(b.darkness(x, 290), 0, 0.06) << x;
}

TEST(Threshold, TurningTheDrawingTurnsTheInk) {
  Image image = blank(260, 260);
  paint(image, arc({130, 130}, 90, 0.3, 4.1), 3, 80);
  paint(image, {{20, 40}, {200, 230}}, 4, 20);
  Image turned = image;
  for (int y = 0; y < 260; ++y)
    for (int x = 0; x < 260; ++x) pixel(turned, 259 - y, x) = pixel(image, x, y);
  const Binarisation a = binarise(image, std::nullopt), b = binarise(turned, std::nullopt);
  long different = 0;
  for (int y = 0; y < 260; ++y)
    for (int x = 0; x < 260; ++x) different += a.ink(x, y) != b.ink(259 - y, x);
  EXPECT_LE(different, 4);
}

}  // namespace
}  // namespace inkgrid
