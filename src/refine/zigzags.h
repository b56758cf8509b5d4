// What:   chains that go back and forth over the same ink are led straight on.
// Source: ours: where strokes of a bundle begin and end, chains are led from one to the other, and may have to turn back for it.
// Differs: docs/METHOD.md, "Zigzags".
// Cost:   linear in the length of the chains.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// Replaces parts of chains by straight lines where they turn back on their way, the chain goes on in the direction that it came
// from, and all that is left out lies within `width` px of the line.  Loops that wide go, too; closed chains stay as they are.
Chains drop_zigzags(Chains chains, double width);

}  // namespace inkgrid
