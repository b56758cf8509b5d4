// Rectangles of pixels.
#pragma once

#include <algorithm>

#include "base/raster.h"

namespace inkgrid {

// Pixels x0 .. x1 - 1, y0 .. y1 - 1.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

// What lies within `margin` px of the box, of a raster of this size.
inline PixelBox with_margin(const PixelBox& box, int margin, int width, int height) {
  return {std::max(0, box.x0 - margin), std::max(0, box.y0 - margin), std::min(width, box.x1 + margin),
          std::min(height, box.y1 + margin)};
}

// The part of a raster in the box.
template <class T>
Raster<T> cropped(const Raster<T>& whole, const PixelBox& box) {
  Raster<T> part(box.width(), box.height());
  for (int y = 0; y < part.height; ++y)
    std::copy_n(&whole.data[whole.index(box.x0, box.y0 + y)], part.width, &part.data[part.index(0, y)]);
  return part;
}

}  // namespace inkgrid
