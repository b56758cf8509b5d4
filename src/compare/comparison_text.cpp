#include "compare/comparison_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/decimal.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLabel = 26;  // columns
constexpr std::size_t kColumn = 11;

std::string padded(std::string text, std::size_t columns) {
  text.resize(std::max(text.size(), columns), ' ');
  return text;
}

std::string line(const std::string& label, const std::vector<std::string>& cells) {
  std::string text = padded(label, kLabel);
  for (const std::string& cell : cells) text += padded(cell, kColumn);
  return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string number(double value, int places = 4) {
  return decimal(value, places);
}

std::vector<std::string> cells(const Agreement& a) {
  return {number(a.f1), number(a.precision), number(a.recall)};
}

std::string points_line(const std::string& label, const PointAgreement& points) {
  std::vector<std::string> row = cells(points);
  row.push_back(std::to_string(points.result) + " of the result, " + std::to_string(points.truth) + " of the truth");
  return line(label, row);
}

std::string counts_line(const std::string& label, double result, double truth, int places) {
  return line(label, {number(result, places), number(truth, places), truth > 0 ? number(result / truth) : "-"});
}

std::string counts_text(const CurveCounts& result, const CurveCounts& truth) {
  return line("", {"result", "truth", "ratio"}) + counts_line("length, px", result.length, truth.length, 1) +
         counts_line("curves", result.curves, truth.curves, 0) + counts_line("segments", result.segments, truth.segments, 0) +
         counts_line("mean length, px", result.mean_length, truth.mean_length, 1) +
         counts_line("median length, px", result.median_length, truth.median_length, 1);
}

Json json_of(const Agreement& a) {
  return {{"precision", a.precision}, {"recall", a.recall}, {"f1", a.f1}};
}

Json json_of(const PointAgreement& points) {
  Json json = json_of(static_cast<const Agreement&>(points));
  json["result"] = points.result;
  json["truth"] = points.truth;
  return json;
}

Json json_of(const CurveCounts& c) {
  return {{"elements", c.elements}, {"curves", c.curves},           {"segments", c.segments},
          {"lines", c.lines},       {"quadratics", c.quadratics},   {"cubics", c.cubics},
          {"length", c.length},     {"mean_length", c.mean_length}, {"median_length", c.median_length}};
}

Json json_of(const BenchmarkMeasures& b) {
  return {{"distance", b.distance}, {"f_score", json_of(b.f_score)}, {"chamfer", b.chamfer}, {"hausdorff", b.hausdorff}};
}

}  // namespace

std::string comparison_text(const Comparison& c) {
  std::string text = "tolerance " + number(c.tolerance, 2) + " px, pen " + number(c.pen, 2) + " px (" + c.set + ")\n\n";
  text += line("", {"F1", "precision", "recall"});
  text += line("length", cells(c.length));
  text += line("  at half the tolerance", {number(c.f1_half_tolerance)});
  text += line("  without tangents", cells(c.without_tangents));
  if (c.recall_overdrawn) text += line("  of overdrawn curves", {"", "", number(*c.recall_overdrawn)});
  text += points_line("junctions", c.junctions) + points_line("ends", c.ends) + "\n";
  text += line("duplicate ratio", {number(c.duplicate_ratio)});
  text += line("Chamfer, px", {number(c.chamfer)}) + line("Hausdorff 95 %, px", {number(c.hausdorff95)}) + "\n";
  text += counts_text(c.result, c.truth) + "\n";
  text += line("benchmark F-score", cells(c.benchmark.f_score)) + line("  within, px", {number(c.benchmark.distance, 2)});
  text += line("benchmark Chamfer, px", {number(c.benchmark.chamfer)});
  text += line("benchmark Hausdorff, px", {number(c.benchmark.hausdorff)});
  if (c.filled_share > 0.5) text += "\nThe result is filled outlines, not centre lines.\n";
  for (const std::string& note : c.notes) text += "\nNote: " + note + ".\n";
  return text;
}

std::string comparison_json(const Comparison& c) {
  Json json{{"version", version()},
            {"tolerance", c.tolerance},
            {"pen", c.pen},
            {"set", c.set},
            {"precision", c.length.precision},
            {"recall", c.length.recall},
            {"f1", c.length.f1},
            {"f1_half_tolerance", c.f1_half_tolerance},
            {"without_tangents", json_of(c.without_tangents)},
            {"recall_overdrawn", c.recall_overdrawn ? Json(*c.recall_overdrawn) : Json()},
            {"duplicate_ratio", c.duplicate_ratio},
            {"chamfer", c.chamfer},
            {"hausdorff95", c.hausdorff95},
            {"junctions", json_of(c.junctions)},
            {"ends", json_of(c.ends)},
            {"length_ratio", c.length_ratio},
            {"segments_ratio", c.segments_ratio},
            {"curves_ratio", c.curves_ratio},
            {"filled_share", c.filled_share},
            {"result", json_of(c.result)},
            {"truth", json_of(c.truth)},
            {"benchmark", json_of(c.benchmark)},
            {"notes", c.notes}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace inkgrid
