#include "refine/leftovers.h"

#include <algorithm>
#include <cmath>

#include "base/polyline.h"
#include "refine/ownership.h"

namespace inkgrid {
namespace {

// Pixels of one piece of ink, and the moments of their centres.
struct Piece {
  std::vector<Vec2> pixels;
  bool reached = false;
};

Piece collect_piece(const Ink& ink, const IndexRaster& owner, Raster<std::uint8_t>& seen, int x0, int y0) {
  Piece piece;
  std::vector<std::pair<int, int>> stack{{x0, y0}};
  seen(x0, y0) = 1;
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    stack.pop_back();
    piece.pixels.push_back({x + 0.5, y + 0.5});
    piece.reached = piece.reached || owner(x, y) >= 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (!ink.mask.contains(x + dx, y + dy) || !ink.mask(x + dx, y + dy) || seen(x + dx, y + dy)) continue;
        seen(x + dx, y + dy) = 1;
        stack.emplace_back(x + dx, y + dy);
      }
  }
  return piece;
}

// A straight mark through the centroid along the longer principal axis, half the piece's breadth inside its ends.
Chain mark_of(const Piece& piece) {
  Vec2 centre;
  for (const Vec2 p : piece.pixels) centre += p;
  centre = centre / static_cast<double>(piece.pixels.size());
  double xx = 0, xy = 0, yy = 0;
  for (const Vec2 p : piece.pixels) {
    const Vec2 d = p - centre;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const Vec2 axis{std::cos(angle), std::sin(angle)};
  double along = 0, across = 0;
  for (const Vec2 p : piece.pixels) {
    along = std::max(along, std::abs(dot(axis, p - centre)) + 0.5);
    across = std::max(across, std::abs(cross(axis, p - centre)) + 0.5);
  }
  const double half = std::max(0.05, along - across);
  Chain chain;
  chain.points = resampled({centre - half * axis, centre + half * axis}, 1);
  chain.width = 2 * across;
  chain.coverage = 1;
  chain.mark = true;
  return chain;
}

}  // namespace

Chains mark_leftovers(Chains chains, const Ink& ink, double reach) {
  const Ownership ownership = assign_ink(chains.chains, ink, reach);
  Raster<std::uint8_t> seen(ink.width(), ink.height());
  for (int y = 0; y < ink.height(); ++y)
    for (int x = 0; x < ink.width(); ++x) {
      if (!ink.mask(x, y) || seen(x, y)) continue;
      const Piece piece = collect_piece(ink, ownership.owner, seen, x, y);
      if (!piece.reached) chains.chains.push_back(mark_of(piece));
    }
  return chains;
}

int count_dashes(const Chains& chains, double stroke_width) {
  return static_cast<int>(std::count_if(chains.chains.begin(), chains.chains.end(), [&](const Chain& chain) {
    return chain.mark && lengths_along(chain.points).back() > 2 * stroke_width;
  }));
}

}  // namespace inkgrid
