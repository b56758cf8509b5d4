// What:   the method from drawing to curves, stage by stage.
// Source: section 3, Fig. 3.
#pragma once

#include "chains.h"
#include "exact_map.h"
#include "fit.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {

// What every stage made, each written once; for pictures and for running again from the middle.  No stage receives it.
struct Stages {
  Ink ink;
  BandMesh mesh;
  FrameField field;
  Charts charts;
  std::vector<Label> labels;
  GridMap map;
  ExactMap exact;
  IsolineGraph graph;
  Chains chains;
  Drawing drawing;
  Report report;
};

Stages run_stages(const Image& image, const Options& options, const Control& control);

// Puts the numbers of curves and segments into the report.
void count_curves(const Drawing& drawing, Report& report);

}  // namespace inkgrid
