// What:   a drawing as the bytes of each format, called by export_drawing, which sees to it that all numbers are some.
// Source: docs/FORMATS.md says what each holds.
// Differs: every number is the same on every machine and in every locale; no format holds a date.
// Cost:   linear in the number of segments; PNG in the number of pixels.
#pragma once

#include <string>

#include "export/export.h"

namespace inkgrid {

// viewBox in pixels; width and height in the unit; one <path> a curve with a stable id and its stroke width; `z` on closed
// curves; filled areas in the group "fills", below the curves, where there are any.  Numbers have at most 3 places; points that
// are equal are written equally.
std::string svg_text(const Drawing& drawing, const ExportOptions& options, const std::string& description);

// One page of the drawing's size.
std::string pdf_text(const Drawing& drawing, const ExportOptions& options, const std::string& description);
std::string eps_text(const Drawing& drawing, const ExportOptions& options, const std::string& description);

// In the unit, y up: a polyline a curve (R12), or a spline a curve (2000), on the layer CURVES, outlines of fills on the layer
// FILLS.  Widths are left out.
std::string dxf_text(const Drawing& drawing, const ExportOptions& options, const std::string& description);

// Black on white.  The description is left out.
std::string png_bytes(const Drawing& drawing, const ExportOptions& options, const std::string& description);

// Everything a Drawing holds, to the last digit, by the schema docs/schema/graph.schema.json.
std::string graph_json(const Drawing& drawing, const ExportOptions& options, const std::string& description);

}  // namespace inkgrid
