// Small drawings for tests, painted with round-capped strokes and antialiased by the exact distance to the stroke.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/polyline.h"
#include "inkgrid/image.h"
#include "inkgrid/vec2.h"

namespace inkgrid::testing {

inline Image blank(int width, int height, std::uint8_t grey = 255) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey), 0};
}

using inkgrid::distance_to_segment;

// Darkens the image along the polyline; `width` in px.
inline void paint(Image& image, const std::vector<Vec2>& line, double width, double grey = 0) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i], b = line[i + 1];
    const double r = width / 2 + 1;
    const int x0 = std::max(0, static_cast<int>(std::min(a.x, b.x) - r)),
              x1 = std::min(image.width - 1, static_cast<int>(std::max(a.x, b.x) + r));
    const int y0 = std::max(0, static_cast<int>(std::min(a.y, b.y) - r)),
              y1 = std::min(image.height - 1, static_cast<int>(std::max(a.y, b.y) + r));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const double cover = std::clamp(width / 2 + 0.5 - distance_to_segment({x + 0.5, y + 0.5}, a, b), 0.0, 1.0);
        auto& g = image.grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)];
        g = static_cast<std::uint8_t>(std::min(static_cast<double>(g), std::round(255 - (255 - grey) * cover)));
      }
  }
}

// Darkens the inside of a polygon (even-odd), with 8 x 8 samples a pixel.
inline void fill(Image& image, const std::vector<Vec2>& polygon, double grey = 0) {
  constexpr int kSamples = 8;
  const auto width = static_cast<std::size_t>(image.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    std::vector<int> hits(width, 0);
    for (int row = 0; row < kSamples; ++row) {
      const double level = static_cast<double>(y) + (row + 0.5) / kSamples;
      std::vector<double> crossings;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if ((a.y > level) != (b.y > level)) crossings.push_back(a.x + (level - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      for (std::size_t k = 0; k < width * kSamples; ++k) {
        const double x = (static_cast<double>(k) + 0.5) / kSamples;
        hits[k / kSamples] += std::count_if(crossings.begin(), crossings.end(), [&](double c) { return c < x; }) % 2 != 0;
      }
    }
    for (std::size_t x = 0; x < width; ++x) {
      const double cover = static_cast<double>(hits[x]) / (kSamples * kSamples);
      auto& g = image.grey[y * width + x];
      g = static_cast<std::uint8_t>(std::min(static_cast<double>(g), std::round(255 - (255 - grey) * cover)));
    }
  }
}

inline std::vector<Vec2> arc(Vec2 centre, double radius, double from, double to, int steps = 200) {
  std::vector<Vec2> line;
  for (int i = 0; i <= steps; ++i) {
    const double a = from + (to - from) * i / steps;
    line.push_back(centre + radius * Vec2{std::cos(a), std::sin(a)});
  }
  return line;
}

inline std::vector<Vec2> circle(Vec2 centre, double radius) {
  return arc(centre, radius, 0, 2 * std::numbers::pi);
}

}  // namespace inkgrid::testing
