// What:   whether a drawing is clean or over-sketched, and the reach and spacing that follow.
// Source: section 5 and section 7, "Simplification control", where a person chooses; the choice from the drawing is ours.
// Differs: docs/METHOD.md, "Presets".
// Cost:   a few passes over the pixels.
#pragma once

#include "ink/ink.h"
#include "inkgrid/options.h"

namespace inkgrid {

// What the choice rests on.
struct Sketchiness {
  double inside = 0;          // share of the ink of which the darkness is not that of a rim
  double opacity_spread = 0;  // standard deviation of the darkness there: overdrawn strokes differ
  double centre_spread = 0;   // the same on the centre lines there, where no blurred rim reaches
  double pale = 0;            // share of those that is less than fully dark
  double plain_spread = 0;  // standard deviation of the darkness there but for seams, which are paler than the ink on both sides
  double one_pen = 0;       // share of the centre lines whose width is about the commonest one
  double slits = 0;         // paper between strokes closer than 0.75 pens, over the ink
  double uneven_width = 0;  // 90th less 10th percentile of the width along the centre lines, strokes; 0 for a step of pixels
};

// `pen_width`: of most of the strokes, px; the average one is that of blots, too.
Sketchiness measure_sketchiness(const Ink& ink, double pen_width);

// Preset::clean or Preset::rough.
Preset choose_preset(const Ink& ink, double pen_width);

struct PresetValues {
  double reach;    // beta, strokes
  double spacing;  // lambda, strokes
  double gap;      // of paper that is bridged between ends in line, strokes: pictures break strokes by a few pixels
};

// For clean drawings both follow the pen: down to half of what a pen of a few pixels is given, so that details smaller than the
// pen are resolved.  `enlargement`: how many times the picture was enlarged.
PresetValues preset_values(Preset preset, double stroke_width, int enlargement = 1);

}  // namespace inkgrid
