// What:   chains to cubic Bezier curves.
// Source: section 6.3, "Curve fitting".
// Differs: docs/METHOD.md, "Curve fitting".
// Cost:   linear in the number of points times the number of tries; curves are fitted on several threads.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "graph/chains.h"
#include "inkgrid/drawing.h"

namespace inkgrid {

struct FitOptions {
  double tolerance = 1;    // px: no point of a chain of the usual width is further from its curve
  double corner_span = 6;  // px: a turn completed within this length is a corner, not a bend (about a stroke width)
  int threads = 0;         // 0: as many as the machine has
  double usual_width = 0;  // px: for chains wider than that the tolerance grows, up to four times; 0: it is the same for all

  friend bool operator==(const FitOptions&, const FitOptions&) = default;
};

// How far it is from a point to the nearest paper, px; empty: nothing is known of the ink.
using InkDepth = std::function<double(Vec2)>;

// Few cubic segments within the tolerance, but for points that cut a corner (they are left out, and the corner is where its sides
// meet). Segments are weighed against squared error, so that joints fall where lines turn into arcs.  The end points are
// interpolated to the last digit; segments share their joints to the last digit; joints that are not corners are smooth (G1,
// tangents equal to 1e-9); a closed polyline (front == back) gives a closed curve, smooth at its seam unless the seam is a corner
// (a closed curve's seam is moved to a corner if it has one).  A turn whose sides meet where the ink does not reach as far as
// that of a corner is an arc.
std::vector<Cubic> fit_polyline(std::span<const Vec2> points, bool closed, const FitOptions& options, const InkDepth& depth = {});

// `before`: curves fitted with the same options to the same ink; those whose chain is there again, as wide, are taken as they
// are. `depth` is asked on several threads.
Drawing fit_curves(const Chains& chains, const FitOptions& options, const InkDepth& depth = {},
                   const std::vector<Curve>& before = {});

}  // namespace inkgrid
