#include <gtest/gtest.h>
#include <leptonica/allheaders.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <random>

#include "image_io.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

struct DestroyPix {
  void operator()(Pix* pix) const { pixDestroy(&pix); }
};
using PixOwner = std::unique_ptr<Pix, DestroyPix>;

constexpr int kWidth = 37, kHeight = 23;

struct Colour {
  int red, green, blue, alpha = 255;
};

Colour colour_at(int x, int y) {
  return {(7 * x) % 256, (11 * y + 3 * x) % 256, (5 * x * y) % 256};
}
int value_at(int x, int y) {
  return (37 * x + 101 * y + x * y) & 0xffff;
}

PixOwner grey_pix(int depth) {
  PixOwner pix(pixCreate(kWidth, kHeight, depth));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) pixSetPixel(pix.get(), x, y, static_cast<l_uint32>(value_at(x, y) & ((1 << depth) - 1)));
  return pix;
}

PixOwner colour_pix(const std::function<Colour(int, int)>& colour, bool alpha = false, int width = kWidth, int height = kHeight) {
  PixOwner pix(pixCreate(width, height, 32));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Colour c = colour(x, y);
      l_uint32 word;
      composeRGBAPixel(c.red, c.green, c.blue, c.alpha, &word);
      pixSetPixel(pix.get(), x, y, word);
    }
  pixSetSpp(pix.get(), alpha ? 4 : 3);
  return pix;
}

std::string own(l_uint8* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  std::free(data);
  return bytes;
}

std::string encode(const PixOwner& pix, int format) {
  l_uint8* data = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(pixWriteMem(&data, &size, pix.get(), format), 0);
  return own(data, size);
}

std::string encode_webp(const PixOwner& pix) {
  l_uint8* data = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(pixWriteMemWebP(&data, &size, pix.get(), 100, 1), 0);
  return own(data, size);
}

std::string encode_ascii_pnm(const PixOwner& pix) {
  char* data = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&data, &size);
  EXPECT_EQ(pixWriteStreamAsciiPnm(stream, pix.get()), 0);
  std::fclose(stream);
  return own(reinterpret_cast<l_uint8*>(data), size);
}

int luma(Colour c) {
  return static_cast<int>(std::lround(0.299 * c.red + 0.587 * c.green + 0.114 * c.blue));
}

void expect_pixels(const Image& image, const std::function<int(int, int)>& grey, int tolerance = 0) {
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  ASSERT_EQ(image.grey.size(), static_cast<std::size_t>(kWidth * kHeight));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_NEAR(image.grey[static_cast<std::size_t>(y * kWidth + x)], grey(x, y), tolerance) << x << ", " << y;
}

// The sentence with which the bytes are refused; empty when they are not.
std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::file);
    return e.what();
  }
  return "";
}
std::string refusal(const std::string& bytes) {
  return refusal([&] { decode_image(bytes, "x.png"); });
}

struct Sample {
  const char* what;
  std::string bytes;
};

std::vector<Sample> samples() {
  const PixOwner colour = colour_pix(colour_at), grey = grey_pix(8), bits = grey_pix(1);
  return {{"png", encode(colour, IFF_PNG)},
          {"grey png", encode(grey, IFF_PNG)},
          {"1 bit png", encode(bits, IFF_PNG)},
          {"jpeg", encode(colour, IFF_JFIF_JPEG)},
          {"grey jpeg", encode(grey, IFF_JFIF_JPEG)},
          {"tiff", encode(colour, IFF_TIFF)},
          {"lzw tiff", encode(grey, IFF_TIFF_LZW)},
          {"zip tiff", encode(colour, IFF_TIFF_ZIP)},
          {"g4 tiff", encode(bits, IFF_TIFF_G4)},
          {"webp", encode_webp(colour)},
          {"bmp", encode(colour, IFF_BMP)},
          {"grey bmp", encode(grey, IFF_BMP)},
          {"ppm", encode(colour, IFF_PNM)},
          {"pgm", encode(grey, IFF_PNM)},
          {"pbm", encode(bits, IFF_PNM)},
          {"ascii pgm", encode_ascii_pnm(grey)},
          {"ascii ppm", encode_ascii_pnm(colour)},
          {"ascii pbm", encode_ascii_pnm(bits)}};
}

TEST(ImageIo, LosslessFormatsGiveTheLuma) {
  const PixOwner pix = colour_pix(colour_at);
  for (const int format : {IFF_PNG, IFF_TIFF, IFF_TIFF_LZW, IFF_TIFF_ZIP, IFF_TIFF_PACKBITS, IFF_BMP, IFF_PNM}) {
    SCOPED_TRACE(format);
    expect_pixels(decode_image(encode(pix, format), "x"), [](int x, int y) { return luma(colour_at(x, y)); });
  }
  expect_pixels(decode_image(encode_webp(pix), "x"), [](int x, int y) { return luma(colour_at(x, y)); });
  expect_pixels(decode_image(encode_ascii_pnm(pix), "x"), [](int x, int y) { return luma(colour_at(x, y)); });
}

TEST(ImageIo, JpegIsClose) {
  const auto smooth = [](int x, int y) { return Colour{6 * x, 10 * y, 128}; };
  expect_pixels(
      decode_image(encode(colour_pix(smooth), IFF_JFIF_JPEG), "x"), [&](int x, int y) { return luma(smooth(x, y)); }, 12);
}

TEST(ImageIo, GreysOfAllDepths) {
  for (const int depth : {1, 2, 4, 8, 16})
    for (const int format : {IFF_PNG, IFF_TIFF, IFF_TIFF_LZW, IFF_PNM}) {
      SCOPED_TRACE(std::to_string(depth) + " bits, format " + std::to_string(format));
      const int most = (1 << depth) - 1;
      const auto grey = [&](int x, int y) {
        const int value = value_at(x, y) & most;
        return depth == 1 ? 255 * (1 - value) : depth == 16 ? value >> 8 : 255 * value / most;
      };
      expect_pixels(decode_image(encode(grey_pix(depth), format), "x"), grey, depth == 16 ? 1 : 0);  // cut or rounded
    }
}

TEST(ImageIo, BlackInkIsDarkInEveryBilevelFormat) {
  PixOwner pix(pixCreate(kWidth, kHeight, 1));
  pixSetPixel(pix.get(), 5, 7, 1);
  for (const int format : {IFF_PNG, IFF_TIFF, IFF_TIFF_G4, IFF_BMP, IFF_PNM}) {
    SCOPED_TRACE(format);
    expect_pixels(decode_image(encode(pix, format), "x"), [](int x, int y) { return x == 5 && y == 7 ? 0 : 255; });
  }
}

TEST(ImageIo, Palette) {
  for (const int depth : {1, 2, 4, 8})
    for (const int format : {IFF_PNG, IFF_TIFF, IFF_BMP}) {
      if (format == IFF_BMP && depth <= 2)
        continue;  // Leptonica writes the first with its colours swapped, the second not at all
      SCOPED_TRACE(std::to_string(depth) + " bits, format " + std::to_string(format));
      PixOwner pix = grey_pix(depth);
      PixColormap* map = pixcmapCreate(depth);
      const auto entry = [](int i) { return Colour{(40 + 83 * i) % 256, (200 + 31 * i) % 256, (19 * i) % 256}; };
      for (int i = 0; i < 1 << depth; ++i) pixcmapAddColor(map, entry(i).red, entry(i).green, entry(i).blue);
      pixSetColormap(pix.get(), map);
      expect_pixels(decode_image(encode(pix, format), "x"),
                    [&](int x, int y) { return luma(entry(value_at(x, y) & ((1 << depth) - 1))); });
    }
}

void put(std::string& bytes, std::size_t value, int count) {
  for (int i = 0; i < count; ++i, value >>= 8) bytes.push_back(static_cast<char>(value & 255));
}

// A BMP of the given header size and pixels, each of `bits` bits; kHeight rows of kWidth.
std::string bmp(std::size_t header_size, std::size_t bits, const std::vector<std::uint32_t>& fields, bool top_down,
                const std::function<std::uint32_t(int, int)>& pixel) {
  std::string bytes = "BM";
  put(bytes, 0, 8);
  put(bytes, 14 + header_size + (header_size == 40 ? 4 * fields.size() : 0), 4);
  put(bytes, header_size, 4);
  put(bytes, kWidth, header_size == 12 ? 2 : 4);
  put(bytes, static_cast<std::uint32_t>(top_down ? -kHeight : kHeight), header_size == 12 ? 2 : 4);
  put(bytes, 1, 2);
  put(bytes, bits, 2);
  if (header_size > 12) {
    put(bytes, fields.empty() ? 0 : 3, 4);
    put(bytes, 0, 20);
    for (const std::uint32_t f : fields) put(bytes, f, 4);
    while (bytes.size() < 14 + header_size) bytes.push_back('\0');
  }
  for (int row = 0; row < kHeight; ++row) {
    for (int x = 0; x < kWidth; ++x) put(bytes, pixel(x, top_down ? row : kHeight - 1 - row), static_cast<int>(bits / 8));
    while ((bytes.size() - 14 - header_size - (header_size == 40 ? 4 * fields.size() : 0)) % 4) bytes.push_back('\0');
  }
  return bytes;
}

TEST(ImageIo, BmpOfManyKinds) {
  const auto packed = [](int x, int y) {
    const Colour c = colour_at(x, y);
    return static_cast<std::uint32_t>(c.red << 16 | c.green << 8 | c.blue);
  };
  const auto exact = [](int x, int y) { return luma(colour_at(x, y)); };
  expect_pixels(decode_image(bmp(12, 24, {}, false, packed), "x"), exact);
  for (const std::size_t header : {40u, 108u, 124u})
    for (const bool top_down : {false, true}) {
      SCOPED_TRACE(header);
      expect_pixels(decode_image(bmp(header, 24, {}, top_down, packed), "x"), exact);
      expect_pixels(decode_image(bmp(header, 32, {}, top_down, packed), "x"), exact);
      expect_pixels(decode_image(bmp(header, 32, {0xFF0000, 0xFF00, 0xFF}, top_down, packed), "x"), exact);
      const auto of_16_bits = [](int x, int y) {
        const Colour c = colour_at(x, y);
        return static_cast<std::uint32_t>(c.red >> 3 << 11 | c.green >> 2 << 5 | c.blue >> 3);
      };
      expect_pixels(decode_image(bmp(header, 16, {0xF800, 0x7E0, 0x1F}, top_down, of_16_bits), "x"), exact, 5);
    }
  const auto half = [](int, int) { return 0x80000000u; };
  expect_pixels(
      decode_image(bmp(108, 32, {0xFF0000, 0xFF00, 0xFF, 0xFF000000}, false, half), "x"), [](int, int) { return 127; }, 1);
  std::string with_jpeg_inside = bmp(40, 24, {}, false, packed);
  with_jpeg_inside[30] = 4;
  EXPECT_EQ(refusal(with_jpeg_inside), "'x.png' is a compressed BMP, which inkgrid does not read");
}

// A BMP of 10 x 4 pixels of 4 or 8 bits whose index i is the grey 10 i, in these runs from the lowest row on.
std::string bmp_in_runs(int bits, const std::vector<int>& runs) {
  std::string bytes = "BM";
  put(bytes, 0, 8);
  put(bytes, 54 + 16 * 4, 4);
  for (const std::size_t value : {40, 10, 4}) put(bytes, value, 4);
  put(bytes, 1, 2);
  put(bytes, static_cast<std::size_t>(bits), 2);
  put(bytes, bits == 8 ? 1 : 2, 4);
  put(bytes, 0, 20);
  for (std::size_t i = 0; i < 16; ++i) put(bytes, 10 * i * 0x10101, 4);
  for (const int byte : runs) put(bytes, static_cast<std::size_t>(byte), 1);
  return bytes;
}

TEST(ImageIo, BmpInRuns) {
  const std::vector<std::vector<int>> rows = {{7, 7, 7, 7, 7, 0, 0, 0, 0, 0},
                                              {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                                              {0, 0, 9, 9, 0, 0, 0, 0, 0, 0},
                                              {1, 1, 1, 1, 2, 3, 4, 0, 0, 0}};
  const auto expect_rows = [&](const Image& image) {
    ASSERT_EQ(std::pair(image.width, image.height), std::pair(10, 4));
    for (std::size_t y = 0; y < 4; ++y)
      for (std::size_t x = 0; x < 10; ++x) EXPECT_EQ(image.grey[10 * y + x], 10 * rows[y][x]) << x << ", " << y;
  };
  // A run, three literals and a byte of filling; a skip of two pixels; two rows up; the end.
  const std::vector<int> of_8{4, 1, 0, 3, 2, 3, 4, 0, 0, 0, 0, 2, 2, 0, 2, 9, 0, 0, 0, 2, 0, 1, 5, 7, 0, 1};
  const std::vector<int> of_4{4, 0x11, 0, 3, 0x23, 0x40, 0, 0, 0, 2, 2, 0, 2, 0x99, 0, 0, 0, 2, 0, 1, 5, 0x77, 0, 1};
  expect_rows(decode_image(bmp_in_runs(8, of_8), "x"));
  expect_rows(decode_image(bmp_in_runs(4, of_4), "x"));
  for (std::size_t n = 0; n + 1 < of_8.size(); ++n)
    EXPECT_EQ(refusal(bmp_in_runs(8, {of_8.begin(), of_8.begin() + static_cast<std::ptrdiff_t>(n)})),
              "'x.png' is truncated or damaged")
        << n;
  EXPECT_EQ(refusal(bmp_in_runs(8, {11, 1, 0, 1})), "'x.png' is truncated or damaged") << "a run past its row";
}

// An Exif block that says how the rows lie, in either order of bytes, behind a tag that says nothing of it.
std::string exif(int orientation, bool big) {
  std::string bytes = big ? std::string("MM\0*\0\0\0\x08", 8) : std::string("II*\0\x08\0\0\0", 8);
  const auto number = [&](int value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> 8 * (big ? count - 1 - i : i) & 255));
  };
  number(2, 2);
  for (const auto& [tag, value] : {std::pair{271, 7}, {274, orientation}}) {
    number(tag, 2), number(3, 2), number(1, 4);
    number(value, 2), number(0, 2);
  }
  number(0, 4);
  return bytes;
}

std::string inserted(std::string bytes, std::size_t at, const std::string& part) {
  return bytes.insert(at, part);
}

std::string big_number(std::size_t value, int count) {
  std::string text;
  for (int i = count - 1; i >= 0; --i) text.push_back(static_cast<char>(value >> 8 * i & 255));
  return text;
}

std::string jpeg_with(const std::string& jpeg, const std::string& exif) {
  return inserted(jpeg, 2, "\xff\xe1" + big_number(exif.size() + 8, 2) + std::string("Exif\0\0", 6) + exif);
}

// The checksum is not looked at: the chunk is none that the pixels need.
std::string png_with(const std::string& png, const std::string& exif) {
  return inserted(png, 33, big_number(exif.size(), 4) + "eXIf" + exif + std::string(4, '\0'));
}

std::string webp_with(const std::string& webp, const std::string& exif, char flags = 8) {
  std::string bytes = "RIFF....WEBPVP8X";
  put(bytes, 10, 4);
  put(bytes, static_cast<std::size_t>(flags), 4);
  put(bytes, kWidth - 1, 3);
  put(bytes, kHeight - 1, 3);
  bytes += webp.substr(12);
  bytes += "EXIF";
  put(bytes, exif.size(), 4);
  bytes += exif;
  std::string size;
  put(size, bytes.size() - 8, 4);
  return bytes.replace(4, 4, size);
}

TEST(ImageIo, PicturesAreTurnedAsTheCameraWasHeld) {
  const PixOwner pix = colour_pix(colour_at);
  const int w = kWidth - 1, h = kHeight - 1;
  // Where pixel (x, y) of the upright picture is stored.
  const std::function<std::pair<int, int>(int, int)> stored[] = {
      [](int x, int y) { return std::pair(x, y); },          [&](int x, int y) { return std::pair(w - x, y); },
      [&](int x, int y) { return std::pair(w - x, h - y); }, [&](int x, int y) { return std::pair(x, h - y); },
      [](int x, int y) { return std::pair(y, x); },          [&](int x, int y) { return std::pair(y, h - x); },
      [&](int x, int y) { return std::pair(w - y, h - x); }, [&](int x, int y) { return std::pair(w - y, x); },
  };
  for (int orientation = 1; orientation <= 8; ++orientation)
    for (const bool big : {false, true}) {
      const std::string block = exif(orientation, big);
      for (const std::string& bytes : {jpeg_with(encode(pix, IFF_JFIF_JPEG), block), png_with(encode(pix, IFF_PNG), block),
                                       webp_with(encode_webp(pix), block)}) {
        SCOPED_TRACE(std::to_string(orientation) + " in " + bytes.substr(bytes[0] == 'R' ? 8 : 1, 3));
        const Image image = decode_image(bytes, "x");
        ASSERT_EQ(std::pair(image.width, image.height),
                  orientation < 5 ? std::pair(kWidth, kHeight) : std::pair(kHeight, kWidth));
        const Image plain = decode_image(bytes[0] == 'R'      ? encode_webp(pix)
                                         : bytes[0] == '\x89' ? encode(pix, IFF_PNG)
                                                              : encode(pix, IFF_JFIF_JPEG),
                                         "x");
        for (int y = 0; y < image.height; ++y)
          for (int x = 0; x < image.width; ++x) {
            const auto [i, j] = stored[orientation - 1](x, y);
            ASSERT_EQ(image.grey[static_cast<std::size_t>(y * image.width + x)],
                      plain.grey[static_cast<std::size_t>(j * kWidth + i)])
                << x << ", " << y;
          }
      }
    }
}

// Greys in one strip, and a directory behind them.
std::string tiff_lying(int orientation) {
  std::string bytes("II*\0", 4);
  const std::size_t pixels = static_cast<std::size_t>(kWidth * kHeight);
  put(bytes, 8 + pixels + pixels % 2, 4);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) put(bytes, static_cast<std::size_t>(luma(colour_at(x, y))), 1);
  if (pixels % 2) put(bytes, 0, 1);
  const std::pair<std::size_t, std::size_t> entries[] = {
      {256, kWidth}, {257, kHeight}, {258, 8},     {259, 1}, {262, 1}, {273, 8}, {274, static_cast<std::size_t>(orientation)},
      {277, 1},      {278, kHeight}, {279, pixels}};
  put(bytes, std::size(entries), 2);
  for (const auto& [tag, value] : entries) put(bytes, tag, 2), put(bytes, 4, 2), put(bytes, 1, 4), put(bytes, value, 4);
  put(bytes, 0, 4);
  return bytes;
}

TEST(ImageIo, ATiffIsTurnedByItsOwnTag) {
  const Image plain = decode_image(tiff_lying(1), "x");
  expect_pixels(plain, [](int x, int y) { return luma(colour_at(x, y)); });
  const Image over_head = decode_image(tiff_lying(3), "x"), clockwise = decode_image(tiff_lying(6), "x");
  EXPECT_TRUE(std::equal(plain.grey.rbegin(), plain.grey.rend(), over_head.grey.begin()));
  ASSERT_EQ(std::pair(clockwise.width, clockwise.height), std::pair(kHeight, kWidth));
  for (int y = 0; y < kWidth; ++y)
    for (int x = 0; x < kHeight; ++x)
      ASSERT_EQ(clockwise.grey[static_cast<std::size_t>(y * kHeight + x)],
                plain.grey[static_cast<std::size_t>((kHeight - 1 - x) * kWidth + y)]);
}

TEST(ImageIo, BrokenExifLeavesThePictureAsItIs) {
  const std::string jpeg = encode(colour_pix(colour_at), IFF_JFIF_JPEG), whole = exif(6, true);
  const Image plain = decode_image(jpeg, "x");
  for (std::size_t n = 0; n < whole.size() - 6; ++n)
    EXPECT_EQ(decode_image(jpeg_with(jpeg, whole.substr(0, n)), "x").grey.size(), plain.grey.size()) << n;
  for (const int nonsense : {0, 9, 255}) EXPECT_EQ(decode_image(jpeg_with(jpeg, exif(nonsense, false)), "x").grey, plain.grey);
}

TEST(ImageIo, KindsThatAreNotReadAreNamed) {
  const auto sentence = [](const std::string& what) { return "'x.png' is " + what + ", which inkgrid does not read"; };
  EXPECT_EQ(refusal(std::string("II+\0\x08\0\0\0", 8) + std::string(60, '\0')), sentence("a BigTIFF"));
  EXPECT_EQ(refusal(std::string("MM\0+\0\x08\0\0", 8) + std::string(60, '\0')), sentence("a BigTIFF"));
  EXPECT_EQ(refusal(webp_with(encode_webp(colour_pix(colour_at)), exif(1, false), 2)), sentence("an animated WebP"));
}

TEST(ImageIo, PaletteWithAlphaLiesOverWhite) {
  PixOwner pix = grey_pix(2);
  PixColormap* map = pixcmapCreate(2);
  const int alpha[] = {0, 255, 128, 51};
  for (int i = 0; i < 4; ++i) pixcmapAddRGBA(map, 0, 0, 0, alpha[i]);
  pixSetColormap(pix.get(), map);
  expect_pixels(
      decode_image(encode(pix, IFF_PNG), "x"), [&](int x, int y) { return 255 - alpha[value_at(x, y) & 3]; }, 1);
}

TEST(ImageIo, AlphaLiesOverWhite) {
  const auto colour = [](int x, int y) { return Colour{10, 60, 30, (7 * x + 9 * y) % 256}; };
  const PixOwner pix = colour_pix(colour, true);
  const auto expected = [&](int x, int y) {
    const double a = colour(x, y).alpha / 255.0;
    return static_cast<int>(std::lround(a * luma(colour(x, y)) + (1 - a) * 255));
  };
  expect_pixels(decode_image(encode(pix, IFF_PNG), "x"), expected, 1);
  expect_pixels(decode_image(encode_webp(pix), "x"), expected, 1);
  expect_pixels(decode_image(encode(pix, IFF_TIFF_LZW), "x"), expected, 1);
}

TEST(ImageIo, ResolutionIsInPixelsPerMillimetre) {
  for (const int format : {IFF_PNG, IFF_JFIF_JPEG, IFF_TIFF, IFF_BMP}) {
    PixOwner pix = grey_pix(8);
    EXPECT_EQ(decode_image(encode(pix, IFF_PNG), "x").pixels_per_mm, 0);
    pixSetResolution(pix.get(), 254, 254);
    EXPECT_NEAR(decode_image(encode(pix, format), "x").pixels_per_mm, 10, 0.05) << format;
  }
}

TEST(ImageIo, CutFilesAreRefused) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.what);
    const Image whole = decode_image(sample.bytes, "x");
    const std::string_view what = sample.what;
    // A number in text that lost its last digits is still a number.
    const std::size_t end = sample.bytes.size() - (what.starts_with("ascii") ? 5 : 0);
    for (std::size_t n = 0; n < end; ++n) {
      Image image;
      const std::string why = refusal([&] { image = decode_image(std::string_view(sample.bytes).substr(0, n), "x.png"); });
      if (why.empty()) {
        ASSERT_EQ(image.grey, whole.grey) << "the first " << n << " of " << sample.bytes.size() << " bytes";
        ASSERT_GT(n, sample.bytes.size() / 2);  // what may be cut stands behind the pixels
      } else if (n > 40) {
        ASSERT_EQ(why, "'x.png' is truncated or damaged") << n;
      }
    }
  }
}

TEST(ImageIo, HolesInAJpegAreRefused) {
  const auto busy = [](int x, int y) { return Colour{(x * 71 + y * 31) % 256, (x * y * 13) % 256, (x * 7) % 256}; };
  const std::string bytes = encode(colour_pix(busy, false, 200, 150), IFF_JFIF_JPEG);
  for (const double part : {0.5, 0.8, 0.95}) {
    const auto keep = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
    EXPECT_NE(refusal(bytes.substr(0, keep) + "\xff\xd9"), "") << "the end mark alone does not make a whole picture";
  }
}

TEST(ImageIo, TrailingBytesDoNoHarm) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.what);
    const Image whole = decode_image(sample.bytes, "x");
    EXPECT_EQ(refusal([&] { EXPECT_EQ(decode_image(sample.bytes + std::string(100, '\n'), "x").grey, whole.grey); }), "");
  }
}

TEST(ImageIo, OtherContentIsNoImage) {
  const std::string sentence = "'x.png' is not an image that inkgrid reads (PNG, JPEG, TIFF, WebP, BMP, PNM)";
  EXPECT_EQ(refusal("a letter to the editor"), sentence);
  EXPECT_EQ(refusal("%PDF-1.5 ..."), sentence);
  EXPECT_EQ(refusal("GIF89a........"), sentence);
  EXPECT_EQ(refusal(std::string(1000, '\0')), sentence);
  EXPECT_EQ(refusal(std::string("P")), sentence);
  EXPECT_EQ(refusal(""), "'x.png' is empty");
  EXPECT_EQ(refusal([] { decode_image(std::string_view(""), "-"); }), "standard input is empty");
}

TEST(ImageIo, HugeAndEmptySizesAreRefusedBeforeDecoding) {
  EXPECT_EQ(refusal("P5\n40000 20000\n255\n"), "'x.png' declares 40000 x 20000 pixels, and inkgrid reads at most 400 million");
  std::string bmp = encode(grey_pix(8), IFF_BMP);
  bmp.replace(18, 8, "\x00\x00\x01\x00\x00\x00\x01\x00", 8);
  EXPECT_NE(refusal(bmp).find("65536 x 65536"), std::string::npos);
  EXPECT_NE(refusal("P5\n0 20\n255\n"), "");
  EXPECT_NE(refusal("P1\n20 0\n"), "");
}

TEST(ImageIo, DamagedBytesNeverCrash) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  int refused = 0, read = 0;
  for (const Sample& sample : samples())
    for (int round = 0; round < 150; ++round) {
      std::string bytes = sample.bytes;
      for (std::size_t k = 0; k <= below(6); ++k)
        bytes[below(round % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 60))] = static_cast<char>(random());
      if (round % 5 == 0) bytes.erase(below(bytes.size()), below(30));
      if (!refusal(bytes).empty()) {
        ++refused;
      } else {
        ++read;
      }
    }
  EXPECT_GT(refused, 100);
  EXPECT_GT(read, 100);
  for (int round = 0; round < 3000; ++round) {
    std::string bytes;
    const char* magic[] = {"",    "\x89PNG\r\n\x1a\n", "\xff\xd8\xff\xe0", "II*", "MM", "RIFF1234WEBPVP8 ", "BM", "P1 3 3 ",
                           "P2 ", "P6 4 4 255\n"};
    bytes = magic[below(std::size(magic))];
    for (std::size_t n = below(300); n > 0; --n) bytes.push_back(static_cast<char>(random()));
    refusal(bytes);
  }
}

TEST(ImageIo, NothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  for (const Sample& sample : samples()) {
    refusal(sample.bytes.substr(0, sample.bytes.size() / 2));
    std::string bytes = sample.bytes;
    for (std::size_t i = bytes.size() / 2; i < bytes.size() - 12 && i < bytes.size() / 2 + 40; ++i)
      bytes[i] = static_cast<char>(~bytes[i]);
    refusal(bytes);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ImageIo, ReadingFiles) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "inkgrid_image_io";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "bytes.bin").string(), content("a\0b\xff\n", 5);
  std::ofstream(file, std::ios::binary) << content;
  EXPECT_EQ(read_bytes(file), content);
  EXPECT_EQ(refusal([&] { read_bytes(folder.string()); }), "cannot read '" + folder.string() + "': it is a directory");
  EXPECT_EQ(refusal([&] { read_bytes(file + ".none"); }), "cannot read '" + file + ".none': No such file or directory");
  std::filesystem::remove_all(folder);
}

ScaleMask mask_of(const PixOwner& pix) {
  return decode_mask(encode(pix, IFF_PNG), "mask.png");
}

TEST(ImageIo, ScribblesByHue) {
  const struct {
    Colour colour;
    float factor;
  } cases[] = {{{128, 0, 128}, 0.5f}, {{160, 32, 240}, 0.5f}, {{255, 165, 0}, 2},   {{230, 110, 20}, 2},
               {{255, 255, 255}, 1},  {{0, 0, 0}, 1},         {{120, 118, 122}, 1}, {{0, 200, 0}, 1},
               {{0, 0, 255}, 1},      {{255, 255, 0}, 1},     {{255, 0, 0}, 1}};
  const int count = static_cast<int>(std::size(cases));
  const PixOwner pix = colour_pix([&](int x, int) { return cases[x % count].colour; });
  const ScaleMask mask = mask_of(pix);
  ASSERT_EQ(mask.width, kWidth);
  ASSERT_EQ(mask.height, kHeight);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(mask.factor[static_cast<std::size_t>(x)], cases[x % count].factor) << x % count;
}

TEST(ImageIo, TransparentIsNoScribble) {
  const PixOwner pix = colour_pix([](int x, int) { return Colour{160, 32, 240, x < 10 ? 0 : 255}; }, true);
  const ScaleMask mask = mask_of(pix);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(mask.factor[static_cast<std::size_t>(x)], x < 10 ? 1.0f : 0.5f);
}

TEST(ImageIo, GreyMaskIsAnExponent) {
  const PixOwner pix = colour_pix([](int x, int) { return Colour{7 * x, 7 * x, 7 * x}; });
  const ScaleMask mask = mask_of(pix);
  for (int x = 0; x < kWidth; ++x) {
    const double expected = std::min(4.0, std::max(0.25, std::pow(2.0, (128 - 7 * x) / 64.0)));
    EXPECT_NEAR(mask.factor[static_cast<std::size_t>(x)], expected, 1e-5) << x;
  }
  EXPECT_EQ(mask_of(colour_pix([](int x, int) { return x == 0 ? Colour{0, 0, 0} : Colour{128, 128, 128}; })).factor[5], 1.0f);
}

TEST(ImageIo, MasksThatSayNothingAreRefused) {
  const auto refused = [](const std::function<Colour(int, int)>& colour, bool alpha = false) {
    const PixOwner pix = colour_pix(colour, alpha);
    return refusal([&] { mask_of(pix); });
  };
  EXPECT_NE(refused([](int, int) { return Colour{255, 255, 255}; }), "");
  EXPECT_NE(refused([](int, int) { return Colour{160, 32, 240, 0}; }, true), "");
  EXPECT_NE(refused([](int x, int) { return x < 5 ? Colour{0, 200, 0} : Colour{255, 255, 255}; }), "");
}

}  // namespace
}  // namespace inkgrid
