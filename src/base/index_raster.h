// A raster of indices, -1 where there is none; it takes memory only around those that are set.
#pragma once

#include "base/raster.h"
#include "base/sample.h"

namespace inkgrid {

class IndexRaster {
 public:
  IndexRaster() = default;
  IndexRaster(int width, int height) : numbers_(width, height) {}

  int width() const { return numbers_.width; }
  int height() const { return numbers_.height; }
  bool contains(int x, int y) const { return numbers_.contains(x, y); }
  // Of the pixel: its number in the order of a raster.
  std::size_t place(int x, int y) const { return numbers_.index(x, y); }

  int operator()(int x, int y) const { return numbers_(x, y) - 1; }
  int operator[](std::size_t place) const { return numbers_.data[place] - 1; }
  // Of the pixel that covers p; -1 beyond the border.
  int at(Vec2 p) const { return nearest(numbers_, p, 0) - 1; }

  void set(int x, int y, int index) { numbers_(x, y) = index + 1; }
  void set(std::size_t place, int index) { numbers_.data[place] = index + 1; }

 private:
  Raster<int> numbers_;  // from 1
};

}  // namespace inkgrid
