// What:   the integer isolines of the map, as a graph on the drawing: nodes where they cross, edges between.
// Source: section 6.3, "Topological graph"; Ebke et al. as told in section 4.
// Differs: marching through triangles with integer predicates; isolines are also followed to the boundary of the band
//          (docs/METHOD.md, "Isolines").
// Cost:   linear in the number of triangles an isoline crosses.
#pragma once

#include <cstdint>
#include <vector>

#include "map/exact_map.h"

namespace inkgrid {

enum class NodeKind : std::uint8_t {
  grid,      // u and v are integers
  singular,  // on a singular vertex of the field, wherever it sits on the grid
  boundary,  // an isoline leaves the band here
};

struct GraphNode {
  Vec2 position;  // px
  NodeKind kind = NodeKind::grid;
  int face = -1;  // that holds it
};

// A piece of one isoline between two nodes, or a whole closed isoline without nodes (from == to == -1).
struct GraphEdge {
  int from = -1;
  int to = -1;
  // At a grid node: 0 leaves along +u, 1 along +v, 2 along -u, 3 along -v, in the chart of the node's face, so p and (p + 2) % 4
  // are one isoline that goes straight on.  At other nodes: -1.
  int from_port = -1;
  int to_port = -1;
  std::vector<Vec2> path;            // from `from` to `to`, one point an edge crossed; path.size() == faces.size() + 1
  std::vector<int> faces;            // the triangle that path[i] -> path[i + 1] crosses
  std::vector<std::uint8_t> family;  // per face: 0 where u is constant along the edge (in that face's chart), 1 where v is
};

struct IsolineGraph {
  std::vector<GraphNode> nodes;
  std::vector<GraphEdge> edges;
};

// All isolines of both families, also through folds of the map, where they cross several times (remove_folds).  `skipped`:
// components of the mesh to leave out (their map means nothing).
IsolineGraph trace_isolines(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components);

}  // namespace inkgrid
