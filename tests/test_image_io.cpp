#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "encoded_images.h"

namespace inkgrid {
namespace {

using namespace testing;

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

// A column of ink with nothing on both sides of it.
TEST(ImageIo, LightInkOnNothingLiesOverBlack) {
  for (const int ink : {250, 100}) {
    const PixOwner pix = colour_pix([&](int x, int) { return Colour{ink, ink, ink, x == 1 ? 255 : 0}; }, true);
    const int paper = ink == 250 ? 0 : 255;
    expect_pixels(
        decode_image(encode(pix, IFF_PNG), "x"), [&](int x, int) { return x == 1 ? ink : paper; }, 0);
  }
}

TEST(ImageIo, ResolutionIsInPixelsPerMillimetre) {
  for (const int format : {IFF_PNG, IFF_JFIF_JPEG, IFF_TIFF, IFF_BMP}) {
    PixOwner pix = grey_pix(8);
    EXPECT_EQ(decode_image(encode(pix, IFF_PNG), "x").pixels_per_mm, 0);
    pixSetResolution(pix.get(), 254, 254);
    EXPECT_NEAR(decode_image(encode(pix, format), "x").pixels_per_mm, 10, 0.05) << format;
  }
}

TEST(ImageIo, AShapeOfPixelsIsNoResolution) {
  PixOwner pix = grey_pix(8);
  pixSetResolution(pix.get(), 254, 254);
  std::string png = encode(pix, IFF_PNG);
  const std::size_t unit = png.find("pHYs") + 12;
  ASSERT_EQ(png.at(unit), 1);
  png[unit] = 0;
  EXPECT_EQ(decode_image(png, "x").pixels_per_mm, 0);
}

TEST(ImageIo, ReadingFiles) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "inkgrid_image_io";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "bytes.bin").string(), content("a\0b\xff\n", 5);
  std::ofstream(file, std::ios::binary) << content;
  EXPECT_EQ(read_bytes(file), content);
  EXPECT_EQ(refusal([&] { read_bytes(folder.string()); }), "can't read '" + folder.string() + "': it is a directory");
  EXPECT_EQ(refusal([&] { read_bytes(file + ".none"); }), "can't read '" + file + ".none': No such file or directory");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace inkgrid
