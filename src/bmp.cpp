// What:   see bmp.h.
// Source: see bmp.h.
// Differs: see bmp.h.
// Cost:   see bmp.h.
#include "bmp.h"

#include <bit>
#include <cstdlib>
#include <stdexcept>

namespace inkgrid {
namespace {

constexpr std::size_t kFileHeader = 14, kCoreHeader = 12, kInfoHeader = 40, kAlphaHeader = 56;
constexpr std::uint32_t kPlain = 0, kBitFields = 3;

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
  header.readable = compression == kPlain || compression == kBitFields;
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

std::array<std::uint8_t, 4> pixel_at(const Bytes& bytes, const BmpHeader& header, std::size_t row_at, std::size_t x) {
  const std::size_t bit = x * header.bits, at = row_at + bit / 8;
  if (header.bits == 16 || header.bits == 32) {
    const std::uint32_t pixel = header.bits == 16 ? bytes.u16(at, false) : bytes.u32(at, false);
    return {field(pixel, header.fields[0]), field(pixel, header.fields[1]), field(pixel, header.fields[2]),
            field(pixel, header.fields[3])};
  }
  std::size_t colour_at = at;
  if (header.bits <= 8) {
    const std::size_t index = bytes.u8(at) >> (8 - header.bits - bit % 8) & ((1U << header.bits) - 1);
    colour_at = header.palette_at + header.palette_entry * index;
  }
  const auto byte = [&](std::size_t place) { return static_cast<std::uint8_t>(bytes.u8(place)); };
  return {byte(colour_at + 2), byte(colour_at + 1), byte(colour_at), 255};
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

std::optional<DecodedImage> decode_bmp(std::span<const char> span) {
  const Bytes bytes(span);
  try {
    const BmpHeader header = bmp_header(bytes);
    const bool known = std::has_single_bit(header.bits) && header.bits <= 32;
    if (!header.readable || (!known && header.bits != 24)) return std::nullopt;
    DecodedImage image{static_cast<int>(header.width), static_cast<int>(header.height), 4, {}, header.pixels_per_mm};
    image.samples.reserve(static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) * 4);
    for (long y = 0; y < header.height; ++y) {
      const auto row = static_cast<std::size_t>(header.top_down ? y : header.height - 1 - y);
      for (long x = 0; x < header.width; ++x) {
        const auto pixel = pixel_at(bytes, header, header.pixels_at + row * header.row_bytes, static_cast<std::size_t>(x));
        image.samples.insert(image.samples.end(), pixel.begin(), pixel.end());
      }
    }
    return image;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

}  // namespace inkgrid
