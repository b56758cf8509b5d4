// What:   the options that the drawing decides where nobody did.
// Source: sections 5 and 7, where a person chooses them.
// Differs: docs/METHOD.md, "Presets", "Fine pens", "Bundles".
// Cost:   a few comparisons.
#pragma once

#include "stages.h"

namespace inkgrid {

// By how much a picture is enlarged.
int enlargement_for(const Look& look, const Options& given);

// Writes Inputs::settled: preset, reach, spacing, gap and what becomes of bundles.  `measured`: stages that hold the ink, which
// may be those of an earlier run.
void settle(Inputs& inputs, const Stages& measured);

}  // namespace inkgrid
