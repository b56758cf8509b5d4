// What:   Windows bitmaps: 1, 2, 4, 8, 16, 24 and 32 bits, palettes, runs of 4 and 8 bits, bit fields, rows in either direction.
// Source: the file format (headers of 12, 40, 52 and more bytes).
// Differs: a JPEG or PNG inside is not read.
// Cost:   one pass over the pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/bytes.h"
#include "images/decoded_image.h"

namespace inkgrid {

struct BmpHeader {
  long width = 0;  // px
  long height = 0;
  bool top_down = false;
  bool readable = false;
  bool in_runs = false;
  std::size_t bits = 0;       // a pixel
  std::size_t row_bytes = 0;  // with filling
  std::size_t pixels_at = 0;  // places in the file
  std::size_t palette_at = 0;
  std::size_t palette_entry = 4;          // bytes
  std::array<std::uint32_t, 4> fields{};  // bits of red, green, blue, alpha; of pixels of 16 bits and more
  double pixels_per_mm = 0;
};

// Throws std::out_of_range where the file ends within it.
BmpHeader bmp_header(const Bytes& bytes);

// Nothing where the bytes end before the last pixel, or the header makes no sense.
std::optional<DecodedImage> decode_bmp(std::span<const char> file);

}  // namespace inkgrid
