#include "refine/crossings.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/polyline.h"

namespace inkgrid {
namespace {

// A segment of a chain, and the cell of the plane that it is listed in.
struct Entry {
  int x, y;
  int chain;
  int segment;
};

bool before(const Entry& a, const Entry& b) {
  if (a.y != b.y) return a.y < b.y;
  if (a.x != b.x) return a.x < b.x;
  return a.chain != b.chain ? a.chain < b.chain : a.segment < b.segment;
}

// Where a chain is to be cut.
struct Cut {
  int segment;
  double parameter;  // on the segment, 0..1
  int junction;
  Vec2 point;
};

std::vector<Entry> entries_of(const std::vector<Chain>& chains, double cell) {
  std::vector<Entry> entries;
  const auto index = [cell](double v) { return static_cast<int>(std::floor(v / cell)); };
  for (int c = 0; c < static_cast<int>(chains.size()); ++c) {
    const auto& points = chains[at(c)].points;
    for (int s = 0; s + 1 < static_cast<int>(points.size()); ++s) {
      const Vec2 a = points[at(s)], b = points[at(s) + 1];
      for (int y = index(std::min(a.y, b.y)); y <= index(std::max(a.y, b.y)); ++y)
        for (int x = index(std::min(a.x, b.x)); x <= index(std::max(a.x, b.x)); ++x) entries.push_back({x, y, c, s});
    }
  }
  std::sort(entries.begin(), entries.end(), before);
  return entries;
}

bool near_end(const Chain& chain, int junction, Vec2 p, double near) {
  return junction >= 0 && ((chain.start_junction == junction && norm(chain.points.front() - p) < near) ||
                           (chain.end_junction == junction && norm(chain.points.back() - p) < near));
}

bool already_meet(const Chain& a, const Chain& b, Vec2 p, double near) {
  for (const int j : {a.start_junction, a.end_junction})
    if (near_end(a, j, p, near) && near_end(b, j, p, near)) return true;
  return false;
}

bool neighbours(const Chain& chain, int s, int t) {
  const int count = static_cast<int>(chain.points.size()) - 1;
  const int apart = std::abs(s - t);
  return apart <= 1 || (chain.closed && apart >= count - 1);
}

std::vector<std::vector<Cut>> cuts_of(Chains& chains, double cell, double near) {
  std::vector<std::vector<Cut>> cuts(chains.chains.size());
  const auto entries = entries_of(chains.chains, cell);
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t k = i + 1; k < entries.size() && entries[k].x == entries[i].x && entries[k].y == entries[i].y; ++k) {
      const Entry &e = entries[i], &f = entries[k];
      const Chain &a = chains.chains[at(e.chain)], &b = chains.chains[at(f.chain)];
      if (e.chain == f.chain && neighbours(a, e.segment, f.segment)) continue;
      const auto s = static_cast<std::size_t>(e.segment), t = static_cast<std::size_t>(f.segment);
      const auto found = crossing(a.points[s], a.points[s + 1], b.points[t], b.points[t + 1]);
      if (!found) continue;
      const Vec2 p = lerp(a.points[s], a.points[s + 1], found->first);
      // A crossing lies in one cell, though its segments may share several.
      if (static_cast<int>(std::floor(p.x / cell)) != e.x || static_cast<int>(std::floor(p.y / cell)) != e.y) continue;
      if (already_meet(a, b, p, near)) continue;
      const int junction = static_cast<int>(chains.junctions.size());
      chains.junctions.push_back(p);
      cuts[at(e.chain)].push_back({e.segment, found->first, junction, p});
      cuts[at(f.chain)].push_back({f.segment, found->second, junction, p});
    }
  return cuts;
}

void add_piece(Chain piece, Vec2 end, int junction, std::vector<Chain>& pieces) {
  if (!(piece.points.back() == end) || piece.points.size() < 2) piece.points.push_back(end);
  piece.end_junction = junction;
  pieces.push_back(std::move(piece));
}

// The parts between the cuts; those of a closed chain begin at its first cut.
std::vector<Chain> split(const Chain& chain, std::vector<Cut> cuts) {
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
    if (a.segment != b.segment) return a.segment < b.segment;
    return a.parameter != b.parameter ? a.parameter < b.parameter : a.junction < b.junction;
  });
  std::vector<Chain> pieces;
  Chain piece = chain;
  piece.closed = false;
  piece.points = {chain.points.front()};
  std::size_t from = 1;
  for (const Cut& cut : cuts) {
    for (; from <= static_cast<std::size_t>(cut.segment); ++from) piece.points.push_back(chain.points[from]);
    add_piece(piece, cut.point, cut.junction, pieces);
    piece.points = {cut.point};
    piece.start_junction = cut.junction;
  }
  piece.points.insert(piece.points.end(), chain.points.begin() + static_cast<std::ptrdiff_t>(from), chain.points.end());
  if (chain.closed) {
    const Chain first = std::move(pieces.front());
    pieces.erase(pieces.begin());
    piece.points.insert(piece.points.end(), first.points.begin() + 1, first.points.end());
    add_piece(std::move(piece), cuts.front().point, cuts.front().junction, pieces);
  } else {
    add_piece(std::move(piece), chain.points.back(), chain.end_junction, pieces);
  }
  return pieces;
}

}  // namespace

Chains join_crossings(Chains chains, double near) {
  const auto cuts = cuts_of(chains, std::max(1.0, near), near);
  std::vector<Chain> result;
  for (std::size_t c = 0; c < chains.chains.size(); ++c) {
    if (cuts[c].empty()) {
      result.push_back(std::move(chains.chains[c]));
      continue;
    }
    auto pieces = split(chains.chains[c], cuts[c]);
    std::move(pieces.begin(), pieces.end(), std::back_inserter(result));
  }
  chains.chains = std::move(result);
  return chains;
}

}  // namespace inkgrid
