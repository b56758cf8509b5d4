// What:   chains that say nothing of their own are dropped: hardly covered ones, spurs, links shorter than a stroke is wide.
// Source: section 6.3, "Curve fitting" (coverage by a histogram); spurs and links are ours.
// Differs: docs/METHOD.md, "Chains".
// Cost:   linear in the length of the chains.
#pragma once

#include <limits>

#include "graph/chains.h"
#include "refine/ownership.h"

namespace inkgrid {

// Section 6.3: each stroke pixel counts for its nearest chain, in a histogram over the chain's parameter; a chain with an empty
// bin is dropped.  `reach` (px) is how far a chain may be from the ink that it stands for.
Chains drop_uncovered(Chains chains, const InkBands& bands, int bins, double reach);

// Chains that run within `distance` px of others all along (but for a seventh of their length), the shorter ones first, are
// dropped.
Chains drop_doubles(Chains chains, double distance);

struct RungOptions {
  double longest = 0;  // px
  double bridge = 0;   // px: less paper is part of a stroke
  double stroke =
      std::numeric_limits<double>::infinity();  // px: over so much ink a chain is a stroke, and may leave it at its free end
};

// Chains on a junction, up to `longest`, that cross more paper than `bridge` are dropped: they lead from one stroke to the next
// where the band closed the paper between them.
Chains drop_rungs(Chains chains, const Ink& ink, const RungOptions& options);

// Loops without paper inside are dropped: there is but a blot.
Chains drop_blot_loops(Chains chains, const Ink& ink);

// Takes out of all chains what lies on more than `longest` px of paper: it runs along a slit between two strokes.
Chains cut_on_paper(Chains chains, const Ink& ink, double longest);

// Chains with a free end, hanging on a junction or on nothing, and nowhere further than `share` times the widest of that
// junction's branches (else than `share` of their own width) from other chains, are dropped: their ink is that of the others.
Chains drop_spurs(Chains chains, double share);

// Chains of up to `longest` px with one free end are dropped where they go straight on (within 37 degrees) from another chain at
// a junction of three or more: strokes that were drawn too far.
Chains drop_overshoots(Chains chains, double longest);

// Junctions linked by chains shorter than `link` px become one, and so do those linked by chains shorter than `bare_link` px that
// paper nowhere bounds on both sides (Chain::confirmed); no junction comes of others further apart than 1.5 of the longer of
// these.  Junctions that are none any more are dissolved.
Chains merge_junctions(Chains chains, double link, double bare_link);

}  // namespace inkgrid
