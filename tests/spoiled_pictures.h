// What light and grain do to a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "inkgrid/image.h"

namespace inkgrid::testing {

inline std::uint8_t& pixel(Image& image, int x, int y) {
  return image.grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)];
}

// Multiplies the light of each pixel by shade(x, y) and adds grain of the given standard deviation, in grey levels.
template <class Shade>
void spoil(Image& image, Shade shade, double grain, unsigned seed = 1) {
  std::mt19937 random(seed);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double noise = -6;  // the sum of twelve uniform numbers is nearly normal, and the same with every library
      for (int i = 0; i < 12; ++i) noise += static_cast<double>(random()) / 4294967296.0;
      pixel(image, x, y) =
          static_cast<std::uint8_t>(std::clamp(std::lround(pixel(image, x, y) * shade(x, y) + grain * noise), 0L, 255L));
    }
}

}  // namespace inkgrid::testing
