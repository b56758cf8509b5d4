// What:   free ends of chains: joined to what they run into, or brought to the end of their ink.
// Source: ours; the paper's curves end at the last grid node (section 6.3).
// Differs: docs/METHOD.md, "Ends".
// Cost:   linear in the number of ends times the stroke width.
#pragma once

#include "graph/chains.h"
#include "ink/fills.h"
#include "refine/ridge.h"

namespace inkgrid {

struct EndOptions {
  double reach = 6;   // how far an end may be from the chain it runs into, px
  double blot = 6;    // the same over nothing but ink: how long two strokes of a sharp fork share it, px
  double bridge = 1;  // paper narrower than this does not end a stroke, px
  double slit = 1;    // paper narrower than this does not part an end from a chain whose ink it is in, px
  double gap = 0;     // the same between ends in line with each other, px
  double deep = 0;    // widths: only ends from which ink leads straight on for more than that are attached; 0: all
};

// For ends that stop inside the ink of strokes of that width, px, as where many lines meet in a blot.
EndOptions deep_ends(double stroke_width);

// The chains, of which free ends that the ink does not confirm, up to `longest` px, are cut off, and what
// is bent by them straight; short ones of which the ink confirms nothing are dropped.
Chains straightened_ends(const std::vector<RidgeChain>& ridges, std::vector<Vec2> junctions, double longest);

// Free ends that face each other within `reach` over ink are joined half way; those that passed each other are cut back first.
Chains join_facing_ends(Chains chains, const Ink& ink, const EndOptions& options);

// join_facing_ends, and then: an end from which ink leads straight on into
// another chain, or into its other end, is joined to it: end to end where both are free ends, by a new junction otherwise.
// Junctions left with two branches are dissolved.
Chains attach_ends(Chains chains, const InkBands& bands, const EndOptions& options);

// A free end that turns back within its own stroke, as where a u isoline goes on as a v isoline in its last cell, ends where it
// turned.  Then every free end goes on straight, or is cut back, to half a stroke width inside the end of the ink.
Chains reach_ends(Chains chains, const Ink& ink, const EndOptions& options);

// A free end that a fill lies straight ahead of, within `reach` px, goes on to its rim.
Chains reach_fills(Chains chains, const Fills& fills, double reach);

}  // namespace inkgrid
