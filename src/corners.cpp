#include "corners.h"

#include <cmath>
#include <optional>

#include "arrival.h"
#include "polyline.h"

namespace inkgrid {
namespace {

constexpr double kGoesOn = 0.4;  // cosine of the angle between a side and the tip: more is a branch

struct End {
  int chain;
  bool at_start;
};

// Where both sides arrive, if ahead of them.
std::optional<Vec2> meeting_of(const Arrival& a, const Arrival& b) {
  const double sine = cross(a.direction, b.direction);
  if (!a.known || !b.known || std::abs(sine) < 0.05) return std::nullopt;
  const double ahead = cross(b.point - a.point, b.direction) / sine, ahead_b = cross(b.point - a.point, a.direction) / sine;
  if (ahead < 0 || ahead_b < 0) return std::nullopt;
  return a.point + ahead * a.direction;
}

bool is_tip(const std::vector<RidgeChain>& ridges, const End& stub, const std::vector<End>& ends, double longest, double near) {
  const Chain& chain = ridges[static_cast<std::size_t>(stub.chain)].chain;
  if ((stub.at_start ? chain.end_junction : chain.start_junction) >= 0 || lengths_along(chain.points).back() > longest)
    return false;
  const Vec2 tip = stub.at_start ? chain.points.back() : chain.points.front();
  std::vector<Arrival> sides;
  for (const End& e : ends)
    if (e.chain != stub.chain) sides.push_back(arrival_at(ridges[static_cast<std::size_t>(e.chain)], e.at_start));
  if (sides.size() != 2) return false;
  const auto meeting = meeting_of(sides[0], sides[1]);
  const Vec2 outward = unit(tip - (stub.at_start ? chain.points.front() : chain.points.back()));
  const auto goes_on = [&](const Arrival& side) { return dot(side.direction, outward) > kGoesOn; };
  return meeting && norm(*meeting - tip) < near && goes_on(sides[0]) && goes_on(sides[1]);
}

}  // namespace

std::vector<RidgeChain> open_corners(std::vector<RidgeChain> ridges, int junctions, double longest, double near) {
  std::vector<std::vector<End>> ends(static_cast<std::size_t>(junctions));
  for (int c = 0; c < static_cast<int>(ridges.size()); ++c) {
    const Chain& chain = ridges[static_cast<std::size_t>(c)].chain;
    if (chain.start_junction >= 0) ends[static_cast<std::size_t>(chain.start_junction)].push_back({c, true});
    if (chain.end_junction >= 0) ends[static_cast<std::size_t>(chain.end_junction)].push_back({c, false});
  }
  std::vector<bool> dropped(ridges.size(), false);
  for (const auto& at : ends) {
    if (at.size() != 3) continue;
    for (const End& stub : at)
      if (is_tip(ridges, stub, at, longest, near)) dropped[static_cast<std::size_t>(stub.chain)] = true;
  }
  std::vector<RidgeChain> kept;
  for (std::size_t c = 0; c < ridges.size(); ++c)
    if (!dropped[c]) kept.push_back(std::move(ridges[c]));
  return kept;
}

}  // namespace inkgrid
