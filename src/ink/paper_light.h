// What:   a drawing as dark lines on light paper, without what light and shade do to the paper.
// Source: ours.
// Differs: docs/METHOD.md, "Threshold".
// Cost:   three passes over the pixels; blocks of them otherwise.
#pragma once

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
  std::uint8_t operator()(int x, int y) const {
    const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    return image.grey[i] ^ flip;
  }
};

// Which of two tones is the paper: the more frequent one, near the strokes, in the whole and along the border.
bool light_on_dark(const View& view);

struct EvenLight {
  Raster<float> darkness;  // 0: bare paper; 1: black
  double paper = 0;        // mean grey level of the bare paper
};

EvenLight even_out(const View& view);

}  // namespace inkgrid
