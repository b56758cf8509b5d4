#include "images/image_format.h"

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "images/bmp.h"
#include "images/orientation.h"

namespace inkgrid {
namespace {

using namespace std::string_view_literals;

// Chunks up to the one that closes the file.
void walk_png(const Bytes& bytes, ImageHeader& header) {
  constexpr std::uint32_t per_metre = 1;
  header.width = bytes.u32(16, true);
  header.height = bytes.u32(20, true);
  std::size_t at = 8;
  for (; !bytes.starts_with("IEND", at + 4); at += std::size_t{12} + bytes.u32(at, true)) {
    if (bytes.starts_with("pHYs", at + 4) && bytes.u8(at + 16) == per_metre)
      header.pixels_per_mm = bytes.u32(at + 8, true) / 1000.0;
    if (bytes.starts_with("eXIf", at + 4)) header.orientation = exif_orientation(bytes, at + 8);
  }
  header.whole = at + 12 <= bytes.size();
}

// Markers up to the one that ends the image; entropy-coded data holds none but restarts.
void walk_jpeg(const Bytes& bytes, ImageHeader& header) {
  for (std::size_t at = 2;; ++at) {
    if (bytes.u8(at) != 0xFF) continue;
    const std::uint32_t marker = bytes.u8(at + 1);
    const bool end_of_image = marker == 0xD9, restart_or_start = marker >= 0xD0 && marker <= 0xD8;
    const bool no_marker = marker == 0x00 || marker == 0x01 || marker == 0xFF;  // a stuffed byte, nothing, filling
    const bool frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (end_of_image) break;
    if (no_marker || restart_or_start) continue;
    if (frame) {
      header.height = bytes.u16(at + 5, true);
      header.width = bytes.u16(at + 7, true);
    }
    if (marker == 0xE1 && bytes.starts_with("Exif\0\0"sv, at + 4)) header.orientation = exif_orientation(bytes, at + 10);
    at += 1 + bytes.u16(at + 2, true);
  }
  header.whole = true;
}

// The first directory of a TIFF: what it says of the picture, by tags.
class TiffDirectory {
 public:
  TiffDirectory(const Bytes& bytes, bool big) : bytes_(bytes), big_(big), at_(bytes.u32(4, big)), entries_(bytes.u16(at_, big)) {}

  // None where the tag is not there.
  std::vector<std::uint32_t> values(std::uint32_t tag) const {
    for (std::size_t entry = at_ + 2; entry < at_ + 2 + 12 * entries_; entry += 12)
      if (bytes_.u16(entry, big_) == tag) return values_of(entry);
    return {};
  }

  std::uint32_t value(std::uint32_t tag, std::uint32_t by_default) const {
    const std::vector<std::uint32_t> found = values(tag);
    return found.empty() ? by_default : found.front();
  }

 private:
  std::vector<std::uint32_t> values_of(std::size_t entry) const {
    const bool is_short = bytes_.u16(entry + 2, big_) == 3;
    const std::size_t count = bytes_.u32(entry + 4, big_), each = is_short ? 2 : 4;
    const std::size_t from = count * each <= 4 ? entry + 8 : bytes_.u32(entry + 8, big_);
    if (from + count * each > bytes_.size()) throw std::out_of_range("past the end of the file");
    std::vector<std::uint32_t> values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(is_short ? bytes_.u16(from + i * each, big_) : bytes_.u32(from + i * each, big_));
    return values;
  }

  const Bytes& bytes_;
  bool big_;
  std::size_t at_, entries_;
};

// What Leptonica does not decode; "" for all else.
const char* unread_tiff(const TiffDirectory& directory) {
  constexpr std::uint32_t bits_tag = 258, compression_tag = 259, colours_tag = 262, samples_tag = 277, planes_tag = 284,
                          tile_width_tag = 322, numbers_tag = 339;
  constexpr std::uint32_t plain = 1, cmyk = 5, separate = 2, unsigned_numbers = 1;
  constexpr std::uint32_t old_jpeg = 6, jpeg_2000 = 34712, webp = 50001;
  const std::uint32_t bits = directory.value(bits_tag, 1), samples = directory.value(samples_tag, 1),
                      compression = directory.value(compression_tag, plain);
  const bool deep = bits == 16 && (samples == 2 || directory.value(colours_tag, 0) == cmyk);
  if (directory.value(numbers_tag, unsigned_numbers) != unsigned_numbers) return "a TIFF of floating-point or signed numbers";
  if (!std::has_single_bit(bits) || bits > 16 || deep) return "a TIFF of an unusual depth";
  if (directory.value(tile_width_tag, 0) > 0) return "a TIFF of tiles";
  if (samples > 1 && directory.value(planes_tag, plain) == separate) return "a TIFF of separate colours";
  if (compression == old_jpeg || compression == jpeg_2000 || compression == webp) return "a TIFF of an unusual compression";
  return "";
}

// All strips of the first picture lie within the file.
void walk_tiff(const Bytes& bytes, ImageHeader& header) {
  constexpr std::uint32_t width = 256, height = 257, strip_offsets = 273, strip_sizes = 279;
  constexpr std::uint32_t of_64_bits = 43;
  const bool big = bytes.u8(0) == 'M';
  if (bytes.u16(2, big) == of_64_bits) {
    header.unread = "a BigTIFF";
    return;
  }
  const TiffDirectory directory(bytes, big);
  header.width = directory.value(width, 0);
  header.height = directory.value(height, 0);
  header.unread = unread_tiff(directory);
  const std::vector<std::uint32_t> offsets = directory.values(strip_offsets), sizes = directory.values(strip_sizes);
  header.whole = !offsets.empty() && offsets.size() == sizes.size();
  for (std::size_t i = 0; header.whole && i < offsets.size(); ++i)
    header.whole = sizes[i] > 0 && std::size_t{offsets[i]} + sizes[i] <= bytes.size();
}

void walk_webp(const Bytes& bytes, ImageHeader& header) {
  constexpr std::uint32_t animated = 2;
  const std::size_t size = std::size_t{8} + bytes.u32(4, false);
  if (bytes.starts_with("VP8X", 12)) {
    if (bytes.u8(20) & animated) header.unread = "an animated WebP";
    for (std::size_t at = 12, length; at + 8 <= std::min(size, bytes.size()); at += 8 + length + length % 2) {
      length = bytes.u32(at + 4, false);
      if (bytes.starts_with("EXIF", at)) header.orientation = exif_orientation(bytes, at + 8);
    }
    header.width = 1 + static_cast<long>(bytes.u32(24, false) & 0xFFFFFF);
    header.height = 1 + static_cast<long>(bytes.u32(27, false) & 0xFFFFFF);
  } else if (bytes.starts_with("VP8L", 12)) {
    header.width = 1 + static_cast<long>(bytes.u32(21, false) & 0x3FFF);
    header.height = 1 + static_cast<long>(bytes.u32(21, false) >> 14 & 0x3FFF);
  } else {
    header.width = bytes.u16(26, false) & 0x3FFF;
    header.height = bytes.u16(28, false) & 0x3FFF;
  }
  header.whole = size <= bytes.size();
}

void walk_bmp(const Bytes& bytes, ImageHeader& header) {
  const BmpHeader bmp = bmp_header(bytes);
  header.width = bmp.width;
  header.height = bmp.height;
  if (!bmp.readable) header.unread = "a compressed BMP";
  // Where runs end is seen when they are read.
  const std::size_t least = bmp.in_runs ? 2 : bmp.row_bytes * static_cast<std::size_t>(bmp.height);
  header.whole = bmp.pixels_at + least <= bytes.size();
}

bool is_space(std::uint32_t c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// Moves `at` to the next character that is neither white nor in a comment.
void skip_pnm_space(const Bytes& bytes, std::size_t& at) {
  for (; is_space(bytes.u8(at)) || bytes.u8(at) == '#'; ++at)
    if (bytes.u8(at) == '#')
      while (bytes.u8(at) != '\n') ++at;
}

long pnm_number(const Bytes& bytes, std::size_t& at) {
  skip_pnm_space(bytes, at);
  long value = 0;
  for (; at < bytes.size() && bytes.u8(at) >= '0' && bytes.u8(at) <= '9'; ++at)
    value = std::min(10 * value + static_cast<long>(bytes.u8(at) - '0'), 1'000'000'000L);
  return value;
}

// Behind the header of a PNM in text: `samples` numbers, or digits that may stand side by side.
bool has_numbers(const Bytes& bytes, std::size_t at, std::size_t samples, bool digits) {
  for (; samples > 0; --samples) {
    skip_pnm_space(bytes, at);
    if (bytes.u8(at) < '0' || bytes.u8(at) > '9') return false;
    if (digits)
      ++at;
    else
      pnm_number(bytes, at);
  }
  return true;
}

void walk_pnm(const Bytes& bytes, ImageHeader& header) {
  const char kind = static_cast<char>(bytes.u8(1));
  const bool bitmap = kind == '1' || kind == '4', text = kind <= '3';
  std::size_t at = 2;
  header.width = pnm_number(bytes, at);
  header.height = pnm_number(bytes, at);
  const long most = bitmap ? 1 : pnm_number(bytes, at);
  const std::size_t channels = kind == '3' || kind == '6' ? 3 : 1, row = static_cast<std::size_t>(header.width) * channels;
  const std::size_t row_bytes = bitmap ? (row + 7) / 8 : row * (most > 255 ? 2 : 1),
                    rows = static_cast<std::size_t>(header.height);
  header.whole = text ? has_numbers(bytes, at, row * rows, bitmap) : at + 1 + row_bytes * rows <= bytes.size();
}

}  // namespace

std::optional<ImageFormat> format_of(std::span<const char> file) {
  const Bytes bytes(file);
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return ImageFormat::png;
  if (bytes.starts_with("\xff\xd8\xff")) return ImageFormat::jpeg;
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) || bytes.starts_with("II+\0"sv) ||
      bytes.starts_with("MM\0+"sv))
    return ImageFormat::tiff;
  if (bytes.starts_with("RIFF") && bytes.starts_with("WEBP", 8)) return ImageFormat::webp;
  if (bytes.starts_with("BM")) return ImageFormat::bmp;
  if (bytes.size() > 2 && bytes.u8(0) == 'P' && bytes.u8(1) >= '1' && bytes.u8(1) <= '6') return ImageFormat::pnm;
  return std::nullopt;
}

const char* other_format(std::span<const char> file) {
  const Bytes bytes(file);
  constexpr std::size_t brand = 4;  // of what is made of boxes, ISO/IEC 14496-12
  if (bytes.starts_with("GIF8")) return "a GIF";
  if (bytes.starts_with("ftyphei", brand) || bytes.starts_with("ftypmif1", brand)) return "a HEIC photograph";
  if (bytes.starts_with("ftypavif", brand)) return "an AVIF";
  if (bytes.starts_with("%PDF")) return "a PDF";
  if (bytes.starts_with("8BPS")) return "a Photoshop document";
  return "";
}

ImageHeader header_of(ImageFormat format, std::span<const char> bytes) {
  ImageHeader header;
  try {
    switch (format) {
      case ImageFormat::png:
        walk_png(Bytes(bytes), header);
        break;
      case ImageFormat::jpeg:
        walk_jpeg(Bytes(bytes), header);
        break;
      case ImageFormat::tiff:
        walk_tiff(Bytes(bytes), header);
        break;
      case ImageFormat::webp:
        walk_webp(Bytes(bytes), header);
        break;
      case ImageFormat::bmp:
        walk_bmp(Bytes(bytes), header);
        break;
      case ImageFormat::pnm:
        walk_pnm(Bytes(bytes), header);
        break;
    }
  } catch (const std::out_of_range&) {
    header.whole = false;
  }
  return header;
}

}  // namespace inkgrid
