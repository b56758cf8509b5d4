// What:   the samples of an image file, 8 bits each.
// Source: libpng and libjpeg, which tell of damage without printing; Leptonica for TIFF, WebP and PNM; bmp.h.
// Differs: a JPEG of whose data a part is missing is damaged, not filled up with grey.
// Cost:   decoding, and one pass over the pixels for the formats of Leptonica.
#pragma once

#include <optional>
#include <span>

#include "images/decoded_image.h"
#include "images/image_format.h"

namespace inkgrid {

// Nothing where the bytes are damaged.  The header is that of the same bytes.
std::optional<DecodedImage> decode(ImageFormat format, const ImageHeader& header, std::span<const char> bytes);

}  // namespace inkgrid
