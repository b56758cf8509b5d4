// What:   how lengths of a drawing are written: unit, size, stroke widths.
// Source: 96 px an inch is the pixel of CSS and SVG.
// Cost:   none.
#pragma once

#include <string>

#include "base/decimal.h"
#include "export/export.h"

namespace inkgrid {

// From pixels of the drawing to what a file holds.
struct Paper {
  LengthUnit unit;        // never automatic
  double units_a_pixel;   // in that unit
  double points_a_pixel;  // 1/72 inch
};

// Of what is asked for, or of the drawing; 0: unknown.
double pixels_per_mm(const Drawing& drawing, const ExportOptions& options);

Paper paper_of(const Drawing& drawing, const ExportOptions& options);

// px; that of an unknown width is 1.
double stroke_width(const Curve& curve, const ExportOptions& options, const Paper& paper);

// px, to a thousandth.
inline std::string coordinate(double value) {
  return decimal(value, 3);
}

}  // namespace inkgrid
