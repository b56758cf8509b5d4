#include "export/paper.h"

namespace inkgrid {
namespace {

constexpr double kInch = 25.4;    // mm
constexpr double kPoint = 72;     // an inch
constexpr double kCssPixel = 96;  // an inch

}  // namespace

double pixels_per_mm(const Drawing& drawing, const ExportOptions& options) {
  return options.resolution ? *options.resolution / kInch : drawing.pixels_per_mm;
}

Paper paper_of(const Drawing& drawing, const ExportOptions& options) {
  const double per_mm = pixels_per_mm(drawing, options);
  const bool known = per_mm > 0;
  const double resolution = known ? kInch * per_mm : kCssPixel;
  LengthUnit unit = options.unit;
  if (unit == LengthUnit::automatic) unit = known ? LengthUnit::millimetres : LengthUnit::pixels;
  switch (unit) {
    case LengthUnit::millimetres:
      return {unit, kInch / resolution, kPoint / resolution};
    case LengthUnit::inches:
      return {unit, 1 / resolution, kPoint / resolution};
    default:
      return {unit, 1, kPoint / kCssPixel};
  }
}

double stroke_width(const Curve& curve, const ExportOptions& options, const Paper& paper) {
  if (options.stroke_width) return *options.stroke_width / paper.units_a_pixel;
  return curve.width > 0 ? curve.width : 1;
}

}  // namespace inkgrid
