// What:   a comparison for people and for programs.
// Source: own.
// Cost:   none.
#pragma once

#include <string>

#include "inkgrid/compare.h"

namespace inkgrid {

std::string comparison_text(const Comparison& comparison);

std::string comparison_json(const Comparison& comparison);

}  // namespace inkgrid
