// What:   which corners snap to a common integer, and how strongly.
// Source: section 6.2, "Integer elimination strategy" and the weights of equation (3).
// Differs: corners of no weight get no integer (docs/METHOD.md, "Grid map").
// Cost:   linear.
#pragma once

#include <vector>

#include "map/grid_map.h"

namespace inkgrid {

struct SnapRegions {
  std::vector<int> region;     // per corner: the region whose integer it snaps to, or -1
  std::vector<double> weight;  // per corner of a region: w_snap
  std::vector<int> component;  // per region: of the mesh
};

// The coordinate that snaps in a face of this label: 0 for u, 1 for v.
constexpr int snapping_coordinate(Label label) {
  return label == Label::along_t ? 0 : 1;
}

// The length of a grid unit in face f, px.
double grid_unit(const BandMesh& mesh, const Ink& ink, const GridMapOptions& options, int f);

SnapRegions merge_snapping(const BandMesh& mesh, const Charts& charts, const std::vector<Label>& labels, const Ink& ink,
                           const GridMapOptions& options);

}  // namespace inkgrid
