// What:   a PolyVector frame field on the vertices of the band: two directions at every point.
// Source: section 6.1, "Computation".
// Differs: docs/METHOD.md, "Frame field".
// Cost:   one sparse factorisation on a quarter of the vertices, then some preconditioned iterations a re-weighting round.
#pragma once

#include <complex>
#include <vector>

#include "ink/band_mesh.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {

using Complex = std::complex<double>;

// Per vertex the polynomial z^4 + c2 z^2 + c0, whose roots +-a, +-b are the frame.
struct FrameField {
  std::vector<Complex> c0;
  std::vector<Complex> c2;
  int rounds = 0;                  // of re-weighting
  double degenerate_fraction = 0;  // of the vertices, at the end
};

// Two roots that are not opposite; lengths are kept.
struct Frame {
  Vec2 a;
  Vec2 b;
};

Frame frame_of(Complex c0, Complex c2);

struct FieldOptions {
  double degenerate_angle = Options{}.degenerate_angle;  // degrees
  double degenerate_ratio = Options{}.degenerate_ratio;
  double degenerate_fraction = Options{}.degenerate_fraction;
  int rounds = Options{}.field_rounds;
  int threads = 0;  // 0: as many as the machine has
};

// Throws Error{numerics} when the system cannot be factorised.
FrameField solve_field(const BandMesh& mesh, const Ink& ink, const FieldOptions& options, const Control& control);

}  // namespace inkgrid
