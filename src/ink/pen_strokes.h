// What:   where the ink is a stroke of a pen: its middle runs on, several widths long, at one depth.
// Source: ours (docs/METHOD.md, "Fills").
// Differs: Euclidean depth; the L1 depth of section 5 changes along a stroke that turns.
// Cost:   linear in the pixels, times the number of depths in steps of 15 %.
#pragma once

#include <cstdint>
#include <vector>

#include "base/raster.h"

namespace inkgrid {

// A pixel on the medial axis of the ink.
struct CentrePixel {
  int x = 0, y = 0;
  float depth = 0;  // Euclidean distance to the nearest paper, px
  bool of_stroke = false;
};

struct PenStrokes {
  Raster<float> depth;  // depth_of the ink
  std::vector<CentrePixel> centres;
  double width = 0;  // of most of the strokes, px; 0 where there is no stroke
};

// Euclidean distance to the nearest paper pixel, px; 0 on paper.
Raster<float> depth_of(const Raster<std::uint8_t>& ink);

// The border of the image is no paper: what lies on it goes on beyond it.  Ink `far_wider` times as wide as the pen is a stroke
// only where it has the look of a wide pen's.
PenStrokes find_pen_strokes(const Raster<std::uint8_t>& ink, const Raster<float>& darkness, float far_wider = 2.5F);

}  // namespace inkgrid
