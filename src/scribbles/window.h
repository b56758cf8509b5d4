// What:   a part of a drawing as a drawing of its own.
// Source: ours.
// Differs: nothing.
// Cost:   linear in the pixels of the window.
#pragma once

#include "scribbles/touched.h"

namespace inkgrid {

// The ink that the part reaches and no other, as measured in the whole drawing; Ink::origin says where it lies.
Ink window_of(const Ink& ink, const TouchedPart& part);

// The mask over the same pixels.
ScaleMask window_of(const ScaleMask& mask, const TouchedPart& part);

}  // namespace inkgrid
