// What:   which parts of a drawing a mask of scribbles touches.
// Source: section 7, "User control" and the freezing of what scribbles leave alone.
// Differs: parts are told apart by distances along the band, so that a stroke nearby that the band does not lead to is another.
// Cost:   linear in the pixels, then in those that are reached.
#pragma once

#include <vector>

#include "base/pixel_box.h"
#include "ink/ink.h"
#include "inkgrid/image.h"

namespace inkgrid {

// One connected part.
struct TouchedPart {
  PixelBox box;
  Raster<float> distance;  // over the box: px along the band to a scribble on the band; kUnreached further than `farthest`
  int width, height;       // of the drawing
};

constexpr float kUnreached = 1e9f;

// The parts of the band within `farthest` px of pixels on the band whose factor is not 1, as far as they hold ink, by their first
// pixel.  The band is that of `reach` (strokes), widened by the mask and by `bundles`, which is empty where there are none.
std::vector<TouchedPart> touched_parts(const ScaleMask& mask, const ScaleMask& bundles, const Ink& ink, double reach,
                                       double farthest);

// The distance at a point of the drawing; the band goes on beyond its edge, where the nearest pixel counts.
float distance_at(const TouchedPart& part, Vec2 p);

}  // namespace inkgrid
