#include "ink/specks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/at.h"
#include "base/union_find.h"
#include "ink/pen_strokes.h"

namespace inkgrid {
namespace {

constexpr int kLargest = 100;       // px^2, of paper that shows through
constexpr float kDepthOfInk = 3;    // times the width of the speck, without it and all others
constexpr float kDepthBetween = 1;  // times that, between them: the cells of a hatching are no specks
constexpr float kNear = 2;          // times that, on all sides of it

// Pixels x0 .. x1 - 1 of a row, all of them paper.
struct Run {
  int y, x0, x1;
};

std::vector<Run> runs_of_paper(const Raster<std::uint8_t>& ink) {
  std::vector<Run> runs;
  for (int y = 0; y < ink.height; ++y) {
    const std::uint8_t* const row = &ink.data[ink.index(0, y)];
    for (int x = 0; x < ink.width;) {
      const int first = static_cast<int>(std::find(row + x, row + ink.width, 0) - row);
      x = static_cast<int>(std::find_if(row + first, row + ink.width, [](auto pixel) { return pixel != 0; }) - row);
      if (first < x) runs.push_back({y, first, x});
    }
  }
  return runs;
}

// Joins the runs of neighbouring rows that touch, corners included.
UnionFind joined(const std::vector<Run>& runs) {
  const int count = static_cast<int>(runs.size());
  UnionFind pieces(count);
  for (int above = 0, i = 0; i < count; ++i) {
    const Run& run = runs[at(i)];
    while (runs[at(above)].y < run.y - 1 || (runs[at(above)].y == run.y - 1 && runs[at(above)].x1 < run.x0)) ++above;
    for (int k = above; runs[at(k)].y == run.y - 1 && runs[at(k)].x0 <= run.x1; ++k) pieces.unite(k, i);
  }
  return pieces;
}

struct Speck {
  int size = 0;             // px^2
  std::vector<Run> runs{};  // of small ones
};

std::vector<Speck> specks_in(const Raster<std::uint8_t>& ink) {
  const std::vector<Run> runs = runs_of_paper(ink);
  UnionFind pieces = joined(runs);
  std::vector<Speck> specks(runs.size());
  for (int i = 0; i < static_cast<int>(runs.size()); ++i) specks[at(pieces.find(i))].size += runs[at(i)].x1 - runs[at(i)].x0;
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
    std::fill(ink.data.begin() + static_cast<std::ptrdiff_t>(ink.index(run.x0, run.y)),
              ink.data.begin() + static_cast<std::ptrdiff_t>(ink.index(run.x1, run.y)), value);
}

float greatest(const Raster<float>& depth, const Speck& speck) {
  float most = 0;
  for (const Run& run : speck.runs)
    for (int x = run.x0; x < run.x1; ++x) most = std::max(most, depth(x, run.y));
  return most;
}

// The same in the box around it, with two of its widths on all sides.
float greatest_near(const Raster<float>& depth, const Speck& speck) {
  const int margin = static_cast<int>(kNear * width_of(speck));
  Run box = speck.runs.front();
  for (const Run& run : speck.runs) box = {box.y, std::min(box.x0, run.x0), std::max(box.x1, run.x1)};
  float most = 0;
  for (int y = std::max(0, box.y - margin); y <= std::min(depth.height - 1, speck.runs.back().y + margin); ++y)
    for (int x = std::max(0, box.x0 - margin); x < std::min(depth.width, box.x1 + margin); ++x)
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
