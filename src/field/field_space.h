// What:   the unknowns of the frame field: the points of a lattice twice as coarse as the band's, with linear elements.
// Source: section 6.1, "Computation".
// Differs: docs/METHOD.md, "Frame field".
// Cost:   linear.
#pragma once

#include <array>
#include <vector>

#include "ink/band_mesh.h"

namespace inkgrid {

struct FieldSpace {
  int size = 0;
  // Per vertex: its value is the mean of the values at these two nodes; the same one twice where it is one itself.
  std::vector<std::array<int, 2>> nodes;
};

// Every vertex is a node.
FieldSpace vertex_space(const BandMesh& mesh);

// Nodes are the lattice points with even coordinates; every other vertex is the middle between two of them.  Points of the
// coarse lattice are one node only where the band connects the vertices that share them.  A mesh that lies on no lattice has its
// vertices.
FieldSpace coarse_space(const BandMesh& mesh);

}  // namespace inkgrid
