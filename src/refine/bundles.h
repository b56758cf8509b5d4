// What:   strokes drawn side by side for one line, found by the chains of a first pass and joined before the grid sees them.
// Source: ours; in the paper the user's scribbles say where the grid is to be coarser (section 7).
// Differs: docs/METHOD.md, "Bundles".
// Cost:   that of a run with a fine grid; linear in the ink.
#pragma once

#include "graph/chains.h"
#include "refine/flanks.h"

namespace inkgrid {

// How likely two chains that run side by side were drawn for one line, 0..1.  `sketchiness`: share of the drawing's length that
// is bundled, 0..1.
double one_line(const Flank& flank, double sketchiness, double stroke_width);

// Whether that is likely enough.
bool are_one_line(const Flank& flank, double sketchiness, double stroke_width);

// Expected share of the length of chains with neighbours that was drawn along a neighbour for the same line.
double sketchiness(const std::vector<Flank>& flanks, const std::vector<Chain>& chains, double stroke_width);

// Where chains can be those of one line.
FlankOptions flank_options(double stroke_width, int threads);

struct Bundles {
  Raster<std::uint8_t> slits;  // 1: between two strokes of one line; empty where there is none
  int count = 0;               // flanks that are one line
  double sketchiness = 0;      // of the drawing
};

Bundles find_bundles(const std::vector<Chain>& chains, const Ink& ink, int threads = 0);

// What the grid works on.
struct JoinedInk {
  Ink ink;          // slits are ink, too; the stroke width stays that of the pen
  ScaleMask scale;  // how many pens wide bundles are; 1 elsewhere
};

// Where the user's mask (may be null) asks for detail, factor below 1, slits stay open.
JoinedInk join_bundles(const Ink& ink, const Bundles& bundles, const ScaleMask* mask);

}  // namespace inkgrid
