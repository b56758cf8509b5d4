// What:   what a run tells of itself, a stage at a time.
// Source: ours; what each number is says include/inkgrid/report.h.
// Differs: nothing.
// Cost:   linear in what is counted.
#pragma once

#include "graph/chains.h"
#include "ink/fills.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {

void report_ink(const Ink& ink, const Fills& fills, double softening, Report& report);
void report_mesh(const BandMesh& mesh, Report& report);
void report_field(const FrameField& field, const Charts& charts, Report& report);
void report_map(const GridMap& map, Report& report);
void report_graph(const IsolineGraph& graph, Report& report);

// After report_map.
void report_leftovers(const Chains& chains, double stroke_width, Report& report);

// The numbers of curves and segments.
void count_curves(const Drawing& drawing, Report& report);

}  // namespace inkgrid
