#include "options.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "base/alternatives.h"
#include "base/decimal.h"
#include "base/overloaded.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr std::array kPresetNames{"auto", "clean", "rough"};
constexpr std::array kFillModeNames{"layer", "drop", "trace"};
constexpr std::array kBundleModeNames{"auto", "join", "keep"};

template <class Value>
concept Choice = std::is_enum_v<Value>;

// In the order of the enumerators.
template <Choice Value>
constexpr const auto& names_of() {
  if constexpr (std::is_same_v<Value, Preset>)
    return kPresetNames;
  else if constexpr (std::is_same_v<Value, FillMode>)
    return kFillModeNames;
  else
    return kBundleModeNames;
}

constexpr std::array<std::string_view, 13> kStageNames{"ink",       "bundles", "slim ink", "band",     "frame field",
                                                       "charts",    "labels",  "grid map", "isolines", "chains",
                                                       "scribbles", "fit",     ""};

constexpr std::array kTable{
    OptionRow{"preset", &Options::preset, Stage::bundles, "", 0, 2, "7",
              "sets what is left at auto: for clean drawings, for rough ones, or as the drawing looks"},
    OptionRow{"threshold", &Options::threshold, Stage::ink, "", 0, 255, "5", "pixels whose grey level is below this are ink"},
    OptionRow{"faintest", &Options::faintest, Stage::ink, "", 0, 0.95, "",
              "strokes with less than this part of the darkness of full ink are none; auto is 0.15, and above the lines of ruled "
              "paper; only without a threshold"},
    OptionRow{"soften", &Options::soften, Stage::ink, "px", 0, 20, "",
              "blur of the picture before anything else, so that strokes broken by grain hold together; 0: none"},
    OptionRow{"fills", &Options::fills, Stage::ink, "", 0, 2, "",
              "filled areas: outlines in a layer of their own, left out, or traced like strokes"},
    OptionRow{"bundles", &Options::bundles, Stage::bundles, "", 0, 2, "",
              "strokes side by side for one line: join them first, keep them, or join them in rough drawings whose reach and "
              "spacing are auto"},
    OptionRow{"reach", &Options::reach, Stage::band, "strokes", 0, 10, "5", "half-width of the band around the ink (beta)"},
    OptionRow{"mesh-size", &Options::mesh_size, Stage::band, "strokes", 0.05, 1, "5", "largest circumdiameter of a triangle"},
    OptionRow{"degenerate-angle", &Options::degenerate_angle, Stage::field, "degrees", 0, 90, "6.1",
              "a frame with a smaller angle is degenerate"},
    OptionRow{"degenerate-ratio", &Options::degenerate_ratio, Stage::field, "", 0, 1, "6.1",
              "a frame with a smaller ratio of lengths is degenerate"},
    OptionRow{"degenerate-fraction", &Options::degenerate_fraction, Stage::field, "", 0, 1, "6.1",
              "re-weighting stops when fewer frames are degenerate"},
    OptionRow{"field-rounds", &Options::field_rounds, Stage::field, "", 0, 10000, "6.1", "re-weighting rounds at most"},
    OptionRow{"label-length", &Options::label_length, Stage::labels, "strokes", 0.5, 100, "6.1",
              "how far a triangle looks along its two directions"},
    OptionRow{"label-ratio", &Options::label_ratio, Stage::labels, "", 0, 0.5, "6.1",
              "above this share of ink the weaker direction is as good"},
    OptionRow{"spacing", &Options::spacing, Stage::map, "strokes", 0.1, 100, "6.2",
              "distance of grid lines; nearer strokes merge, and below 0.7 strokes are slimmed first (lambda)"},
    OptionRow{"snap", &Options::snap, Stage::map, "", 0, 1e6, "6.2", "weight that draws strokes to grid lines (mu)"},
    OptionRow{"snap-sigma", &Options::snap_sigma, Stage::map, "half-widths", 0.01, 10, "6.2",
              "how far from its centre line a stroke snaps (sigma)"},
    OptionRow{"damping", &Options::damping, Stage::map, "", 1e-6, 1, "6.2", "weight that keeps coordinates small (epsilon)"},
    OptionRow{"merge-difference", &Options::merge_difference, Stage::map, "grid units", 0, 10, "6.2",
              "corners nearer than this share an integer"},
    OptionRow{"gap", &Options::gap, Stage::chains, "strokes", 0, 20, "",
              "paper over which two ends in line with each other are joined; 0: none"},
    OptionRow{
        "details", &Options::details, Stage::chains, "strokes", 0, 1000, "",
        "where the grid is coarse, pieces of ink up to this length that stand alone have a finer one of their own; 0: none"},
    OptionRow{"coverage-bins", &Options::coverage_bins, Stage::chains, "", 1, 1000, "6.3",
              "parts of a chain that must all hold ink"},
    OptionRow{"tolerance", &Options::tolerance, Stage::fit, "strokes", 0.001, 10, "6.3",
              "largest distance of a curve from its chain, up to four times that for one of several strokes"},
    OptionRow{"threads", &Options::threads, Stage::none, "", 0, 1024, "",
              "workers, 0 for as many as the machine has; the result is the same"},
};

// False for what is no number, too.
bool in_range(const OptionRow& row, double value) {
  return row.least <= value && value <= row.most;
}

bool in_range(const OptionRow& row, const Options& options) {
  return std::visit(Overloaded{[&](std::optional<double> Options::*m) { return !(options.*m) || in_range(row, *(options.*m)); },
                               [&](auto Options::*m) { return in_range(row, static_cast<double>(options.*m)); }},
                    row.member);
}

[[noreturn]] void refuse(const OptionRow& row, std::string_view text) {
  throw Error(ErrorCode::usage, std::string(row.name) + " must be " + accepted_values(row) + ", not '" + std::string(text) + "'");
}

template <class Number>
Number number_in_range(const OptionRow& row, std::string_view text) {
  const std::optional<Number> value = parsed<Number>(text);
  if (!value || !in_range(row, static_cast<double>(*value))) refuse(row, text);
  return *value;
}

}  // namespace

std::span<const OptionRow> option_table() {
  return kTable;
}

const OptionRow& option_row(std::string_view name) {
  const auto row = std::find_if(kTable.begin(), kTable.end(), [&](const OptionRow& r) { return r.name == name; });
  if (row == kTable.end()) throw Error(ErrorCode::usage, "there is no option '" + std::string(name) + "'");
  return *row;
}

std::string_view stage_name(Stage stage) {
  return kStageNames.at(static_cast<std::size_t>(stage));
}

bool is_name(const OptionRow& row) {
  return std::visit([]<class Value>(Value Options::*) { return Choice<Value>; }, row.member);
}

std::string accepted_values(const OptionRow& row) {
  std::string range = shortest(row.least) + " to " + shortest(row.most);
  if (!row.unit.empty()) range.append(" ").append(row.unit);
  return std::visit(Overloaded{[]<Choice Value>(Value Options::*) { return alternatives(names_of<Value>()); },
                               [&](double Options::*) { return "a number from " + range; },
                               [&](std::optional<double> Options::*) { return "a number from " + range + " or auto"; },
                               [&](int Options::*) { return "a whole number from " + range; }},
                    row.member);
}

void set_option(Options& options, const OptionRow& row, std::string_view text) {
  std::visit(Overloaded{[&]<Choice Value>(Value Options::*m) {
                          const auto& names = names_of<Value>();
                          const auto name = std::find(names.begin(), names.end(), text);
                          if (name == names.end()) refuse(row, text);
                          options.*m = static_cast<Value>(name - names.begin());
                        },
                        [&](double Options::*m) { options.*m = number_in_range<double>(row, text); },
                        [&](std::optional<double> Options::*m) {
                          options.*m = text == "auto" ? std::nullopt : std::optional(number_in_range<double>(row, text));
                        },
                        [&](int Options::*m) { options.*m = number_in_range<int>(row, text); }},
             row.member);
}

std::string option_text(const Options& options, const OptionRow& row) {
  return std::visit(
      Overloaded{[&]<Choice Value>(Value Options::*m) {
                   return std::string(names_of<Value>().at(static_cast<std::size_t>(options.*m)));
                 },
                 [&](double Options::*m) { return shortest(options.*m); },
                 [&](std::optional<double> Options::*m) { return options.*m ? shortest(*(options.*m)) : std::string("auto"); },
                 [&](int Options::*m) { return std::to_string(options.*m); }},
      row.member);
}

Stage first_stage_changed(const Options& before, const Options& after) {
  Stage first = Stage::none;
  for (const OptionRow& row : kTable)
    if (!std::visit([&](auto Options::*m) { return before.*m == after.*m; }, row.member)) first = std::min(first, row.stage);
  return first;
}

bool is_default(const Options& options, const OptionRow& row) {
  return std::visit([&](auto Options::*m) { return options.*m == Options{}.*m; }, row.member);
}

std::string command_line_text(const Options& options) {
  std::string text;
  for (const OptionRow& row : kTable) {
    if (is_default(options, row)) continue;
    if (!text.empty()) text += ' ';
    text.append("--").append(row.name).append(" ").append(option_text(options, row));
  }
  return text;
}

void validate(const Options& options) {
  for (const OptionRow& row : kTable)
    if (!in_range(row, options))
      std::visit(Overloaded{[&]<Choice Value>(Value Options::*m) { refuse(row, std::to_string(static_cast<int>(options.*m))); },
                            [&](auto Options::*) { refuse(row, option_text(options, row)); }},
                 row.member);
}

}  // namespace inkgrid
