#include "refine/junctions.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/sample.h"
#include "ink/ink.h"
#include "refine/arrival.h"

namespace inkgrid {
namespace {

constexpr double kOnLine = 0.3;   // strokes
constexpr double kOffInk = 0.33;  // of how far a junction may move: so far beside the ink it may lie
constexpr double kStay = 0.005;   // weight of the junction's old place against each branch's line

struct Branch {
  int chain;
  bool at_start;
  Arrival arrival;
};

Vec2 meeting_point(const std::vector<Branch>& branches, Vec2 old, const CornerInk& ink, const JunctionOptions& options) {
  double a = kStay, b = 0, c = kStay;
  Vec2 right = kStay * old;
  int known = 0;
  for (const auto& branch : branches) {
    if (!branch.arrival.known) continue;
    ++known;
    const Vec2 normal = quarter_turn(branch.arrival.direction);
    const double level = dot(normal, branch.arrival.point);
    a += normal.x * normal.x;
    b += normal.x * normal.y;
    c += normal.y * normal.y;
    right += level * normal;
  }
  if (known < 2) return old;
  const double determinant = a * c - b * b;
  const Vec2 found{(c * right.x - b * right.y) / determinant, (a * right.y - b * right.x) / determinant};
  const double moved = norm(found - old);
  if (moved <= options.blot && over_ink(ink.slim, old, found, 1)) return found;
  const Vec2 nearer = moved <= options.near ? found : lerp(old, found, options.near / moved);
  const Vec2 before = old + std::max(0.0, norm(nearer - old) - kOffInk * options.near) * unit(nearer - old);
  const bool leaves_ink = nearest(ink.drawn, old, std::uint8_t{0}) && !nearest(ink.drawn, before, std::uint8_t{0});
  return leaves_ink ? old : nearer;
}

// Shifts the unconfirmed end of the chain, most at its end, so that it ends at `target`.
void bend_end(Chain& chain, const Branch& branch, Vec2 target) {
  const int n = static_cast<int>(chain.points.size());
  const auto index = [&](int k) { return static_cast<std::size_t>(branch.at_start ? k : n - 1 - k); };
  const int last = std::min(n - 1, std::max(1, branch.arrival.known ? branch.arrival.last : n / 2));
  // What the ink does not confirm says less than the line that leads from there to the junction.
  const Vec2 from = chain.points[index(last)], way = target - branch.arrival.point;
  if (branch.arrival.known && std::abs(cross(branch.arrival.direction, way)) < kOnLine * chain.width) {
    for (int k = 0; k < last; ++k) chain.points[index(k)] = lerp(target, from, static_cast<double>(k) / last);
    return;
  }
  const Vec2 shift = target - chain.points[index(0)];
  for (int k = 0; k < last; ++k) chain.points[index(k)] += (1 - static_cast<double>(k) / last) * shift;
  chain.points[index(0)] = target;
}

}  // namespace

Chains locate_junctions(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const CornerInk& ink,
                        const JunctionOptions& options) {
  std::vector<std::vector<Branch>> branches(junctions.size());
  for (int c = 0; c < static_cast<int>(ridges.size()); ++c) {
    const auto& ridge = ridges[at(c)];
    if (ridge.chain.start_junction >= 0) branches[at(ridge.chain.start_junction)].push_back({c, true, arrival_at(ridge, true)});
    if (ridge.chain.end_junction >= 0) branches[at(ridge.chain.end_junction)].push_back({c, false, arrival_at(ridge, false)});
  }
  for (std::size_t j = 0; j < junctions.size(); ++j) {
    junctions[j] = meeting_point(branches[j], junctions[j], ink, options);
    for (const auto& branch : branches[j]) bend_end(ridges[at(branch.chain)].chain, branch, junctions[j]);
  }
  Chains chains{std::move(junctions), {}};
  for (auto& ridge : ridges) chains.chains.push_back(std::move(ridge.chain));
  return chains;
}

}  // namespace inkgrid
