#include "ink/runs.h"

#include <algorithm>

#include "base/at.h"

namespace inkgrid {

std::vector<Run> runs_of(const Raster<std::uint8_t>& mask, std::uint8_t value) {
  std::vector<Run> runs;
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* const row = &mask.data[mask.index(0, y)];
    const std::uint8_t* const end = row + mask.width;
    for (const std::uint8_t* pixel = row; pixel < end;) {
      const std::uint8_t* const first = std::find(pixel, end, value);
      pixel = std::find_if(first, end, [&](std::uint8_t p) { return p != value; });
      if (first < pixel) runs.push_back({y, static_cast<int>(first - row), static_cast<int>(pixel - row) - 1});
    }
  }
  return runs;
}

UnionFind pieces_of(const std::vector<Run>& runs, bool corners) {
  const int reach = corners ? 1 : 0, count = static_cast<int>(runs.size());
  UnionFind pieces(count);
  for (int above = 0, i = 0; i < count; ++i) {
    const Run& run = runs[at(i)];
    while (runs[at(above)].y + 1 < run.y || (runs[at(above)].y < run.y && runs[at(above)].last + reach < run.first)) ++above;
    for (int k = above; k < i && runs[at(k)].y < run.y && runs[at(k)].first <= run.last + reach; ++k) pieces.unite(k, i);
  }
  return pieces;
}

}  // namespace inkgrid
