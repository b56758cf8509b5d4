// What:   the one table that describes every option; command line, manual, report and metadata are generated from it.
// Source: the sections named in its rows.
// Differs: defaults are those of the struct Options, never copied.
// Cost:   none.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "inkgrid/options.h"

namespace inkgrid {

using OptionMember = std::variant<Preset Options::*, FillMode Options::*, BundleMode Options::*, double Options::*,
                                  std::optional<double> Options::*, int Options::*>;

// The stages of the method that an option may enter at, in their order (pipeline.h).
enum class Stage { ink, bundles, slim, band, field, charts, labels, map, isolines, chains, scribbles, fit, none };

// The name of the stage as progress and Report::seconds tell it; "" for none.
std::string_view stage_name(Stage stage);

struct OptionRow {
  std::string_view name;  // "mesh-size": --mesh-size on the command line
  OptionMember member;
  Stage stage;            // the first that reads it: what comes before need not run again when it changes
  std::string_view unit;  // strokes (multiples of the stroke width), half-widths (of a stroke), degrees, grid units, or empty
  double least;           // the range holds both ends
  double most;
  std::string_view section;  // of the paper; empty where the paper has no such parameter
  std::string_view help;     // one line, no full stop
};

// In the order of the pipeline.
std::span<const OptionRow> option_table();

// Throws Error{usage} when there is no such option.
const OptionRow& option_row(std::string_view name);

// Its values are names, not numbers.
bool is_name(const OptionRow& row);

// What may be given: "a number from 0 to 10 strokes or auto".
std::string accepted_values(const OptionRow& row);

// Throws Error{usage}, and leaves the options alone, unless the text is one of the accepted values.
void set_option(Options& options, const OptionRow& row, std::string_view text);

// The shortest text that set_option reads back as the same value.
std::string option_text(const Options& options, const OptionRow& row);

// The first stage whose options differ; Stage::none where the result is the same.  `auto` differs from every number here, and a
// spacing that slims strokes otherwise counts as any other: what the drawing decides is known to rerun_stages only.
Stage first_stage_changed(const Options& before, const Options& after);

bool is_default(const Options& options, const OptionRow& row);

// As they would be typed, without the defaults: "--threshold 165 --reach 0.3".
std::string command_line_text(const Options& options);

// Throws Error{usage} where a value is outside its range or no number.
void validate(const Options& options);

}  // namespace inkgrid
