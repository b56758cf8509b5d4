// What:   a picture that is drawn over a lightened copy of the drawing, in the drawing's own coordinates.
// Source: ours; no third-party header leaves canvas.cpp.
// Differs: widths and radii are in pixels of the picture, so marks look the same whatever the drawing's size.
// Cost:   linear in what is drawn; a picture has at most 4000 x 4000 pixels.
// 4000^2.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/raster.h"
#include "inkgrid/drawing.h"
#include "inkgrid/image.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

struct Colour {
  std::uint32_t rgb = 0;  // 0xRRGGBB
  double alpha = 1;
};

// Picture pixels a drawing pixel: a whole number that brings small drawings near 2000 px, or one over a whole number for drawings
// beyond 4000 px.
double picture_scale(int width, int height);

class Canvas {
 public:
  // `inverted`: light lines on dark paper are turned over before they are lightened.
  Canvas(const Image& drawing, bool inverted);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  double scale() const { return scale_; }

  void pixels(const Raster<std::uint8_t>& mask, Colour colour);
  void triangle(Vec2 a, Vec2 b, Vec2 c, Colour colour);
  void polyline(std::span<const Vec2> points, double width, Colour colour);
  void line(Vec2 a, Vec2 b, double width, Colour colour);
  void curve(const Curve& curve, double width, Colour colour);
  void disc(Vec2 centre, double radius, Colour colour);  // with a white rim
  void ring(Vec2 centre, double radius, double width, Colour colour);
  void square(Vec2 centre, double half_side, Colour colour);

  // Written beside and renamed.  Throws Error{file}.
  void write_png(const std::string& path) const;

 private:
  struct Surface;
  Vec2 at(Vec2 p) const { return scale_ * p; }
  void stroke(double width, Colour colour);
  void fill(Colour colour);

  double scale_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace inkgrid
