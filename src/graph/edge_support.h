// What:   which parts of an isoline run along a stroke.
// Source: section 6.3, "Topological graph": only isolines in the tangent direction.
// Cost:   linear in the length of the isolines.
#pragma once

#include <vector>

#include "graph/isolines.h"

namespace inkgrid {

// A part of an edge's path, by length from its start, px.
struct Interval {
  double from = 0;
  double to = 0;
};

// The parts of the edge that run along a stroke: in faces that are in_stroke and whose label agrees (an unlabelled one
// agrees with everything); labels as spread_labels gives them.  Gaps shorter than `bridged` px between two such parts are closed.
std::vector<Interval> supported_intervals(const GraphEdge& edge, const BandMesh& mesh, const std::vector<Label>& labels,
                                          double bridged);

// The part of a path between two lengths.
std::vector<Vec2> cut_out(const std::vector<Vec2>& path, const std::vector<double>& lengths, Interval part);

}  // namespace inkgrid
