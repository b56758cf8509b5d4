#include "images/image_decode.h"

// jpeglib.h needs stdio.h before it, and jerror.h needs jpeglib.h.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on
#include <leptonica/allheaders.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <memory>
#include <utility>

#include "base/at.h"
#include "images/bmp.h"

namespace inkgrid {
namespace {

constexpr double kMmPerInch = 25.4, kMmPerCentimetre = 10;

const unsigned char* unsigned_data(std::span<const char> bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

std::optional<DecodedImage> decode_png(const ImageHeader& header, std::span<const char> bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) return std::nullopt;
  const bool alpha = png.format & PNG_FORMAT_FLAG_ALPHA, colour = png.format & PNG_FORMAT_FLAG_COLOR;
  png.format = alpha ? PNG_FORMAT_RGBA : colour ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // 16 bits are no more linear than 8
  DecodedImage image{static_cast<int>(png.width),
                     static_cast<int>(png.height),
                     alpha    ? 4
                     : colour ? 3
                              : 1,
                     {},
                     header.pixels_per_mm};
  image.samples.resize(PNG_IMAGE_SIZE(png));
  const bool read = png_image_finish_read(&png, nullptr, image.samples.data(), 0, nullptr) != 0;
  png_image_free(&png);
  return read ? std::optional(std::move(image)) : std::nullopt;
}

struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf escape;
  bool damaged = false;
};

JpegErrors& errors_of(j_common_ptr jpeg) {
  return *reinterpret_cast<JpegErrors*>(jpeg->err);
}

[[noreturn]] void escape_jpeg(j_common_ptr jpeg) {
  std::longjmp(errors_of(jpeg).escape, 1);
}

// The decoder warns where it fills up missing data, and of two harmless things.
void note_jpeg_warning(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  if (level < 0 && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM) errors_of(jpeg).damaged = true;
}

// Decodes into `image`, which the caller owns: nothing with a destructor may live here, an error jumps out of the middle.
bool read_jpeg(jpeg_decompress_struct& jpeg, JpegErrors& errors, std::span<const char> bytes, DecodedImage& image) {
  if (setjmp(errors.escape)) return false;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, unsigned_data(bytes), static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&jpeg, TRUE);
  const int channels = jpeg.num_components;
  if (channels != 1 && channels != 3 && channels != 4) return false;  // what others stand for, nobody knows
  if (channels == 4) jpeg.out_color_space = JCS_CMYK;
  jpeg_start_decompress(&jpeg);
  image.width = static_cast<int>(jpeg.output_width);
  image.height = static_cast<int>(jpeg.output_height);
  image.channels = jpeg.output_components;
  const std::size_t row_size = std::size_t{jpeg.output_width} * static_cast<std::size_t>(jpeg.output_components);
  image.samples.resize(row_size * jpeg.output_height);
  while (jpeg.output_scanline < jpeg.output_height) {
    if (errors.damaged) return false;
    JSAMPROW row = image.samples.data() + row_size * jpeg.output_scanline;
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return !errors.damaged;
}

// Inks that Adobe's programs store turned over.
void cmyk_to_rgb(DecodedImage& image, bool turned) {
  const std::size_t pixels = image.samples.size() / 4;
  const auto light = [&](std::size_t i) { return turned ? image.samples[i] : 255 - image.samples[i]; };
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.samples[3 * i + c] = static_cast<std::uint8_t>((light(4 * i + c) * light(4 * i + 3) + 127) / 255);
  image.samples.resize(3 * pixels);
  image.channels = 3;
}

std::optional<DecodedImage> decode_jpeg(std::span<const char> bytes) {
  JpegErrors errors;
  jpeg_decompress_struct jpeg{};
  jpeg.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = escape_jpeg;
  errors.manager.emit_message = note_jpeg_warning;
  DecodedImage image;
  const bool read = read_jpeg(jpeg, errors, bytes, image);
  const double unit = jpeg.density_unit == 1 ? kMmPerInch : kMmPerCentimetre;
  if (jpeg.density_unit == 1 || jpeg.density_unit == 2) image.pixels_per_mm = jpeg.X_density / unit;
  const bool turned = jpeg.saw_Adobe_marker;
  jpeg_destroy_decompress(&jpeg);
  if (!read) return std::nullopt;
  if (image.channels == 4) cmyk_to_rgb(image, turned);
  return image;
}

struct DestroyPix {
  void operator()(Pix* pix) const { pixDestroy(&pix); }
};

// Leptonica prints what it has to say, unless told once to be silent.
void silence_leptonica() {
  static const bool once = [] {
    setMsgSeverity(L_SEVERITY_NONE);
    leptSetStderrHandler([](const char*) {});
    return true;
  }();
  static_cast<void>(once);
}

// What the values of a pixel of at most 8 bits stand for.
std::array<std::array<std::uint8_t, 4>, 256> palette_of(Pix* pix) {
  std::array<std::array<std::uint8_t, 4>, 256> palette{};
  const int values = 1 << pixGetDepth(pix);
  PixColormap* map = pixGetColormap(pix);
  for (int v = 0; v < values; ++v) {
    int red = values == 2 ? 255 * (1 - v) : 255 * v / (values - 1), green = red, blue = red, alpha = 255;
    if (map && v < pixcmapGetCount(map)) pixcmapGetRGBA(map, v, &red, &green, &blue, &alpha);
    palette[at(v)] = {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue),
                      static_cast<std::uint8_t>(alpha)};
  }
  return palette;
}

// Leptonica packs pixels into words of 32 bits, the leftmost in the highest bits.
DecodedImage unpack(Pix* pix) {
  const int depth = pixGetDepth(pix);
  const bool mapped = pixGetColormap(pix) != nullptr, colour = mapped || depth == 32, alpha = mapped || pixGetSpp(pix) == 4;
  const auto palette = depth <= 8 ? palette_of(pix) : decltype(palette_of(pix)){};
  DecodedImage image{pixGetWidth(pix), pixGetHeight(pix), colour ? 4 : 1, {}, pixGetXRes(pix) / kMmPerInch};
  const auto channels = static_cast<std::size_t>(image.channels), bits_per_pixel = static_cast<std::size_t>(depth);
  image.samples.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * channels);
  std::uint8_t* out = image.samples.data();
  for (int y = 0; y < image.height; ++y) {
    const l_uint32* line = pixGetData(pix) + static_cast<std::ptrdiff_t>(y) * pixGetWpl(pix);
    for (std::size_t bit = 0; bit < static_cast<std::size_t>(image.width) * bits_per_pixel;
         bit += bits_per_pixel, out += channels) {
      const l_uint32 from_pixel = line[bit / 32] << (bit % 32);
      std::array<std::uint8_t, 4> pixel;  // of a deeper grey the high byte
      for (std::size_t c = 0; c < 4; ++c) pixel[c] = static_cast<std::uint8_t>(from_pixel >> (24 - 8 * c));
      if (depth <= 8) pixel = palette[from_pixel >> (32 - depth)];
      if (!alpha) pixel[3] = 255;
      std::copy_n(pixel.begin(), channels, out);
    }
  }
  return image;
}

std::optional<DecodedImage> decode_by_leptonica(std::span<const char> bytes) {
  silence_leptonica();
  const std::unique_ptr<Pix, DestroyPix> pix(pixReadMem(unsigned_data(bytes), bytes.size()));
  return pix ? std::optional(unpack(pix.get())) : std::nullopt;
}

}  // namespace

std::optional<DecodedImage> decode(ImageFormat format, const ImageHeader& header, std::span<const char> bytes) {
  if (format == ImageFormat::png) return decode_png(header, bytes);
  if (format == ImageFormat::jpeg) return decode_jpeg(bytes);
  if (format == ImageFormat::bmp) return decode_bmp(bytes);
  return decode_by_leptonica(bytes);
}

}  // namespace inkgrid
