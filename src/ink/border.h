// What:   strokes that run along the border of the image.
// Source: ours; a drawing that was cropped has them.
// Differs: docs/METHOD.md, "Ink".
// Cost:   linear in the ink times the stroke width where there is such a stroke, else in the border.
#pragma once

#include <cstdint>

#include "base/raster.h"

namespace inkgrid {

// What lies on the border goes on beyond it, so a stroke along it that is seen in its full width would be twice as wide.  Its
// outermost pixels become paper: it ends at the border.  Of a stroke much narrower than those inside the image a part lies beyond
// the border, and it stays as it is.
void end_strokes_at_border(Raster<std::uint8_t>& mask);

}  // namespace inkgrid
