// What:   drawings and scribble masks from files or memory, by content, whatever the extension.
// Source: section 7, "User control" for the colours of the scribbles; Rec. 601 for the luma.
// Differs: nothing.
// Cost:   decoding, and a pass over the pixels.
#pragma once

#include <span>
#include <string>

#include "inkgrid/image.h"

namespace inkgrid {

// The bytes of a file, or of standard input for "-".  Throws Error{file} with a sentence that names the file.
std::string read_bytes(const std::string& path);

// PNG, JPEG, TIFF, WebP, BMP, PNM; alpha composited over white, or over black where all that is not see-through is light; grey,
// RGB, palette, 1- and 16-bit; colour to luma.
// `name` is only for messages.  Throws Error{file} when the bytes are no image, truncated, or larger than 400 Mpx.
Image decode_image(std::span<const char> bytes, const std::string& name);

// A scribble mask: saturated purple -> 0.5, saturated orange -> 2, all else 1.  A mask without colour is a grey one:
// factor = 2^((128 - grey) / 64), clamped to [1/4, 4]; mid grey (128) leaves the scale alone.
// Throws Error{file} when there is neither a scribble nor a grey that differs from plain paper.
ScaleMask decode_mask(std::span<const char> bytes, const std::string& name);

}  // namespace inkgrid
