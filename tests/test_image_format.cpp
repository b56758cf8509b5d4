#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "encoded_images.h"

namespace inkgrid {
namespace {

using namespace testing;

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

TEST(ImageFormat, BmpOfManyKinds) {
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

TEST(ImageFormat, BmpInRuns) {
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

TEST(ImageFormat, PicturesAreTurnedAsTheCameraWasHeld) {
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

// Greys in one strip, and a directory behind them, in which a tag has the value.
std::string tiff_with(std::size_t given_tag, std::size_t given_value) {
  std::string bytes("II*\0", 4);
  const std::size_t pixels = static_cast<std::size_t>(kWidth * kHeight);
  put(bytes, 8 + pixels + pixels % 2, 4);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) put(bytes, static_cast<std::size_t>(luma(colour_at(x, y))), 1);
  if (pixels % 2) put(bytes, 0, 1);
  std::map<std::size_t, std::size_t> entries{{256, kWidth}, {257, kHeight}, {258, 8},       {259, 1},     {262, 1},
                                             {273, 8},      {277, 1},       {278, kHeight}, {279, pixels}};
  entries[given_tag] = given_value;
  put(bytes, entries.size(), 2);
  for (const auto& [tag, value] : entries) put(bytes, tag, 2), put(bytes, 4, 2), put(bytes, 1, 4), put(bytes, value, 4);
  put(bytes, 0, 4);
  return bytes;
}

TEST(ImageFormat, ATiffIsTurnedByItsOwnTag) {
  constexpr std::size_t kTurned = 274;
  const Image plain = decode_image(tiff_with(kTurned, 1), "x");
  expect_pixels(plain, [](int x, int y) { return luma(colour_at(x, y)); });
  const Image over_head = decode_image(tiff_with(kTurned, 3), "x"), clockwise = decode_image(tiff_with(kTurned, 6), "x");
  EXPECT_TRUE(std::equal(plain.grey.rbegin(), plain.grey.rend(), over_head.grey.begin()));
  ASSERT_EQ(std::pair(clockwise.width, clockwise.height), std::pair(kHeight, kWidth));
  for (int y = 0; y < kWidth; ++y)
    for (int x = 0; x < kHeight; ++x)
      ASSERT_EQ(clockwise.grey[static_cast<std::size_t>(y * kHeight + x)],
                plain.grey[static_cast<std::size_t>((kHeight - 1 - x) * kWidth + y)]);
}

TEST(ImageFormat, BrokenExifLeavesThePictureAsItIs) {
  const std::string jpeg = encode(colour_pix(colour_at), IFF_JFIF_JPEG), whole = exif(6, true);
  const Image plain = decode_image(jpeg, "x");
  for (std::size_t n = 0; n < whole.size() - 6; ++n)
    EXPECT_EQ(decode_image(jpeg_with(jpeg, whole.substr(0, n)), "x").grey.size(), plain.grey.size()) << n;
  for (const int nonsense : {0, 9, 255}) EXPECT_EQ(decode_image(jpeg_with(jpeg, exif(nonsense, false)), "x").grey, plain.grey);
}

TEST(ImageFormat, KindsThatAreNotReadAreNamed) {
  const auto sentence = [](const std::string& what) { return "'x.png' is " + what + ", which inkgrid does not read"; };
  EXPECT_EQ(refusal(std::string("II+\0\x08\0\0\0", 8) + std::string(60, '\0')), sentence("a BigTIFF"));
  EXPECT_EQ(refusal(std::string("MM\0+\0\x08\0\0", 8) + std::string(60, '\0')), sentence("a BigTIFF"));
  EXPECT_EQ(refusal(webp_with(encode_webp(colour_pix(colour_at)), exif(1, false), 2)), sentence("an animated WebP"));
}

TEST(ImageFormat, KindsOfTiffThatAreNotReadAreNamed) {
  constexpr std::size_t kBits = 258, kCompression = 259, kTileWidth = 322, kNumbers = 339;
  const auto sentence = [](const std::string& what) { return "'x.png' is a TIFF of " + what + ", which inkgrid does not read"; };
  EXPECT_EQ(refusal(tiff_with(kNumbers, 1)), "");
  for (const std::size_t kind : {2u, 3u})
    EXPECT_EQ(refusal(tiff_with(kNumbers, kind)), sentence("floating-point or signed numbers")) << kind;
  for (const std::size_t bits : {3u, 12u, 32u, 64u})
    EXPECT_EQ(refusal(tiff_with(kBits, bits)), sentence("an unusual depth")) << bits;
  for (const std::size_t compression : {6u, 34712u, 50001u})
    EXPECT_EQ(refusal(tiff_with(kCompression, compression)), sentence("an unusual compression")) << compression;
  EXPECT_EQ(refusal(tiff_with(kTileWidth, 16)), sentence("tiles"));
}

}  // namespace
}  // namespace inkgrid
