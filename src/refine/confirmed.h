// What:   the points of a chain that the ink confirms to lie on a stroke of its own.
// Source: ours; docs/METHOD.md, "Blots" and "Turning back".
// Cost:   linear in the points.
#pragma once

#include <cstdint>
#include <vector>

#include "refine/ridge.h"

namespace inkgrid {

// One a point: whether paper on both sides confirms it, in a part no shorter than `isolated` px.  Free ends are where a stroke
// may run into a blot, and are not.
std::vector<std::uint8_t> confirmed_points(const RidgeChain& ridge, double isolated);

// The same where the ink that was drawn is as wide as one pen (px), in parts of some length.
std::vector<std::uint8_t> slender_points(const RidgeChain& ridge, const Raster<std::uint8_t>& drawn, double pen);

}  // namespace inkgrid
