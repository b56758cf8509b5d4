#include "arrival.h"

#include <algorithm>

namespace inkgrid {

Arrival arrival_at(const RidgeChain& ridge, bool at_start) {
  const int n = static_cast<int>(ridge.chain.points.size());
  const auto index = [&](int k) { return static_cast<std::size_t>(at_start ? k : n - 1 - k); };
  Arrival arrival;
  int k = 0;
  while (k < n && ridge.sections[index(k)].weight <= 0) ++k;
  if (k >= n - 2) return arrival;
  // Direction over about a stroke width of confirmed points.
  const double span = std::max(2.0, ridge.chain.width);
  int far = k + 1;
  while (far + 1 < n && norm(ridge.chain.points[index(far)] - ridge.chain.points[index(k)]) < span) ++far;
  arrival = {true, ridge.chain.points[index(k)], unit(ridge.chain.points[index(k)] - ridge.chain.points[index(far)]), k};
  return arrival;
}

}  // namespace inkgrid
