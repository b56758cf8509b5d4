// What:   evenly spread streamlines of the frame field, for a picture of it.
// Source: section 6.1 (the figures show the field this way).
// Differs: a streamline is straight within a triangle.
// Cost:   linear in the number of triangles that streamlines cross.
#pragma once

#include <vector>

#include "map/charts.h"

namespace inkgrid {

struct Streamline {
  std::vector<Vec2> points;  // px
  bool along_s = true;       // in the chart of the triangle where it was started
};

struct StreamlineOptions {
  double length = 1;   // px, at most, to each side of its start
  double spacing = 1;  // px, about, between lines of one direction
};

// Every triangle without a line of a direction nearby starts one, in order of the triangles.
std::vector<Streamline> spread_streamlines(const BandMesh& mesh, const Charts& charts, const StreamlineOptions& options);

}  // namespace inkgrid
