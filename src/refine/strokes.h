// What:   chains that go straight on into each other at a junction, as the strokes that were drawn.
// Source: ours; the paper's chains end at junctions (section 6.3).
// Differs: docs/METHOD.md, "Ridge".
// Cost:   linear in the chains, but for the branches of a junction, which are tried in pairs.
#pragma once

#include <vector>

#include "graph/chains.h"

namespace inkgrid {

struct StrokePart {
  int chain = -1;
  bool reversed = false;  // whether the stroke runs against the chain
};

// Every chain is part of one stroke.  At a junction the two branches that are most nearly in line are one stroke, if they bend by
// less than 20 degrees there; of the others again the two, and so on.  `span`: over which directions are taken, px; chains
// shorter than that go on into none, and with a span of 0 each chain is a stroke.
std::vector<std::vector<StrokePart>> strokes_of(const std::vector<Chain>& chains, double span);

}  // namespace inkgrid
