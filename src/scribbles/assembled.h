// What:   the drawing's mesh with its scribbled parts put in, and what was solved on it: as if it had been solved at once.
// Source: section 7, "User control".
// Differs: docs/METHOD.md, "Scribbles".
// Cost:   linear in the mesh.
#pragma once

#include "scribbles/parts.h"

namespace inkgrid {

// As build_band would describe it.
BandMesh assembled_mesh(const Stages& stages);

// For pictures: mesh, field, charts, labels, exact map and isolines with the parts put in; the rest as it is.
Stages assembled(const Stages& stages);

}  // namespace inkgrid
