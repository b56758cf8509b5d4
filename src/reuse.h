// What:   what of an earlier run holds for other inputs.
// Source: ours; section 7 has drawings solved again for every scribble.
// Differs: docs/DESIGN.md, "Running again".
// Cost:   a comparison of images and masks.
#pragma once

#include "options.h"
#include "stages.h"

namespace inkgrid {

// Whether the ink of an earlier run is that of these inputs.
bool is_ink_of(const Stages& before, const Inputs& now);

// The first stage that another image, mask or option changes; Stage::ink where there was no run.  `now` is settled, but for
// another ink.
Stage first_stage_changed(const Stages& before, const Inputs& now);

// Moves what the stages before `first` made.
void move_kept(Stage first, Stages& from, Stages& to);

}  // namespace inkgrid
