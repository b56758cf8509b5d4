#include <gtest/gtest.h>

#include <cmath>

#include "encoded_images.h"

namespace inkgrid {
namespace {

using namespace testing;

ScaleMask mask_of(const PixOwner& pix) {
  return decode_mask(encode(pix, IFF_PNG), "mask.png");
}

TEST(Masks, ScribblesByHue) {
  const struct {
    Colour colour;
    float factor;
  } cases[] = {{{128, 0, 128}, 0.5f}, {{160, 32, 240}, 0.5f}, {{255, 165, 0}, 2},   {{230, 110, 20}, 2}, {{255, 255, 255}, 1},
               {{0, 0, 0}, 1},        {{120, 118, 122}, 1},   {{0, 200, 0}, 1},     {{0, 0, 255}, 1},    {{255, 255, 0}, 1},
               {{255, 0, 0}, 1},      {{200, 160, 200}, 1},   {{230, 210, 180}, 1}, {{60, 0, 60}, 1},    {{255, 0, 140}, 1},
               {{255, 0, 160}, 1},    {{47, 0, 255}, 1},      {{255, 25, 0}, 1},    {{255, 230, 0}, 1}};
  const int count = static_cast<int>(std::size(cases));
  const PixOwner pix = colour_pix([&](int x, int) { return cases[x % count].colour; });
  const ScaleMask mask = mask_of(pix);
  ASSERT_EQ(mask.width, kWidth);
  ASSERT_EQ(mask.height, kHeight);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(mask.factor[static_cast<std::size_t>(x)], cases[x % count].factor) << x % count;
}

TEST(Masks, TransparentIsNoScribble) {
  const PixOwner pix = colour_pix([](int x, int) { return Colour{160, 32, 240, x < 10 ? 0 : 255}; }, true);
  const ScaleMask mask = mask_of(pix);
  for (int x = 0; x < kWidth; ++x) EXPECT_EQ(mask.factor[static_cast<std::size_t>(x)], x < 10 ? 1.0f : 0.5f);
}

TEST(Masks, GreyMaskIsAnExponent) {
  const PixOwner pix = colour_pix([](int x, int) { return Colour{7 * x, 7 * x, 7 * x}; });
  const ScaleMask mask = mask_of(pix);
  for (int x = 0; x < kWidth; ++x) {
    const double expected = std::min(4.0, std::max(0.25, std::pow(2.0, (128 - 7 * x) / 64.0)));
    EXPECT_NEAR(mask.factor[static_cast<std::size_t>(x)], expected, 1e-5) << x;
  }
  EXPECT_EQ(mask_of(colour_pix([](int x, int) { return x == 0 ? Colour{0, 0, 0} : Colour{128, 128, 128}; })).factor[5], 1.0f);
}

TEST(Masks, MasksThatSayNothingAreRefused) {
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
