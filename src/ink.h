// What:   the ink of a drawing: mask, distances, stroke width, tangents.
// Source: section 5; the tangents are what section 6.1 aligns the field with.
// Differs: docs/METHOD.md, "Ink".
// Cost:   linear passes over the pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "base/raster.h"
#include "inkgrid/vec2.h"
#include "threshold.h"

namespace inkgrid {

// A direction that the field is asked to contain, at a point of the drawing.
struct StrokeTangent {
  Vec2 position;   // px
  Vec2 direction;  // unit; its sign means nothing
  double weight;   // 0..1
};

struct Ink {
  Raster<std::uint8_t> mask;       // 1: stroke pixel
  Raster<float> darkness;          // 0 paper .. 1 ink
  Raster<std::uint16_t> depth;     // L1 distance to the nearest background pixel, px; 0 outside; outside the image is background
  Raster<float> gap;               // Euclidean distance to the nearest stroke pixel, px; 0 on ink
  Raster<float> centre_distance;   // d of equation (3): 0 on the centre line, 1 at the rim of the ink and outside
  std::vector<StrokeTangent> tangents;
  double stroke_width = 0;         // omega-bar, px
  long pixels = 0;                 // stroke pixels
};

Ink measure_ink(const Binarisation& binarisation);

}  // namespace inkgrid
