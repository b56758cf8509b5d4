#include "images/image_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "images/image_decode.h"
#include "images/image_format.h"
#include "images/orientation.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr long kMostPixels = 400'000'000;

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorCode::file, sentence);
}

std::string quoted(const std::string& name) {
  return name == "-" ? "standard input" : "'" + name + "'";
}

std::string is_no_image(std::span<const char> bytes) {
  const std::string what = other_format(bytes), read = "(PNG, JPEG, TIFF, WebP, BMP, PNM)";
  return what.empty() ? " is not an image that inkgrid reads " + read : " is " + what + ", which inkgrid does not read " + read;
}

DecodedImage decode(std::span<const char> bytes, const std::string& name) {
  if (bytes.empty()) refuse(quoted(name) + " is empty");
  const std::string damaged = quoted(name) + " is truncated or damaged";
  const std::optional<ImageFormat> format = format_of(bytes);
  if (!format) refuse(quoted(name) + is_no_image(bytes));
  const ImageHeader header = header_of(*format, bytes);
  if (*header.unread) refuse(quoted(name) + " is " + header.unread + ", which inkgrid does not read");
  if (header.width <= 0 || header.height <= 0) refuse(damaged);
  if (header.width > kMostPixels / header.height)
    refuse(quoted(name) + " declares " + std::to_string(header.width) + " x " + std::to_string(header.height) +
           " pixels, and inkgrid reads at most 400 million");
  if (!header.whole) refuse(damaged);
  std::optional<DecodedImage> image = decode(*format, header, bytes);
  if (!image || image->width <= 0 || image->height <= 0) refuse(damaged);
  return upright(std::move(*image), header.orientation);
}

constexpr int kLight = 192;  // luma

struct Rgba {
  int red, green, blue, alpha;
};

// Calls visit(colour) for all pixels, row by row.
template <class Visit>
void visit_pixels(const DecodedImage& image, Visit visit) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.samples.size(); i += channels) {
    const std::uint8_t* s = &image.samples[i];
    visit(channels == 1 ? Rgba{s[0], s[0], s[0], 255} : Rgba{s[0], s[1], s[2], channels == 4 ? s[3] : 255});
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

// What shows through: white paper, but black behind a drawing in light ink alone, of which white paper would leave nothing.
int paper_behind(const DecodedImage& image) {
  bool see_through = false, light_alone = true;
  visit_pixels(image, [&](Rgba c) {
    if (is_see_through(c))
      see_through = true;
    else
      light_alone = light_alone && luma(c) >= kLight;
  });
  return see_through && light_alone ? 0 : 255;
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
  if (std::ferror(stream)) refuse("can't read " + quoted(name) + ": " + std::generic_category().message(errno));
  return bytes;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::string read_bytes(const std::string& path) {
  if (path == "-") return slurp(stdin, path);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("can't read " + quoted(path) + ": it is a directory");
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) refuse("can't read " + quoted(path) + ": " + std::generic_category().message(errno));
  return slurp(file.get(), path);
}

Image decode_image(std::span<const char> bytes, const std::string& name) {
  const DecodedImage decoded = decode(bytes, name);
  Image image{decoded.width, decoded.height, {}, decoded.pixels_per_mm};
  image.grey.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const int paper = paper_behind(decoded);
  visit_pixels(decoded, [&](Rgba c) {
    image.grey.push_back(static_cast<std::uint8_t>((luma(c) * c.alpha + paper * (255 - c.alpha) + 127) / 255));
  });
  return image;
}

ScaleMask decode_mask(std::span<const char> bytes, const std::string& name) {
  const DecodedImage decoded = decode(bytes, name);
  bool scribbled = false, coloured = false, grey = false;
  visit_pixels(decoded, [&](Rgba c) {
    if (is_see_through(c)) return;
    const Scribble scribble = scribble_of(c);
    scribbled |= scribble == Scribble::finer || scribble == Scribble::coarser;
    coloured |= scribble == Scribble::other;
    grey |= luma(c) < 250;
  });
  if (!scribbled && (coloured || !grey))
    refuse(quoted(name) + " is no mask: it holds neither purple nor orange scribbles nor greys");
  ScaleMask mask{decoded.width, decoded.height, {}};
  mask.factor.reserve(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height));
  visit_pixels(decoded, [&](Rgba c) {
    mask.factor.push_back(scribbled || is_see_through(c) ? factor_of_scribble(c) : factor_of_grey(c));
  });
  return mask;
}

}  // namespace inkgrid
