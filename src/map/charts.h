// What:   one chart a component: combed frames, period jumps, singular vertices, cut graph.
// Source: section 4.
// Cost:   linear in the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "field/frame_field.h"

namespace inkgrid {

// Convention: across halfedge h from face f into face g, (u, v)_g = i^turns[h] (u, v)_f + shift, so the frames obey
// s_g ~ i^-turns[h] s_f.  turns[twin] = -turns[h] mod 4; 0 everywhere but on cuts.
struct Charts {
  std::vector<Vec2> s;                 // per face: unit direction along which u grows
  std::vector<Vec2> t;                 // per face: unit direction along which v grows; cross(s, t) > 0
  std::vector<std::uint8_t> turns;     // per halfedge: period jump, 0..3
  std::vector<std::uint8_t> cut;       // per halfedge: 1 on the cut graph (both halfedges of the edge), never on the boundary
  std::vector<std::uint8_t> singular;  // per vertex: quarter turns mod 4 around an interior vertex; 0 regular and on the boundary
  int singularities = 0;
};

struct Known;

// Frames and cuts that are known stay; the combing starts from them.  The same for any number of threads.
Charts comb_charts(const BandMesh& mesh, const FrameField& field, const Known* known = nullptr, int threads = 1);

}  // namespace inkgrid
