#include "ink/specks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/at.h"
#include "ink/pen_strokes.h"
#include "ink/runs.h"

namespace inkgrid {
namespace {

constexpr int kLargest = 100;       // px^2, of paper that shows through
constexpr float kDepthOfInk = 3;    // times the width of the speck, without it and all others
constexpr float kDepthBetween = 1;  // times that, between them: the cells of a hatching are no specks
constexpr float kNear = 2;          // times that, on all sides of it

struct Speck {
  int size = 0;             // px^2
  std::vector<Run> runs{};  // of small ones
};

std::vector<Speck> specks_in(const Raster<std::uint8_t>& ink) {
  const std::vector<Run> runs = runs_of(ink, 0);
  UnionFind pieces = pieces_of(runs, true);
  std::vector<Speck> specks(runs.size());
  for (int i = 0; i < static_cast<int>(runs.size()); ++i) specks[at(pieces.find(i))].size += runs[at(i)].pixels();
  for (int i = 0; i < static_cast<int>(runs.size()); ++i)
    if (Speck& speck = specks[at(pieces.find(i))]; speck.size <= kLargest) speck.runs.push_back(runs[at(i)]);
  std::erase_if(specks, [](const Speck& speck) { return speck.runs.empty(); });
  return specks;
}

float width_of(const Speck& speck) {
  return std::sqrt(static_cast<float>(speck.size));
}

void paint(const Speck& speck, std::uint8_t value, Raster<std::uint8_t>& ink) {
  for (const Run& run : speck.runs)
    std::fill_n(ink.data.begin() + static_cast<std::ptrdiff_t>(ink.index(run.first, run.y)), run.pixels(), value);
}

float greatest(const Raster<float>& depth, const Speck& speck) {
  float most = 0;
  for (const Run& run : speck.runs)
    for (int x = run.first; x <= run.last; ++x) most = std::max(most, depth(x, run.y));
  return most;
}

// The same in the box around it, with two of its widths on all sides.
float greatest_near(const Raster<float>& depth, const Speck& speck) {
  const int margin = static_cast<int>(kNear * width_of(speck));
  Run box = speck.runs.front();
  for (const Run& run : speck.runs) box = {box.y, std::min(box.first, run.first), std::max(box.last, run.last)};
  float most = 0;
  for (int y = std::max(0, box.y - margin); y <= std::min(depth.height - 1, speck.runs.back().y + margin); ++y)
    for (int x = std::max(0, box.first - margin); x <= std::min(depth.width - 1, box.last + margin); ++x)
      most = std::max(most, depth(x, y));
  return most;
}

}  // namespace

Raster<std::uint8_t> close_specks(const Raster<std::uint8_t>& ink) {
  Raster<std::uint8_t> closed = ink;
  std::vector<Speck> specks = specks_in(ink);
  if (specks.empty()) return closed;
  const auto pixels = static_cast<std::ptrdiff_t>(ink.data.size()), paper = std::count(ink.data.begin(), ink.data.end(), 0);
  for (const Speck& speck : specks) paint(speck, 1, closed);
  const bool none_left = std::find(closed.data.begin(), closed.data.end(), 0) == closed.data.end();
  if (none_left && 2 * paper > pixels) return ink;  // the sheet of a drawing so small that it has no more
  const auto reopen = [&](const Raster<std::uint8_t>& mask, auto depth_at, float widths) {
    const Raster<float> depth = depth_of(mask);
    std::erase_if(specks, [&](const Speck& speck) {
      const bool open = depth_at(depth, speck) <= widths * width_of(speck);
      if (open) paint(speck, 0, closed);
      return open;
    });
  };
  reopen(closed, greatest, kDepthOfInk);
  if (!specks.empty()) reopen(ink, greatest_near, kDepthBetween);
  return closed;
}

}  // namespace inkgrid
