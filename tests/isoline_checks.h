// What holds of every isoline graph, and comparison of graphs free of numbering and charts.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "base/at.h"
#include "graph/isolines.h"
#include "mapped_meshes.h"

namespace inkgrid {

inline IsolineGraph traced(const Mapped& m) {
  return trace_isolines(m.mesh, round_map(m.map), {});
}

inline int count(const IsolineGraph& graph, NodeKind kind) {
  return static_cast<int>(
      std::count_if(graph.nodes.begin(), graph.nodes.end(), [&](const GraphNode& n) { return n.kind == kind; }));
}

inline int closed_edges(const IsolineGraph& graph) {
  return static_cast<int>(std::count_if(graph.edges.begin(), graph.edges.end(), [](const GraphEdge& e) { return e.from < 0; }));
}

inline std::vector<int> edge_ends(const IsolineGraph& graph) {
  std::vector<int> ends(graph.nodes.size(), 0);
  for (const GraphEdge& e : graph.edges) {
    if (e.from < 0) continue;
    ++ends[at(e.from)];
    ++ends[at(e.to)];
  }
  return ends;
}

inline bool inside(const BandMesh& mesh, int face, Vec2 p) {
  for (int k = 0; k < 3; ++k) {
    const Vec2 a = mesh.points[at(mesh.faces[at(face)][at(k)])];
    const Vec2 b = mesh.points[at(mesh.faces[at(face)][at((k + 1) % 3)])];
    if (cross(b - a, p - a) < -1e-9) return false;
  }
  return true;
}

inline bool adjacent(const BandMesh& mesh, int f, int g) {
  for (int k = 0; k < 3; ++k) {
    const int other = mesh.twins[at(3 * f + k)];
    if (other >= 0 && other / 3 == g) return true;
  }
  return false;
}

inline void expect_valid_edge(const BandMesh& mesh, const IsolineGraph& graph, const GraphEdge& e) {
  ASSERT_FALSE(e.faces.empty());
  ASSERT_EQ(e.path.size(), e.faces.size() + 1);
  ASSERT_EQ(e.family.size(), e.faces.size());
  ASSERT_EQ(e.from < 0, e.to < 0);
  if (e.from < 0) {
    EXPECT_EQ(e.path.front(), e.path.back());
  } else {
    EXPECT_EQ(e.path.front(), graph.nodes[at(e.from)].position);
    EXPECT_EQ(e.path.back(), graph.nodes[at(e.to)].position);
    EXPECT_EQ(e.from_port >= 0, graph.nodes[at(e.from)].kind == NodeKind::grid);
    EXPECT_EQ(e.to_port >= 0, graph.nodes[at(e.to)].kind == NodeKind::grid);
  }
  for (std::size_t i = 0; i < e.faces.size(); ++i) {
    ASSERT_TRUE(std::isfinite(e.path[i].x) && std::isfinite(e.path[i].y));
    EXPECT_TRUE(inside(mesh, e.faces[i], e.path[i]) && inside(mesh, e.faces[i], e.path[i + 1]));
    if (i > 0) {
      EXPECT_TRUE(e.faces[i - 1] == e.faces[i] || adjacent(mesh, e.faces[i - 1], e.faces[i]));
    }
  }
}

// What holds of every graph, also of folded maps.
inline void expect_valid(const BandMesh& mesh, const IsolineGraph& graph) {
  std::vector<std::array<int, 4>> ports(graph.nodes.size(), {0, 0, 0, 0});
  for (const GraphEdge& e : graph.edges) {
    expect_valid_edge(mesh, graph, e);
    if (e.from_port >= 0) ++ports[at(e.from)][at(e.from_port)];
    if (e.to_port >= 0) ++ports[at(e.to)][at(e.to_port)];
  }
  const std::vector<int> ends = edge_ends(graph);
  for (int n = 0; n < static_cast<int>(graph.nodes.size()); ++n) {
    const GraphNode& node = graph.nodes[at(n)];
    EXPECT_TRUE(inside(mesh, node.face, node.position));
    if (node.kind == NodeKind::grid) {
      EXPECT_EQ(ports[at(n)], (std::array<int, 4>{1, 1, 1, 1}));
    }
    if (node.kind == NodeKind::boundary) {
      EXPECT_EQ(ends[at(n)], 1);
    }
  }
}

// A graph without the numbering of its nodes and edges, the direction of its edges and, with the charts given, free of the
// charts.
using Place = std::pair<double, double>;
using FlatEdge = std::tuple<std::vector<Place>, std::vector<int>, std::vector<int>, int, int>;

inline FlatEdge flattened(const GraphEdge& e, const IsolineGraph& graph, const std::vector<Transition>& charts) {
  auto port = [&](int node, int p) { return p < 0 ? p : (p - charts[at(graph.nodes[at(node)].face)].turn + 4) % 4; };
  std::vector<Place> path;
  std::vector<int> family;
  for (const Vec2 p : e.path) path.push_back({p.x, p.y});
  for (std::size_t i = 0; i < e.faces.size(); ++i) family.push_back(e.family[i] ^ (charts[at(e.faces[i])].turn & 1));
  FlatEdge forward{path, e.faces, family, port(e.from, e.from_port), port(e.to, e.to_port)};
  FlatEdge backward{{path.rbegin(), path.rend()},
                    {e.faces.rbegin(), e.faces.rend()},
                    {family.rbegin(), family.rend()},
                    std::get<4>(forward),
                    std::get<3>(forward)};
  return std::min(forward, backward);
}

inline FlatEdge flattened_closed(GraphEdge e, const IsolineGraph& graph, const std::vector<Transition>& charts) {
  FlatEdge least = flattened(e, graph, charts);
  for (std::size_t i = 1; i < e.faces.size(); ++i) {
    e.path.erase(e.path.begin());
    e.path.push_back(e.path.front());
    std::rotate(e.faces.begin(), e.faces.begin() + 1, e.faces.end());
    std::rotate(e.family.begin(), e.family.begin() + 1, e.family.end());
    least = std::min(least, flattened(e, graph, charts));
  }
  return least;
}

inline std::multiset<FlatEdge> flat_edges(const IsolineGraph& graph, const std::vector<Transition>& charts) {
  std::multiset<FlatEdge> flat;
  for (const GraphEdge& e : graph.edges)
    flat.insert(e.from < 0 ? flattened_closed(e, graph, charts) : flattened(e, graph, charts));
  return flat;
}

inline std::multiset<std::tuple<NodeKind, int, double, double>> flat_nodes(const IsolineGraph& graph) {
  std::multiset<std::tuple<NodeKind, int, double, double>> flat;
  for (const GraphNode& n : graph.nodes) flat.insert({n.kind, n.face, n.position.x, n.position.y});
  return flat;
}

inline void expect_chart_invariant(const Mapped& m, unsigned seed) {
  const std::vector<Transition> charts = random_charts(m.mesh.face_count(), seed);
  const IsolineGraph graph = traced(m);
  const IsolineGraph other = trace_isolines(m.mesh, round_map(recharted(m, charts)), {});
  EXPECT_EQ(flat_nodes(graph), flat_nodes(other));
  EXPECT_EQ(flat_edges(graph, std::vector<Transition>(charts.size())), flat_edges(other, charts));
}

inline void expect_grid_counts(const IsolineGraph& graph, int u_lines, int v_lines) {
  EXPECT_EQ(count(graph, NodeKind::grid), u_lines * v_lines);
  EXPECT_EQ(count(graph, NodeKind::boundary), 2 * (u_lines + v_lines));
  EXPECT_EQ(static_cast<int>(graph.edges.size()), u_lines * (v_lines + 1) + v_lines * (u_lines + 1));
}

}  // namespace inkgrid
