// What:   the integer isolines inside every triangle, linked across its edges: what trace_isolines walks along.
// Source: section 6.3, "Topological graph"; section 4, last paragraph.
// Differs: triangles are cut one by one with integer predicates (docs/METHOD.md, "Isolines").
// Cost:   linear in the number of triangles and of the isolines in them.
#pragma once

#include <array>
#include <vector>

#include "base/at.h"
#include "graph/isolines.h"

namespace inkgrid {

// The isoline u = value (family 0) or v = value (family 1) of one chart.
struct Isoline {
  int family = 0;
  std::int64_t value = 0;  // grid units
};

// One end of a segment: on a crossed halfedge, or in a node, or (where that edge is on the boundary) both.
struct SegmentEnd {
  int halfedge = -1;
  int crossing = -1;  // shared with the segment on the other side
  int node = -1;      // where the isoline ends here: singular or boundary
  // The largest grid coordinates at or below the end and strictly below it, along the isoline.  They differ only at a singular
  // corner on a grid point, which is no grid node of its isolines.
  std::int64_t at_or_below = 0;
  std::int64_t below = 0;
};

// An isoline inside one triangle, from ends[0] to ends[1].
struct IsolineSegment {
  int face = -1;
  Isoline isoline;
  std::array<SegmentEnd, 2> ends;
  std::int64_t first_grid = 0;  // first_grid .. last_grid: coordinates along the isoline of the grid points on the segment
  std::int64_t last_grid = -1;
  int step = 1;        // +1 where that coordinate grows from ends[0] to ends[1], else -1
  int first_node = 0;  // its grid nodes from ends[0] to ends[1]: segment_nodes[first_node], ...
  int node_count = 0;
};

struct Crossing {
  Vec2 position;                        // px
  std::array<int, 2> segments{-1, -1};  // in the faces of the edge's smaller and larger halfedge
};

struct Arrangement {
  std::vector<GraphNode> nodes;          // by face
  std::vector<IsolineSegment> segments;  // by face
  std::vector<int> segment_nodes;
  std::vector<Crossing> crossings;
  std::vector<int> twins;  // per halfedge; -1 also where the neighbour is left out

  // The halfedge that numbers the crossings of its edge; it has side 0 of them.
  bool owns_edge(int halfedge) const {
    const int twin = twins[at(halfedge)];
    return twin < 0 || halfedge < twin;
  }
};

// Skipped components and triangles of absurd width are left out as if the band had a hole there.  Throws Error{numerics} where a
// transition does not hold.
Arrangement arrange_isolines(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components);

}  // namespace inkgrid
