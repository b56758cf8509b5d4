// What:   junctions where chains cross or touch that share none.
// Source: ours; in the paper isolines meet at grid nodes alone (section 6.3); chains moved onto their ink may cross elsewhere.
// Differs: docs/METHOD.md, "Crossings".
// Cost:   linear in the length of the chains.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// Splits chains where they properly cross another chain or themselves, and joins the parts in a junction there.  A crossing
// within `near` px of a junction that both already share is left alone.
Chains join_crossings(Chains chains, double near);

// Splits chains at their sharp corners that lie within `near` px of another chain, and joins them with it there: a crossing whose
// chains turn into each other's arms is one all the same.
Chains join_touching_corners(Chains chains, double near);

}  // namespace inkgrid
