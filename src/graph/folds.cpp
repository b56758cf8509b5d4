#include "graph/folds.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/at.h"

namespace inkgrid {
namespace {

struct Fold {
  int first = -1;  // the two nodes
  int second = -1;
  std::array<int, 2> first_ports;  // of the u and of the v isoline between them
  std::array<int, 2> second_ports;
};

constexpr int opposite(int port) {
  return (port + 2) & 3;
}

void reverse(GraphEdge& e) {
  std::swap(e.from, e.to);
  std::swap(e.from_port, e.to_port);
  std::reverse(e.path.begin(), e.path.end());
  std::reverse(e.faces.begin(), e.faces.end());
  std::reverse(e.family.begin(), e.family.end());
}

void append(GraphEdge& e, const GraphEdge& rest) {
  e.path.insert(e.path.end(), rest.path.begin() + 1, rest.path.end());
  e.faces.insert(e.faces.end(), rest.faces.begin(), rest.faces.end());
  e.family.insert(e.family.end(), rest.family.begin(), rest.family.end());
  e.to = rest.to;
  e.to_port = rest.to_port;
}

class Unfolder {
 public:
  Unfolder(IsolineGraph graph, const BandMesh& mesh, const ExactMap& map);
  IsolineGraph run();

 private:
  IsolineGraph graph_;
  const BandMesh& mesh_;
  const ExactMap& map_;
  std::vector<std::array<int, 4>> edge_at_port_;  // per node
  std::vector<std::uint8_t> removed_node_;
  std::vector<std::uint8_t> removed_edge_;

  void note_ports(int edge);
  GraphEdge& leave(int node, int port);
  Transition transport(const GraphEdge& edge) const;
  std::optional<Fold> fold_at(int node);
  int merge(int first, int first_port, int second, int second_port);
  void remove(const Fold& fold, std::vector<int>& pending);
  void drop_removed();
};

Unfolder::Unfolder(IsolineGraph graph, const BandMesh& mesh, const ExactMap& map)
    : graph_(std::move(graph)),
      mesh_(mesh),
      map_(map),
      edge_at_port_(graph_.nodes.size(), {-1, -1, -1, -1}),
      removed_node_(graph_.nodes.size(), 0),
      removed_edge_(graph_.edges.size(), 0) {
  for (int e = 0; e < static_cast<int>(graph_.edges.size()); ++e) note_ports(e);
}

void Unfolder::note_ports(int edge) {
  const GraphEdge& e = graph_.edges[at(edge)];
  if (e.from_port >= 0) edge_at_port_[at(e.from)][at(e.from_port)] = edge;
  if (e.to_port >= 0) edge_at_port_[at(e.to)][at(e.to_port)] = edge;
}

// The edge at a port of a grid node, turned so that it starts there.
GraphEdge& Unfolder::leave(int node, int port) {
  GraphEdge& e = graph_.edges[at(edge_at_port_[at(node)][at(port)])];
  if (e.from != node || e.from_port != port) reverse(e);
  return e;
}

// From the chart of the edge's first face to that of its last.
Transition Unfolder::transport(const GraphEdge& edge) const {
  Transition total;
  for (std::size_t i = 1; i < edge.faces.size(); ++i) {
    if (edge.faces[i] == edge.faces[i - 1]) continue;
    int h = 3 * edge.faces[i - 1];
    while (mesh_.twins[at(h)] < 0 || face_of(mesh_.twins[at(h)]) != edge.faces[i]) ++h;
    const Transition& t = map_.transitions[at(h)];
    total = {(total.turn + t.turn) & 3, turned(total.shift, t.turn) + t.shift};
  }
  return total;
}

// Two edges between the same nodes, one of each family, that go through the same charts: both nodes are one grid point there, and
// as no grid point lies between, both edges turn back.  Where the charts differ, a singular vertex or a hole lies between the
// edges and the isolines do cross twice.
std::optional<Fold> Unfolder::fold_at(int node) {
  for (const int u_port : {1, 3}) {
    for (const int v_port : {0, 2}) {
      const GraphEdge& u = leave(node, u_port);
      const GraphEdge& v = leave(node, v_port);
      const bool between_two_grid_nodes = u.to == v.to && u.to != node && u.to_port >= 0;
      if (!between_two_grid_nodes || !(transport(u) == transport(v))) continue;
      return Fold{node, u.to, {u_port, v_port}, {u.to_port, v.to_port}};
    }
  }
  return std::nullopt;
}

// What comes before `first`, the edge from `first` to `second` and what goes on after it become one edge.
int Unfolder::merge(int first, int first_port, int second, int second_port) {
  const int before = edge_at_port_[at(first)][at(opposite(first_port))];
  const int between = edge_at_port_[at(first)][at(first_port)];
  const int after = edge_at_port_[at(second)][at(opposite(second_port))];
  GraphEdge merged;
  if (before == after) {
    merged = leave(first, first_port);
    append(merged, leave(second, opposite(second_port)));
    merged.from = merged.to = merged.from_port = merged.to_port = -1;
  } else {
    merged = leave(first, opposite(first_port));
    reverse(merged);
    append(merged, leave(first, first_port));
    append(merged, leave(second, opposite(second_port)));
  }
  graph_.edges[at(between)] = std::move(merged);
  removed_edge_[at(before)] = removed_edge_[at(after)] = 1;
  note_ports(between);
  return between;
}

void Unfolder::remove(const Fold& fold, std::vector<int>& pending) {
  for (int i = 0; i < 2; ++i) {
    const GraphEdge& merged = graph_.edges[at(merge(fold.first, fold.first_ports[at(i)], fold.second, fold.second_ports[at(i)]))];
    if (merged.from_port >= 0 && merged.to_port >= 0) pending.push_back(merged.from);  // a new fold would be between these two
  }
  removed_node_[at(fold.first)] = removed_node_[at(fold.second)] = 1;
}

void Unfolder::drop_removed() {
  std::vector<int> number(graph_.nodes.size(), -1);
  IsolineGraph kept;
  for (int n = 0; n < static_cast<int>(number.size()); ++n) {
    if (removed_node_[at(n)]) continue;
    number[at(n)] = static_cast<int>(kept.nodes.size());
    kept.nodes.push_back(graph_.nodes[at(n)]);
  }
  for (int i = 0; i < static_cast<int>(removed_edge_.size()); ++i) {
    if (removed_edge_[at(i)]) continue;
    GraphEdge& e = graph_.edges[at(i)];
    if (e.from >= 0) e.from = number[at(e.from)];
    if (e.to >= 0) e.to = number[at(e.to)];
    kept.edges.push_back(std::move(e));
  }
  graph_ = std::move(kept);
}

IsolineGraph Unfolder::run() {
  std::vector<int> pending;
  for (int n = static_cast<int>(graph_.nodes.size()) - 1; n >= 0; --n) {
    if (graph_.nodes[at(n)].kind == NodeKind::grid) pending.push_back(n);
  }
  while (!pending.empty()) {
    const int node = pending.back();
    pending.pop_back();
    if (removed_node_[at(node)]) continue;
    if (const auto fold = fold_at(node)) remove(*fold, pending);
  }
  drop_removed();
  return std::move(graph_);
}

}  // namespace

IsolineGraph remove_folds(IsolineGraph graph, const BandMesh& mesh, const ExactMap& map) {
  return Unfolder(std::move(graph), mesh, map).run();
}

}  // namespace inkgrid
