// A page with a drawing, and light that falls on it.
#pragma once

#include "drawings.h"
#include "inkgrid/image.h"
#include "spoiled_pictures.h"

namespace inkgrid::testing {

constexpr int kPageWidth = 420, kPageHeight = 320;  // px

// A ring, a line that comes close to every edge, and a dot as wide as two pens.
inline Image drawn_page(double grey = 50) {
  Image image = blank(kPageWidth, kPageHeight, 240);
  paint(image, circle({150, 150}, 90), 4, grey);
  paint(image, {{20.5, 300}, {400, 30.5}}, 4, grey);
  paint(image, {{60, 60}, {60.5, 60}}, 8, grey);
  return image;
}

using Light = double (*)(double x, double y);

inline Image in_light(Image image, Light light, double grain = 0) {
  spoil(
      image, [&](int x, int y) { return light(x + 0.5, y + 0.5); }, grain);
  return image;
}

}  // namespace inkgrid::testing
