// What:   what a run did, in words and as JSON.
// Cost:   none.
#pragma once

#include <string>

#include "inkgrid/inkgrid.h"

namespace inkgrid {

// "clean drawing: threshold 128, stroke width 6.1 px, reach 0.3, spacing 1".
std::string choice_text(const Report& report);

// For the metadata of a result: the version, the options that differ from the defaults but for threads, which change nothing, and
// what was chosen where there was ink.
std::string run_description(const Options& options, const Report& report);

// Version, every option, every field of the report; indented, with a line break at its end.
std::string report_json(const Options& options, const Report& report);

}  // namespace inkgrid
