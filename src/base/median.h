// The median of values, of which there is one at least: where their number is even, the greater of the two in the middle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace inkgrid {

template <class T>
T median(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace inkgrid
