#include "refine/crossings.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/polyline.h"

namespace inkgrid {
namespace {

constexpr double kSharp = 0.17;  // cosine: corners turn by more than 80 degrees

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

Chains cut_at(Chains chains, const std::vector<std::vector<Cut>>& cuts) {
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

// Of a corner: the turn between the points `near` px before and behind it, as its cosine.
double turn_at(const std::vector<Vec2>& points, const std::vector<double>& lengths, std::size_t k, double near) {
  const Vec2 p = points[k];
  return dot(unit(p - point_at(points, lengths, lengths[k] - near)), unit(point_at(points, lengths, lengths[k] + near) - p));
}

// The points of a chain at which it turns sharply, each the sharpest within `near` px and further than that from the chain's
// ends.
std::vector<int> sharp_corners(const Chain& chain, double near) {
  const auto& points = chain.points;
  const auto lengths = lengths_along(points);
  std::vector<double> turns(points.size(), 1);
  for (std::size_t k = 0; k < points.size(); ++k)
    if (lengths[k] > near && lengths.back() - lengths[k] > near) turns[k] = turn_at(points, lengths, k, near);
  std::vector<int> corners;
  double last = -near;  // length at the last one
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (turns[k] >= kSharp) continue;
    const bool sharper = !corners.empty() && lengths[k] - last < near;
    if (sharper && turns[k] >= turns[at(corners.back())]) continue;
    if (sharper) corners.pop_back();
    corners.push_back(static_cast<int>(k));
    last = lengths[k];
  }
  return corners;
}

// The place of another chain that is nearest to a point.
struct Touch {
  int chain = -1;
  int segment = 0;
  double parameter = 0;
  Vec2 point;
};

// The nearest one within `near` px, which is the side of the cells of `entries`; none where that chain has an end about there.
Touch nearest_touch(const std::vector<Chain>& chains, const std::vector<Entry>& entries, int except, Vec2 p, double near) {
  Touch best;
  double nearest = near;
  const int column = static_cast<int>(std::floor(p.x / near)), row = static_cast<int>(std::floor(p.y / near));
  for (int y = row - 1; y <= row + 1; ++y) {
    auto entry = std::lower_bound(entries.begin(), entries.end(), Entry{column - 1, y, -1, 0}, before);
    for (; entry != entries.end() && entry->y == y && entry->x <= column + 1; ++entry) {
      if (entry->chain == except || chains[at(entry->chain)].mark) continue;
      const auto& points = chains[at(entry->chain)].points;
      const Vec2 a = points[at(entry->segment)], b = points[at(entry->segment) + 1];
      const double t = nearest_parameter(p, a, b);
      const Vec2 q = lerp(a, b, t);
      if (norm(p - q) < nearest) best = {entry->chain, entry->segment, t, q}, nearest = norm(p - q);
    }
  }
  if (best.chain < 0) return best;
  const Chain& other = chains[at(best.chain)];
  const bool at_end = !other.closed && std::min(norm(other.points.front() - p), norm(other.points.back() - p)) < 2 * near;
  return at_end ? Touch{} : best;
}

std::vector<std::vector<Cut>> touches_of(Chains& chains, double near) {
  std::vector<std::vector<Cut>> cuts(chains.chains.size());
  const auto entries = entries_of(chains.chains, near);
  std::vector<Vec2> found;
  for (int c = 0; c < static_cast<int>(chains.chains.size()); ++c)
    for (const int k : sharp_corners(chains.chains[at(c)], near)) {
      const Vec2 p = chains.chains[at(c)].points[at(k)];
      const Touch touch = nearest_touch(chains.chains, entries, c, p, near);
      const auto close = [&](Vec2 q) { return norm(q - p) < 2 * near; };
      if (touch.chain < 0 || std::any_of(found.begin(), found.end(), close)) continue;
      const int junction = static_cast<int>(chains.junctions.size());
      chains.junctions.push_back(touch.point);
      cuts[at(c)].push_back({k, 0, junction, touch.point});
      cuts[at(touch.chain)].push_back({touch.segment, touch.parameter, junction, touch.point});
      found.push_back(touch.point);
    }
  return cuts;
}

}  // namespace

Chains join_crossings(Chains chains, double near) {
  const auto cuts = cuts_of(chains, std::max(1.0, near), near);
  return cut_at(std::move(chains), cuts);
}

Chains join_touching_corners(Chains chains, double near) {
  const auto cuts = touches_of(chains, near);
  return cut_at(std::move(chains), cuts);
}

}  // namespace inkgrid
