#include "images/orientation.h"

#include <algorithm>
#include <utility>

namespace inkgrid {

int exif_orientation(const Bytes& bytes, std::size_t at) {
  constexpr std::uint32_t orientation = 274;
  try {
    const bool big = bytes.u8(at) == 'M';
    const std::size_t directory = at + bytes.u32(at + 4, big), entries = bytes.u16(directory, big);
    for (std::size_t entry = directory + 2; entry < directory + 2 + 12 * entries; entry += 12) {
      if (bytes.u16(entry, big) != orientation) continue;
      const std::uint32_t value = bytes.u16(entry + 8, big);
      return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
    }
  } catch (const std::out_of_range&) {
    // pixels do not need what is broken beside them
  }
  return 1;
}

DecodedImage upright(DecodedImage image, int orientation) {
  if (orientation == 1) return image;
  const bool swapped = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  DecodedImage turned = image;
  if (swapped) std::swap(turned.width, turned.height);
  const auto channels = static_cast<std::ptrdiff_t>(image.channels);
  auto out = turned.samples.begin();
  for (int y = 0; y < turned.height; ++y)
    for (int x = 0; x < turned.width; ++x, out += channels) {
      const int column = swapped ? y : x, row = swapped ? x : y;
      const std::ptrdiff_t from_x = from_right ? image.width - 1 - column : column;
      const std::ptrdiff_t from_y = from_below ? image.height - 1 - row : row;
      std::copy_n(image.samples.begin() + (from_y * image.width + from_x) * channels, channels, out);
    }
  return turned;
}

}  // namespace inkgrid
