// Strokes that grain has broken: softened until they hold together, and nothing else is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "base/blur.h"
#include "ink/grain.h"
#include "ink/threshold.h"
#include "known_curves.h"

namespace inkgrid {
namespace {

using namespace testing;

std::uint8_t& grey_at(Image& image, int x, int y) {
  return image.grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)];
}

double grain_in(const Image& image) {
  return grain_of(image, measure_ink(binarise(image, std::nullopt)), 1);
}

// Hills and valleys of this radius, px, of mean 0 and deviation 1.
Raster<float> paper_tooth(int width, int height, double radius, unsigned seed) {
  std::mt19937 random(seed);
  Raster<float> noise(width, height);
  for (float& value : noise.data) value = static_cast<float>(random()) / static_cast<float>(std::mt19937::max()) - 0.5F;
  Raster<float> tooth = blurred(noise, radius, 1);
  double squares = 0;
  for (const float value : tooth.data) squares += static_cast<double>(value) * static_cast<double>(value);
  const auto deviation = static_cast<float>(std::sqrt(squares / static_cast<double>(tooth.data.size())));
  for (float& value : tooth.data) value /= deviation;
  return tooth;
}

// Ink stays where the tooth of the paper is above `level`, grey as pencil.
Image on_tooth(const Image& image, double radius, double level, unsigned seed) {
  const Raster<float> tooth = paper_tooth(image.width, image.height, radius, seed);
  Image result = image;
  for (std::size_t i = 0; i < result.grey.size(); ++i)
    result.grey[i] =
        static_cast<double>(tooth.data[i]) > level ? static_cast<std::uint8_t>(255 - (255 - image.grey[i]) * 6 / 10) : 255;
  return result;
}

// Two tones, by Floyd and Steinberg's diffusion of errors.
Image dithered(const Image& image) {
  Raster<double> grey(image.width, image.height);
  for (std::size_t i = 0; i < image.grey.size(); ++i) grey.data[i] = image.grey[i];
  Image result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double tone = grey(x, y) < 128 ? 0 : 255, error = grey(x, y) - tone;
      grey_at(result, x, y) = static_cast<std::uint8_t>(tone);
      const auto pass = [&](int dx, int dy, double part) {
        if (grey.contains(x + dx, y + dy)) grey(x + dx, y + dy) += part / 16 * error;
      };
      pass(1, 0, 7), pass(-1, 1, 3), pass(0, 1, 5), pass(1, 1, 1);
    }
  return result;
}

// Dots on a slanting grid of 3.6 px, larger where it is darker.
Image screened(const Image& image) {
  Image result = image;
  const double turn = 2 * std::numbers::pi / (3.6 * std::numbers::sqrt2);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      grey_at(result, x, y) =
          grey_at(result, x, y) > 255 * (2 + std::cos(turn * (x + y)) + std::cos(turn * (x - y))) / 4 ? 255 : 0;
  return result;
}

const std::vector<Line> kLines{circle({110, 110}, 70), {{30, 230}, {300, 200}}, {{220, 30}, {260, 250}}};

Image drawn(double pen, double grey = 0) {
  return painted(kLines, pen, 330, 270, grey);
}

// The share of the lines that is farther than 4 px from all that were found.
double missed(const std::vector<Line>& found) {
  int points = 0, far = 0;
  for (const Line& line : kLines)
    for (const Vec2 p : dense(line)) {
      ++points;
      far += distance(p, found) > 4;
    }
  return static_cast<double>(far) / points;
}

TEST(Grain, PaperStaysPaperAndInkIsNotLost) {
  Image image = blank(61, 61);
  EXPECT_EQ(softened(image, 3, 1).grey, image.grey);
  for (int x = 20; x <= 40; ++x) grey_at(image, x, 30) = 55;
  double before = 0, after = 0, spread = 0;
  Image soft = softened(image, 2, 1);
  for (int y = 0; y < 61; ++y)
    for (int x = 0; x < 61; ++x) {
      before += 255.0 - grey_at(image, x, y);
      after += 255.0 - grey_at(soft, x, y);
      spread += (255.0 - grey_at(soft, x, y)) * (y - 30) * (y - 30);
    }
  EXPECT_NEAR(after / before, 1, 0.02);
  EXPECT_NEAR(spread / after, 4, 0.2) << "the variance across the line";
}

TEST(Grain, SofteningIsTheSameOnAnyNumberOfThreads) {
  const Image image = on_tooth(drawn(6), 1.2, 0, 3);
  EXPECT_EQ(softened(image, 1.7, 1).grey, softened(image, 1.7, 4).grey);
}

TEST(Grain, OfPaperPensScreensAndDitheringIsFound) {
  for (const double pen : {5.0, 8.0, 14.0}) {
    for (const double radius : {0.7, 1.2})
      for (const double level : {-0.2, 0.2}) {
        const double grain = grain_in(on_tooth(drawn(pen), radius, level, 7));
        EXPECT_GE(grain, 1) << pen << ' ' << radius << ' ' << level;
        EXPECT_LE(grain, 0.6 * pen) << pen << ' ' << radius << ' ' << level;
      }
    EXPECT_GE(grain_in(dithered(drawn(pen, 110))), 1) << pen;
    EXPECT_GE(grain_in(screened(drawn(pen, 110))), 1) << pen;
  }
}

TEST(Grain, GrowsWithThePicture) {
  const double small = grain_in(on_tooth(drawn(6), 0.8, 0, 5));
  std::vector<Line> twice = kLines;
  for (Line& line : twice)
    for (Vec2& p : line) p = 2.0 * p;
  const double large = grain_in(on_tooth(painted(twice, 12, 660, 540), 1.6, 0, 5));
  EXPECT_GT(large, 1.2 * small);
  EXPECT_LT(large, 3 * small);
}

TEST(Grain, WhatHoldsTogetherHasNone) {
  for (const double pen : {1.5, 3.0, 6.0, 12.0}) EXPECT_EQ(grain_in(drawn(pen)), 0) << pen;
  Image noise = drawn(4);
  std::mt19937 random(1);
  for (std::uint8_t& grey : noise.grey)
    grey = static_cast<std::uint8_t>(std::clamp(static_cast<int>(grey) + static_cast<int>(random() % 61) - 30, 0, 255));
  EXPECT_EQ(grain_in(noise), 0);
  EXPECT_EQ(grain_in(blank(40, 30)), 0);
}

TEST(Grain, DashesAndDotsHaveNone) {
  for (const double pen : {2.0, 4.0, 8.0})
    for (const double dash : {0.0, 1.0, 4.0})
      for (const double gap : {0.8, 1.5}) {
        Image image = blank(400, 200);
        for (double y = 20; y < 190; y += 6 * pen)
          for (double x = 20; x < 380; x += (dash + 1 + gap) * pen) paint(image, {{x, y}, {x + dash * pen, y}}, pen);
        EXPECT_EQ(grain_in(image), 0) << "pen " << pen << " dash " << dash << " gap " << gap;
      }
}

TEST(Grain, HatchingAndNetsHaveNone) {
  for (const double pen : {2.0, 3.0, 5.0})
    for (const double paper : {1.5, 3.0}) {
      Image hatching = blank(200, 200), net = blank(200, 200);
      for (double x = 30; x < 170; x += pen + paper) {
        paint(hatching, {{x, 30}, {x + 20, 170}}, pen);
        paint(net, {{x, 30}, {x, 170}}, pen);
        paint(net, {{30, x}, {170, x}}, pen);
      }
      EXPECT_EQ(grain_in(hatching), 0) << pen << ' ' << paper;
      EXPECT_EQ(grain_in(net), 0) << pen << ' ' << paper;
    }
}

TEST(Grain, LinesOverBrokenStrokesAreWhole) {
  for (const unsigned seed : {1U, 2U, 3U})
    for (const bool light : {false, true}) {
      Image image = on_tooth(drawn(7), 0.9, -0.1, seed);
      if (light)
        for (std::uint8_t& grey : image.grey) grey = static_cast<std::uint8_t>(255 - grey);
      const Drawing drawing = traced(image);
      EXPECT_LT(farthest(lines_of(drawing), kLines), 4) << seed << light;
      EXPECT_LT(missed(lines_of(drawing)), 0.06) << seed << light;
      EXPECT_LE(drawing.curves.size(), 12U) << seed << light;
      Options sharp;
      sharp.soften = 0;
      EXPECT_GT(vectorize(image, sharp).drawing.curves.size(), 40U) << "without, they are crumbs";
    }
}

TEST(Grain, OptionsDecide) {
  const Image image = dithered(drawn(7, 110));
  Options options;
  const Report report = vectorize(image, options).report;
  EXPECT_GE(report.softening, 1);
  EXPECT_EQ(report.gap, 2) << "grain leaves gaps";
  options.threshold = 128;
  EXPECT_EQ(vectorize(image, options).report.softening, 0) << "a threshold means what is darker and nothing else";
  options.soften = 1.5;
  EXPECT_EQ(vectorize(image, options).report.softening, 1.5);
  options.threshold.reset();
  options.soften = 0;
  EXPECT_EQ(vectorize(image, options).report.softening, 0);
}

}  // namespace
}  // namespace inkgrid
