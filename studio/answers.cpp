#include "answers.h"

#include <nlohmann/json.hpp>

#include "base/decimal.h"
#include "embedded.h"
#include "export/export.h"
#include "inkgrid/inkgrid.h"
#include "options.h"
#include "report_json.h"

namespace inkgrid::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPlaces = 3;  // of coordinates, px

std::string kind_of(const OptionRow& row) {
  if (is_name(row)) return "preset";
  if (std::holds_alternative<int Options::*>(row.member)) return "whole";
  return std::holds_alternative<std::optional<double> Options::*>(row.member) ? "optional" : "number";
}

std::vector<std::string> choices_of(const OptionRow& row) {
  std::vector<std::string> choices;
  if (!is_name(row)) return choices;
  for (int i = 0; i <= static_cast<int>(row.most); ++i) {
    Options options;
    std::visit(
        [&]<class Value>(Value Options::*member) {
          if constexpr (std::is_enum_v<Value>) options.*member = static_cast<Value>(i);
        },
        row.member);
    choices.push_back(option_text(options, row));
  }
  return choices;
}

Json option_json(const OptionRow& row) {
  return {{"name", row.name},
          {"kind", kind_of(row)},
          {"unit", row.unit},
          {"least", row.least},
          {"most", row.most},
          {"section", row.section},
          {"help", row.help},
          {"default", option_text(Options{}, row)},
          {"stage", stage_name(row.stage)},
          {"accepted", accepted_values(row)},
          {"choices", choices_of(row)}};
}

template <class Choice>
std::vector<std::string> choices_of(const ExportOptionRow& row, Choice ExportOptions::*member, Choice last) {
  std::vector<std::string> choices;
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    ExportOptions options;
    options.*member = static_cast<Choice>(i);
    choices.push_back(option_text(options, row));
  }
  return choices;
}

std::vector<std::string> choices_of(const ExportOptionRow& row) {
  if (const auto* unit = std::get_if<LengthUnit ExportOptions::*>(&row.member)) return choices_of(row, *unit, LengthUnit::pixels);
  if (const auto* curves = std::get_if<DxfCurves ExportOptions::*>(&row.member))
    return choices_of(row, *curves, DxfCurves::splines);
  return {};
}

Json export_option_json(const ExportOptionRow& row) {
  return {{"name", row.name},
          {"default", option_text(ExportOptions{}, row)},
          {"accepted", accepted_values(row)},
          {"choices", choices_of(row)},
          {"help", row.help}};
}

void append(std::string& text, Vec2 p) {
  text.append(decimal(p.x, kPlaces)).append(",").append(decimal(p.y, kPlaces));
}

// x, y of the first point, then of the three others of each segment.
std::string points_json(const Curve& curve) {
  std::string text = "[";
  if (!curve.segments.empty()) append(text, curve.segments.front().p0);
  for (const Cubic& cubic : curve.segments)
    for (const Vec2 p : {cubic.p1, cubic.p2, cubic.p3}) append(text += ',', p);
  return text + "]";
}

std::string curve_json(const Curve& curve) {
  return "{\"id\":\"" + std::to_string(curve.id) + "\",\"closed\":" + (curve.closed ? "true" : "false") +
         ",\"width\":" + decimal(curve.width, kPlaces) + ",\"coverage\":" + decimal(curve.coverage, kPlaces) +
         ",\"start\":" + std::to_string(curve.start_junction) + ",\"end\":" + std::to_string(curve.end_junction) +
         ",\"points\":" + points_json(curve) + "}";
}

template <class Items, class Write>
std::string list(const Items& items, Write write) {
  std::string text = "[";
  for (const auto& item : items) text.append(text.size() > 1 ? "," : "").append(write(item));
  return text + "]";
}

std::string point_json(Vec2 p) {
  std::string text = "[";
  append(text, p);
  return text + "]";
}

std::string fill_json(const Fill& fill) {
  return list(fill.outlines, points_json);
}

std::string one_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string about_json(const std::string& opened) {
  Json json{{"version", version()}, {"opened", opened}, {"options", Json::array()}, {"formats", Json::array()}};
  for (const OptionRow& row : option_table()) json["options"].push_back(option_json(row));
  for (const ExportFormat& format : export_formats()) json["formats"].push_back({{"name", format.name}, {"help", format.help}});
  for (const ExportOptionRow& row : export_option_table()) json["export_options"].push_back(export_option_json(row));
  for (const EmbeddedFile& file : embedded_samples()) json["samples"].push_back(file.name);
  return one_line(json);
}

std::string document_json(const Document& document, const Project& project) {
  Project state = project;
  state.drawing = {document.file.name, ""};
  return one_line({{"id", document.id},
                   {"width", document.image.width},
                   {"height", document.image.height},
                   {"project", Json::parse(project_text(state))}});
}

std::string solved_json(const Solved& solved) {
  const Json report = Json::parse(report_json(solved.options, solved.report));
  return "{\"revision\":" + one_line(solved.revision) + ",\"command\":" + one_line(command_line_text(solved.options)) +
         ",\"report\":" + one_line(report) + ",\"junctions\":" + list(solved.drawing.junctions, point_json) +
         ",\"curves\":" + list(solved.drawing.curves, curve_json) + ",\"fills\":" + list(solved.drawing.fills, fill_json) + "}";
}

std::string anchors_json(const Drawing& drawing, int curve) {
  return "{\"at\":" + point_json(anchor_of(drawing, curve)) + ",\"start\":" + point_json(anchor_of_end(drawing, curve, false)) +
         ",\"end\":" + point_json(anchor_of_end(drawing, curve, true)) + "}";
}

}  // namespace inkgrid::studio
