// What:   the method from drawing to curves, stage by stage.
// Source: section 3, Fig. 3.
#pragma once

#include "stages.h"

namespace inkgrid {

Stages run_stages(const Image& image, const Options& options, const Control& control);

// The same result as that of run_stages, to the last digit, from the stages of an earlier run (or none), unchanged: only what
// comes after the first change of the image, the options or the mask runs again, and Report::seconds names only that.  Where it
// throws, the stages are as they were.
void rerun_stages(Stages& stages, const Image& image, const Options& options, const Control& control);

}  // namespace inkgrid
