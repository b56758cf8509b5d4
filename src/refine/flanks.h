// What:   where chains run side by side, and what is seen of them there.
// Source: ours; see bundles.h.
// Differs: docs/METHOD.md, "Bundles".
// Cost:   linear in the length of the chains times the widest gap.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// A stretch of a chain to one side of which the nearest chain runs nearly parallel, at a distance that changes without jumps.
struct Flank {
  int chain = 0;
  int other = 0;               // the chain opposite the end of the stretch (the neighbour may change at a junction)
  std::vector<Vec2> here;      // px, one a step along the chain
  std::vector<Vec2> opposite;  // px, of the neighbour
  double length = 0;           // px
  double gap = 0;              // px, mean
  double clearance = 0;        // px: median distance to the nearest chain on the other side; infinite where there is none
  int own_ends = 0;            // free ends of the chain beside which the neighbour goes on, 0..2
  int other_ends = 0;          // free ends of the neighbour beside which the chain goes on, 0..2
  int meetings = 0;            // ends of the stretch at which the two chains meet in a junction, 0..2
};

struct FlankOptions {
  double farthest = 0;      // px: what lies further off is no neighbour
  double stroke_width = 0;  // px
  int threads = 0;          // 0: as many as the machine has
};

// Of both sides of every chain.  `chains` lie inside width x height px, parts outside have no neighbours.
std::vector<Flank> find_flanks(const std::vector<Chain>& chains, int width, int height, const FlankOptions& options);

}  // namespace inkgrid
