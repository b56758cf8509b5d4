// What:   marks for ink that no chain stands for: dots, and what the grid could not resolve.
// Source: ours (docs/METHOD.md, "Leftovers").
// Cost:   linear in the pixels of ink.
#pragma once

#include "chains.h"

namespace inkgrid {

struct Leftovers {
  Chains chains;   // with the marks
  int dots = 0;    // marks no longer than two stroke widths
  int dashes = 0;  // longer ones: ink whose shape the mark only hints at
};

// Each connected piece of ink that no chain reaches within `reach` px becomes a straight mark along its longer axis.
Leftovers mark_leftovers(Chains chains, const Ink& ink, double reach);

}  // namespace inkgrid
