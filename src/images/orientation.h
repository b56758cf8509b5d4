// What:   which way up a picture was taken, as cameras write it beside the pixels.
// Source: Exif 2.32, tag 274: values 1 to 8, of rows and columns that begin at any corner.
// Differs: nothing.
// Cost:   a walk over one directory; one pass over the pixels of a picture that is turned.
#pragma once

#include <cstddef>

#include "base/bytes.h"
#include "images/decoded_image.h"

namespace inkgrid {

// Of an Exif block (a TIFF header) that begins at `at`: 1 to 8; 1, upright, where it says nothing or ends.
int exif_orientation(const Bytes& bytes, std::size_t at);

DecodedImage upright(DecodedImage image, int orientation);

}  // namespace inkgrid
