// What:   junctions that are none: those where fewer than three chain ends meet.
// Source: section 6.3, "Topological graph": chains go on through nodes of two edges; here where others have gone.
// Cost:   linear in the length of the chains, times the branches of a junction.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// Where two ends meet, the chains become one, or a chain closed; where there is but one, it becomes free.
Chains dissolve_junctions(Chains chains);

}  // namespace inkgrid
