// What:   the integer-grid map: (u, v) at every corner, whose integer isolines follow the frames and lie on the strokes.
// Source: section 6.2, equations (1) to (4); section 4 for the transition functions.
// Differs: docs/METHOD.md, "Grid map".
// Cost:   one sparse factorisation and solve; the integers are its trailing block.
#pragma once

#include <array>
#include <vector>

#include "base/at.h"
#include "base/transition.h"
#include "inkgrid/options.h"
#include "map/labels.h"
#include "numerics/pair_ldl.h"

namespace inkgrid {

struct GridMapOptions {
  double spacing = 1;                                    // lambda, strokes
  double snap = Options{}.snap;                          // mu
  double snap_sigma = Options{}.snap_sigma;              // sigma
  double damping = Options{}.damping;                    // epsilon
  double merge_difference = Options{}.merge_difference;  // grid units, of the local estimates
  int threads = 0;                                       // 0: as many as the machine has
};

// A corner is 3 f + k, the corner of face f at faces[f][k]; it belongs to halfedge 3 f + k, which starts there.
// Each corner is  uv = i^corner_turn * base[corner_base] + corner_shift  (all of these hold the transitions by construction).
struct GridMap {
  std::vector<Vec2> base;        // real coordinates, one for each vertex of the mesh
  std::vector<int> corner_base;  // per corner: index into base (the vertex of the corner)
  std::vector<std::uint8_t> corner_turn;
  std::vector<IVec2> corner_shift;         // grid units
  std::vector<Transition> transitions;     // per halfedge, towards the twin's face; identity off the cuts and on the boundary
  std::vector<std::uint8_t> half_integer;  // per vertex: 1 where the base is exactly a multiple of 1/2 (singular vertices)
  int cut_integers = 0;
  int snapping_integers = 0;
  int cuts = 0;                        // cut paths
  double alignment_energy = 0;         // equation (2)
  double snapping_energy = 0;          // equation (3), without mu
  std::vector<int> failed_components;  // of the mesh: their solve failed, their coordinates mean nothing
  std::vector<EliminationPlan> plans;  // per component

  Vec2 uv(int corner) const {
    const auto c = static_cast<std::size_t>(corner);
    const Vec2 shift{static_cast<double>(corner_shift[c].x), static_cast<double>(corner_shift[c].y)};
    return turned(base[at(corner_base[c])], corner_turn[c]) + shift;
  }
};

struct Known;

// Vertices of which all faces are known keep their coordinates to the last digit.  `plans`: those of an earlier map with the same
// charts and nothing known, or none.
GridMap solve_grid_map(const BandMesh& mesh, const Charts& charts, const std::vector<Label>& labels, const Ink& ink,
                       const GridMapOptions& options, const Control& control, const Known* known = nullptr,
                       std::vector<EliminationPlan> plans = {});

}  // namespace inkgrid
