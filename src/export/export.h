// What:   the one table of file formats that a drawing is written to, and of the options of writing.
// Source: docs/FORMATS.md.
// Differs: nothing.
// Cost:   linear in the number of segments; PNG in the number of pixels.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "inkgrid/drawing.h"

namespace inkgrid {

enum class LengthUnit { automatic, millimetres, inches, pixels };
enum class DxfCurves { polylines, splines };

struct ExportOptions {
  LengthUnit unit = LengthUnit::automatic;      // of sizes and coordinates; automatic: mm where the resolution is known, else px
  std::optional<double> resolution;             // px an inch; unset: the drawing's, or 96 where it has none
  std::optional<double> stroke_width;           // in the unit; unset: as measured, curve by curve
  DxfCurves dxf_curves = DxfCurves::polylines;  // splines are exact and need DXF 2000
  double flatness = 0.05;                       // of the polylines in DXF, px
  double png_scale = 1;                         // px of a PNG for a px of the drawing
};

struct ExportFormat {
  std::string_view name;        // "svg"; what --format takes, and the extension of its files
  std::string_view media_type;  // "image/svg+xml"
  std::string_view help;        // one line, no full stop
  std::string (*write)(const Drawing& drawing, const ExportOptions& options, const std::string& description);
};

// The first one is what is written where nothing else is asked for.
std::span<const ExportFormat> export_formats();

// Throws Error{usage} when there is no such format.
const ExportFormat& export_format(std::string_view name);

// "svg, pdf, ...": the names of the formats, for messages.
std::string export_format_names();

// The file's bytes.  `description` goes where the format has a place for it: version and options (run_description).
// Throws Error{usage} where an option is out of range, Error{numerics} where a coordinate is no number.
std::string export_drawing(const Drawing& drawing, const ExportFormat& format, const ExportOptions& options,
                           const std::string& description);

using ExportMember = std::variant<LengthUnit ExportOptions::*, DxfCurves ExportOptions::*, double ExportOptions::*,
                                  std::optional<double> ExportOptions::*>;

struct ExportOptionRow {
  std::string_view name;  // "stroke-width": --stroke-width on the command line
  ExportMember member;
  std::string_view unset;  // the word for a number that is not given: "measured"
  double least;            // the range holds both ends
  double most;
  std::string_view help;  // one line, no full stop
};

std::span<const ExportOptionRow> export_option_table();

// What may be given: "a number from 0 to 10".
std::string accepted_values(const ExportOptionRow& row);

// As set_option and option_text of options.h.
void set_option(ExportOptions& options, const ExportOptionRow& row, std::string_view text);
std::string option_text(const ExportOptions& options, const ExportOptionRow& row);

}  // namespace inkgrid
