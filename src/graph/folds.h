// What:   the isolines without the crossings that only a fold of the map makes.
// Source: section 4, last paragraph, and section 7 on parametric inversions; how to undo them is ours.
// Differs: the paper keeps what Ebke et al. extract (docs/METHOD.md, "Isolines").
// Cost:   linear in the graph, and in the length of what is merged.
#pragma once

#include "graph/isolines.h"

namespace inkgrid {

// Where the map folds, a u and a v isoline meet there and back: forward, backward, forward.  Two nodes that the same two isolines
// join twice, both ways turning back to the same grid point, are removed together; the isolines pass each other there, and keep
// their paths.  Every remaining grid node keeps its four ports.
IsolineGraph remove_folds(IsolineGraph graph, const BandMesh& mesh, const ExactMap& map);

}  // namespace inkgrid
