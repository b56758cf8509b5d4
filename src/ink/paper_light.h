// What:   a drawing as dark lines on light paper, without what light and shade do to the paper.
// Source: ours.
// Differs: docs/METHOD.md, "Threshold".
// Cost:   three passes over the pixels; blocks of them otherwise.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/raster.h"
#include "inkgrid/image.h"

namespace inkgrid {

// The drawing as dark lines on light paper, whichever way it came.
struct View {
  const Image& image;
  std::uint8_t flip;  // 255 turns light into dark

  int width() const { return image.width; }
  int height() const { return image.height; }
  std::uint8_t operator[](std::size_t pixel) const { return image.grey[pixel] ^ flip; }
  std::uint8_t operator()(int x, int y) const {
    return (*this)[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)];
  }
};

// Which of two tones is the paper: the more frequent one, near the strokes, in the whole and along the border.
bool light_on_dark(const View& view);

// The light of the bare paper, smooth over the picture.
struct Paper {
  int block = 1;        // px
  Raster<float> level;  // grey level at the centre of each block of so many pixels each way

  double mean() const;
};

struct EvenLight {
  Raster<float> darkness;  // 0: bare paper; 1: black
  Paper paper;
};

// The lightest pixel of each block of size x size pixels.
Raster<float> lightest_of_blocks(const View& view, int size);

EvenLight even_out(const View& view);

}  // namespace inkgrid
