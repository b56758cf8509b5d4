// Rasters that enter the library.  Pixel (i, j) covers [i, i+1) x [j, j+1), y down.
#pragma once

#include <cstdint>
#include <vector>

namespace inkgrid {

// A grey drawing: 0 is black, 255 is white, row by row; grey.size() == width * height.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> grey;
  double pixels_per_mm = 0;  // 0 when the file says nothing of its resolution
};

// Section 7, "User control": by how much grid spacing and band reach are scaled at each pixel
// (0.5 under a purple scribble, 2 under an orange one, 1 elsewhere); factor.size() == width * height.
struct ScaleMask {
  int width = 0;
  int height = 0;
  std::vector<float> factor;
};

}  // namespace inkgrid
