// What:   strokes made slimmer where the grid is finer than the pen, so that details smaller than the pen fit the grid.
// Source: ours; the paper ties its grid, mesh and band to the pen of the drawing (sections 5 and 6.2).
// Differs: docs/METHOD.md, "Slimmer strokes".
// Cost:   linear in the pixels, and in the ink times the stroke width.
#pragma once

#include <optional>

#include "ink/ink.h"

namespace inkgrid {

// By how much strokes are to be slimmed for a grid spacing in strokes: 1 keeps most of them.
double slim_share(const Ink& ink, double spacing);

// Whether slim_ink is to do the same for both spacings.
bool same_slimming(const Ink& ink, double spacing, double other);

// The same drawing with a pen of `share` (0..1] of the width.  Strokes keep their middles, ends and connections: paper is won
// from the rim inwards, never through.  Strokes of a broader pen become as slim as the others, and so do blots more than twice as
// wide as the pen.
Ink slim_ink(const Ink& ink, double share);

// Whether slim_ink is to be used for the spacing, and changes anything.
bool is_slimmed(const Ink& ink, double spacing);

// Of the strokes around each pixel of ink, px.
struct StrokeWidths {
  Raster<float> depth;      // from the rim
  Raster<float> thickness;  // half the width
  Raster<float> broad;      // half that of a broader pen, 0 elsewhere
  double usual = 0;         // half the width of most
};

struct Slimming {
  double share;
  StrokeWidths widths;
};

// What is to be done for the spacing: nothing unless is_slimmed.
std::optional<Slimming> slimming_of(const Ink& ink, double spacing);

// As above; the widths are found already.
Ink slim_ink(const Ink& ink, Slimming slimming);

}  // namespace inkgrid
