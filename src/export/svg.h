// What:   a drawing as SVG.
#pragma once

#include <string>

#include "inkgrid/drawing.h"

namespace inkgrid {

// viewBox in pixels; width and height in mm where the drawing has a resolution, in pixels otherwise; one <path> a curve with a
// stable id and its measured stroke width; `z` on closed curves.  `description` goes into <metadata> (version and options).
// Numbers are shortest decimals with at most 3 places, the same on every machine; points that are equal are written equally.
std::string svg_text(const Drawing& drawing, const std::string& description);

}  // namespace inkgrid
