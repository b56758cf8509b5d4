// What:   pictures in which grain has broken the strokes, softened until they hold together.
// Source: ours (docs/METHOD.md, "Grain").
// Differs: nothing.
// Cost:   pieces of the ink; where they are many, a blur, a threshold and distances for each degree of softening.
#pragma once

#include <optional>

#include "ink/ink.h"
#include "inkgrid/image.h"

namespace inkgrid {

// Blurred by a Gaussian of this standard deviation, px, above 0.
Image softened(const Image& image, double sigma, int threads);

// By how much, px, the strokes hold together that paper with a tooth, a dry pen, a screen or dithering has broken; 0 where they
// are not, or would not.  `ink`: of the image as it is; `faintest`: as for binarise.
double grain_of(const Image& image, const Ink& ink, int threads, std::optional<double> faintest = std::nullopt);

}  // namespace inkgrid
