// What:   lenses, lines that part and meet again because two strokes of one line were not drawn on each other, become one line.
// Source: ours; in the paper the user's scribbles say where the grid is to be coarser (section 7).
// Differs: docs/METHOD.md, "Lenses".
// Cost:   linear in the length of the chains.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// Two chains between the same two junctions, not further apart than strokes of one line are (`stroke_width`, px) and leaving the
// junctions in much the same direction, become the line in their middle, where nothing else than that line goes on at both ends.
Chains join_lenses(Chains chains, double stroke_width);

}  // namespace inkgrid
