// The mixed-integer problems that make up a drawing's grid map.
#pragma once

#include "map/map_system.h"
#include "stages.h"

namespace inkgrid {

// Calls visit(problem) for each component of the band.
template <class Visit>
void for_each_map_problem(const Stages& stages, Visit visit) {
  const Options& options = stages.inputs.settled;
  const Ink& ink = grid_ink(stages);
  const double spacing = *options.spacing * stages.ink.stroke_width / ink.stroke_width;
  const GridMapOptions map_options{spacing, options.snap, options.snap_sigma, options.damping, options.merge_difference, 1};
  const CutShifts cuts = trace_cuts(stages.mesh, stages.charts);
  const SnapRegions snap = merge_snapping(stages.mesh, stages.charts, stages.labels, ink, map_options);
  const HeldVertices held = held_vertices(stages.mesh, cuts, nullptr);
  const MapSetup setup{stages.mesh, stages.charts, stages.labels, ink, map_options, cuts, snap, held};
  const MapLayout layout = lay_out(setup);
  for (int component = 0; component < stages.mesh.components; ++component) visit(map_problem(setup, layout, component));
}

}  // namespace inkgrid
