// What:   shadows with an edge, stains and toned areas that strokes run through: paper, though darker than the paper around.
// Source: ours (docs/METHOD.md, "Threshold").
// Differs: nothing.
// Cost:   two passes over the pixels; where there are wide areas of ink, filters over a window as well.
#pragma once

#include <cstdint>

#include "base/raster.h"
#include "ink/paper_light.h"

namespace inkgrid {

// Makes the darkness (0: bare paper) in shades, and near their edges, that against the light of the shade.  `ink`: 1 where it
// stands out from the paper.  True where there are any.
bool lighten_shades(const View& view, const Paper& paper, const Raster<std::uint8_t>& ink, Raster<float>& darkness);

}  // namespace inkgrid
