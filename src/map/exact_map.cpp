#include "map/exact_map.h"

#include <cmath>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"

namespace inkgrid {
namespace {

// Beyond this a coordinate is the trace of a failed solve; kept away from it, sums of coordinates and shifts never overflow.
constexpr double kLargestCoordinate = 0x1p30;  // grid units

std::int64_t rounded(double value, double units_per_grid) {
  return std::abs(value) < kLargestCoordinate ? std::llround(value * units_per_grid) : 0;  // NaN compares false
}

std::int64_t regular_coordinate(double value) {
  const std::int64_t fixed = rounded(value, static_cast<double>(kFixedOne));
  return fixed % kFixedOne == 0 ? fixed + 1 : fixed;
}

std::int64_t half_integer_coordinate(double value) {
  return rounded(value, 2) * (kFixedOne / 2);
}

// `exact` has the shifts of the corners.
void place_corners(const GridMap& map, ExactMap& exact) {
  std::vector<IVec2> base(map.base.size());
  for (std::size_t v = 0; v < base.size(); ++v) {
    const Vec2 b = map.base[v];
    base[v] = map.half_integer[v] ? IVec2{half_integer_coordinate(b.x), half_integer_coordinate(b.y)}
                                  : IVec2{regular_coordinate(b.x), regular_coordinate(b.y)};
  }
  for (std::size_t c = 0; c < exact.uv.size(); ++c)
    exact.uv[c] = turned(base[at(map.corner_base[c])], map.corner_turn[c]) + kFixedOne * exact.uv[c];
}

}  // namespace

ExactMap round_map(const GridMap& map, int threads) {
  ExactMap exact;
  const auto copy_and_place_corners = [&] {
    exact.uv = map.corner_shift;
    place_corners(map, exact);
  };
  at_once(threads, copy_and_place_corners, [&] { exact.transitions = map.transitions; });
  return exact;
}

ExactMap round_map(GridMap&& map) {
  GridMap taken = std::move(map);
  ExactMap exact{std::move(taken.corner_shift), std::move(taken.transitions)};
  place_corners(taken, exact);
  return exact;
}

}  // namespace inkgrid
