// What:   the linear system of the frame field: its energy as a quadratic form over the nodes of a field space.
// Source: section 6.1, "Computation".
// Differs: real instead of complex, by a change of unknowns; docs/METHOD.md, "Frame field".
// Cost:   linear in the pixels and the mesh.
#pragma once

#include <complex>
#include <vector>

#include "field/field_space.h"
#include "numerics/pair_ldl.h"

namespace inkgrid {

// With c0 = p + i q and c2 = p - i q, alignment to the direction tau is  |tau^4 + c2 tau^2 + c0| = |tau^3 + 2 (tau_x p + tau_y
// q)|, so the matrix between p and q is real; only orthogonality, the square of |c2| = |p - i q|, is not.
struct FieldSystem {
  PairMatrix matrix;                  // smoothness, alignment, and a trace of orthogonality
  std::vector<ComplexPair> right;     // per node
  std::vector<double> orthogonality;  // per vertex: weight of |c2|^2 there, for each round in which its frame is degenerate
  EliminationPlan plan;
};

// The same for any number of threads.
FieldSystem assemble_field(const BandMesh& mesh, const FieldSpace& space, const Ink& ink, int threads = 1);

}  // namespace inkgrid
