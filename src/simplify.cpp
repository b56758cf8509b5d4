#include "simplify.h"

#include <algorithm>

#include "base/union_find.h"
#include "ends.h"
#include "ownership.h"
#include "polyline.h"

namespace inkgrid {
namespace {

double length_of(const Chain& chain) {
  return lengths_along(chain.points).back();
}

int& junction_at(Chain& chain, bool at_start) {
  return at_start ? chain.start_junction : chain.end_junction;
}

void move_end(Chain& chain, bool at_start, Vec2 target) {
  (at_start ? chain.points.front() : chain.points.back()) = target;
}

// Number of chain ends at each junction.
std::vector<int> degrees(const Chains& chains) {
  std::vector<int> degree(chains.junctions.size(), 0);
  for (const auto& chain : chains.chains)
    for (const int j : {chain.start_junction, chain.end_junction})
      if (j >= 0) ++degree[static_cast<std::size_t>(j)];
  return degree;
}

void drop_spurs(Chains& chains, double spur) {
  const auto degree = degrees(chains);
  const auto is_spur = [&](const Chain& c) {
    const int j = std::max(c.start_junction, c.end_junction);
    if (c.closed || j < 0 || std::min(c.start_junction, c.end_junction) >= 0) return false;
    return degree[static_cast<std::size_t>(j)] >= 3 && length_of(c) < spur;
  };
  std::erase_if(chains.chains, is_spur);
}

void collapse_links(Chains& chains, double link) {
  UnionFind groups(static_cast<int>(chains.junctions.size()));
  const auto is_link = [&](const Chain& c) { return c.start_junction >= 0 && c.end_junction >= 0 && length_of(c) < link; };
  for (const auto& c : chains.chains)
    if (is_link(c)) groups.unite(c.start_junction, c.end_junction);
  std::erase_if(chains.chains, is_link);
  std::vector<Vec2> sum(chains.junctions.size());
  std::vector<int> count(chains.junctions.size(), 0);
  for (int j = 0; j < static_cast<int>(chains.junctions.size()); ++j) {
    const auto root = static_cast<std::size_t>(groups.find(j));
    sum[root] += chains.junctions[static_cast<std::size_t>(j)];
    ++count[root];
  }
  for (auto& c : chains.chains)
    for (const bool at_start : {true, false}) {
      int& j = junction_at(c, at_start);
      if (j < 0) continue;
      j = groups.find(j);
      const auto root = static_cast<std::size_t>(j);
      if (count[root] > 1) chains.junctions[root] = sum[root] / count[root];
      if (count[root] > 1) move_end(c, at_start, sum[root] / count[root]);
    }
}

}  // namespace

Chains drop_uncovered(Chains chains, const Ink& ink, int bins) {
  const Ownership ownership = assign_ink(chains.chains, ink, 0);
  std::vector<int> histogram(chains.chains.size() * static_cast<std::size_t>(bins), 0);
  std::vector<std::vector<double>> lengths;
  for (const auto& c : chains.chains) lengths.push_back(lengths_along(c.points));
  for (std::size_t i = 0; i < ownership.owner.data.size(); ++i) {
    const int owner = ownership.owner.data[i];
    if (owner < 0 || !ink.mask.data[i]) continue;
    const auto s = ownership.samples[static_cast<std::size_t>(owner)];
    const auto& l = lengths[static_cast<std::size_t>(s.chain)];
    const double parameter = l.back() > 0 ? l[static_cast<std::size_t>(s.point)] / l.back() : 0;
    const int bin = std::min(bins - 1, static_cast<int>(parameter * bins));
    ++histogram[static_cast<std::size_t>(s.chain * bins + bin)];
  }
  std::vector<Chain> kept;
  for (std::size_t c = 0; c < chains.chains.size(); ++c) {
    const auto begin = histogram.begin() + static_cast<std::ptrdiff_t>(c) * bins;
    if (std::find(begin, begin + bins, 0) == begin + bins) kept.push_back(std::move(chains.chains[c]));
  }
  chains.chains = std::move(kept);
  return dissolve_junctions(std::move(chains));
}

Chains merge_junctions(Chains chains, double spur, double link) {
  drop_spurs(chains, spur);
  collapse_links(chains, link);
  return dissolve_junctions(std::move(chains));
}

}  // namespace inkgrid
