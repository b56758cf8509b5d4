// What:   marks for ink that no chain stands for: dots, and what the grid could not resolve.
// Source: ours (docs/METHOD.md, "Leftovers").
// Cost:   linear in the pixels of ink.
#pragma once

#include "graph/chains.h"

namespace inkgrid {

// Each connected piece of ink that no chain reaches within `reach` px becomes a straight mark along its longer axis.
Chains mark_leftovers(Chains chains, const Ink& ink, double reach);

// Marks longer than two stroke widths: ink whose shape they only hint at.  Shorter ones are dots.
int count_dashes(const Chains& chains, double stroke_width);

}  // namespace inkgrid
