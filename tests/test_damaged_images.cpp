#include <gtest/gtest.h>

#include <random>

#include "encoded_images.h"

namespace inkgrid {
namespace {

using namespace testing;

TEST(DamagedImages, CutFilesAreRefused) {
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

TEST(DamagedImages, HolesInAJpegAreRefused) {
  const auto busy = [](int x, int y) { return Colour{(x * 71 + y * 31) % 256, (x * y * 13) % 256, (x * 7) % 256}; };
  const std::string bytes = encode(colour_pix(busy, false, 200, 150), IFF_JFIF_JPEG);
  for (const double part : {0.5, 0.8, 0.95}) {
    const auto keep = static_cast<std::size_t>(part * static_cast<double>(bytes.size()));
    EXPECT_NE(refusal(bytes.substr(0, keep) + "\xff\xd9"), "") << "the end mark alone does not make a whole picture";
  }
}

TEST(DamagedImages, AJpegOfTwoChannelsIsRefused) {
  std::string bytes = encode(grey_pix(8), IFF_JFIF_JPEG);
  const std::size_t frame = bytes.find(std::string("\xff\xc0\0\x0b", 4));
  ASSERT_NE(frame, std::string::npos);
  EXPECT_EQ(bytes[frame + 9], 1);
  bytes[frame + 3] = 14;
  bytes[frame + 9] = 2;
  bytes.insert(frame + 13, std::string("\x02\x11\0", 3));  // another that no scan is of
  EXPECT_EQ(refusal(bytes), "'x.png' is truncated or damaged");
}

TEST(DamagedImages, TrailingBytesDoNoHarm) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.what);
    const Image whole = decode_image(sample.bytes, "x");
    EXPECT_EQ(refusal([&] { EXPECT_EQ(decode_image(sample.bytes + std::string(100, '\n'), "x").grey, whole.grey); }), "");
  }
}

TEST(DamagedImages, OtherContentIsNoImage) {
  const std::string sentence = "'x.png' is not an image that inkgrid reads (PNG, JPEG, TIFF, WebP, BMP, PNM)";
  EXPECT_EQ(refusal("a letter to the editor"), sentence);
  EXPECT_EQ(refusal(std::string(1000, '\0')), sentence);
  EXPECT_EQ(refusal(std::string("P")), sentence);
  EXPECT_EQ(refusal(""), "'x.png' is empty");
  EXPECT_EQ(refusal([] { decode_image(std::string_view(""), "-"); }), "standard input is empty");
}

TEST(DamagedImages, OtherFormatsAreCalledByTheirNames) {
  const auto sentence = [](const std::string& what) {
    return "'x.png' is " + what + ", which inkgrid does not read (PNG, JPEG, TIFF, WebP, BMP, PNM)";
  };
  const auto boxes = [](const std::string& brand) {
    return std::string("\0\0\0\x18", 4) + "ftyp" + brand + std::string(60, '\0');
  };
  EXPECT_EQ(refusal("%PDF-1.5 ..."), sentence("a PDF"));
  EXPECT_EQ(refusal("GIF89a........"), sentence("a GIF"));
  EXPECT_EQ(refusal("8BPS........."), sentence("a Photoshop document"));
  for (const char* brand : {"heic", "heix", "mif1"}) EXPECT_EQ(refusal(boxes(brand)), sentence("a HEIC photograph"));
  EXPECT_EQ(refusal(boxes("avif")), sentence("an AVIF"));
  EXPECT_EQ(refusal(boxes("isom")).find("HEIC"), std::string::npos) << "a film";
}

TEST(DamagedImages, HugeAndEmptySizesAreRefusedBeforeDecoding) {
  EXPECT_EQ(refusal("P5\n40000 20000\n255\n"), "'x.png' declares 40000 x 20000 pixels, and inkgrid reads at most 400 million");
  std::string bmp = encode(grey_pix(8), IFF_BMP);
  bmp.replace(18, 8, "\x00\x00\x01\x00\x00\x00\x01\x00", 8);
  EXPECT_NE(refusal(bmp).find("65536 x 65536"), std::string::npos);
  EXPECT_NE(refusal("P5\n0 20\n255\n"), "");
  EXPECT_NE(refusal("P1\n20 0\n"), "");
}

TEST(DamagedImages, DamagedBytesNeverCrash) {
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

TEST(DamagedImages, NothingIsPrinted) {
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

}  // namespace
}  // namespace inkgrid
