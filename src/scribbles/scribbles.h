// What:   scribbles as a mask of scale factors.
// Source: section 7, "User control".
// Cost:   rows covered by each stroke, one pass over the pixels a stroke.
#pragma once

#include <span>
#include <vector>

#include "inkgrid/image.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

enum class ScribbleKind { less, more, erase };  // simplification: factor 0.5 (purple), 2 (orange), 1

// A stroke of a round brush.
struct Scribble {
  ScribbleKind kind = ScribbleKind::less;
  double radius = 0;         // px
  std::vector<Vec2> points;  // px; at least one
};

// Sets the factor of each pixel whose centre a scribble reaches; later scribbles cover earlier ones.
void paint_scribbles(ScaleMask& mask, std::span<const Scribble> scribbles);

}  // namespace inkgrid
