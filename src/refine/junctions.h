// What:   junctions where the middles of their branches meet, and chains that end in them exactly.
// Source: ours; the paper takes grid nodes (section 6.3).
// Differs: docs/METHOD.md, "Junctions".
// Cost:   linear in the number of junctions.
#pragma once

#include <vector>

#include "refine/ridge.h"
#include "refine/tips.h"

namespace inkgrid {

struct JunctionOptions {
  double near = 6;   // how far a junction may move, px
  double blot = 25;  // the same over ink: strokes of a sharp fork share it for long
};

// Moves each junction to the point nearest to the lines along which its branches arrive, and bends the ends of the chains into
// it.
Chains locate_junctions(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const CornerInk& ink,
                        const JunctionOptions& options);

}  // namespace inkgrid
