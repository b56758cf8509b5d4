// The pixels of an image file before they become grey levels or scale factors.
#pragma once

#include <cstdint>
#include <vector>

namespace inkgrid {

struct DecodedImage {
  int width = 0;
  int height = 0;
  int channels = 1;                   // 1: grey, 3: red green blue, 4: and alpha (not multiplied in)
  std::vector<std::uint8_t> samples;  // row by row, channels side by side
  double pixels_per_mm = 0;           // 0: not said
};

}  // namespace inkgrid
