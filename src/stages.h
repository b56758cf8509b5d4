// What:   the value that holds what every stage made.
// Source: section 3, Fig. 3.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fit/fit.h"
#include "graph/chains.h"
#include "ink/fills.h"
#include "ink/slim.h"
#include "inkgrid/inkgrid.h"
#include "map/exact_map.h"
#include "refine/bundles.h"

namespace inkgrid {

// What a result is made from.
struct Inputs {
  Image image;
  std::optional<ScaleMask> mask;  // Control::mask, enlarged where the ink is
  Options options;                // as given
  Options settled;                // as used: preset, reach and spacing decided by the ink
};

// Of a picture before it is enlarged.
struct Look {
  Preset preset = Preset::clean;
  bool fine_pen = false, fine_paper = false;  // ink/enlarge.h
  double softening = 0;                       // px, ink/grain.h; all else is of the softened picture
};

struct SolvedPart;  // scribbles/parts.h

// What every stage made, each written once; for pictures and for running again from the middle.  No stage receives it.  All up to
// the parts is in pixels of the ink, which may be those of an enlarged picture; chains and drawing are in the drawing's own.
struct Stages {
  Look look;
  Fills fills;
  Ink ink;
  Bundles bundles;
  Ink slim;  // the ink with bundles joined, and strokes as slim as the spacing asks for; empty where that is the ink
  ScaleMask bundle_scale;  // how much coarser bundles are; empty where there are none
  // Without the mask:
  BandMesh mesh;
  FrameField field;
  Charts charts;
  std::vector<Label> labels;
  GridMap map;
  ExactMap exact;
  IsolineGraph graph;
  Chains plain;
  // With it:
  std::vector<std::shared_ptr<const SolvedPart>> parts;
  Chains chains;
  Drawing drawing;
  Report report;
  Inputs inputs;
};

// The side of a pixel of the ink in the drawing, px.
inline double pixel_of(const Stages& stages) {
  return 1.0 / stages.ink.enlargement;
}

// What the grid works on.
inline const Ink& grid_ink(const Stages& stages) {
  return stages.slim.mask.data.empty() ? stages.ink : stages.slim;
}

// What the curves are to cover: the middle of a bundle may be paper.
inline const Ink& covered_ink(const Stages& stages) {
  return stages.bundles.count > 0 ? stages.slim : stages.ink;
}

}  // namespace inkgrid
