// A picture of a fine pen, enlarged: nothing moves, and nothing is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "chain_checks.h"
#include "drawings.h"
#include "ink/enlarge.h"
#include "inkgrid/inkgrid.h"
#include "settings.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::ink_of;
using testing::paint;

std::uint8_t grey_at(const Image& image, int x, int y) {
  return image.grey[static_cast<std::size_t>(y * image.width + x)];
}

Image image_of(int width, int height, const std::function<double(int, int)>& grey) {
  Image image = blank(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.grey[static_cast<std::size_t>(y * width + x)] = static_cast<std::uint8_t>(std::lround(grey(x, y)));
  return image;
}

// The middle of the ink of a picture of one tone, px.
Vec2 centroid(const Image& image) {
  double ink = 0;
  Vec2 sum;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double dark = 255.0 - grey_at(image, x, y);
      ink += dark;
      sum += dark * Vec2{x + 0.5, y + 0.5};
    }
  return sum / ink;
}

TEST(Enlarge, PaperStaysPaperUpToTheBorder) {
  for (const auto grey : std::initializer_list<std::uint8_t>{0, 77, 255}) {
    const Image image = enlarged(blank(5, 3, grey));
    EXPECT_EQ(image.width, 10);
    EXPECT_EQ(image.height, 6);
    EXPECT_EQ(image.grey, std::vector<std::uint8_t>(60, grey));
  }
}

TEST(Enlarge, ASlopeStaysASlope) {
  const Image image = enlarged(image_of(20, 20, [](int x, int y) { return 8 * x + 4 * y; }));
  for (int y = 6; y < 34; ++y)
    for (int x = 6; x < 34; ++x)
      EXPECT_NEAR(grey_at(image, x, y), 8 * ((x + 0.5) / 2 - 0.5) + 4 * ((y + 0.5) / 2 - 0.5), 1) << x << ' ' << y;
}

TEST(Enlarge, StrokesStayWhereTheyAre) {
  for (const double x : {12.0, 12.3, 12.5, 12.8}) {
    Image image = blank(30, 30);
    paint(image, {{x, 10}, {x + 3, 20}}, 1.5);
    const Vec2 before = centroid(image), after = centroid(enlarged(image));
    EXPECT_NEAR(after.x, 2 * before.x, 0.06) << x;
    EXPECT_NEAR(after.y, 2 * before.y, 0.06) << x;
  }
}

TEST(Enlarge, TurnsWithThePicture) {
  const auto grey = [](int x, int y) { return (37 * x * x + 91 * y + 13 * x * y) % 256; };
  const Image image = enlarged(image_of(9, 9, grey));
  const Image turned = enlarged(image_of(9, 9, [&](int x, int y) { return grey(8 - x, y); }));
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 18; ++x) EXPECT_NEAR(grey_at(image, x, y), grey_at(turned, 17 - x, y), 1);
}

TEST(Enlarge, AMaskSaysTheSameOfEveryPlace) {
  ScaleMask mask{3, 2, {1, 0.5F, 2, 1, 1, 0.25F}};
  const ScaleMask large = enlarged(mask);
  ASSERT_EQ(large.factor.size(), 24u);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x)
      EXPECT_EQ(large.factor[static_cast<std::size_t>(6 * y + x)], mask.factor[static_cast<std::size_t>(3 * (y / 2) + x / 2)]);
}

// Two strokes of 6 px with `paper` px between them.
Ink two_strokes(double paper) {
  Image image = blank(100, 60);
  for (const double y : {27 - paper / 2, 33 + paper / 2}) paint(image, {{10, y}, {90, y}}, 6);
  return ink_of(image);
}

TEST(Enlarge, OnlyPicturesOfAFinePenThatAreNotHuge) {
  const Ink small = two_strokes(20);
  EXPECT_TRUE(has_fine_pen(1, small));
  EXPECT_TRUE(has_fine_pen(2.79, small));
  EXPECT_FALSE(has_fine_pen(2.81, small));
  EXPECT_FALSE(has_fine_pen(0, small)) << "there is no stroke";
  Ink huge;
  huge.mask = Raster<std::uint8_t>(20000, 1000);
  huge.pixels = 1;
  EXPECT_FALSE(has_fine_pen(2, huge));
  EXPECT_FALSE(has_fine_paper(huge));
}

TEST(Enlarge, PicturesOfFineSlits) {
  for (const double paper : {1.0, 2.0, 3.0}) EXPECT_TRUE(has_fine_paper(two_strokes(paper))) << paper;
  for (const double paper : {5.0, 6.0, 12.0}) EXPECT_FALSE(has_fine_paper(two_strokes(paper))) << paper;
}

TEST(Enlarge, NotForAShortSlitBesideLongStrokes) {
  Image image = blank(320, 80);
  for (const double y : {15.0, 45.0}) paint(image, {{10, y}, {310, y}}, 6);
  paint(image, {{150, 53}, {162, 53}}, 6);
  EXPECT_FALSE(has_fine_paper(ink_of(image)));
  for (const double x : {40.0, 95.0, 205.0, 260.0}) paint(image, {{x, 53}, {x + 30, 53}}, 6);
  EXPECT_TRUE(has_fine_paper(ink_of(image)));
}

TEST(Enlarge, TheReportIsInPixelsOfTheDrawing) {
  Image image = blank(140, 60);
  paint(image, {{20, 30}, {120, 30}}, 2);
  const Report report = vectorize(image).report;
  EXPECT_EQ(report.enlargement, 2);
  EXPECT_NEAR(report.stroke_width, 2, 0.5);
  EXPECT_NEAR(static_cast<double>(report.ink_pixels), 203, 20);
}

TEST(Enlarge, NotForSlitsThatAreToBeJoined) {
  Options options;
  EXPECT_EQ(enlargement_for({Preset::clean, false, true}, options), 2);
  EXPECT_EQ(enlargement_for({Preset::rough, true, true}, options), 1);
  options.bundles = BundleMode::join;
  EXPECT_EQ(enlargement_for({Preset::clean, false, true}, options), 1);
  EXPECT_EQ(enlargement_for({Preset::clean, true, true}, options), 2);
}

TEST(Enlarge, NotWhereNothingWouldBeInkAfterwards) {
  const Image strip = image_of(3, 200, [](int x, int) { return x == 1 ? 0 : 255; });
  const Result one = vectorize(strip);
  EXPECT_EQ(one.report.enlargement, 1);
  ASSERT_EQ(one.drawing.curves.size(), 1u);
  EXPECT_EQ(one.drawing.curves.front().width, 1);
  const Image lines = image_of(60, 60, [](int x, int) { return x % 3 == 1 ? 0 : 255; });
  EXPECT_EQ(vectorize(lines).drawing.curves.size(), 20u);
}

}  // namespace
}  // namespace inkgrid
