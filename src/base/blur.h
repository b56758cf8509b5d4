// What:   rasters blurred by a Gaussian.
// Source: textbook.
// Differs: nothing.
// Cost:   six standard deviations of products a pixel, along rows and columns each, where a row is not zero.
#pragma once

#include "base/raster.h"

namespace inkgrid {

// `sigma`: px, above 0.  Beyond the border it goes on as it ends.
Raster<float> blurred(const Raster<float>& in, double sigma, int threads);

}  // namespace inkgrid
