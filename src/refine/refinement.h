// What:   chains brought onto the ink: what says nothing of its own goes, and what the grid left apart or bent meets.
// Source: section 6.3, "Curve fitting" (coverage); the rest is ours.
// Differs: docs/METHOD.md, "Chains" to "Ends".
// Cost:   linear in the ink and in the length of the chains, times the stroke width.
#pragma once

#include "graph/chains.h"
#include "refine/flanking.h"

namespace inkgrid {

struct RefinementOptions {
  double pen = 5;         // width of the strokes as they were drawn, px
  double reach = 0.3;     // of the band, strokes
  double spacing = 0.7;   // of the grid, strokes
  double gap = 1;         // of paper in a line, pens
  double slit = 0;        // strokes: paper that may lie between two strokes of one line; 0: what the reach closes
  int coverage_bins = 4;  // of a chain
  int threads = 0;        // 0: as many as the machine has
};

// The grid has decided which strokes are one and how they meet; the ink, which may be slimmed, says where they run, bend and end.
// `drawn` is the ink before it was slimmed.
Chains refine_on_ink(const Chains& chains, const Ink& ink, const Raster<std::uint8_t>& drawn, const RefinementOptions& options);

// The same of a drawing whose bundles were joined, without what the grid left beside their lines; chains that turn back where one
// stroke relieves another, or touch without a junction, are led straight on and meet.
Chains refine_bundles(Chains chains, const FlankingOptions& options);

// The same chains with the widths that they have on other ink, as that which was drawn; reach and spacing in its strokes.
Chains with_widths_on(Chains chains, const Ink& ink, double reach, double spacing, int threads);

}  // namespace inkgrid
