#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawn_bands.h"
#include "ink/pen_strokes.h"
#include "ink/preset.h"
#include "settings.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::paint;

std::vector<Vec2> wave(double y, double phase) {
  std::vector<Vec2> line;
  for (int x = 20; x <= 180; x += 4) line.push_back({double(x), y + 3 * std::sin(0.05 * x + phase)});
  return line;
}

struct Strokes {
  Ink ink;
  double pen_width;
};

Strokes strokes_of(const Image& image) {
  Strokes strokes{measure_ink(binarise(image, std::nullopt)), 0};
  strokes.pen_width = find_pen_strokes(strokes.ink.mask, strokes.ink.darkness).width;
  return strokes;
}

Sketchiness sketchiness_of(const Image& image) {
  const Strokes strokes = strokes_of(image);
  return measure_sketchiness(strokes.ink, strokes.pen_width);
}

Preset chosen_for(const Image& image) {
  const Strokes strokes = strokes_of(image);
  return choose_preset(strokes.ink, strokes.pen_width);
}

TEST(Preset, EvenInkIsClean) {
  Image image = blank(200, 200);
  for (const double y : {40.0, 90.0, 150.0}) paint(image, wave(y, 0), 6);
  EXPECT_EQ(chosen_for(image), Preset::clean);
}

TEST(Preset, StrokesOfDifferentGreyAreRough) {
  Image image = blank(200, 200);
  for (const double y : {40.0, 90.0, 150.0})
    for (int k = 0; k < 4; ++k) paint(image, wave(y + 1.5 * k, 0.8 * k), 5, 20 + 30 * k);
  EXPECT_GT(sketchiness_of(image).opacity_spread, 0.05);
  EXPECT_EQ(chosen_for(image), Preset::rough);
}

// As in a sketch of firm strokes, a few of which were tried lightly before.
TEST(Preset, AFewPaleStrokesUnderBlackOnesAreRough) {
  Image image = blank(400, 200);
  for (const double y : {30.0, 65.0, 100.0, 135.0, 170.0}) {
    paint(image, {{20, y}, {90, y}}, 6, 90);
    paint(image, {{60, y}, {380, y}}, 6);
  }
  EXPECT_LT(sketchiness_of(image).pale, 0.2) << "what the test is about";
  EXPECT_EQ(chosen_for(image), Preset::rough);
}

// What is dark there and not black is rim: the tips of corners, and where strokes meet.
TEST(Preset, FineStrokesWithCornersAreClean) {
  for (const double pen : {1.5, 2.0, 3.0}) {
    Image image = blank(420, 300);
    for (int k = 0; k < 6; ++k) {
      const auto polar = [&](double radius, double turn) {
        return radius * Vec2{std::cos(1.047 * k + 0.2 + turn), std::sin(1.047 * k + 0.2 + turn)};
      };
      const Vec2 tip = Vec2{210, 150} + polar(130, 0);
      paint(image, {Vec2{210, 150} + polar(40, 0), tip}, pen);
      for (const double turn : {2.6, -2.6}) paint(image, {tip, tip + polar(6 * pen, turn)}, pen);
    }
    EXPECT_EQ(chosen_for(image), Preset::clean) << pen;
  }
}

TEST(Preset, AnEnlargedPictureOfFineStrokesIsClean) {
  Image small = blank(200, 200), image = blank(400, 400);
  for (double y = 30; y < 170; y += 6) paint(small, wave(y, 0.1 * y), 2);
  const auto of_small = [&](double x, double y) {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const auto grey = [&](int px, int py) {
      return static_cast<double>(small.grey[static_cast<std::size_t>(std::clamp(py, 0, 199) * 200 + std::clamp(px, 0, 199))]);
    };
    return std::lerp(std::lerp(grey(x0, y0), grey(x0 + 1, y0), x - x0), std::lerp(grey(x0, y0 + 1), grey(x0 + 1, y0 + 1), x - x0),
                     y - y0);
  };
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x)
      image.grey[static_cast<std::size_t>(y * 400 + x)] = static_cast<std::uint8_t>(of_small(0.5 * x - 0.25, 0.5 * y - 0.25));
  EXPECT_GT(sketchiness_of(image).opacity_spread, 0.05) << "what the test is about";
  EXPECT_EQ(chosen_for(image), Preset::clean);
}

TEST(Preset, BlackStrokesWithSlitsAreRough) {
  Image image = blank(200, 200);
  for (const double y : {40.0, 90.0, 150.0})
    for (int k = 0; k < 5; ++k) paint(image, wave(y + 3 * k, 0.9 * k), 2.5 + 0.8 * (k % 3));
  EXPECT_EQ(chosen_for(image), Preset::rough);
}

// Most of the paper between them is closed, but for grey seams.
TEST(Preset, ACircleDrawnOverSeveralTimesIsRough) {
  Image image = blank(300, 300);
  for (int k = 0; k < 5; ++k) {
    std::vector<Vec2> round;
    for (double t = 0; t < 2.1 * std::numbers::pi; t += 0.02)
      round.push_back(Vec2{150, 150} + (100 + 3.8 * std::sin(2 * t + 3.3 * k)) * Vec2{std::cos(t + k), std::sin(t + k)});
    paint(image, round, 3);
  }
  EXPECT_LT(sketchiness_of(image).slits, 0.03);
  EXPECT_EQ(chosen_for(image), Preset::rough);
}

// Acute corners of thick outlines and thin details leave slits as well.
TEST(Preset, AnOutlineAndItsDetailsAreClean) {
  Image image = blank(300, 300);
  for (int k = 0; k < 8; ++k) {
    const double turn = 0.8 * k;
    const Vec2 tip = Vec2{150, 150} + 110 * Vec2{std::cos(turn), std::sin(turn)};
    for (const double half : {-0.12, 0.12})
      paint(image, {tip, tip - 90 * Vec2{std::cos(turn + half), std::sin(turn + half)}}, k % 2 ? 6 : 4);
  }
  const Sketchiness s = sketchiness_of(image);
  EXPECT_GT(s.slits, 0.009);
  EXPECT_GT(s.uneven_width, 0.48);
  EXPECT_EQ(chosen_for(image), Preset::clean);
}

// Blades whose two sides meet in a tip, side by side: slits and seams, but nothing is drawn over.
TEST(Preset, HairAndGrassAreClean) {
  Image image = blank(400, 200);
  for (int k = 0; k < 24; ++k) {
    const Vec2 root{20 + 15.0 * k, 180}, tip = root + Vec2{30 * std::sin(2.3 * k), -90 - 25 * std::cos(1.7 * k)};
    for (const double aside : {-3.0, 3.0}) {
      std::vector<Vec2> side;
      for (double t = 0; t <= 1.001; t += 0.05)
        side.push_back(lerp(root + Vec2{aside, 0}, tip, t) + 6 * std::sin(std::numbers::pi * t) * Vec2{std::sin(1.0 * k), 0});
      paint(image, side, 3);
    }
  }
  const Sketchiness s = sketchiness_of(image);
  EXPECT_GT(s.centre_spread, 0.08) << "what the test is about";
  EXPECT_LT(s.plain_spread, 0.016);
  EXPECT_EQ(chosen_for(image), Preset::clean);
}

// Whole pixels measure strokes of 2.5 px here as 2 wide, there as 4.
TEST(Preset, FineStrokesCloseBesideEachOtherAreClean) {
  Image image = blank(300, 120);
  for (int k = 0; k < 4; ++k) {
    std::vector<Vec2> line;
    for (double t = 0; t <= 1; t += 0.005) line.push_back({20 + 260 * t, 40 + 20 * std::sin(6 * t) + 4 * k});
    paint(image, line, 2.5);
  }
  EXPECT_GT(sketchiness_of(image).slits, 0.03);
  EXPECT_EQ(chosen_for(image), Preset::clean);
}

TEST(Preset, PensOfDifferentWidthAreClean) {
  Image image = blank(400, 300);
  paint(image, {{20, 40}, {380, 50}}, 40);
  paint(image, {{20, 110}, {380, 115}}, 20);
  for (const double y : {150.0, 170.0, 190.0, 210.0}) paint(image, {{20, y}, {380, y + 4}}, 2);
  paint(image, {{60, 30}, {70, 260}}, 6);
  const Sketchiness s = sketchiness_of(image);
  EXPECT_GT(s.uneven_width, 1.8);
  EXPECT_EQ(chosen_for(image), Preset::clean);
}

// The same with slits between the fine ones: what tells is how far their widths spread.
TEST(Preset, PensOfDifferentWidthWithSlitsAreClean) {
  Image image = blank(400, 300);
  for (const double y : {40.0, 90.0}) paint(image, {{20, y}, {380, y + 4}}, 30);
  for (int k = 0; k < 5; ++k) paint(image, {{20, 120.0 + 6 * k}, {380, 124.0 + 6 * k}}, 4);
  const Sketchiness s = sketchiness_of(image);
  EXPECT_GT(s.uneven_width, 1.8);
  EXPECT_GT(s.slits, 0.03);
  EXPECT_EQ(chosen_for(image), Preset::clean);
}

// Its crossings are half of what is drawn, and wider than the pen; corners of its cells are no slits.
TEST(Preset, CloseCrossHatchingIsClean) {
  for (const double pen : {4.0, 5.0, 6.0})
    for (const double paper : {pen, pen + 1, 1.5 * pen}) {
      const double apart = pen + paper, size = 40 + 7 * apart;
      Image image = blank(static_cast<int>(size) + 20, static_cast<int>(size) + 20);
      for (int k = 0; k < 7; ++k) {
        paint(image, {{20, 30 + apart * k}, {size, 30 + apart * k}}, pen);
        paint(image, {{30 + apart * k, 20}, {30 + apart * k, size}}, pen);
      }
      EXPECT_EQ(chosen_for(image), Preset::clean) << pen << " px, " << paper << " px apart";
    }
}

TEST(Preset, AGivenOneIsKept) {
  Stages measured;
  measured.ink.stroke_width = 6;
  for (const Preset looks : {Preset::clean, Preset::rough})
    for (const Preset given : {Preset::clean, Preset::rough, Preset::automatic}) {
      measured.look.preset = looks;
      Inputs inputs;
      inputs.options.preset = given;
      settle(inputs, measured);
      EXPECT_EQ(inputs.settled.preset, given == Preset::automatic ? looks : given);
    }
}

TEST(Preset, SketchesHaveACoarserGridThatReachesFurther) {
  EXPECT_GT(preset_values(Preset::rough, 6).reach, preset_values(Preset::clean, 6).reach);
  EXPECT_GT(preset_values(Preset::rough, 6).spacing, preset_values(Preset::clean, 6).spacing);
}

TEST(Preset, AThickPenHasAFinerGridInItsOwnWidths) {
  EXPECT_EQ(preset_values(Preset::clean, 2).spacing, preset_values(Preset::clean, 4).spacing);
  EXPECT_LT(preset_values(Preset::clean, 6).spacing, preset_values(Preset::clean, 4).spacing);
  EXPECT_GT(6 * preset_values(Preset::clean, 6).spacing, 2.7) << "the grid never gets finer than what pixels resolve";
  EXPECT_EQ(preset_values(Preset::clean, 20).spacing, preset_values(Preset::clean, 60).spacing);
  EXPECT_EQ(preset_values(Preset::rough, 2).spacing, preset_values(Preset::rough, 60).spacing);
}

// Two pixels of paper between two of ink are no slit to be closed.
TEST(Preset, APenOfFewPixelsReachesLess) {
  EXPECT_LT(2 * preset_values(Preset::clean, 2).reach, 0.4);
  EXPECT_GT(4 * preset_values(Preset::clean, 4).reach, 1);
  EXPECT_EQ(preset_values(Preset::clean, 1.5).reach, preset_values(Preset::clean, 2).reach);
}

TEST(Preset, GapsAreAsWideAsAPenButNotWiderThanPicturesBreakStrokes) {
  for (const Preset preset : {Preset::clean, Preset::rough}) {
    EXPECT_EQ(preset_values(preset, 2).gap, 1);
    EXPECT_EQ(preset_values(preset, 6).gap, 1);
    EXPECT_DOUBLE_EQ(24 * preset_values(preset, 24).gap, 6);
  }
}

}  // namespace
}  // namespace inkgrid
