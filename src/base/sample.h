// Reading rasters between pixel centres.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/raster.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

// The integer below v, which must fit; without a call into the mathematics library.
constexpr int floor_of(double v) {
  const int towards_zero = static_cast<int>(v);
  return towards_zero - (v < towards_zero);
}

// Bilinear between pixel centres, constant beyond the border; value(x, y) is that of a pixel.
template <class Value>
double bilinear(int width, int height, Vec2 p, const Value& value) {
  const double x = std::clamp(p.x - 0.5, 0.0, width - 1.0), y = std::clamp(p.y - 0.5, 0.0, height - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
  const double fx = x - x0, fy = y - y0;
  const auto at = [&](int i, int j) { return static_cast<double>(value(i, j)); };
  return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x1, y0)) + fy * ((1 - fx) * at(x0, y1) + fx * at(x1, y1));
}

template <class T>
double bilinear(const Raster<T>& r, Vec2 p) {
  return bilinear(r.width, r.height, p, r);
}

// The value of the pixel that covers p; `outside` beyond the border.
template <class T>
T nearest(const Raster<T>& r, Vec2 p, T outside) {
  const int x = floor_of(p.x), y = floor_of(p.y);
  return r.contains(x, y) ? r(x, y) : outside;
}

// The value of the pixel nearest to p, which may lie beyond the border.
template <class T>
T nearest_inside(const Raster<T>& r, Vec2 p) {
  const auto pixel = [](double v, int size) { return std::clamp(floor_of(v), 0, size - 1); };
  return r(pixel(p.x, r.width), pixel(p.y, r.height));
}

}  // namespace inkgrid
