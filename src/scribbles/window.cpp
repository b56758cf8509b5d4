#include "scribbles/window.h"

#include <algorithm>

namespace inkgrid {
namespace {

constexpr int kMargin = 8;  // px around what is reached, where the blurred ink is read

}  // namespace

Ink window_of(const Ink& ink, const TouchedPart& part) {
  const PixelBox box = with_margin(part.box, kMargin, ink.width(), ink.height());
  Ink window;
  window.mask = cropped(ink.mask, box);
  window.darkness = cropped(ink.darkness, box);
  window.depth = cropped(ink.depth, box);
  window.gap = cropped(ink.gap, box);
  window.rise = cropped(ink.rise, box);
  const auto is_reached = [&](int x, int y) { return distance_at(part, {box.x0 + x + 0.5, box.y0 + y + 0.5}) < kUnreached; };
  for (int y = 0; y < window.height(); ++y)
    for (int x = 0; x < window.width(); ++x)
      if (!is_reached(x, y)) window.mask(x, y) = 0;
  const Raster<float> gap = distance_to(window.mask);
  for (int y = 0; y < window.height(); ++y)
    for (int x = 0; x < window.width(); ++x)
      if (!is_reached(x, y)) window.gap(x, y) = gap(x, y);
  window.stroke_width = ink.stroke_width;
  window.pixels = static_cast<long>(std::count(window.mask.data.begin(), window.mask.data.end(), std::uint8_t{1}));
  window.threshold = ink.threshold;
  window.inverted = ink.inverted;
  window.enlargement = ink.enlargement;
  window.origin = ink.origin + Vec2{static_cast<double>(box.x0), static_cast<double>(box.y0)};
  return window;
}

ScaleMask window_of(const ScaleMask& mask, const TouchedPart& part) {
  const PixelBox box = with_margin(part.box, kMargin, mask.width, mask.height);
  ScaleMask window{box.width(), box.height(), {}};
  for (int y = box.y0; y < box.y1; ++y) {
    const auto row = mask.factor.begin() + static_cast<std::ptrdiff_t>(y) * mask.width;
    window.factor.insert(window.factor.end(), row + box.x0, row + box.x1);
  }
  return window;
}

}  // namespace inkgrid
