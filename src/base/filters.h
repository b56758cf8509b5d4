// What:   sliding-window filters over a raster, separable, with a cost that does not depend on the window.
// Source: textbook (monotone queue, running sum).
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

// Applies `filter(line)` to every row, then to every column; a line is a std::vector<float> changed in place.
template <class Filter>
void filter_lines(Raster<float>& raster, Filter filter) {
  std::vector<float> line(static_cast<std::size_t>(raster.width));
  for (int y = 0; y < raster.height; ++y) {
    const auto row = raster.data.begin() + static_cast<std::ptrdiff_t>(raster.index(0, y));
    std::copy_n(row, raster.width, line.begin());
    filter(line);
    std::copy(line.begin(), line.end(), row);
  }
  line.resize(static_cast<std::size_t>(raster.height));
  for (int x = 0; x < raster.width; ++x) {
    for (int y = 0; y < raster.height; ++y) line[at(y)] = raster(x, y);
    filter(line);
    for (int y = 0; y < raster.height; ++y) raster(x, y) = line[at(y)];
  }
}

// The same along the diagonals: down to the right, then down to the left.
template <class Filter>
void filter_diagonals(Raster<float>& raster, Filter filter) {
  const int w = raster.width, h = raster.height;
  std::vector<float> line;
  for (const int step : {1, -1})
    for (int start = 1 - h; start < w; ++start) {  // where the diagonal meets row 0, from its own side
      const int top = std::max(0, -start), length = std::min(h - top, w - std::max(0, start));
      const auto pixel = [&](int k) -> float& {
        const int x = start + top + k;
        return raster(step > 0 ? x : w - 1 - x, top + k);
      };
      line.resize(at(length));
      for (int k = 0; k < length; ++k) line[at(k)] = pixel(k);
      filter(line);
      for (int k = 0; k < length; ++k) pixel(k) = line[at(k)];
    }
}

// The extreme of each window of 2 radius + 1 values under `before` (std::greater: the largest); the window ends at the line's
// ends.
template <class Before>
void slide_extreme(std::vector<float>& line, int radius, Before before) {
  const std::size_t n = line.size(), reach = static_cast<std::size_t>(radius);
  const std::vector<float> value = line;
  std::vector<std::size_t> queue(n);  // positions whose values are in order: the front is the extreme of the window
  std::size_t front = 0, back = 0;
  for (std::size_t i = 0; i < n + reach; ++i) {
    if (i < n) {
      while (back > front && !before(value[queue[back - 1]], value[i])) --back;
      queue[back++] = i;
    }
    if (i < reach) continue;
    while (queue[front] + 2 * reach < i) ++front;
    line[i - reach] = value[queue[front]];
  }
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
