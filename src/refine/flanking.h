// What:   chains that the grid left side by side, though they were drawn for one line, become one.
// Source: ours; in the paper the user's scribbles say where the grid is to be coarser (section 7).
// Differs: docs/METHOD.md, "Flanking chains".
// Cost:   linear in the length of the chains times the widest gap; of chains that are joined, their length times that of the flank.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

struct FlankingOptions {
  int width = 0;            // px, of the drawing
  int height = 0;           // px
  double stroke_width = 0;  // px
  double sketchiness = 0;   // of the drawing, 0..1
  int threads = 0;          // 0: as many as the machine has
};

// A chain with a free end that runs beside another and is likely to have been drawn for the same line (one_line) is dropped where
// it does so all along; where the other ends beside it as well, both go on into each other; else it runs into the other from
// where the two are side by side.  What stays runs through the middle.  Where more than a tenth of the length is drawn over,
// lenses are joined (lenses.h), and where more than a third is, short ends that stick out of wide bundles are dropped.
Chains join_flanking(Chains chains, const FlankingOptions& options);

}  // namespace inkgrid
