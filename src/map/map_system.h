// What:   the energy of the grid map as a quadratic over coordinates of vertices and integers, a component of the mesh at a time.
// Source: section 6.2, equations (2) to (4).
// Differs: docs/METHOD.md, "Grid map".
// Cost:   linear in the mesh.
#pragma once

#include <array>
#include <vector>

#include "base/at.h"
#include "map/cut_shifts.h"
#include "map/grid_map.h"
#include "map/snap_regions.h"
#include "numerics/mixed_integer.h"

namespace inkgrid {

struct Known;

inline Vec2 real(IVec2 a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y)};
}

// Vertices that keep their coordinates.
struct HeldVertices {
  std::vector<std::uint8_t> is_held;  // per vertex
  std::vector<Vec2> uv;               // per vertex
};

// A vertex is held where all faces around it are known; nothing known, none held.
HeldVertices held_vertices(const BandMesh& mesh, const CutShifts& cuts, const Known* known);

// What stands before the solver.
struct MapSetup {
  const BandMesh& mesh;
  const Charts& charts;
  const std::vector<Label>& labels;
  const Ink& ink;
  const GridMapOptions& options;
  const CutShifts& cuts;
  const SnapRegions& snap;
  const HeldVertices& held;
};

// Where each unknown stands among those of its component.
struct MapLayout {
  std::vector<int> node;                   // per vertex: the pair of its (u, v); -1 at fixed points and held vertices
  std::vector<int> shift;                  // per free shift: its first integer, the second follows
  std::vector<int> region;                 // per snapping region: its integer
  std::vector<int> nodes;                  // per component: how many
  std::vector<int> integers;               // per component: how many
  std::vector<std::vector<int>> faces;     // per component
  std::vector<std::vector<int>> vertices;  // per component
};

MapLayout lay_out(const MapSetup& setup);

// J (s phi) = sum over corners of uv (along_s, along_t)', with the derivatives of the corners' hat functions along the scaled
// frame.
struct FaceFrame {
  std::array<double, 3> along_s;
  std::array<double, 3> along_t;
};

FaceFrame face_frame(const MapSetup& setup, int f);

// Half of equation (4), but for a constant.
// `plan`: of the elimination of the reals, made at the same time as their values where it is empty; or none.
MixedIntegerProblem map_problem(const MapSetup& setup, const MapLayout& layout, int component, EliminationPlan* plan = nullptr,
                                int threads = 1);

}  // namespace inkgrid
