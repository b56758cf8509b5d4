// What:   the parts of a drawing that scribbles touch, solved anew with everything around them kept.
// Source: section 7, "User control": re-solving locally is its future work.
// Differs: docs/METHOD.md, "Scribbles".
// Cost:   that of the method on the parts.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "map/known.h"
#include "scribbles/touched.h"
#include "stages.h"

namespace inkgrid {

// A window of the drawing as a drawing of its own, with what is known of its rim.  Points are those of the whole drawing.
struct Window {
  Stages stages;
  Known known;
};

struct SolvedPart {
  TouchedPart touched;
  ScaleMask mask;     // of the window
  double margin = 0;  // px from the scribbles: within it everything is solved anew
  bool local = true;  // false: the whole drawing, where keeping its other parts did not do
  Window window;
};

struct Scribbled {
  Chains chains;
  std::vector<std::shared_ptr<const SolvedPart>> parts;
};

// Solves the stages of the window around a part, with its mask.  What lies further than `margin` px from the scribbles is kept as
// the drawing around has it.
using SolveWindow = std::function<Window(const ScaleMask&, const TouchedPart&, double margin)>;

// The chains of a drawing with its mask.  `plain`: its stages, as far as the chains, without one.  They hold the mask, and parts
// that were solved before, on the same stages with another mask; those are used again where they are the same.
Scribbled solve_scribbles(const Stages& plain, const SolveWindow& solve);

}  // namespace inkgrid
