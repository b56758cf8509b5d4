#include "graph/dissolve.h"

#include <algorithm>
#include <utility>

#include "base/at.h"

namespace inkgrid {
namespace {

struct ChainEnd {
  int chain;
  bool at_start;
};

// By chain, starts first.
std::pair<int, bool> rank(ChainEnd end) {
  return {end.chain, !end.at_start};
}

class Dissolver {
 public:
  explicit Dissolver(Chains chains) : chains_(std::move(chains)), ends_(chains_.junctions.size()) { collect_ends(); }

  Chains run() {
    for (const auto& ends : ends_) {
      if (ends.size() == 1) junction_at(chain(ends[0].chain), ends[0].at_start) = -1;
      if (ends.size() == 2) join(ends[0], ends[1]);
    }
    std::erase_if(chains_.chains, [](const Chain& chain) { return chain.points.size() < 2; });
    collect_ends();
    std::vector<std::uint8_t> joins;
    for (const auto& ends : ends_) joins.push_back(ends.size() >= 2);
    keep_junctions(chains_, joins);
    return std::move(chains_);
  }

 private:
  Chain& chain(int c) { return chains_.chains[at(c)]; }

  void collect_ends() {
    for (auto& ends : ends_) ends.clear();
    for (int c = 0; c < static_cast<int>(chains_.chains.size()); ++c)
      for (const bool at_start : {true, false})
        if (const int junction = junction_at(chain(c), at_start); junction >= 0) ends_[at(junction)].push_back({c, at_start});
  }

  // In the list of the junction, which keeps its order.
  void rename_end(int junction, ChainEnd from, ChainEnd to) {
    if (junction < 0) return;
    auto& ends = ends_[at(junction)];
    std::erase_if(ends, [&](ChainEnd end) { return rank(end) == rank(from); });
    ends.insert(std::find_if(ends.begin(), ends.end(), [&](ChainEnd end) { return rank(end) > rank(to); }), to);
  }

  // Into the chain of `a`; that of `b` is left without points.
  void join(ChainEnd a, ChainEnd b) {
    Chain &first = chain(a.chain), &second = chain(b.chain);
    if (a.chain == b.chain) {
      first.closed = true;
      first.start_junction = first.end_junction = -1;
      first.points.back() = first.points.front();
      return;
    }
    if (a.at_start) {
      rename_end(first.end_junction, {a.chain, false}, {a.chain, true});
      first = reversed(std::move(first));
    }
    if (!b.at_start) second = reversed(std::move(second));
    rename_end(second.end_junction, {b.chain, !b.at_start}, {a.chain, false});
    first.points.insert(first.points.end(), second.points.begin() + 1, second.points.end());
    first.end_junction = second.end_junction;
    second.points.clear();
    second.start_junction = second.end_junction = -1;
  }

  Chains chains_;
  std::vector<std::vector<ChainEnd>> ends_;  // per junction
};

}  // namespace

Chains dissolve_junctions(Chains chains) {
  return Dissolver(std::move(chains)).run();
}

}  // namespace inkgrid
