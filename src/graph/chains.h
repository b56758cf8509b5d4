// What:   the isolines that strokes follow, joined into chains.
// Source: section 6.3, "Topological graph" and "Curve fitting" up to the fit.
// Differs: docs/METHOD.md, "Chains".
// Cost:   linear in the length of the isolines.
#pragma once

#include <cstdint>
#include <vector>

#include "graph/isolines.h"

namespace inkgrid {

// A sequence of points along one intended curve.
struct Chain {
  std::vector<Vec2> points;  // px; when closed, the last point is the first
  bool closed = false;
  int start_junction = -1;  // index into Chains::junctions, or -1
  int end_junction = -1;
  double width = 0;      // px
  double coverage = 0;   // 0..1
  bool mark = false;     // straight, in the place of ink that no isoline follows
  double confirmed = 0;  // length along which paper bounds it on both sides, px (follow_ridges)
};

struct Chains {
  std::vector<Vec2> junctions;  // px; a chain that starts or ends there has it as its first or last point, to the last digit
  std::vector<Chain> chains;
};

// The same in other units of length.
Chains scaled(Chains chains, double factor);

// Whether the chain ends where it starts: closed, or in one junction.
bool is_loop(const Chain& chain);

// The junction in which the chain starts, or ends; -1 where there is none.
inline int& junction_at(Chain& chain, bool at_start) {
  return at_start ? chain.start_junction : chain.end_junction;
}
inline int junction_at(const Chain& chain, bool at_start) {
  return at_start ? chain.start_junction : chain.end_junction;
}

// The same the other way round.
Chain reversed(Chain chain);

// Only these chains, per chain.
void keep_chains(Chains& chains, const std::vector<std::uint8_t>& kept);

// Only these junctions, per junction; ends at the others become free.
void keep_junctions(Chains& chains, const std::vector<std::uint8_t>& kept);

// Those in which no chain starts or ends.
void drop_unused_junctions(Chains& chains);

// The share of the chain's points that lie on ink.
double ink_coverage(const Chain& chain, const Ink& ink);

// `labels` as spread_labels gives them.
Chains chain_strokes(const IsolineGraph& graph, const BandMesh& mesh, const std::vector<Label>& labels, const Ink& ink);

}  // namespace inkgrid
