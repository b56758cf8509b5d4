// What:   the grid map in fixed point: transitions hold with ==, and every question about an isoline is integer arithmetic.
// Source: section 4, last paragraph (what Ebke et al. reach with exact predicates on floating-point numbers).
// Differs: fixed point instead of sanitised floating point (docs/METHOD.md, "Exact map").
// Cost:   linear.
#pragma once

#include <vector>

#include "map/grid_map.h"

namespace inkgrid {

constexpr int kFixedBits = 20;
constexpr std::int64_t kFixedOne = std::int64_t{1} << kFixedBits;  // one grid unit

struct ExactMap {
  std::vector<IVec2> uv;                // per corner, in units of 2^-20 grid units
  std::vector<Transition> transitions;  // per halfedge; shifts in grid units
};

// Coordinates of a regular vertex never are whole grid units: they are moved by one unit of the last place where they would be,
// the same way in every chart, so an isoline passes through no regular vertex.
ExactMap round_map(const GridMap& map, int threads = 1);
ExactMap round_map(GridMap&& map);

}  // namespace inkgrid
