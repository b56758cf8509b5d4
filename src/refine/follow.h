// What:   free ends of chains that stop in the middle of a stroke follow it on, to its end or to the next chain.
// Source: ours; in the paper strokes without a supported isoline have no curve.
// Differs: docs/METHOD.md, "Ends".
// Cost:   linear in the length of the chains times the stroke width.
#pragma once

#include "graph/chains.h"
#include "ink/ink.h"

namespace inkgrid {

// The chains, free ends prolonged where their stroke leads on to a free end, for `least` px or more: along the middle of the ink,
// over paper of up to `bridge` px, until that end is less than a stroke width away.  Where the ink ends, or another chain is in
// the way, an end stays where it is.
Chains follow_strokes(Chains chains, const Ink& ink, double bridge, double least);

}  // namespace inkgrid
