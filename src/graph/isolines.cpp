#include "graph/isolines.h"

#include <utility>

#include "base/at.h"
#include "graph/arrangement.h"

namespace inkgrid {
namespace {

// A place between two nodes on a segment and a direction along it: +1 towards ends[1], -1 towards ends[0].
struct Cursor {
  int segment = 0;
  int piece = 0;  // 0 .. node_count
  int direction = 1;
};

class Tracer {
 public:
  explicit Tracer(const Arrangement& arrangement) : arrangement_(arrangement) {
    traced_.resize(arrangement.segments.size() + arrangement.segment_nodes.size(), 0);
  }

  std::vector<GraphEdge> trace();

 private:
  const Arrangement& arrangement_;
  std::vector<std::uint8_t> traced_;  // per piece, segment by segment

  const IsolineSegment& segment(Cursor c) const { return arrangement_.segments[at(c.segment)]; }
  // Each segment has one piece more than it has nodes.
  int piece_index(Cursor c) const { return segment(c).first_node + c.segment + c.piece; }
  int node(Cursor c) const;
  int port(Cursor c, int node) const;
  const SegmentEnd& end(Cursor c) const { return segment(c).ends[c.direction > 0 ? 1 : 0]; }
  Vec2 crossing_point(Cursor c) const { return arrangement_.crossings[at(end(c).crossing)].position; }
  Cursor next(Cursor c) const;
  GraphEdge follow(Cursor start);
  void trace_pieces(bool closed, std::vector<GraphEdge>& edges);
};

constexpr Cursor reversed(Cursor c) {
  return {c.segment, c.piece, -c.direction};
}

// The node in which the piece ends in the direction of the cursor, or -1 where the isoline goes on into the next triangle.
int Tracer::node(Cursor c) const {
  const IsolineSegment& s = segment(c);
  const int i = c.direction > 0 ? c.piece : c.piece - 1;
  return i < 0 || i == s.node_count ? end(c).node : arrangement_.segment_nodes[at(s.first_node + i)];
}

// Of the node in which the piece ends: the direction from the node back into the piece.
int Tracer::port(Cursor c, int node) const {
  if (arrangement_.nodes[at(node)].kind != NodeKind::grid) return -1;
  const bool grows_backwards = segment(c).step * c.direction < 0;
  return (segment(c).isoline.family == 0 ? 1 : 0) + (grows_backwards ? 0 : 2);
}

Cursor Tracer::next(Cursor c) const {
  const int entered = arrangement_.twins[at(end(c).halfedge)];
  const int next_segment = arrangement_.crossings[at(end(c).crossing)].segments[arrangement_.owns_edge(entered) ? 0 : 1];
  const IsolineSegment& s = arrangement_.segments[at(next_segment)];
  return s.ends[0].halfedge == entered ? Cursor{next_segment, 0, 1} : Cursor{next_segment, s.node_count, -1};
}

GraphEdge Tracer::follow(Cursor start) {
  GraphEdge edge;
  edge.from = node(reversed(start));
  edge.from_port = edge.from < 0 ? -1 : port(reversed(start), edge.from);
  edge.path = {edge.from < 0 ? crossing_point(reversed(start)) : arrangement_.nodes[at(edge.from)].position};
  for (Cursor c = start; !traced_[at(piece_index(c))]; c = next(c)) {
    traced_[at(piece_index(c))] = 1;
    edge.faces.push_back(segment(c).face);
    edge.family.push_back(static_cast<std::uint8_t>(segment(c).isoline.family));
    edge.to = node(c);
    edge.path.push_back(edge.to < 0 ? crossing_point(c) : arrangement_.nodes[at(edge.to)].position);
    if (edge.to < 0) continue;
    edge.to_port = port(c, edge.to);
    break;
  }
  return edge;
}

void Tracer::trace_pieces(bool closed, std::vector<GraphEdge>& edges) {
  for (int s = 0; s < static_cast<int>(arrangement_.segments.size()); ++s) {
    for (int piece = 0; piece <= arrangement_.segments[at(s)].node_count; ++piece) {
      const Cursor forward{s, piece, 1};
      if (traced_[at(piece_index(forward))]) continue;
      if (closed || node(reversed(forward)) >= 0) {
        edges.push_back(follow(forward));
      } else if (node(forward) >= 0) {
        edges.push_back(follow(reversed(forward)));
      }
    }
  }
}

// What is left when every node has been left through all its ports is closed.
std::vector<GraphEdge> Tracer::trace() {
  std::vector<GraphEdge> edges;
  trace_pieces(false, edges);
  trace_pieces(true, edges);
  return edges;
}

}  // namespace

IsolineGraph trace_isolines(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components) {
  Arrangement arrangement = arrange_isolines(mesh, map, skipped_components);
  std::vector<GraphEdge> edges = Tracer(arrangement).trace();
  return {std::move(arrangement.nodes), std::move(edges)};
}

}  // namespace inkgrid
