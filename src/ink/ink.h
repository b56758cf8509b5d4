// What:   the ink of a drawing: mask, distances, stroke width.
// Source: section 5.
// Differs: docs/METHOD.md, "Ink".
// Cost:   linear passes over the pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "base/raster.h"
#include "ink/threshold.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

struct Ink {
  Raster<std::uint8_t> mask;    // 1: stroke pixel
  Raster<float> darkness;       // 0 paper .. 1 ink
  Raster<std::uint16_t> depth;  // L1 distance to the nearest background pixel, px; 0 outside the ink
  Raster<float> gap;            // Euclidean distance to the nearest stroke pixel, px; 0 on ink
  Raster<float> rise;           // depth over the depth of the summit that it leads to: 1 on the centre line, 0 outside the ink
  double stroke_width = 0;      // omega-bar, px; 0 where there is no ink
  long pixels = 0;              // stroke pixels
  double threshold = 0;         // as Binarisation
  bool inverted = false;
  double faintest = 0;
  bool ruled = false;
  int enlargement = 1;  // how many of its pixels lie side by side in one of the drawing (enlarge.h)
  Vec2 origin;  // px: where pixel (0, 0) lies in the drawing, whole numbers; other than zero for a window of it (window.h)

  int width() const { return mask.width; }
  int height() const { return mask.height; }
  // d of equation (3): 0 on the centre line, towards 1 at the rim of the ink, 1 outside.
  float centre_distance(int x, int y) const { return 1 - rise(x, y); }
};

// Per pixel: the Euclidean distance to the nearest pixel with a value other than 0, px.
Raster<float> distance_to(const Raster<std::uint8_t>& mask);

// The ink with paper narrower than 2 radius (px) closed, as between the strokes of one over-sketched line.
Raster<std::uint8_t> closed_ink(const Ink& ink, double radius, int threads = 1);

// Paper between strokes closer than `width` px, over the ink; corners of wider paper are none.
double slit_share(const Ink& ink, double width);

// The image's border counts as a continuation of what lies on it, not as background.
Ink measure_ink(Binarisation binarisation, int enlargement = 1);

// From p to the middle of the nearest paper pixel, less half a pixel, px; 0 on paper, at most `most`; beyond the border is no
// paper.
double depth_at(const Raster<std::uint8_t>& mask, Vec2 p, double most);

// Whether no more than `bridge` px of paper at a time lie on the straight way.
bool over_ink(const Raster<std::uint8_t>& mask, Vec2 from, Vec2 to, double bridge);

}  // namespace inkgrid
