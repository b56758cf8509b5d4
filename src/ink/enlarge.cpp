#include "ink/enlarge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/at.h"
#include "base/raster.h"

namespace inkgrid {
namespace {

constexpr double kFinestPen = 2.8;       // px
constexpr double kFinePaper = 4;         // px: as many pixels of paper may be two or four
constexpr double kMuchFinePaper = 0.05;  // px, a pixel of ink
constexpr double kMostPixels = 16e6;     // of a picture that is enlarged
constexpr int kLobes = 3;
constexpr int kTaps = 2 * kLobes;

using Taps = std::array<float, kTaps>;

double lanczos(double x) {
  if (x == 0) return 1;
  const double angle = std::numbers::pi * x;
  return std::sin(angle) * std::sin(angle / kLobes) * kLobes / (angle * angle);
}

// The weights of the pixels around a place that is `part` of a pixel beyond the centre of the third of them.
Taps taps_at(double part) {
  Taps taps{};
  double sum = 0;
  for (int k = 0; k < kTaps; ++k) sum += lanczos(k - (kLobes - 1) - part);
  for (int k = 0; k < kTaps; ++k) taps[at(k)] = static_cast<float>(lanczos(k - (kLobes - 1) - part) / sum);
  return taps;
}

// Of an enlarged pixel, along one axis: its pixels, those beyond the border being the last ones, and their weights.
struct Place {
  std::array<int, kTaps> pixels;
  Taps taps;
};

std::vector<Place> places_along(int size) {
  static_assert(kEnlargement == 2, "an enlarged pixel lies a quarter of a pixel to either side of a centre");
  const Taps before = taps_at(0.75), after = taps_at(0.25);
  std::vector<Place> places(at(kEnlargement * size));
  for (int i = 0; i < kEnlargement * size; ++i) {
    const int first = i / 2 - (i % 2 == 0 ? kLobes : kLobes - 1);
    Place& place = places[at(i)];
    place.taps = i % 2 == 0 ? before : after;
    for (int k = 0; k < kTaps; ++k) place.pixels[at(k)] = std::clamp(first + k, 0, size - 1);
  }
  return places;
}

template <class Value>
float interpolated(const Place& place, const Value& value) {
  float sum = 0;
  for (int k = 0; k < kTaps; ++k) sum += place.taps[at(k)] * value(place.pixels[at(k)]);
  return sum;
}

bool may_be_enlarged(const Ink& ink) {
  return ink.pixels > 0 && static_cast<double>(ink.width()) * ink.height() <= kMostPixels;
}

}  // namespace

bool has_fine_pen(double pen_width, const Ink& ink) {
  return may_be_enlarged(ink) && pen_width > 0 && pen_width < kFinestPen;
}

// Slits, acute corners and specks.
bool has_fine_paper(const Ink& ink) {
  if (!may_be_enlarged(ink)) return false;
  const auto closed = closed_ink(ink, kFinePaper / 2);
  const auto all = std::count(closed.data.begin(), closed.data.end(), std::uint8_t{1});
  return static_cast<double>(all - ink.pixels) > kMuchFinePaper * static_cast<double>(ink.pixels);
}

Image enlarged(const Image& image) {
  const std::vector<Place> across = places_along(image.width), down = places_along(image.height);
  Raster<float> wide(kEnlargement * image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* const row = &image.grey[at(y) * at(image.width)];
    for (int x = 0; x < wide.width; ++x)
      wide(x, y) = interpolated(across[at(x)], [&](int i) { return static_cast<float>(row[i]); });
  }
  Image result{wide.width, kEnlargement * image.height, {}, kEnlargement * image.pixels_per_mm};
  result.grey.reserve(at(result.width) * at(result.height));
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const float grey = interpolated(down[at(y)], [&](int i) { return wide(x, i); });
      result.grey.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0F, 255.0F))));
    }
  return result;
}

ScaleMask enlarged(const ScaleMask& mask) {
  ScaleMask result{kEnlargement * mask.width, kEnlargement * mask.height, {}};
  result.factor.reserve(at(result.width) * at(result.height));
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      result.factor.push_back(mask.factor[at(y / kEnlargement) * at(mask.width) + at(x / kEnlargement)]);
  return result;
}

}  // namespace inkgrid
