// What:   ink without the paper that shows through its deep parts.
// Source: ours (docs/METHOD.md, "Fills").
// Differs: nothing.
// Cost:   linear in the pixels.
#pragma once

#include <cstdint>

#include "base/raster.h"

namespace inkgrid {

// Small holes in ink that is much deeper than they are wide become ink.
Raster<std::uint8_t> close_specks(const Raster<std::uint8_t>& ink);

}  // namespace inkgrid
