// What:   what an earlier solution says about a mesh of which a part has changed.
// Source: section 7, "freeze the already-computed parametric coordinates in triangles outside of regions affected by the mask".
// Differs: frames and labels are kept with the coordinates.
// Cost:   linear in the mesh.
#pragma once

#include <functional>

#include "map/grid_map.h"

namespace inkgrid {

// In the numbering of the changed mesh; values mean something in faces that are known.
struct Known {
  std::vector<std::uint8_t> faces;  // per face: 1 where the earlier solution holds
  std::vector<Vec2> s, t;           // per face: as Charts
  std::vector<std::uint8_t> uncut;  // per halfedge: 1 where both faces are known and the edge was no cut between them
  std::vector<Label> labels;        // per face
  std::vector<Vec2> uv;             // per corner, in the face's chart: s and t
  std::vector<int> corners;         // per corner: that of the earlier mesh, -1 where the face is not known
};

// A solution on a mesh.
struct Solution {
  const BandMesh& mesh;
  const Charts& charts;
  const std::vector<Label>& labels;
  const GridMap& map;
};

// What is known of the faces that are faces of `before` too, where `holds` is true of their barycentre.  The meshes have one
// lattice, or that of `mesh` is finer by a power of two.
Known known_from(const Solution& before, const BandMesh& mesh, const std::function<bool(Vec2)>& holds);

}  // namespace inkgrid
