// What:   see image_io.h.
// Source: the file formats; Rec. 601 for the luma.
// Differs: files that a decoder would quietly fill up (cut JPEG, TIFF, BMP, PNM) are refused before decoding.
// Cost:   one walk over the structure of the file, decoding, one pass over the pixels.
#include "image_io.h"

#include <leptonica/allheaders.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr long kMostPixels = 400'000'000;
constexpr double kMmPerInch = 25.4;

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorCode::file, sentence);
}

std::string quoted(const std::string& name) {
  return name == "-" ? "standard input" : "'" + name + "'";
}

enum class Format { png, jpeg, tiff, webp, bmp, pnm };

struct Size {
  long width = 0;
  long height = 0;
};

// Numbers at places of the file; std::out_of_range past its end.
class Bytes {
 public:
  explicit Bytes(std::span<const char> bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  bool starts_with(std::string_view magic, std::size_t at = 0) const {
    return at + magic.size() <= size() &&
           std::equal(magic.begin(), magic.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at));
  }
  std::uint32_t u8(std::size_t at) const {
    if (at >= size()) throw std::out_of_range("past the end of the file");
    return static_cast<unsigned char>(bytes_[at]);
  }
  std::uint32_t u16(std::size_t at, bool big) const { return big ? u8(at) << 8 | u8(at + 1) : u8(at + 1) << 8 | u8(at); }
  std::uint32_t u32(std::size_t at, bool big) const {
    return big ? u16(at, big) << 16 | u16(at + 2, big) : u16(at + 2, big) << 16 | u16(at, big);
  }

 private:
  std::span<const char> bytes_;
};

std::optional<Format> format_of(const Bytes& bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return Format::png;
  if (bytes.starts_with("\xff\xd8\xff")) return Format::jpeg;
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return Format::tiff;
  if (bytes.starts_with("RIFF") && bytes.starts_with("WEBP", 8)) return Format::webp;
  if (bytes.starts_with("BM")) return Format::bmp;
  if (bytes.size() > 2 && bytes.u8(0) == 'P' && bytes.u8(1) >= '1' && bytes.u8(1) <= '6') return Format::pnm;
  return std::nullopt;
}

// Chunks up to the one that closes the file.
bool png_is_whole(const Bytes& bytes) {
  std::size_t at = 8;
  while (!bytes.starts_with("IEND", at + 4)) at += std::size_t{12} + bytes.u32(at, true);
  return at + 12 <= bytes.size();
}

// Markers up to the one that ends the image; entropy-coded data holds none but restarts.
bool jpeg_is_whole(const Bytes& bytes) {
  constexpr std::uint32_t end_of_image = 0xD9, first_restart = 0xD0, last_restart = 0xD7, start_of_image = 0xD8, stuffed = 0,
                          temporary = 1;
  for (std::size_t at = 2;; ++at) {
    if (bytes.u8(at) != 0xFF) continue;
    const std::uint32_t marker = bytes.u8(at + 1);
    if (marker == end_of_image) return true;
    const bool bare = marker == stuffed || marker == temporary || marker == 0xFF || marker == start_of_image ||
                      (marker >= first_restart && marker <= last_restart);
    if (!bare) at += 1 + bytes.u16(at + 2, true);
  }
}

// The values of one entry of a TIFF directory.
std::vector<std::uint32_t> tiff_values(const Bytes& bytes, std::size_t entry, bool big) {
  const bool is_short = bytes.u16(entry + 2, big) == 3;
  const std::size_t count = bytes.u32(entry + 4, big), each = is_short ? 2 : 4;
  const std::size_t from = count * each <= 4 ? entry + 8 : bytes.u32(entry + 8, big);
  if (from + count * each > bytes.size()) throw std::out_of_range("past the end of the file");
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(is_short ? bytes.u16(from + i * each, big) : bytes.u32(from + i * each, big));
  return values;
}

// All strips or tiles of the first picture lie within the file.
bool tiff_is_whole(const Bytes& bytes) {
  constexpr std::uint32_t strip_offsets = 273, strip_sizes = 279, tile_offsets = 324, tile_sizes = 325;
  const bool big = bytes.u8(0) == 'M';
  const std::size_t directory = bytes.u32(4, big), entries = bytes.u16(directory, big);
  std::vector<std::uint32_t> offsets, sizes;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const std::uint32_t tag = bytes.u16(entry, big);
    if (tag == strip_offsets || tag == tile_offsets) offsets = tiff_values(bytes, entry, big);
    if (tag == strip_sizes || tag == tile_sizes) sizes = tiff_values(bytes, entry, big);
  }
  if (offsets.empty() || offsets.size() != sizes.size()) return false;
  for (std::size_t i = 0; i < offsets.size(); ++i)
    if (sizes[i] == 0 || std::size_t{offsets[i]} + sizes[i] > bytes.size()) return false;
  return true;
}

struct BmpHeader {
  Size size;
  std::size_t pixels_at, bits_per_pixel;
  bool compressed;
};

BmpHeader bmp_header(const Bytes& bytes) {
  const auto extent = [&](std::size_t at) {
    return std::abs(static_cast<long>(static_cast<std::int32_t>(bytes.u32(at, false))));
  };
  return {{extent(18), extent(22)}, bytes.u32(10, false), bytes.u16(28, false), bytes.u32(30, false) != 0};
}

bool bmp_is_whole(const Bytes& bytes) {
  const BmpHeader header = bmp_header(bytes);
  const std::size_t row = (static_cast<std::size_t>(header.size.width) * header.bits_per_pixel + 31) / 32 * 4;
  return header.pixels_at + row * static_cast<std::size_t>(header.size.height) <= bytes.size();
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

struct PnmHeader {
  std::uint32_t kind;  // '1'..'6'
  Size size;
  long most = 1;              // largest value of a sample
  std::size_t pixels_at = 0;  // behind the number that ends the header
};

PnmHeader pnm_header(const Bytes& bytes) {
  PnmHeader header{bytes.u8(1), {}, 1, 2};
  header.size.width = pnm_number(bytes, header.pixels_at);
  header.size.height = pnm_number(bytes, header.pixels_at);
  if (header.kind != '1' && header.kind != '4') header.most = pnm_number(bytes, header.pixels_at);
  return header;
}

bool pnm_is_whole(const Bytes& bytes) {
  const PnmHeader header = pnm_header(bytes);
  const auto width = static_cast<std::size_t>(header.size.width), height = static_cast<std::size_t>(header.size.height);
  const std::size_t channels = header.kind == '3' || header.kind == '6' ? 3 : 1;
  if (header.kind >= '4') {
    const std::size_t row = header.kind == '4' ? (width + 7) / 8 : width * channels * (header.most > 255 ? 2 : 1);
    return header.pixels_at + 1 + row * height <= bytes.size();
  }
  std::size_t at = header.pixels_at;
  for (std::size_t missing = width * height * channels; missing > 0; --missing) {
    skip_pnm_space(bytes, at);
    if (bytes.u8(at) < '0' || bytes.u8(at) > '9') return false;
    if (header.kind == '1')
      ++at;  // digits of a bitmap may stand side by side
    else
      pnm_number(bytes, at);
  }
  return true;
}

bool is_whole(Format format, const Bytes& bytes) {
  try {
    switch (format) {
      case Format::png:
        return png_is_whole(bytes);
      case Format::jpeg:
        return jpeg_is_whole(bytes);
      case Format::tiff:
        return tiff_is_whole(bytes);
      case Format::webp:
        return std::size_t{8} + bytes.u32(4, false) <= bytes.size();
      case Format::bmp:
        return bmp_is_whole(bytes);
      case Format::pnm:
        return pnm_is_whole(bytes);
    }
  } catch (const std::out_of_range&) {
  }
  return false;
}

const l_uint8* lept_data(std::span<const char> bytes) {
  return reinterpret_cast<const l_uint8*>(bytes.data());
}

// What the header says, without decoding; nothing where it is damaged.
std::optional<Size> declared_size(Format format, std::span<const char> bytes) {
  try {
    if (format == Format::bmp) return bmp_header(Bytes(bytes)).size;
    if (format == Format::pnm) return pnm_header(Bytes(bytes)).size;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
  l_int32 kind, width, height, bits, samples, palette;
  if (pixReadHeaderMem(lept_data(bytes), bytes.size(), &kind, &width, &height, &bits, &samples, &palette) != 0)
    return std::nullopt;
  return Size{width, height};
}

struct DestroyPix {
  void operator()(Pix* pix) const { pixDestroy(&pix); }
};
using PixOwner = std::unique_ptr<Pix, DestroyPix>;

PixOwner decode(std::span<const char> bytes, const std::string& name) {
  static const l_int32 silenced = setMsgSeverity(L_SEVERITY_NONE);
  static_cast<void>(silenced);
  if (bytes.empty()) refuse(quoted(name) + " is empty");
  const std::string damaged = quoted(name) + " is truncated or damaged";
  const std::optional<Format> format = format_of(Bytes(bytes));
  if (!format) refuse(quoted(name) + " is not an image that inkgrid reads (PNG, JPEG, TIFF, WebP, BMP, PNM)");
  const std::optional<Size> size = declared_size(*format, bytes);
  if (!size || size->width <= 0 || size->height <= 0) refuse(damaged);
  if (size->width > kMostPixels / size->height)
    refuse(quoted(name) + " declares " + std::to_string(size->width) + " x " + std::to_string(size->height) +
           " pixels, and inkgrid reads at most 400 million");
  if (*format == Format::bmp && bmp_header(Bytes(bytes)).compressed)
    refuse(quoted(name) + " is a compressed BMP, which inkgrid does not read");
  if (!is_whole(*format, Bytes(bytes))) refuse(damaged);
  PixOwner pix(pixReadMem(lept_data(bytes), bytes.size()));
  if (!pix || pixGetWidth(pix.get()) <= 0 || pixGetHeight(pix.get()) <= 0) refuse(damaged);
  return pix;
}

struct Rgba {
  int red, green, blue, alpha;
};

Rgba uniform(int grey) {
  return {grey, grey, grey, 255};
}

// The colours that the values of a pixel of at most 8 bits stand for.
std::array<Rgba, 256> palette_of(Pix* pix) {
  std::array<Rgba, 256> palette{};
  const int values = 1 << pixGetDepth(pix);
  for (int v = 0; v < values; ++v) {
    Rgba& colour = palette[static_cast<std::size_t>(v)] = uniform(values == 2 ? 255 * (1 - v) : 255 * v / (values - 1));
    PixColormap* map = pixGetColormap(pix);
    if (map && v < pixcmapGetCount(map)) pixcmapGetRGBA(map, v, &colour.red, &colour.green, &colour.blue, &colour.alpha);
  }
  return palette;
}

// Calls visit(colour) for all pixels, row by row.
template <class Visit>
void visit_pixels(Pix* pix, Visit visit) {
  const int depth = pixGetDepth(pix), width = pixGetWidth(pix), height = pixGetHeight(pix);
  const bool has_alpha = pixGetSpp(pix) == 4;
  const std::array<Rgba, 256> palette = depth <= 8 ? palette_of(pix) : std::array<Rgba, 256>{};
  for (int y = 0; y < height; ++y) {
    const l_uint32* line = pixGetData(pix) + static_cast<std::ptrdiff_t>(y) * pixGetWpl(pix);
    for (int x = 0; x < width; ++x) {
      const std::size_t bit = static_cast<std::size_t>(x) * static_cast<std::size_t>(depth);
      const l_uint32 word = line[bit / 32];
      const auto part = [&](std::size_t first, int bits) {
        return static_cast<int>(word >> (32 - first - static_cast<std::size_t>(bits))) & ((1 << bits) - 1);
      };
      if (depth == 32)
        visit(Rgba{part(0, 8), part(8, 8), part(16, 8), has_alpha ? part(24, 8) : 255});
      else if (depth == 16)
        visit(uniform(part(bit % 32, 8)));  // the high byte
      else
        visit(palette[static_cast<std::size_t>(part(bit % 32, depth))]);
    }
  }
}

int luma(Rgba c) {
  return (299 * c.red + 587 * c.green + 114 * c.blue + 500) / 1000;
}

enum class Scribble { none, finer, coarser, other };

// By hue, of colours that are clearly no grey.
Scribble scribble_of(Rgba c) {
  const int most = std::max({c.red, c.green, c.blue}), least = std::min({c.red, c.green, c.blue}), range = most - least;
  if (most < 64 || 10 * range < 3 * most) return Scribble::none;
  const double hue = most == c.red     ? 60.0 * (c.green - c.blue) / range
                     : most == c.green ? 120 + 60.0 * (c.blue - c.red) / range
                                       : 240 + 60.0 * (c.red - c.green) / range;
  const double degrees = hue < 0 ? hue + 360 : hue;
  if (degrees >= 260 && degrees <= 320) return Scribble::finer;
  if (degrees >= 15 && degrees <= 45) return Scribble::coarser;
  return Scribble::other;
}

bool is_see_through(Rgba c) {
  return c.alpha < 64;
}

float factor_of_grey(Rgba c) {
  return static_cast<float>(std::clamp(std::exp2((128 - luma(c)) / 64.0), 0.25, 4.0));
}

float factor_of_scribble(Rgba c) {
  if (is_see_through(c)) return 1;
  const Scribble scribble = scribble_of(c);
  return scribble == Scribble::finer ? 0.5f : scribble == Scribble::coarser ? 2.0f : 1.0f;
}

// All of a stream that is open for reading.
std::string slurp(std::FILE* stream, const std::string& name) {
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), stream)) bytes.append(buffer.data(), n);
  if (std::ferror(stream)) refuse("cannot read " + quoted(name) + ": " + std::generic_category().message(errno));
  return bytes;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::string read_bytes(const std::string& path) {
  if (path == "-") return slurp(stdin, path);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("cannot read " + quoted(path) + ": it is a directory");
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) refuse("cannot read " + quoted(path) + ": " + std::generic_category().message(errno));
  return slurp(file.get(), path);
}

Image decode_image(std::span<const char> bytes, const std::string& name) {
  const PixOwner pix = decode(bytes, name);
  Image image{pixGetWidth(pix.get()), pixGetHeight(pix.get()), {}, pixGetXRes(pix.get()) / kMmPerInch};
  image.grey.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  visit_pixels(pix.get(), [&](Rgba c) {
    image.grey.push_back(static_cast<std::uint8_t>((luma(c) * c.alpha + 255 * (255 - c.alpha) + 127) / 255));
  });
  return image;
}

ScaleMask decode_mask(std::span<const char> bytes, const std::string& name) {
  const PixOwner pix = decode(bytes, name);
  bool scribbled = false, coloured = false, grey = false;
  visit_pixels(pix.get(), [&](Rgba c) {
    if (is_see_through(c)) return;
    const Scribble scribble = scribble_of(c);
    scribbled |= scribble == Scribble::finer || scribble == Scribble::coarser;
    coloured |= scribble == Scribble::other;
    grey |= luma(c) < 250;
  });
  if (!scribbled && (coloured || !grey))
    refuse(quoted(name) + " is no mask: it holds neither purple nor orange scribbles nor greys");
  ScaleMask mask{pixGetWidth(pix.get()), pixGetHeight(pix.get()), {}};
  mask.factor.reserve(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height));
  visit_pixels(pix.get(), [&](Rgba c) {
    mask.factor.push_back(scribbled || is_see_through(c) ? factor_of_scribble(c) : factor_of_grey(c));
  });
  return mask;
}

}  // namespace inkgrid
