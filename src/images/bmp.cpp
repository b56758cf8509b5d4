#include "images/bmp.h"

#include <bit>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "base/at.h"

namespace inkgrid {
namespace {

constexpr std::size_t kFileHeader = 14, kCoreHeader = 12, kInfoHeader = 40, kAlphaHeader = 56;
constexpr std::uint32_t kPlain = 0, kRunsOf8 = 1, kRunsOf4 = 2, kBitFields = 3;

void read_core_header(const Bytes& bytes, BmpHeader& header) {
  header.width = bytes.u16(18, false);
  header.height = bytes.u16(20, false);
  header.bits = bytes.u16(24, false);
  header.palette_entry = 3;
  header.readable = true;
}

void read_info_header(const Bytes& bytes, std::size_t header_size, BmpHeader& header) {
  const auto height = static_cast<std::int32_t>(bytes.u32(22, false));
  header.width = std::labs(static_cast<std::int32_t>(bytes.u32(18, false)));
  header.height = std::labs(height);
  header.top_down = height < 0;
  header.bits = bytes.u16(28, false);
  header.pixels_per_mm = bytes.u32(38, false) / 1000.0;
  const std::uint32_t compression = bytes.u32(30, false);
  header.in_runs = (compression == kRunsOf8 && header.bits == 8) || (compression == kRunsOf4 && header.bits == 4);
  header.readable = header.in_runs || compression == kPlain || compression == kBitFields;
  if (compression != kBitFields) return;
  for (std::size_t c = 0; c < 4; ++c)
    if (c < 3 || header_size >= kAlphaHeader) header.fields[c] = bytes.u32(54 + 4 * c, false);
  if (header_size == kInfoHeader) header.palette_at += 12;
}

// A sample of any number of bits as one of 8.
std::uint8_t field(std::uint32_t pixel, std::uint32_t mask) {
  if (mask == 0) return 255;
  const std::uint32_t most = mask >> std::countr_zero(mask), value = (pixel & mask) >> std::countr_zero(mask);
  return static_cast<std::uint8_t>((std::uint64_t{value} * 255 + most / 2) / most);
}

std::array<std::uint8_t, 4> colour_at(const Bytes& bytes, std::size_t at) {
  const auto byte = [&](std::size_t place) { return static_cast<std::uint8_t>(bytes.u8(place)); };
  return {byte(at + 2), byte(at + 1), byte(at), 255};
}

std::array<std::uint8_t, 4> pixel_at(const Bytes& bytes, const BmpHeader& header, std::size_t row_at, std::size_t x) {
  const std::size_t bit = x * header.bits, at = row_at + bit / 8;
  if (header.bits == 16 || header.bits == 32) {
    const std::uint32_t pixel = header.bits == 16 ? bytes.u16(at, false) : bytes.u32(at, false);
    return {field(pixel, header.fields[0]), field(pixel, header.fields[1]), field(pixel, header.fields[2]),
            field(pixel, header.fields[3])};
  }
  if (header.bits > 8) return colour_at(bytes, at);
  const std::size_t index = bytes.u8(at) >> (8 - header.bits - bit % 8) & ((1U << header.bits) - 1);
  return colour_at(bytes, header.palette_at + header.palette_entry * index);
}

// Indices into the palette, written one after the other from the lowest row on.
class Runs {
 public:
  Runs(const Bytes& bytes, const BmpHeader& header)
      : bytes_(bytes),
        header_(header),
        at_(header.pixels_at),
        indices_(static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height)) {
    while (y_ < header.height && next()) continue;
  }

  // y: from the lowest row.
  std::size_t index(long x, long y) const { return indices_[at(y * header_.width + x)]; }

 private:
  enum Escape : std::uint32_t { kEndOfRow = 0, kEnd = 1, kSkip = 2 };

  bool next() {
    const std::uint32_t count = bytes_.u8(at_), what = bytes_.u8(at_ + 1);
    at_ += 2;
    if (count > 0)
      for (std::uint32_t i = 0; i < count; ++i) put(value(what, i));
    else if (what == kEndOfRow)
      x_ = 0, ++y_;
    else if (what == kSkip)
      skip();
    else if (what != kEnd)
      literals(what);
    return count > 0 || what != kEnd;
  }

  void skip() {
    x_ += static_cast<long>(bytes_.u8(at_));
    y_ += static_cast<long>(bytes_.u8(at_ + 1));
    at_ += 2;
  }

  void literals(std::uint32_t count) {
    const std::uint32_t each = header_.bits == 4 ? 2 : 1, bytes = (count + each - 1) / each;
    for (std::uint32_t i = 0; i < count; ++i) put(value(bytes_.u8(at_ + i / each), i));
    at_ += bytes + bytes % 2;
  }

  // The left one of two that share a byte is in its high bits.
  std::uint32_t value(std::uint32_t byte, std::uint32_t i) const {
    return header_.bits == 8 ? byte : i % 2 ? byte & 15 : byte >> 4;
  }

  void put(std::uint32_t index) {
    if (x_ >= header_.width || y_ >= header_.height) throw std::out_of_range("a run past the end of its row");
    indices_[at(y_ * header_.width + x_++)] = static_cast<std::uint8_t>(index);
  }

  const Bytes& bytes_;
  const BmpHeader& header_;
  std::size_t at_;
  long x_ = 0, y_ = 0;
  std::vector<std::uint8_t> indices_;
};

template <class Pixel>
DecodedImage drawn(const BmpHeader& header, Pixel pixel) {
  DecodedImage image{static_cast<int>(header.width), static_cast<int>(header.height), 4, {}, header.pixels_per_mm};
  image.samples.reserve(static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) * 4);
  for (long y = 0; y < header.height; ++y)
    for (long x = 0; x < header.width; ++x) {
      const std::array<std::uint8_t, 4> colour = pixel(x, header.top_down ? y : header.height - 1 - y);
      image.samples.insert(image.samples.end(), colour.begin(), colour.end());
    }
  return image;
}

}  // namespace

BmpHeader bmp_header(const Bytes& bytes) {
  BmpHeader header;
  const std::size_t header_size = bytes.u32(kFileHeader, false);
  header.pixels_at = bytes.u32(10, false);
  header.palette_at = kFileHeader + header_size;
  if (header_size == kCoreHeader)
    read_core_header(bytes, header);
  else
    read_info_header(bytes, header_size, header);
  if (header.fields[0] == 0 && header.bits == 16) header.fields = {0x7C00, 0x3E0, 0x1F, 0};
  if (header.fields[0] == 0 && header.bits == 32) header.fields = {0xFF0000, 0xFF00, 0xFF, 0};
  header.row_bytes = (static_cast<std::size_t>(header.width) * header.bits + 31) / 32 * 4;
  return header;
}

std::optional<DecodedImage> decode_bmp(std::span<const char> file) {
  const Bytes bytes(file);
  try {
    const BmpHeader header = bmp_header(bytes);
    const bool known = std::has_single_bit(header.bits) && header.bits <= 32;
    if (!header.readable || (!known && header.bits != 24)) return std::nullopt;
    if (header.in_runs) {
      const Runs runs(bytes, header);
      return drawn(header,
                   [&](long x, long y) { return colour_at(bytes, header.palette_at + header.palette_entry * runs.index(x, y)); });
    }
    return drawn(header, [&](long x, long y) {
      const std::size_t row_at = header.pixels_at + static_cast<std::size_t>(y) * header.row_bytes;
      return pixel_at(bytes, header, row_at, static_cast<std::size_t>(x));
    });
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

}  // namespace inkgrid
