// What:   what the bytes of an image file say of themselves, without decoding: format, size, whether the end is there.
// Source: the file formats.
// Differs: decoders quietly fill up a file that is cut; here it is told apart.
// Cost:   one walk over the structure of the file.
#pragma once

#include <optional>
#include <span>

namespace inkgrid {

enum class ImageFormat { png, jpeg, tiff, webp, bmp, pnm };

// By the first bytes, whatever the name.
std::optional<ImageFormat> format_of(std::span<const char> file);

// What the bytes are where they are of another format, as "a GIF"; empty where that is not known either.
const char* other_format(std::span<const char> file);

struct ImageHeader {
  long width = 0;  // px; 0 where the file ends or breaks before it says so
  long height = 0;
  double pixels_per_mm = 0;  // PNG only; 0: not said
  bool whole = false;        // the last pixel is there
  int orientation = 1;       // as in orientation.h
  const char* unread = "";   // what it is where its kind is not read: "an animated WebP"
};

ImageHeader header_of(ImageFormat format, std::span<const char> bytes);

}  // namespace inkgrid
