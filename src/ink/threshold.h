// What:   stroke pixels of a grey drawing; without a threshold, what is half as dark as the darkest ink nearby and a stroke.
// Source: section 5, first paragraph (a manual threshold); the rest is ours: half is where an antialiased edge really is.
// Differs: docs/METHOD.md, "Threshold".
// Cost:   about ten passes over the pixels; apart from the results one float a pixel, and the runs of the mask.
#pragma once

#include <cstdint>
#include <optional>

#include "base/raster.h"
#include "inkgrid/image.h"

namespace inkgrid {

struct Binarisation {
  Raster<std::uint8_t> ink;  // 1: stroke pixel
  Raster<float> darkness;  // 0: paper, 1: full ink; light and shade of the paper divided out, light-on-dark drawings turned over
  double threshold = 0;    // grey level below which a pixel of the image is ink; the mean one where it varies
  bool inverted = false;   // light lines on dark paper
  double faintest = 0;     // of full ink: what is paler is none
  bool ruled = false;      // the paper is, and its lines are left out
};

// With a number (0..255): ink is exactly grey < threshold, nothing inverted or removed.  Without: copes with clean and
// antialiased ink, pencil, cream, shaded and grainy paper, shadows, pure black-and-white, light lines on dark.  `enlargement`:
// how many times the picture was enlarged each way, and specks with it.  `faintest`: the part of full ink, 0..1, below which
// nothing is ink where there is no threshold; without it 0.15, and above the lines of ruled paper.
Binarisation binarise(const Image& image, std::optional<double> threshold, int enlargement = 1,
                      std::optional<double> faintest = std::nullopt);

}  // namespace inkgrid
