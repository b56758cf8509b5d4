// What:   junctions where the middles of their branches meet, and chains that end in them exactly.
// Source: ours; the paper takes grid nodes (section 6.3).
// Differs: docs/METHOD.md, "Junctions".
// Cost:   linear in the number of junctions.
#pragma once

#include <vector>

#include "ridge.h"

namespace inkgrid {

// Moves each junction to the point nearest to the lines along which its branches arrive, and bends the ends of the chains into
// it. A junction never moves by more than `farthest` px.
Chains locate_junctions(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, double farthest);

}  // namespace inkgrid
