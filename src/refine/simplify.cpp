#include "refine/simplify.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/at.h"
#include "base/polyline.h"
#include "base/sample.h"
#include "base/union_find.h"
#include "graph/dissolve.h"

namespace inkgrid {
namespace {

constexpr double kLeastBin = 1.5;    // px, the diagonal of a pixel
constexpr double kTiny = 2;          // px
constexpr double kPaperStep = 0.25;  // px
constexpr double kStraightOn = 0.8;  // cosine of the angle between a stroke and what goes on from it

double length_of(const Chain& chain) {
  return lengths_along(chain.points).back();
}

// How far a chain that links junctions leads from one to the other; a loop, how far it leads there and back.
double link_length(const Chain& chain) {
  if (chain.start_junction != chain.end_junction) return length_of(chain);
  double furthest = 0;
  for (const Vec2 p : chain.points) furthest = std::max(furthest, norm(p - chain.points.front()));
  return 2 * furthest;
}

// Number of chain ends at each junction.
std::vector<int> degrees(const Chains& chains) {
  std::vector<int> degree(chains.junctions.size(), 0);
  for (const auto& chain : chains.chains)
    for (const int j : {chain.start_junction, chain.end_junction})
      if (j >= 0) ++degree[at(j)];
  return degree;
}

// Unites junctions over short chains, the shortest first, while a group stays small.
UnionFind linked_junctions(const Chains& chains, const std::vector<int>& links, double widest) {
  UnionFind groups(static_cast<int>(chains.junctions.size()));
  std::vector<std::pair<Vec2, Vec2>> extent;
  for (const Vec2 p : chains.junctions) extent.emplace_back(p, p);
  for (const int i : links) {
    const auto& c = chains.chains[at(i)];
    const auto a = static_cast<std::size_t>(groups.find(c.start_junction)),
               b = static_cast<std::size_t>(groups.find(c.end_junction));
    const Vec2 low{std::min(extent[a].first.x, extent[b].first.x), std::min(extent[a].first.y, extent[b].first.y)};
    const Vec2 high{std::max(extent[a].second.x, extent[b].second.x), std::max(extent[a].second.y, extent[b].second.y)};
    if (norm(high - low) > widest) continue;
    extent[a] = extent[b] = {low, high};
    groups.unite(c.start_junction, c.end_junction);
  }
  return groups;
}

// Of chains between two junctions those that are short enough to be none, the shortest first.
std::vector<int> short_links(const std::vector<Chain>& chains, double link, double bare_link) {
  std::vector<int> links;
  std::vector<double> length;
  for (int i = 0; i < static_cast<int>(chains.size()); ++i) {
    const auto& c = chains[at(i)];
    length.push_back(link_length(c));
    if (c.start_junction < 0 || c.end_junction < 0) continue;
    if (length.back() < link || (length.back() < bare_link && c.confirmed < 0.25 * link)) links.push_back(i);
  }
  std::stable_sort(links.begin(), links.end(), [&](int a, int b) { return length[at(a)] < length[at(b)]; });
  return links;
}

// The junctions of a group become one in their middle, where the chains that are left meet.
void unite_junctions(Chains& chains, UnionFind& groups) {
  std::vector<Vec2> sum(chains.junctions.size());
  std::vector<int> count(chains.junctions.size(), 0);
  for (int j = 0; j < static_cast<int>(chains.junctions.size()); ++j) {
    const auto root = static_cast<std::size_t>(groups.find(j));
    sum[root] += chains.junctions[at(j)];
    ++count[root];
  }
  for (auto& c : chains.chains)
    for (const bool at_start : {true, false}) {
      int& j = junction_at(c, at_start);
      if (j < 0) continue;
      j = groups.find(j);
      const auto root = static_cast<std::size_t>(j);
      if (count[root] > 1) chains.junctions[root] = (at_start ? c.points.front() : c.points.back()) = sum[root] / count[root];
    }
}

void collapse_links(Chains& chains, double link, double bare_link) {
  const std::vector<int> links = short_links(chains.chains, link, bare_link);
  UnionFind groups = linked_junctions(chains, links, 1.5 * std::max(link, bare_link));
  std::vector<std::uint8_t> kept(chains.chains.size(), 1);
  for (const int i : links) {
    const auto& c = chains.chains[at(i)];
    kept[at(i)] = groups.find(c.start_junction) != groups.find(c.end_junction);
  }
  keep_chains(chains, kept);
  unite_junctions(chains, groups);
}

// What is left of the chains, and the junctions that these leave.
Chains kept_chains(Chains chains, const std::vector<std::uint8_t>& alive) {
  keep_chains(chains, alive);
  return dissolve_junctions(std::move(chains));
}

// A chain has no more bins than pixels can fill.
int bins_of(double length, int most) {
  return std::clamp(static_cast<int>(length / kLeastBin), 1, most);
}

}  // namespace

Chains drop_uncovered(Chains chains, const InkBands& bands, int bins, double reach) {
  const InkBand& band = bands.of(reach);
  const Ownership ownership = assign_ink(chains.chains, band);
  std::vector<int> histogram(chains.chains.size() * static_cast<std::size_t>(bins), 0);
  std::vector<std::vector<double>> lengths;
  for (const auto& c : chains.chains) lengths.push_back(lengths_along(c.points));
  for (std::size_t i = 0; i < ownership.owners.size(); ++i) {
    const int owner = ownership.owners[i];
    if (owner < 0 || !bands.ink().mask(band.pixels()[i].x, band.pixels()[i].y)) continue;
    const auto s = ownership.samples[at(owner)];
    const auto& l = lengths[at(s.chain)];
    const double parameter = l.back() > 0 ? l[at(s.point)] / l.back() : 0;
    const int own = bins_of(l.back(), bins), bin = std::min(own - 1, static_cast<int>(parameter * own));
    ++histogram[at(s.chain * bins + bin)];
  }
  std::vector<std::uint8_t> alive(chains.chains.size(), 1);
  for (std::size_t c = 0; c < chains.chains.size(); ++c) {
    const auto begin = histogram.begin() + static_cast<std::ptrdiff_t>(c) * bins;
    const auto end = begin + bins_of(lengths[c].back(), bins);
    // Between junctions there may be no room for a pixel.
    const bool tiny = lengths[c].back() < kTiny && std::min(chains.chains[c].start_junction, chains.chains[c].end_junction) >= 0;
    alive[c] = tiny || std::find(begin, end, 0) == end;
  }
  return kept_chains(std::move(chains), alive);
}

namespace {

// All points of all chains, binned so that neighbours are found at once.
class PointBins {
 public:
  // `chains` must live as long and stay as they are.
  PointBins(const std::vector<Chain>& chains, double cell) : chains_(chains), cell_(cell) {
    for (int c = 0; c < static_cast<int>(chains.size()); ++c)
      for (int k = 0; k < static_cast<int>(chains[at(c)].points.size()); ++k) {
        const Vec2 p = chains[at(c)].points[at(k)];
        entries_.push_back({column(p.x), column(p.y), c, k});
      }
    std::sort(entries_.begin(), entries_.end(), before);
  }

  // Whether a point of another chain that is still alive is within `distance` (at most the cell size) of point k of the chain
  // and runs the same way, to an angle of this cosine.
  bool has_companion(int chain, int k, const std::vector<std::uint8_t>& alive, double distance, double cosine) const {
    const Vec2 p = chains_[at(chain)].points[at(k)];
    for (int y = column(p.y) - 1; y <= column(p.y) + 1; ++y) {
      auto it = std::lower_bound(entries_.begin(), entries_.end(), Entry{column(p.x) - 1, y, -1, -1}, before);
      for (; it != entries_.end() && it->y == y && it->x <= column(p.x) + 1; ++it)
        if (it->chain != chain && alive[at(it->chain)] &&
            norm2(chains_[at(it->chain)].points[at(it->point)] - p) <= distance * distance &&
            (cosine <= 0 || std::abs(dot(direction(it->chain, it->point), direction(chain, k))) >= cosine))
          return true;
    }
    return false;
  }

 private:
  struct Entry {
    int x, y, chain, point;
  };
  static bool before(const Entry& a, const Entry& b) {
    if (a.y != b.y) return a.y < b.y;
    return a.x != b.x ? a.x < b.x : a.chain < b.chain;
  }
  int column(double v) const { return static_cast<int>(std::floor(v / cell_)); }
  Vec2 direction(int chain, int k) const { return tangent_at(chains_[at(chain)].points, k, 2, false); }

  const std::vector<Chain>& chains_;
  double cell_;
  std::vector<Entry> entries_;
};

// Of two chains that stand for the same ink the longer one is to stay.
std::vector<int> shortest_first(const std::vector<Chain>& chains) {
  std::vector<int> order(chains.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> length(chains.size());
  std::transform(chains.begin(), chains.end(), length.begin(), length_of);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return length[at(a)] < length[at(b)]; });
  return order;
}

}  // namespace

Chains drop_doubles(Chains chains, double distance) {
  for (auto& c : chains.chains) c.points = resampled(c.points, 0.5 * distance);
  const PointBins bins(chains.chains, distance);
  std::vector<std::uint8_t> alive(chains.chains.size(), 1);
  for (const int c : shortest_first(chains.chains)) {
    const auto& points = chains.chains[at(c)].points;
    int doubled = 0;
    for (int k = 0; k < static_cast<int>(points.size()); ++k) doubled += bins.has_companion(c, k, alive, distance, 0.8);
    if (7 * doubled >= 6 * static_cast<int>(points.size())) alive[at(c)] = 0;
  }
  return kept_chains(std::move(chains), alive);
}

Chains drop_spurs(Chains chains, double share) {
  const auto degree = degrees(chains);
  std::vector<double> widest(chains.junctions.size(), 0);
  for (const auto& c : chains.chains)
    for (const int j : {c.start_junction, c.end_junction})
      if (j >= 0) widest[at(j)] = std::max(widest[at(j)], c.width);
  double widest_of_all = 0;
  for (const auto& c : chains.chains) widest_of_all = std::max(widest_of_all, c.width);
  if (widest_of_all <= 0) return chains;
  const PointBins bins(chains.chains, share * widest_of_all);
  std::vector<std::uint8_t> alive(chains.chains.size(), 1);
  for (const int i : shortest_first(chains.chains)) {
    const Chain& c = chains.chains[at(i)];
    const int j = std::max(c.start_junction, c.end_junction);
    if (c.closed || std::min(c.start_junction, c.end_junction) >= 0) continue;
    if (j >= 0 && degree[at(j)] < 3) continue;
    const double distance = share * (j >= 0 ? widest[at(j)] : c.width);
    bool accompanied = true;
    for (int k = 0; accompanied && k < static_cast<int>(c.points.size()); ++k)
      accompanied = bins.has_companion(i, k, alive, distance, 0);
    alive[at(i)] = !accompanied;
  }
  return kept_chains(std::move(chains), alive);
}

namespace {

// First point and point after the last of each stretch of more than `longest` px on paper; the points are kPaperStep apart.
std::vector<std::pair<std::size_t, std::size_t>> paper_stretches(const std::vector<Vec2>& points, const Ink& ink,
                                                                 double longest) {
  std::vector<std::pair<std::size_t, std::size_t>> stretches;
  std::size_t begin = 0;
  for (std::size_t k = 0; k <= points.size(); ++k) {
    if (k < points.size() && !nearest(ink.mask, points[k], std::uint8_t{0})) continue;
    if (static_cast<double>(k - begin) * kPaperStep > longest) stretches.emplace_back(begin, k);
    begin = k + 1;
  }
  return stretches;
}

// Whether a chain leads over paper, but for what lies beyond the end of a stroke that it went along before.
bool is_rung(const Chain& chain, const Ink& ink, const RungOptions& options) {
  const auto points = resampled(chain.points, kPaperStep);
  const auto stretches = paper_stretches(points, ink, options.bridge);
  if (stretches.size() != 1) return !stretches.empty();
  const auto [begin, end] = stretches.front();
  const bool beyond_end = (begin == 0 && chain.start_junction < 0) || (end == points.size() && chain.end_junction < 0);
  return !beyond_end || kPaperStep * static_cast<double>(points.size() - (end - begin)) < options.stroke;
}

}  // namespace

Chains drop_rungs(Chains chains, const Ink& ink, const RungOptions& options) {
  std::vector<std::uint8_t> alive(chains.chains.size(), 1);
  for (std::size_t i = 0; i < chains.chains.size(); ++i) {
    const Chain& c = chains.chains[i];
    if (std::max(c.start_junction, c.end_junction) < 0 || length_of(c) > options.longest) continue;
    alive[i] = !is_rung(c, ink, options);
  }
  return kept_chains(std::move(chains), alive);
}

namespace {

// Whether the line through the middles of a row of pixels finds paper inside the loop (even-odd).
bool encloses_paper(const Chain& loop, const Ink& ink) {
  double low = loop.points.front().y, high = low;
  for (const Vec2 p : loop.points) low = std::min(low, p.y), high = std::max(high, p.y);
  for (int y = std::max(0, static_cast<int>(low)); y <= std::min(ink.height() - 1, static_cast<int>(high)); ++y) {
    const double level = y + 0.5;
    std::vector<double> crossings;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const Vec2 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
      if ((a.y > level) != (b.y > level)) crossings.push_back(a.x + (level - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      for (int x = std::max(0, static_cast<int>(std::ceil(crossings[i] - 0.5)));
           x < std::min<double>(ink.width(), crossings[i + 1] - 0.5); ++x)
        if (!ink.mask(x, y)) return true;
  }
  return false;
}

}  // namespace

Chains drop_blot_loops(Chains chains, const Ink& ink) {
  std::vector<std::uint8_t> alive(chains.chains.size(), 1);
  for (std::size_t i = 0; i < chains.chains.size(); ++i)
    alive[i] = !is_loop(chains.chains[i]) || encloses_paper(chains.chains[i], ink);
  return kept_chains(std::move(chains), alive);
}

Chains cut_on_paper(Chains chains, const Ink& ink, double longest) {
  std::vector<Chain> kept;
  for (auto& chain : chains.chains) {
    const auto points = resampled(chain.points, kPaperStep);
    const auto stretches = paper_stretches(points, ink, longest);
    if (stretches.empty()) {
      kept.push_back(std::move(chain));
      continue;
    }
    Chain piece = chain;
    piece.closed = false;
    std::size_t from = 0;
    const auto keep = [&](std::size_t to, bool last) {
      piece.points.assign(points.begin() + static_cast<std::ptrdiff_t>(from), points.begin() + static_cast<std::ptrdiff_t>(to));
      piece.end_junction = last ? chain.end_junction : -1;
      if (piece.points.size() > 1) kept.push_back(piece);
      piece.start_junction = -1;
    };
    for (const auto& [begin, end] : stretches) {
      keep(begin, false);
      from = end;
    }
    keep(points.size(), true);
  }
  chains.chains = std::move(kept);
  return dissolve_junctions(std::move(chains));
}

namespace {

// From the junction into the chain, over `span` px.
Vec2 departure(const Chain& chain, bool at_start, double span) {
  const auto lengths = lengths_along(chain.points);
  const double s = std::min(span, lengths.back());
  const Vec2 from = at_start ? chain.points.front() : chain.points.back();
  return unit(point_at(chain.points, lengths, at_start ? s : lengths.back() - s) - from);
}

}  // namespace

Chains drop_overshoots(Chains chains, double longest) {
  std::vector<std::vector<std::pair<int, Vec2>>> branches(chains.junctions.size());
  for (int c = 0; c < static_cast<int>(chains.chains.size()); ++c) {
    const Chain& chain = chains.chains[at(c)];
    for (const bool at_start : {true, false}) {
      const int j = junction_at(chain, at_start);
      if (j >= 0) branches[at(j)].emplace_back(c, departure(chain, at_start, longest));
    }
  }
  std::vector<std::uint8_t> alive(chains.chains.size(), 1);
  for (const auto& here : branches) {
    if (here.size() < 3) continue;
    for (const auto& [c, direction] : here) {
      const Chain& chain = chains.chains[at(c)];
      if (std::min(chain.start_junction, chain.end_junction) >= 0 || length_of(chain) > longest) continue;
      const bool goes_on = std::any_of(here.begin(), here.end(), [&, c = c, direction = direction](const auto& other) {
        return other.first != c && dot(other.second, direction) < -kStraightOn;
      });
      if (goes_on) alive[at(c)] = 0;
    }
  }
  return kept_chains(std::move(chains), alive);
}

Chains merge_junctions(Chains chains, double link, double bare_link) {
  collapse_links(chains, link, bare_link);
  return dissolve_junctions(std::move(chains));
}

}  // namespace inkgrid
