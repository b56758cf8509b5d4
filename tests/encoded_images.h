// Small pictures of known pixels, encoded by Leptonica.
#pragma once

#include <gtest/gtest.h>
#include <leptonica/allheaders.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "images/image_io.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid::testing {

struct DestroyPix {
  void operator()(Pix* pix) const { pixDestroy(&pix); }
};
using PixOwner = std::unique_ptr<Pix, DestroyPix>;

inline constexpr int kWidth = 37, kHeight = 23;

struct Colour {
  int red, green, blue, alpha = 255;
};

inline Colour colour_at(int x, int y) {
  return {(7 * x) % 256, (11 * y + 3 * x) % 256, (5 * x * y) % 256};
}
inline int value_at(int x, int y) {
  return (37 * x + 101 * y + x * y) & 0xffff;
}

inline PixOwner grey_pix(int depth) {
  PixOwner pix(pixCreate(kWidth, kHeight, depth));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) pixSetPixel(pix.get(), x, y, static_cast<l_uint32>(value_at(x, y) & ((1 << depth) - 1)));
  return pix;
}

inline PixOwner colour_pix(const std::function<Colour(int, int)>& colour, bool alpha = false, int width = kWidth,
                           int height = kHeight) {
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

inline std::string own(l_uint8* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  std::free(data);
  return bytes;
}

inline std::string encode(const PixOwner& pix, int format) {
  l_uint8* data = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(pixWriteMem(&data, &size, pix.get(), format), 0);
  return own(data, size);
}

inline std::string encode_webp(const PixOwner& pix) {
  l_uint8* data = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(pixWriteMemWebP(&data, &size, pix.get(), 100, 1), 0);
  return own(data, size);
}

inline std::string encode_ascii_pnm(const PixOwner& pix) {
  char* data = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&data, &size);
  EXPECT_EQ(pixWriteStreamAsciiPnm(stream, pix.get()), 0);
  std::fclose(stream);
  return own(reinterpret_cast<l_uint8*>(data), size);
}

inline int luma(Colour c) {
  return static_cast<int>(std::lround(0.299 * c.red + 0.587 * c.green + 0.114 * c.blue));
}

inline void expect_pixels(const Image& image, const std::function<int(int, int)>& grey, int tolerance = 0) {
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  ASSERT_EQ(image.grey.size(), static_cast<std::size_t>(kWidth * kHeight));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      ASSERT_NEAR(image.grey[static_cast<std::size_t>(y * kWidth + x)], grey(x, y), tolerance) << x << ", " << y;
}

// The sentence with which the bytes are refused; empty when they are not.
inline std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::file);
    return e.what();
  }
  return "";
}
inline std::string refusal(const std::string& bytes) {
  return refusal([&] { decode_image(bytes, "x.png"); });
}

struct Sample {
  const char* what;
  std::string bytes;
};

inline std::vector<Sample> samples() {
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
          {"deep pgm", encode(grey_pix(16), IFF_PNM)},
          {"deep tiff", encode(grey_pix(16), IFF_TIFF)},
          {"pbm", encode(bits, IFF_PNM)},
          {"ascii pgm", encode_ascii_pnm(grey)},
          {"ascii ppm", encode_ascii_pnm(colour)},
          {"ascii pbm", encode_ascii_pnm(bits)}};
}

}  // namespace inkgrid::testing
