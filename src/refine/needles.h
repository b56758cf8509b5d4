// What:   chains that turn back on themselves and again are led past it.
// Source: ours: where the sides of an acute corner are one blot, its middle may be walked more than once.
// Differs: docs/METHOD.md, "Corners".
// Cost:   linear in the length of the chains, but for the few places where they turn back.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// Leaves out, of each chain, up to `longest` px between two places that are at most `distance` apart and in which the chain
// turns back, where the rest of the chain is nowhere further away than that: what is left stands for the same ink.
Chains drop_needles(Chains chains, double distance, double longest);

// Leaves out loops in which a chain crosses itself and that are too short to go around paper: up to three of the pen that drew
// the chain; and chains from a junction to itself around less than a pen's dot.  The tips of acute corners, whose sides cross,
// are none.  `slimmed`: what was taken from the width of the strokes, px.
Chains drop_knots(Chains chains, double slimmed);

// Chains that pass a junction by at most `distance`, turn back within the last `longest` px, next to it or at most
// `distance` from another chain, and end in it, go there on their way.
Chains drop_hooks(Chains chains, double distance, double longest);

}  // namespace inkgrid
