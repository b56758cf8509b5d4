// What:   areas that are filled rather than drawn: blots, pupils, black hair.
// Source: ours (docs/METHOD.md, "Fills"); the paper has strokes only.
// Cost:   linear in the pixels, and in the areas of the strokes' discs.
#pragma once

#include <vector>

#include "ink/threshold.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

struct Fills {
  Raster<int> region;  // index of the fill that the pixel belongs to, -1 elsewhere; empty where there is none
  int count = 0;
  std::vector<std::vector<std::vector<Vec2>>> outlines;  // per fill: closed polylines, the outermost first, or none; px
  double stroke_width = 0;                               // of the strokes beside the fills, px; 0 where there are none
};

// Connected pieces of ink that no stroke explains, and that are much wider than the strokes that lead into them and than the
// strokes of the drawing.  Blobs where strokes cross, wide pens and dots are none.
Fills find_fills(const Binarisation& ink);

// The ink without its fills, nor the rim around them.
Binarisation without_fills(Binarisation ink, const Fills& fills);

}  // namespace inkgrid
