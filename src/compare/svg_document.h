// What:   the curves of an SVG file, in pixels of a page.
// Source: SVG 1.1: path, line, polyline, polygon, rect, circle, ellipse, g, svg, use, symbol; transform, viewBox; styles.
// Differs: strokes and fills are their geometry, widths and dashes apart.  Left out: definitions, text, images, clipping,
//          markers, what is hidden or not painted, a filled shape that is the page.  Where nothing is painted, all counts.
// Cost:   a few passes over the file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/svg_path.h"
#include "compare/svg_values.h"
#include "inkgrid/compare.h"

namespace inkgrid {

// One sub-path.
struct SvgCurve {
  SubPath segments;
  double stroke_width = 0;  // px
  bool filled = false;      // and not stroked
  bool overdrawn = false;   // it stands for several strokes of the drawing (data-strokes)
};

struct SvgDocument {
  Extent page;                // px
  std::optional<double> pen;  // px, the drawing's, where the file says it (data-pen)
  std::string set;            // kind of drawing, where the file says it (data-set)
  std::vector<SvgCurve> curves;
  int elements = 0;                // that are drawn
  std::vector<std::string> notes;  // what a person should know, one sentence each
};

// In pixels of `page`; a file of another size is fitted to it.  Without it, in pixels of the file's own page: its width and
// height where they are in pixels, its viewBox otherwise.  Throws Error{file} where the text is no SVG or has no size of its own.
SvgDocument read_svg(const SvgText& svg, const std::optional<Extent>& page = std::nullopt);

}  // namespace inkgrid
