// What:   sliding-window filters over a raster, separable, with a cost that does not depend on the window.
// Source: textbook (van Herk 1992, running sum).
// Differs: nothing.
// Cost:   O(pixels).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/raster.h"

namespace inkgrid {

constexpr int kLinesTogether = 16;  // so that pixels that lie side by side are read one after the other

// Applies `filter(line)` to every row, then to every column; a line is a std::vector<float> changed in place.
template <class Filter>
void filter_lines(Raster<float>& raster, Filter filter) {
  std::vector<float> row(static_cast<std::size_t>(raster.width));
  for (int y = 0; y < raster.height; ++y) {
    const auto pixels = raster.data.begin() + static_cast<std::ptrdiff_t>(raster.index(0, y));
    std::copy_n(pixels, raster.width, row.begin());
    filter(row);
    std::copy(row.begin(), row.end(), pixels);
  }
  std::vector<std::vector<float>> columns(kLinesTogether, std::vector<float>(static_cast<std::size_t>(raster.height)));
  for (int first = 0; first < raster.width; first += kLinesTogether) {
    const int count = std::min(kLinesTogether, raster.width - first);
    for (int y = 0; y < raster.height; ++y)
      for (int k = 0; k < count; ++k) columns[at(k)][at(y)] = raster(first + k, y);
    for (int k = 0; k < count; ++k) filter(columns[at(k)]);
    for (int y = 0; y < raster.height; ++y)
      for (int k = 0; k < count; ++k) raster(first + k, y) = columns[at(k)][at(y)];
  }
}

// The same along the diagonals: down to the right, then down to the left.
template <class Filter>
void filter_diagonals(Raster<float>& raster, Filter filter) {
  const int w = raster.width, h = raster.height;
  std::vector<std::vector<float>> lines(kLinesTogether);
  for (const int side : {1, -1})
    for (int first = 1 - h; first < w; first += kLinesTogether) {  // where a diagonal meets row 0, from its own side
      const int count = std::min(kLinesTogether, w - first);
      const auto for_each_pixel = [&](auto visit) {
        for (int y = std::max(0, 1 - first - count); y < std::min(h, w - first); ++y)
          for (int k = std::max(0, -first - y); k < std::min(count, w - first - y); ++k)
            visit(lines[at(k)], at(y - std::max(0, -first - k)), raster(side > 0 ? first + k + y : w - 1 - first - k - y, y));
      };
      for (int k = 0; k < count; ++k) {
        const int start = first + k;
        lines[at(k)].resize(at(std::min(h - std::max(0, -start), w - std::max(0, start))));
      }
      for_each_pixel([](std::vector<float>& line, std::size_t i, float pixel) { line[i] = pixel; });
      for (int k = 0; k < count; ++k) filter(lines[at(k)]);
      for_each_pixel([](const std::vector<float>& line, std::size_t i, float& pixel) { pixel = line[i]; });
    }
}

// The extreme of each window of 2 radius + 1 values under `before` (std::greater: the largest); the window ends at the line's
// ends.
template <class Before>
void slide_extreme(std::vector<float>& line, int radius, Before before) {
  // The line is cut into pieces as long as the window (van Herk 1992): each window is the end of one and the start of the next.
  const std::size_t n = line.size(), reach = static_cast<std::size_t>(radius), window = 2 * reach + 1;
  const auto better = [&](float a, float b) { return before(b, a) ? b : a; };
  std::vector<float> from_start(n + 2 * reach, line.front());
  std::copy(line.begin(), line.end(), from_start.begin() + radius);
  std::fill(from_start.end() - radius, from_start.end(), line.back());
  std::vector<float> to_end = from_start;
  for (std::size_t i = 1; i < from_start.size(); ++i)
    if (i % window != 0) from_start[i] = better(from_start[i - 1], from_start[i]);
  for (std::size_t i = to_end.size() - 1; i > 0; --i)
    if (i % window != 0) to_end[i - 1] = better(to_end[i], to_end[i - 1]);
  for (std::size_t i = 0; i < n; ++i) line[i] = better(to_end[i], from_start[i + 2 * reach]);
}

template <class Before>
Raster<float> window_extreme(Raster<float> raster, int radius, Before before) {
  filter_lines(raster, [&](std::vector<float>& line) { slide_extreme(line, radius, before); });
  return raster;
}

// The sum over each window of 2 radius + 1 values, nothing outside the line.
inline void slide_sum(std::vector<float>& line, int radius) {
  const std::size_t n = line.size(), reach = static_cast<std::size_t>(radius);
  const std::vector<float> value = line;
  double sum = 0;
  for (std::size_t i = 0; i < std::min(n, reach); ++i) sum += value[i];
  for (std::size_t i = 0; i < n; ++i) {
    if (i + reach < n) sum += value[i + reach];
    if (i > reach) sum -= value[i - reach - 1];
    line[i] = static_cast<float>(sum);
  }
}

// A smooth field through samples known only in places, given as sums of values and of weights on a grid: means over ever
// smaller neighbourhoods, each falling back on the larger one where it knows little.
class SmoothField {
 public:
  // full_weight: that of a place about which everything is known.
  SmoothField(Raster<float> weight, float full_weight) : weight_(std::move(weight)) {
    for (const int radius : {64, 16, 4})
      scales_.push_back(
          {radius, 0.02f * full_weight * std::pow(2.0f * static_cast<float>(radius) + 1.0f, 4.0f), blur(weight_, radius)});
  }

  // The mean of what the field still misses is added again: a slope that ends at the border of the grid or of the samples
  // would else come out flat.
  Raster<float> through(const Raster<float>& sum) const {
    Raster<float> field = mean(sum);
    for (int round = 0; round < 2; ++round) {
      Raster<float> missing = sum;
      for (std::size_t i = 0; i < sum.data.size(); ++i) missing.data[i] -= weight_.data[i] * field.data[i];
      missing = mean(missing);
      for (std::size_t i = 0; i < sum.data.size(); ++i) field.data[i] += missing.data[i];
    }
    return field;
  }

 private:
  struct Scale {
    int radius;
    float prior;  // weight of the larger scale
    Raster<float> weight;
  };

  static Raster<float> blur(Raster<float> raster, int radius) {
    filter_lines(raster, [&](std::vector<float>& line) {
      slide_sum(line, radius);
      slide_sum(line, radius);
    });
    return raster;
  }

  Raster<float> mean(const Raster<float>& sum) const {
    const double total = std::accumulate(sum.data.begin(), sum.data.end(), 0.0);
    const double weight = std::accumulate(weight_.data.begin(), weight_.data.end(), 0.0);
    Raster<float> field(sum.width, sum.height, static_cast<float>(weight > 0 ? total / weight : 0.0));
    for (const Scale& scale : scales_) {
      const Raster<float> near = blur(sum, scale.radius);
      for (std::size_t i = 0; i < field.data.size(); ++i)
        field.data[i] = (near.data[i] + scale.prior * field.data[i]) / (scale.weight.data[i] + scale.prior);
    }
    return field;
  }

  Raster<float> weight_;
  std::vector<Scale> scales_;
};

}  // namespace inkgrid
