// What:   cairo behind canvas.h.
#include "pictures/canvas.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "inkgrid/inkgrid.h"

namespace inkgrid {

namespace {

constexpr int kSmallSide = 2000;     // px; smaller drawings are magnified towards it
constexpr int kLargeSide = 4000;     // px; larger drawings are reduced to it
constexpr int kLargestScale = 16;    // a drawing of a few pixels stays a small picture
constexpr double kLightening = 0.3;  // what is left of the drawing's darkness

int picture_side(int side, double scale) {
  return std::max(1, static_cast<int>(std::lround(side * scale)));
}

std::uint32_t lightened(std::uint8_t grey, bool inverted) {
  const double darkness = inverted ? grey : 255 - grey;
  const auto level = static_cast<std::uint32_t>(std::lround(255 - kLightening * darkness));
  return level << 16 | level << 8 | level;
}

void set_colour(cairo_t* cairo, Colour colour) {
  const auto channel = [&](int shift) { return static_cast<double>(colour.rgb >> shift & 0xff) / 255; };
  cairo_set_source_rgba(cairo, channel(16), channel(8), channel(0), colour.alpha);
}

// The drawing as a surface of its own size; the caller destroys it.
cairo_surface_t* paper_surface(const Image& drawing, bool inverted) {
  cairo_surface_t* paper = cairo_image_surface_create(CAIRO_FORMAT_RGB24, drawing.width, drawing.height);
  if (cairo_surface_status(paper) != CAIRO_STATUS_SUCCESS) return paper;
  unsigned char* row = cairo_image_surface_get_data(paper);
  const int stride = cairo_image_surface_get_stride(paper);
  std::size_t pixel = 0;
  for (int y = 0; y < drawing.height; ++y, row += stride)
    for (int x = 0; x < drawing.width; ++x) reinterpret_cast<std::uint32_t*>(row)[x] = lightened(drawing.grey[pixel++], inverted);
  cairo_surface_mark_dirty(paper);
  return paper;
}

}  // namespace

double picture_scale(int width, int height) {
  const int side = std::max({width, height, 1});
  const int shrink = (side + kLargeSide - 1) / kLargeSide;
  if (shrink > 1) return 1.0 / shrink;
  return std::clamp<double>(std::round(static_cast<double>(kSmallSide) / side), 1, kLargestScale);
}

struct Canvas::Surface {
  cairo_surface_t* image = nullptr;
  cairo_t* cairo = nullptr;

  Surface(int width, int height)
      : image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), cairo(cairo_create(image)) {}
  ~Surface() {
    cairo_destroy(cairo);
    cairo_surface_destroy(image);
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
};

Canvas::Canvas(const Image& drawing, bool inverted)
    : scale_(picture_scale(drawing.width, drawing.height)),
      surface_(std::make_unique<Surface>(picture_side(drawing.width, scale_), picture_side(drawing.height, scale_))) {
  cairo_t* cairo = surface_->cairo;
  cairo_surface_t* paper = paper_surface(drawing, inverted);
  cairo_save(cairo);
  cairo_scale(cairo, scale_, scale_);
  cairo_set_source_surface(cairo, paper, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo), scale_ >= 1 ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_paint(cairo);
  cairo_restore(cairo);
  cairo_surface_destroy(paper);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  if (cairo_status(cairo) != CAIRO_STATUS_SUCCESS)
    throw Error(ErrorCode::file, "There is not enough memory for a stage picture.");
}

Canvas::~Canvas() = default;

void Canvas::stroke(double width, Colour colour) {
  set_colour(surface_->cairo, colour);
  cairo_set_line_width(surface_->cairo, width);
  cairo_stroke(surface_->cairo);
}

void Canvas::fill(Colour colour) {
  set_colour(surface_->cairo, colour);
  cairo_fill(surface_->cairo);
}

void Canvas::pixels(const Raster<std::uint8_t>& mask, double side, Colour colour) {
  cairo_t* cairo = surface_->cairo;
  const double scale = side * scale_;
  cairo_save(cairo);
  cairo_scale(cairo, scale, scale);
  if (scale >= 1) cairo_set_antialias(cairo, CAIRO_ANTIALIAS_NONE);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width;) {
      const int begin = x;
      while (x < mask.width && mask(x, y)) ++x;
      if (x > begin) {
        cairo_rectangle(cairo, begin, y, x - begin, 1);
        fill(colour);
      } else {
        ++x;
      }
    }
  cairo_restore(cairo);
}

// Without antialiasing, so that neighbours leave no seam.
void Canvas::triangle(Vec2 a, Vec2 b, Vec2 c, Colour colour) {
  cairo_t* cairo = surface_->cairo;
  cairo_save(cairo);
  cairo_set_antialias(cairo, CAIRO_ANTIALIAS_NONE);
  cairo_move_to(cairo, at(a).x, at(a).y);
  cairo_line_to(cairo, at(b).x, at(b).y);
  cairo_line_to(cairo, at(c).x, at(c).y);
  fill(colour);
  cairo_restore(cairo);
}

void Canvas::polyline(std::span<const Vec2> points, double width, Colour colour) {
  for (const Vec2 p : points) cairo_line_to(surface_->cairo, at(p).x, at(p).y);
  stroke(width, colour);
}

void Canvas::curve(const Curve& curve, double width, Colour colour) {
  if (curve.segments.empty()) return;
  const Vec2 start = at(curve.segments.front().p0);
  cairo_move_to(surface_->cairo, start.x, start.y);
  for (const Cubic& cubic : curve.segments) {
    const Vec2 a = at(cubic.p1), b = at(cubic.p2), end = at(cubic.p3);
    cairo_curve_to(surface_->cairo, a.x, a.y, b.x, b.y, end.x, end.y);
  }
  if (curve.closed) cairo_close_path(surface_->cairo);
  stroke(width, colour);
}

void Canvas::disc(Vec2 centre, double radius, Colour colour) {
  const auto circle = [&](double r) { cairo_arc(surface_->cairo, at(centre).x, at(centre).y, r, 0, 2 * std::numbers::pi); };
  circle(radius + 1);
  fill({0xffffff, colour.alpha});
  circle(radius);
  fill(colour);
}

void Canvas::dot(Vec2 centre, double radius, Colour colour) {
  disc(centre, scale_ * radius, colour);
}

void Canvas::ring(Vec2 centre, double radius, double width, Colour colour) {
  cairo_new_sub_path(surface_->cairo);
  cairo_arc(surface_->cairo, at(centre).x, at(centre).y, radius, 0, 2 * std::numbers::pi);
  stroke(width, colour);
}

void Canvas::square(Vec2 centre, double half_side, Colour colour) {
  cairo_rectangle(surface_->cairo, at(centre).x - half_side, at(centre).y - half_side, 2 * half_side, 2 * half_side);
  fill(colour);
}

void Canvas::write_png(const std::string& path) const {
  const std::string beside = path + ".part";
  std::error_code failure, ignored;
  const cairo_status_t status = cairo_surface_write_to_png(surface_->image, beside.c_str());
  if (status == CAIRO_STATUS_SUCCESS) {
    std::filesystem::rename(beside, path, failure);
    if (!failure) return;
  }
  std::filesystem::remove(beside, ignored);
  throw Error(ErrorCode::file, "can't write '" + path + "': " + (failure ? failure.message() : cairo_status_to_string(status)));
}

}  // namespace inkgrid
