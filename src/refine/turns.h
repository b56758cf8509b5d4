// What:   where a pen turned back and left no paper between its two ways.
// Source: ours; section 7 names sharp turns among the paper's limitations (Fig. 17).
// Differs: docs/METHOD.md, "Turning back".
// Cost:   the ink around the turn.
#pragma once

#include <cstdint>
#include <optional>

#include "base/raster.h"
#include "refine/arrival.h"

namespace inkgrid {

// Half a pen before the end of the ink, in the direction in which both sides lead, where the ink is no wider than their two ways
// and no more than `longest` px (from the end of a side, and along the ink) away.  `drawn`: the ink before it was slimmed; `pen`:
// the width of its strokes, px.
std::optional<Vec2> turn_of(const Arrival& a, const Arrival& b, const Raster<std::uint8_t>& drawn, double pen, double longest);

}  // namespace inkgrid
