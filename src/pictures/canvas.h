// What:   a painter that makes a PNG file: marks over a lightened copy of the drawing.
// Source: ours; no third-party header leaves canvas.cpp.
// Differs: nothing.
// Cost:   linear in what is drawn; a picture has at most 4000 x 4000 pixels.
#pragma once

#include <memory>
#include <string>

#include "inkgrid/image.h"
#include "pictures/painter.h"

namespace inkgrid {

// Picture pixels a drawing pixel: a whole number that brings small drawings near 2000 px, or one over a whole number for drawings
// beyond 4000 px.
double picture_scale(int width, int height);

class Canvas final : public Painter {
 public:
  // `inverted`: light lines on dark paper are turned over before they are lightened.
  Canvas(const Image& drawing, bool inverted);
  ~Canvas() override;
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void pixels(const Raster<std::uint8_t>& mask, double side, Colour colour) override;
  void triangle(Vec2 a, Vec2 b, Vec2 c, Colour colour) override;
  void polyline(std::span<const Vec2> points, double width, Colour colour) override;
  void curve(const Curve& curve, double width, Colour colour) override;
  void disc(Vec2 centre, double radius, Colour colour) override;
  void dot(Vec2 centre, double radius, Colour colour) override;
  void ring(Vec2 centre, double radius, double width, Colour colour) override;
  void square(Vec2 centre, double half_side, Colour colour) override;

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
