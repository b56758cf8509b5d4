// What:   the method from drawing to curves, stage by stage.
// Source: section 3, Fig. 3.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bundles.h"
#include "chains.h"
#include "exact_map.h"
#include "fills.h"
#include "fit.h"
#include "inkgrid/inkgrid.h"
#include "options.h"
#include "slim.h"

namespace inkgrid {

// What a result is made from.
struct Inputs {
  Image image;
  std::optional<ScaleMask> mask;  // Control::mask
  Options options;                // as given
  Options settled;                // as used: preset, reach and spacing decided by the ink
};

struct SolvedPart;  // parts.h

// What every stage made, each written once; for pictures and for running again from the middle.  No stage receives it.
struct Stages {
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

// What the grid works on.
const Ink& grid_ink(const Stages& stages);

// What the curves are to cover: the middle of a bundle may be paper.
const Ink& covered_ink(const Stages& stages);

Stages run_stages(const Image& image, const Options& options, const Control& control);

// The same result as that of run_stages, to the last digit, from the stages of an earlier run (or none), unchanged: only what
// comes after the first change of the image, the options or the mask runs again, and Report::seconds names only that.  Where it
// throws, the stages are as they were.
void rerun_stages(Stages& stages, const Image& image, const Options& options, const Control& control);

}  // namespace inkgrid
