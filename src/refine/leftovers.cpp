#include "refine/leftovers.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/polyline.h"
#include "base/sample.h"
#include "refine/ownership.h"

namespace inkgrid {
namespace {

// Per pixel of the band: whether it is one of a chain, or leads to one.
std::vector<std::uint8_t> reached_pixels(const std::vector<Chain>& chains, const InkBand& band) {
  std::vector<std::uint8_t> reached(band.pixels().size(), 0);
  std::vector<int> queue;
  const auto reach = [&](int number) {
    if (reached[at(number)]) return;
    reached[at(number)] = 1;
    queue.push_back(number);
  };
  for (const Chain& chain : chains)
    for (const Vec2 p : chain.points)
      if (const int number = band.number(floor_of(p.x), floor_of(p.y)); number >= 0) reach(number);
  for (std::size_t k = 0; k < queue.size(); ++k)
    band.for_each_around(queue[k], [&](int other, std::size_t, std::size_t) { reach(other); });
  return reached;
}

// The centres of the pixels of one piece of ink that are not done yet.
std::vector<Vec2> collect_piece(const Ink& ink, const InkBand& band, std::vector<std::uint8_t>& done, int first) {
  std::vector<Vec2> piece;
  std::vector<int> stack{first};
  done[at(first)] = 1;
  while (!stack.empty()) {
    const int number = stack.back();
    const auto [x, y] = band.pixels()[at(number)];
    stack.pop_back();
    piece.push_back({x + 0.5, y + 0.5});
    band.for_each_around(number, [&](int other, std::size_t, std::size_t) {
      const auto beside = band.pixels()[at(other)];
      if (!ink.mask(beside.x, beside.y) || done[at(other)]) return;
      done[at(other)] = 1;
      stack.push_back(other);
    });
  }
  return piece;
}

// A straight mark through the centroid along the longer principal axis, half the piece's breadth inside its ends.
Chain mark_of(const std::vector<Vec2>& piece) {
  Vec2 centre;
  for (const Vec2 p : piece) centre += p;
  centre = centre / static_cast<double>(piece.size());
  double xx = 0, xy = 0, yy = 0;
  for (const Vec2 p : piece) {
    const Vec2 d = p - centre;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const Vec2 axis{std::cos(angle), std::sin(angle)};
  double along = 0, across = 0;
  for (const Vec2 p : piece) {
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
  const InkBand band(ink, reach);
  std::vector<std::uint8_t> done = reached_pixels(chains.chains, band);
  for (int k = 0; k < static_cast<int>(done.size()); ++k) {
    const auto [x, y] = band.pixels()[at(k)];
    if (ink.mask(x, y) && !done[at(k)]) chains.chains.push_back(mark_of(collect_piece(ink, band, done, k)));
  }
  return chains;
}

int count_dashes(const Chains& chains, double stroke_width) {
  return static_cast<int>(std::count_if(chains.chains.begin(), chains.chains.end(), [&](const Chain& chain) {
    return chain.mark && lengths_along(chain.points).back() > 2 * stroke_width;
  }));
}

}  // namespace inkgrid
