// What:   the marks that pictures of the stages are made of, in the drawing's own coordinates.
// Source: ours; a picture is drawn once and painted by whoever shows it (PNG files, the studio's layers).
// Differs: widths and radii are in pixels of the picture, whatever the drawing's size; only a dot grows with it.
// Cost:   that of who paints.
#pragma once

#include <cstdint>
#include <span>

#include "base/raster.h"
#include "inkgrid/drawing.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

struct Colour {
  std::uint32_t rgb = 0;  // 0xRRGGBB
  double alpha = 1;
};

class Painter {
 public:
  virtual ~Painter() = default;

  // `side` of a pixel of the mask in px of the drawing.
  virtual void pixels(const Raster<std::uint8_t>& mask, double side, Colour colour) = 0;
  virtual void triangle(Vec2 a, Vec2 b, Vec2 c, Colour colour) = 0;
  virtual void polyline(std::span<const Vec2> points, double width, Colour colour) = 0;
  virtual void curve(const Curve& curve, double width, Colour colour) = 0;
  virtual void disc(Vec2 centre, double radius, Colour colour) = 0;  // with a white rim
  virtual void dot(Vec2 centre, double radius, Colour colour) = 0;   // its radius is in px of the drawing
  virtual void ring(Vec2 centre, double radius, double width, Colour colour) = 0;
  virtual void square(Vec2 centre, double half_side, Colour colour) = 0;

  void line(Vec2 a, Vec2 b, double width, Colour colour) {
    const Vec2 ends[] = {a, b};
    polyline(ends, width, colour);
  }
};

}  // namespace inkgrid
