// PNG: black curves and fills on white paper.
#include <cairo.h>

#include <memory>

#include "export/paper.h"
#include "export/writers.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr double kLargestSide = 32767;  // px, of a cairo surface

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};

int scaled_side(int side, double scale) {
  const double scaled = std::max(1.0, std::round(side * scale));
  if (scaled > kLargestSide)
    throw Error(ErrorCode::usage, "the PNG would be " + decimal(scaled, 0) + " pixels long, and the longest is " +
                                      decimal(kLargestSide, 0) + ": png-scale is too large");
  return static_cast<int>(scaled);
}

void add_path(cairo_t* cairo, const Curve& curve) {
  const Vec2 start = curve.segments.front().p0;
  cairo_move_to(cairo, start.x, start.y);
  for (const Cubic& c : curve.segments) cairo_curve_to(cairo, c.p1.x, c.p1.y, c.p2.x, c.p2.y, c.p3.x, c.p3.y);
  if (curve.closed) cairo_close_path(cairo);
}

void fill(cairo_t* cairo, const Fill& fill) {
  for (const Curve& outline : fill.outlines) add_path(cairo, outline);
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(cairo);
}

void stroke(cairo_t* cairo, const Curve& curve, double width) {
  add_path(cairo, curve);
  cairo_set_line_width(cairo, width);
  cairo_stroke(cairo);
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string png_bytes(const Drawing& drawing, const ExportOptions& options, const std::string&) {
  const Paper paper = paper_of(drawing, options);
  const int width = scaled_side(drawing.width, options.png_scale), height = scaled_side(drawing.height, options.png_scale);
  const std::unique_ptr<cairo_surface_t, Release> image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  const std::unique_ptr<cairo_t, Release> cairo(cairo_create(image.get()));
  cairo_set_source_rgb(cairo.get(), 1, 1, 1);
  cairo_paint(cairo.get());
  cairo_set_source_rgb(cairo.get(), 0, 0, 0);
  cairo_set_line_cap(cairo.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_scale(cairo.get(), options.png_scale, options.png_scale);
  for (const Fill& area : drawing.fills) fill(cairo.get(), area);
  for (const Curve& curve : drawing.curves) stroke(cairo.get(), curve, stroke_width(curve, options, paper));
  std::string bytes;
  if (cairo_status(cairo.get()) != CAIRO_STATUS_SUCCESS ||
      cairo_surface_write_to_png_stream(image.get(), append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw Error(ErrorCode::file, "there is not enough memory for the PNG");
  return bytes;
}

}  // namespace inkgrid
