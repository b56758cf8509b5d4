// What:   what chains do inside blots is replaced by the lines along which they arrive.
// Source: ours; section 7 names sharp turns among the paper's limitations (Fig. 17).
// Differs: docs/METHOD.md, "Blots".
// Cost:   linear in the ink that the chains own.
#pragma once

#include "base/raster.h"
#include "refine/ridge.h"

namespace inkgrid {

struct BlotOptions {
  double longest = 15;  // from where an arm is confirmed to where it meets the others, px
  double pen = 5;       // width of the strokes as they were drawn, px
  double bridge = 1;    // paper narrower than this is part of a stroke, px
};

struct Blots {
  std::vector<RidgeChain> ridges;
  std::vector<Vec2> junctions;
};

// Where three or more strokes run into one blot (ink that confirms no chain, connected) along lines that meet in one point of it,
// they end there, in a new junction, whatever chains there are inside.  `drawn` is the ink before it was slimmed, which hollows
// blots out.
Blots meet_in_blots(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const InkBands& bands,
                    const Raster<std::uint8_t>& drawn, const BlotOptions& options);

// Where a pen turned back that left no paper between its two ways, both end at the turn, in a new junction, whatever chains there
// are inside.
Blots turn_in_blots(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const InkBands& bands,
                    const Raster<std::uint8_t>& drawn, const BlotOptions& options);

}  // namespace inkgrid
