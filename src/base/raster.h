// A dense 2-D array, row by row; pixel (x, y) covers [x, x+1) x [y, y+1).
#pragma once

#include <cstddef>

#include "base/pixels.h"

namespace inkgrid {

template <class T>
struct Raster {
  int width = 0;
  int height = 0;
  Pixels<T> data;

  Raster() = default;
  Raster(int w, int h, T value = T())
      : width(w), height(h), data(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  T& operator()(int x, int y) { return data[index(x, y)]; }
  const T& operator()(int x, int y) const { return data[index(x, y)]; }
};

}  // namespace inkgrid
