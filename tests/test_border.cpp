#include <gtest/gtest.h>

#include "drawings.h"
#include "ink/border.h"
#include "ink/threshold.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::paint;

using Mask = Raster<std::uint8_t>;

Mask mask_of(const Image& image) {
  return binarise(image, 128).ink;
}

Mask ended(Mask mask) {
  end_strokes_at_border(mask);
  return mask;
}

// A stroke inside the image says how wide strokes are.
Image with_inner_stroke(double pen) {
  Image image = blank(120, 90);
  paint(image, {{20, 45}, {100, 60}}, pen);
  return image;
}

// The ink of the image is that which is left and, on each side, the outermost row of what is taken.
void expect_taken(const Mask& before, const Mask& after, int rows_above, int columns_left) {
  for (int y = 0; y < before.height; ++y)
    for (int x = 0; x < before.width; ++x) {
      const bool taken = before(x, y) && (y < rows_above || x < columns_left);
      ASSERT_EQ(after(x, y), taken ? 0 : before(x, y)) << x << ' ' << y;
    }
}

TEST(Border, AStrokeAlongItEndsThere) {
  for (const int pen : {2, 4, 9}) {
    Image image = with_inner_stroke(pen);
    paint(image, {{-20, 0.5 * pen}, {140, 0.5 * pen}}, pen);
    expect_taken(mask_of(image), ended(mask_of(image)), 1, 0);
    paint(image, {{0.5 * pen, -20}, {0.5 * pen, 120}}, pen);
    expect_taken(mask_of(image), ended(mask_of(image)), 1, 1);
  }
}

TEST(Border, ABranchDoesNotKeepItOpen) {
  Image image = with_inner_stroke(4);
  paint(image, {{-20, 2}, {140, 2}}, 4);
  paint(image, {{110, 2}, {105, 70}}, 4);
  expect_taken(mask_of(image), ended(mask_of(image)), 1, 0);
}

TEST(Border, AStrokeThatIsHalfBeyondItGoesOn) {
  Image image = with_inner_stroke(8);
  paint(image, {{-20, 0}, {140, 0}}, 8);
  expect_taken(mask_of(image), ended(mask_of(image)), 0, 0);
}

TEST(Border, WhatCrossesItGoesOn) {
  Image image = with_inner_stroke(5);
  paint(image, {{10, -20}, {10, 120}}, 5);
  paint(image, {{60, -20}, {160, 50}}, 5);
  paint(image, {{-40, 20}, {60, -20}}, 5);
  expect_taken(mask_of(image), ended(mask_of(image)), 0, 0);
}

TEST(Border, InkOfOnePixelIsKept) {
  Mask mask(40, 30);
  for (int x = 0; x < 40; ++x) mask(x, 0) = 1;
  expect_taken(mask, ended(mask), 0, 0);
}

}  // namespace
}  // namespace inkgrid
