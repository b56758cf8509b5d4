// How often values occur, in bins of one width; what lies outside is counted in the first and the last.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace inkgrid {

struct Histogram {
  std::vector<long> count;
  float low, scale;

  Histogram(int bins, float from, float to)
      : count(static_cast<std::size_t>(bins)), low(from), scale(static_cast<float>(bins) / (to - from)) {}
  void add(float value) {
    ++count[static_cast<std::size_t>(std::clamp((value - low) * scale, 0.0f, static_cast<float>(count.size() - 1)))];
  }
  // The value below which the given fraction of the samples in [from, to) lies; `from` when there are none.
  double quantile(double fraction, double from, double to) const {
    const auto bin = [&](double v) {
      return static_cast<std::size_t>(std::clamp((v - low) * scale, 0.0, static_cast<double>(count.size())));
    };
    const std::size_t first = bin(from), last = bin(to);
    long total = 0, seen = 0;
    for (std::size_t i = first; i < last; ++i) total += count[i];
    if (total == 0) return from;
    std::size_t i = first;
    for (; i + 1 < last && static_cast<double>(seen += count[i]) < fraction * static_cast<double>(total);) ++i;
    return low + (static_cast<double>(i) + 0.5) / scale;
  }
};

}  // namespace inkgrid
