// What:   a drawing as the bytes of each format; export.h has the table of them.
// Source: docs/FORMATS.md says what each holds.
// Differs: every number is the same on every machine and in every locale; no format holds a date.
// Cost:   linear in the number of segments; PNG in the number of pixels.
#pragma once

#include <string>

#include "export/export.h"

namespace inkgrid {

// viewBox in pixels; width and height in the unit; one <path> a curve with a stable id and its stroke width; `z` on closed
// curves.  Numbers have at most 3 places; points that are equal are written equally.
std::string svg_text(const Drawing& drawing, const ExportOptions& options, const std::string& description);

// Everything a Drawing holds, to the last digit, by the schema docs/schema/graph.schema.json.
std::string graph_json(const Drawing& drawing, const ExportOptions& options, const std::string& description);

}  // namespace inkgrid
