#include "report_json.h"

#include <nlohmann/json.hpp>

#include "base/decimal.h"
#include "options.h"

namespace inkgrid {
namespace {

using Json = nlohmann::ordered_json;

std::string brief(double value) {
  return decimal(value, 2);
}

struct JsonValue {
  const Options& options;
  const OptionRow& row;

  Json operator()(Preset Options::*) const { return option_text(options, row); }
  Json operator()(FillMode Options::*) const { return option_text(options, row); }
  Json operator()(BundleMode Options::*) const { return option_text(options, row); }
  Json operator()(std::optional<double> Options::*member) const {
    const std::optional<double> value = options.*member;
    return value ? Json(*value) : Json("auto");
  }
  Json operator()(auto Options::*member) const { return options.*member; }
};

Json options_json(const Options& options) {
  Json json = Json::object();
  for (const OptionRow& row : option_table()) json[std::string(row.name)] = std::visit(JsonValue{options, row}, row.member);
  return json;
}

Json seconds_json(const Report& report) {
  Json json = Json::object();
  for (const auto& [stage, seconds] : report.seconds) json[stage] = seconds;
  return json;
}

}  // namespace

std::string choice_text(const Report& report) {
  return report.preset + " drawing: " + (report.inverted ? "light lines, " : "") + "threshold " + brief(report.threshold) +
         ", stroke width " + brief(report.stroke_width) + " px, reach " + brief(report.reach) + ", spacing " +
         brief(report.spacing) + (report.ruled ? ", without the lines of the paper" : "") +
         (report.softening > 0 ? ", softened by " + brief(report.softening) + " px" : "");
}

std::string run_description(const Options& options, const Report& report) {
  Options telling = options;
  telling.threads = Options{}.threads;  // the result is the same for any number of them
  const std::string given = command_line_text(telling);
  const std::string chosen = report.preset.empty() ? "" : " (" + choice_text(report) + ")";
  return std::string("inkgrid ") + version() + (given.empty() ? "" : " " + given) + chosen;
}

std::string report_json(const Options& options, const Report& report) {
  const Json json{{"version", version()},
                  {"options", options_json(options)},
                  {"threshold", report.threshold},
                  {"inverted", report.inverted},
                  {"faintest", report.faintest},
                  {"ruled", report.ruled},
                  {"stroke_width", report.stroke_width},
                  {"ink_pixels", report.ink_pixels},
                  {"softening", report.softening},
                  {"enlargement", report.enlargement},
                  {"fills", report.fills},
                  {"preset", report.preset},
                  {"reach", report.reach},
                  {"spacing", report.spacing},
                  {"gap", report.gap},
                  {"bundles", report.bundles},
                  {"vertices", report.vertices},
                  {"triangles", report.triangles},
                  {"components", report.components},
                  {"holes", report.holes},
                  {"field_rounds", report.field_rounds},
                  {"degenerate_fraction", report.degenerate_fraction},
                  {"singularities", report.singularities},
                  {"cuts", report.cuts},
                  {"cut_integers", report.cut_integers},
                  {"snapping_integers", report.snapping_integers},
                  {"alignment_energy", report.alignment_energy},
                  {"snapping_energy", report.snapping_energy},
                  {"fallback_components", report.fallback_components},
                  {"nodes", report.nodes},
                  {"edges", report.edges},
                  {"curves", report.curves},
                  {"segments", report.segments},
                  {"seconds", seconds_json(report)},
                  {"warnings", report.warnings}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace inkgrid
