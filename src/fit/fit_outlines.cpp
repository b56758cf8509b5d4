#include "fit/fit_outlines.h"

#include "base/polyline.h"
#include "fit/fit.h"

namespace inkgrid {
namespace {

// An outline is known to a part of a pixel, however wide the strokes are.
constexpr double kScale = 4;   // px, of a unit of the tolerance
constexpr double kCorner = 6;  // px, within which a turn is a corner

Curve fitted(std::vector<Vec2> line, double pixel, const FitOptions& options) {
  for (Vec2& p : line) p = pixel * p;
  Curve curve;
  curve.segments = fit_polyline(resampled(line, 1), true, options);
  curve.closed = true;
  curve.coverage = 1;
  return curve;
}

}  // namespace

std::vector<Fill> fit_outlines(const Fills& fills, double tolerance, double pixel) {
  const FitOptions options{tolerance * kScale, kCorner};
  std::vector<Fill> fitted_fills;
  for (const auto& outline : fills.outlines) {
    if (outline.empty()) continue;
    Fill& fill = fitted_fills.emplace_back();
    for (const auto& line : outline) fill.outlines.push_back(fitted(line, pixel, options));
  }
  return fitted_fills;
}

}  // namespace inkgrid
