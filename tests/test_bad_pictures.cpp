// Pictures as people have them: light on dark, of two tones, enlarged, faint, grainy, unevenly lit.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "known_curves.h"

namespace inkgrid {
namespace {

using namespace testing;

// A loop, a line and a crossing.
const std::vector<Line>& usual() {
  static const std::vector<Line> lines{
      circle({70, 75}, 40), {{20, 150}, {220, 130}}, {{140, 20}, {190, 165}}, arc({190, 60}, 30, -2, 1.5)};
  return lines;
}

void expect_usual(const Drawing& drawing, double pen, double blur = 0.5) {
  EXPECT_EQ(drawing.curves.size(), 6u);  // one is crossed
  EXPECT_EQ(drawing.junctions.size(), 1u);
  EXPECT_LT(distance_between(lines_of(drawing), usual()), 0.2 * pen + blur);
}

Image usual_image(double pen, double grey = 0) {
  return painted(usual(), pen, 250, 190, grey);
}

TEST(BadPictures, WhiteOnBlack) {
  Image image = usual_image(4);
  for (auto& g : image.grey) g = static_cast<std::uint8_t>(255 - g);
  expect_usual(vectorize(image).drawing, 4);
}

TEST(BadPictures, StepsOfTwoTones) {
  for (const double pen : {2.0, 3.0, 4.0, 7.0}) {
    SCOPED_TRACE(pen);
    Image image = usual_image(pen);
    for (auto& g : image.grey) g = g < 128 ? 0 : 255;
    expect_usual(vectorize(image).drawing, pen, 0.8);
  }
}

TEST(BadPictures, BlocksOfAnEnlargedPicture) {
  for (const int factor : {2, 3, 4}) {
    SCOPED_TRACE(factor);
    const Image small = usual_image(3);
    Image image = blank(small.width * factor, small.height * factor);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        image.grey[static_cast<std::size_t>(y * image.width + x)] =
            small.grey[static_cast<std::size_t>(y / factor * small.width + x / factor)];
    Drawing drawing = vectorize(image).drawing;
    for (Curve& curve : drawing.curves)
      for (Cubic& c : curve.segments)
        for (Vec2* p : {&c.p0, &c.p1, &c.p2, &c.p3}) *p = *p / factor;
    expect_usual(drawing, 3);
  }
}

Image with_noise(Image image, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, sigma);
  for (auto& g : image.grey) g = static_cast<std::uint8_t>(std::clamp(g + noise(random), 0.0, 255.0));
  return image;
}

TEST(BadPictures, FaintPencil) {
  for (const double grey : {150.0, 190.0, 215.0, 230.0}) {
    SCOPED_TRACE(grey);
    expect_usual(vectorize(usual_image(3, grey)).drawing, 3);
    expect_usual(vectorize(with_noise(usual_image(3, grey), 3, 5)).drawing, 3, 0.8);
  }
}

TEST(BadPictures, UnevenLight) {
  Image image = usual_image(4);
  for (std::size_t k = 0; k < image.grey.size(); ++k) {
    const double x = static_cast<double>(k % 250) / 250, y = static_cast<double>(k / 250) / 190;
    image.grey[k] = static_cast<std::uint8_t>(image.grey[k] * (1 - 0.5 * x * y - 0.1 * x));
  }
  expect_usual(vectorize(image).drawing, 4);
}

}  // namespace
}  // namespace inkgrid
