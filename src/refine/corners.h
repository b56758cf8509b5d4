// What:   sharp corners whose tips the grid rounds, cuts, leaves open or takes for branches.
// Source: ours; section 7 names sharp turns among the paper's limitations (Fig. 17).
// Differs: docs/METHOD.md, "Corners".
// Cost:   a few points a chain end, and the ink of the corners.
#pragma once

#include "refine/ridge.h"
#include "refine/tips.h"

namespace inkgrid {

struct ArmsJoined {
  std::vector<RidgeChain> ridges;
  std::vector<Vec2> junctions;
};

// Free ends whose lines meet over ink where no other chain leads through are the arms of a corner, and become one chain, or those
// of a fork: they end in the junction that is there, or in a new one with the chain that ends there or passed it.  Chains in
// their blot that lead nowhere else go.
ArmsJoined join_arms(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const CornerInk& ink,
                     const CornerOptions& options);

// A free chain at a junction of three is the tip of a corner, and dropped, where the other two arrive along lines that meet near
// its end, and no other chain ends beside it.  What two chain ends share, free ends whose lines meet in the ink between them too,
// becomes one chain; and wherever a chain turns over ink that does not confirm it, it goes along the lines of its sides to where
// they meet in the ink.  Junctions keep their numbers, those of two chains are left without any.
std::vector<RidgeChain> open_corners(std::vector<RidgeChain> ridges, const std::vector<Vec2>& junctions, const CornerInk& ink,
                                     const CornerOptions& options);

}  // namespace inkgrid
