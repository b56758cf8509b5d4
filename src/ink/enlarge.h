// What:   pictures of a fine pen, or of fine slits between strokes, enlarged before anything is made of them.
// Source: ours (docs/METHOD.md, "Fine pens").
// Differs: nothing.
// Cost:   twelve products a pixel of the enlarged picture.
#pragma once

#include "ink/ink.h"
#include "inkgrid/image.h"
#include "inkgrid/options.h"

namespace inkgrid {

// Whether strokes of this width (px) are too slim for what is measured in whole pixels, in a picture that may be enlarged.
bool has_fine_pen(double pen_width, const Ink& ink);

// Whether much of the paper between strokes is, in such a picture.
bool has_fine_paper(const Ink& ink);

// How many times a picture of a fine pen is enlarged each way.
constexpr int kEnlargement = 2;

// Interpolated between pixel centres by Lanczos' kernel of three lobes; `pixels_per_mm` grows with the picture.
Image enlarged(const Image& image);

ScaleMask enlarged(const ScaleMask& mask);

}  // namespace inkgrid
