#include "export/export.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/alternatives.h"
#include "base/decimal.h"
#include "base/overloaded.h"
#include "export/writers.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr std::array kFormats{
    ExportFormat{"svg", "image/svg+xml", "a path a curve, for drawing programs and browsers", svg_text},
    ExportFormat{"pdf", "application/pdf", "one page of the drawing's size, for print", pdf_text},
    ExportFormat{"eps", "application/postscript", "the same as Encapsulated PostScript", eps_text},
    ExportFormat{"dxf", "image/vnd.dxf", "a polyline or spline a curve, for cutters, plotters and CAD; no widths", dxf_text},
    ExportFormat{"json", "application/json", "curves, junctions and what was measured, to the last digit, for programs",
                 graph_json},
    ExportFormat{"png", "image/png", "the curves as pixels, black on white", png_bytes},
};

constexpr std::array kTable{
    ExportOptionRow{"unit", &ExportOptions::unit, "", 0, 0,
                    "unit of sizes and coordinates; auto is mm where the resolution is known, px elsewhere"},
    ExportOptionRow{"resolution", &ExportOptions::resolution, "auto", 1, 1e5,
                    "pixels of the drawing an inch; auto is what its file says, or 96 where it says nothing"},
    ExportOptionRow{"stroke-width", &ExportOptions::stroke_width, "measured", 1e-3, 1e5,
                    "width of all curves, in the unit; not in JSON and DXF"},
    ExportOptionRow{"dxf-curves", &ExportOptions::dxf_curves, "", 0, 0,
                    "of DXF: polylines, which every reader knows (R12), or splines, which are exact (2000)"},
    ExportOptionRow{"flatness", &ExportOptions::flatness, "", 1e-3, 100,
                    "of DXF: largest distance of a polyline from its curve, px"},
    ExportOptionRow{"png-scale", &ExportOptions::png_scale, "", 0.01, 100, "of PNG: its pixels for a pixel of the drawing"},
};

constexpr std::array kUnitNames{"auto", "mm", "inch", "px"};
constexpr std::array kDxfCurvesNames{"polylines", "splines"};

constexpr std::span<const char* const> names_of(LengthUnit) {
  return kUnitNames;
}
constexpr std::span<const char* const> names_of(DxfCurves) {
  return kDxfCurvesNames;
}

bool in_range(const ExportOptionRow& row, double value) {
  return row.least <= value && value <= row.most;
}

[[noreturn]] void refuse(const ExportOptionRow& row, std::string_view text) {
  throw Error(ErrorCode::usage, std::string(row.name) + " must be " + accepted_values(row) + ", not '" + std::string(text) + "'");
}

double number_in_range(const ExportOptionRow& row, std::string_view text) {
  const std::optional<double> value = parsed<double>(text);
  if (!value || !in_range(row, *value)) refuse(row, text);
  return *value;
}

template <class Choice>
Choice choice_of(const ExportOptionRow& row, std::string_view text) {
  const auto names = names_of(Choice{});
  const auto name = std::find(names.begin(), names.end(), text);
  if (name == names.end()) refuse(row, text);
  return static_cast<Choice>(name - names.begin());
}

void validate(const ExportOptions& options) {
  for (const ExportOptionRow& row : kTable)
    std::visit(Overloaded{[&](double ExportOptions::*m) {
                            if (!in_range(row, options.*m)) refuse(row, shortest(options.*m));
                          },
                          [&](std::optional<double> ExportOptions::*m) {
                            if (options.*m && !in_range(row, *(options.*m))) refuse(row, shortest(*(options.*m)));
                          },
                          [](auto) {}},
               row.member);
}

void check(double value) {
  constexpr double kLargest = 1e9;
  if (!(std::abs(value) < kLargest)) throw Error(ErrorCode::numerics, "a curve has a coordinate that is no number");
}

void check(Vec2 p) {
  check(p.x);
  check(p.y);
}

void check(const Curve& curve) {
  check(curve.width);
  check(curve.coverage);
  for (const Cubic& c : curve.segments)
    for (const Vec2 p : {c.p0, c.p1, c.p2, c.p3}) check(p);
}

// No writer meets what is no number.
void check(const Drawing& drawing) {
  for (const Vec2 p : drawing.junctions) check(p);
  for (const Curve& curve : drawing.curves) check(curve);
  for (const Fill& fill : drawing.fills)
    for (const Curve& outline : fill.outlines) check(outline);
}

}  // namespace

std::span<const ExportFormat> export_formats() {
  return kFormats;
}

std::string export_format_names() {
  std::string names;
  for (const ExportFormat& format : kFormats) names.append(names.empty() ? "" : ", ").append(format.name);
  return names;
}

const ExportFormat& export_format(std::string_view name) {
  const auto format = std::find_if(kFormats.begin(), kFormats.end(), [&](const ExportFormat& f) { return f.name == name; });
  if (format == kFormats.end())
    throw Error(ErrorCode::usage, "there is no format '" + std::string(name) + "': the formats are " + export_format_names());
  return *format;
}

std::string export_drawing(const Drawing& drawing, const ExportFormat& format, const ExportOptions& options,
                           const std::string& description) {
  validate(options);
  check(drawing);
  return format.write(drawing, options, description);
}

std::span<const ExportOptionRow> export_option_table() {
  return kTable;
}

std::string accepted_values(const ExportOptionRow& row) {
  std::string range = "a number from " + shortest(row.least) + " to " + shortest(row.most);
  return std::visit(Overloaded{[&](double ExportOptions::*) { return range; },
                               [&](std::optional<double> ExportOptions::*) { return range + " or " + std::string(row.unset); },
                               [](auto choice) { return alternatives(names_of((ExportOptions{}).*choice)); }},
                    row.member);
}

void set_option(ExportOptions& options, const ExportOptionRow& row, std::string_view text) {
  std::visit(Overloaded{[&](double ExportOptions::*m) { options.*m = number_in_range(row, text); },
                        [&](std::optional<double> ExportOptions::*m) {
                          options.*m = text == row.unset ? std::nullopt : std::optional(number_in_range(row, text));
                        },
                        [&]<class Choice>(Choice ExportOptions::*m) { options.*m = choice_of<Choice>(row, text); }},
             row.member);
}

std::string option_text(const ExportOptions& options, const ExportOptionRow& row) {
  return std::visit(
      Overloaded{
          [&](double ExportOptions::*m) { return shortest(options.*m); },
          [&](std::optional<double> ExportOptions::*m) { return options.*m ? shortest(*(options.*m)) : std::string(row.unset); },
          [&](auto choice) { return std::string(names_of(options.*choice)[static_cast<std::size_t>(options.*choice)]); }},
      row.member);
}

}  // namespace inkgrid
