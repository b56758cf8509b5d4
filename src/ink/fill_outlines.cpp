#include "ink/fill_outlines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/at.h"
#include "base/contour.h"
#include "base/median.h"
#include "base/polyline.h"

namespace inkgrid {
namespace {

constexpr int kRim = 2;                // px, of paper around a fill that its antialiased edge may reach
constexpr double kSmallestHole = 0.5;  // strokes squared
constexpr double kSpeck = 4;           // px^2: what is smaller is noise, whatever the strokes

struct Box {
  int x0, y0, x1, y1;
};

std::vector<Box> boxes_of(const Fills& fills) {
  const Raster<int>& region = fills.region;
  std::vector<Box> boxes(static_cast<std::size_t>(fills.count), {region.width, region.height, 0, 0});
  for (int y = 0; y < region.height; ++y)
    for (int x = 0; x < region.width; ++x) {
      if (region(x, y) < 0) continue;
      Box& box = boxes[at(region(x, y))];
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
    }
  constexpr int kMargin = kRim + 2;
  for (Box& box : boxes)
    box = {std::max(0, box.x0 - kMargin), std::max(0, box.y0 - kMargin), std::min(region.width - 1, box.x1 + kMargin),
           std::min(region.height - 1, box.y1 + kMargin)};
  return boxes;
}

// The darkness of one fill and of the paper at its rim; strokes are cut off.
Raster<float> darkness_of(int fill, const Box& box, const Fills& fills, const Binarisation& ink) {
  Raster<float> dark(box.x1 - box.x0 + 1, box.y1 - box.y0 + 1, 0.0F);
  for (int y = box.y0; y <= box.y1; ++y)
    for (int x = box.x0; x <= box.x1; ++x) {
      if (fills.region(x, y) != fill) continue;
      for (int j = std::max(box.y0, y - kRim); j <= std::min(box.y1, y + kRim); ++j)
        for (int i = std::max(box.x0, x - kRim); i <= std::min(box.x1, x + kRim); ++i)
          if (fills.region(i, j) == fill || !ink.ink(i, j)) dark(i - box.x0, j - box.y0) = ink.darkness(i, j);
    }
  return dark;
}

float median_darkness(int fill, const Box& box, const Fills& fills, const Binarisation& ink) {
  std::vector<float> values;
  for (int y = box.y0; y <= box.y1; ++y)
    for (int x = box.x0; x <= box.x1; ++x)
      if (fills.region(x, y) == fill) values.push_back(ink.darkness(x, y));
  return median(std::move(values));
}

// Binomial weights 1 2 1 along rows and columns, as wide as a pixel: the steps of a picture of two tones become straight.
void soften(Raster<float>& raster) {
  const auto blurred = [&](auto value_at, int k, int n) {
    return 0.25F * value_at(std::max(0, k - 1)) + 0.5F * value_at(k) + 0.25F * value_at(std::min(n - 1, k + 1));
  };
  Raster<float> rows = raster;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) rows(x, y) = blurred([&](int k) { return raster(k, y); }, x, raster.width);
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) raster(x, y) = blurred([&](int k) { return rows(x, k); }, y, raster.height);
}

std::vector<std::vector<Vec2>> outline_of(int index, const Box& box, const Fills& fills, const Binarisation& ink) {
  Raster<float> dark = darkness_of(index, box, fills, ink);
  soften(dark);
  auto lines = contours_at(dark, 0.5F * median_darkness(index, box, fills, ink));
  if (lines.empty()) return lines;  // ink as light as the paper
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return std::abs(enclosed_area(a)) > std::abs(enclosed_area(b)); });
  const double hole = std::max(kSpeck, kSmallestHole * fills.stroke_width * fills.stroke_width);
  const double outermost = enclosed_area(lines.front());
  std::erase_if(lines, [&](const auto& line) {
    const double area = enclosed_area(line);
    return std::abs(area) < (area * outermost > 0 ? kSpeck : hole);
  });
  for (auto& line : lines)
    for (Vec2& p : line) p += {static_cast<double>(box.x0), static_cast<double>(box.y0)};
  return lines;
}

}  // namespace

void trace_outlines(Fills& fills, const Binarisation& ink) {
  const std::vector<Box> boxes = boxes_of(fills);
  fills.outlines.clear();
  for (int f = 0; f < fills.count; ++f) fills.outlines.push_back(outline_of(f, boxes[at(f)], fills, ink));
}

}  // namespace inkgrid
