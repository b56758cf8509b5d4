// What:   how lengths of a drawing are written: unit, size, stroke widths.
// Source: 96 px an inch is the pixel of CSS and SVG.
// Cost:   none.
#pragma once

#include <string>

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

// The value.  Throws Error{numerics} for what is no number or absurdly large.
double checked(double value);

// The same as a decimal without trailing zeros.
std::string coordinate(double value, int places = 3);

}  // namespace inkgrid
