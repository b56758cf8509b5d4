// What:   a painter that writes marks down as the page's WebGL takes them.
// Source: page/recording.js reads it.
// Differs: curves are no marks of it: the page draws them itself.
// Cost:   36 bytes a triangle, 24 a line or disc, 1 a pixel.
#pragma once

#include <string>

#include "pictures/painter.h"

namespace inkgrid::studio {

// Little-endian batches, each a kind (u32), a number of elements (u32) and the elements, 4-byte aligned:
//   0 triangles  per element 3 corners: x, y (f32), colour (u8 r, g, b, a)
//   1 lines      x0, y0, x1, y1, width (f32; screen px), colour
//   2 discs      x, y, radius, hole radius (f32; screen px), flags (f32; 1: white rim, 2: radii in px of the drawing,
//                4: square), colour
//   3 pixels     one element: width, height (u32), side of a pixel (f32; px of the drawing), colour, then
//                width * height bytes, padded to 4
class Recording final : public Painter {
 public:
  void pixels(const Raster<std::uint8_t>& mask, double side, Colour colour) override;
  void triangle(Vec2 a, Vec2 b, Vec2 c, Colour colour) override;
  void polyline(std::span<const Vec2> points, double width, Colour colour) override;
  void curve(const Curve& curve, double width, Colour colour) override;
  void disc(Vec2 centre, double radius, Colour colour) override;
  void dot(Vec2 centre, double radius, Colour colour) override;
  void ring(Vec2 centre, double radius, double width, Colour colour) override;
  void square(Vec2 centre, double half_side, Colour colour) override;

  std::string take() { return std::move(bytes_); }

 private:
  enum class Kind : std::uint32_t { triangles, lines, discs, pixels, none };
  void element_of(Kind kind);
  void put(double number);
  void put_count(std::uint32_t count);
  void put(Colour colour);
  void put_disc(Vec2 centre, double radius, double hole, int flags, Colour colour);

  std::string bytes_;
  Kind kind_ = Kind::none;
  std::size_t count_at_ = 0;
};

}  // namespace inkgrid::studio
