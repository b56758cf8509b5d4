// The exact map and the isolines on hand-made meshes: analytic counts and positions, brute force on folded maps, random
// re-charting.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "base/union_find.h"
#include "inkgrid/inkgrid.h"
#include "isolines.h"

namespace inkgrid {
namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

struct Mapped {
  BandMesh mesh;
  GridMap map;
};

void link(BandMesh& mesh) {
  std::map<std::pair<int, int>, int> halfedges;
  const int count = 3 * mesh.face_count();
  auto ends = [&](int h) { return std::pair{mesh.faces[idx(h / 3)][idx(h % 3)], mesh.faces[idx(h / 3)][idx((h + 1) % 3)]}; };
  for (int h = 0; h < count; ++h) halfedges[ends(h)] = h;
  mesh.twins.assign(idx(count), -1);
  UnionFind sets(mesh.face_count());
  for (int h = 0; h < count; ++h) {
    const auto [a, b] = ends(h);
    if (const auto found = halfedges.find({b, a}); found != halfedges.end()) {
      mesh.twins[idx(h)] = found->second;
      sets.unite(h / 3, found->second / 3);
    }
  }
  mesh.component.resize(mesh.faces.size());
  for (int f = 0; f < mesh.face_count(); ++f) {
    mesh.component[idx(f)] = sets.find(f) == f ? mesh.components++ : mesh.component[idx(sets.find(f))];
  }
  mesh.scale.assign(mesh.faces.size(), 1.0F);
  mesh.on_ink.assign(mesh.faces.size(), 0);
}

// One chart: all corners are their vertex's base.
Mapped with_one_chart(BandMesh mesh, const std::function<Vec2(Vec2)>& uv) {
  GridMap map;
  for (const Vec2 p : mesh.points) map.base.push_back(uv(p));
  for (const auto& face : mesh.faces) map.corner_base.insert(map.corner_base.end(), face.begin(), face.end());
  map.corner_turn.assign(map.corner_base.size(), 0);
  map.corner_shift.assign(map.corner_base.size(), {});
  map.transitions.assign(map.corner_base.size(), {});
  map.half_integer.assign(map.base.size(), 0);
  return {std::move(mesh), std::move(map)};
}

// columns x rows cells of size step from the origin, each cut into two triangles by alternating diagonals; numbered in random
// order where seed > 0, so that the canonical directions of edges are mixed.
BandMesh lattice(int columns, int rows, double step, unsigned seed = 0) {
  BandMesh mesh;
  std::vector<int> number(idx((columns + 1) * (rows + 1)));
  std::iota(number.begin(), number.end(), 0);
  if (seed > 0) std::shuffle(number.begin(), number.end(), std::mt19937(seed));
  mesh.points.resize(number.size());
  auto vertex = [&](int i, int j) { return number[idx(j * (columns + 1) + i)]; };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) mesh.points[idx(vertex(i, j))] = {i * step, j * step};
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.faces.insert(mesh.faces.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  link(mesh);
  return mesh;
}

Transition composed(const Transition& second, const Transition& first) {
  return {(first.turn + second.turn) & 3, turned(first.shift, second.turn) + second.shift};
}

// `quadrants` square patches of the grid around one vertex whose coordinates are `apex`.  Each chart holds `per_chart` quadrants
// (1, or 2 for an apex with only one integer coordinate).
Mapped cone(int quadrants, int per_chart, Vec2 apex, int cells, double step) {
  BandMesh mesh;
  GridMap map;
  // Grid points of quadrant q that are not on its side v = 0 belong to it; that side belongs to quadrant q - 1, the apex to all.
  auto vertex = [&](int q, int i, int j) {
    if (i == 0 && j == 0) return 0;
    if (j == 0) return 1 + ((q + quadrants - 1) % quadrants) * cells * (cells + 1) + (i - 1) * (cells + 1);
    return 1 + q * cells * (cells + 1) + (j - 1) * (cells + 1) + i;
  };
  mesh.points.resize(idx(1 + quadrants * cells * (cells + 1)));
  map.base.resize(mesh.points.size());
  map.base[0] = apex;
  for (int q = 0; q < quadrants; ++q) {
    for (int j = 1; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i) {
        const Vec2 local{i * step, j * step};
        const double angle = 2 * std::numbers::pi / quadrants * (q + std::atan2(local.y, local.x) / (std::numbers::pi / 2));
        mesh.points[idx(vertex(q, i, j))] = norm(local) * Vec2{std::cos(angle), std::sin(angle)};
        map.base[idx(vertex(q, i, j))] = apex + turned(local, q % per_chart);
      }
    }
  }
  auto about_apex = [&](int turn) {
    const Vec2 shift = apex - turned(apex, turn);
    return Transition{turn & 3, {std::llround(shift.x), std::llround(shift.y)}};
  };
  auto seam = [&](int q) {
    return about_apex((q + 1) % quadrants % per_chart - q % per_chart - 1);
  };  // from quadrant q to the next
  auto previous = [&](int q) { return (q + quadrants - 1) % quadrants; };
  auto add_face = [&](int q, std::array<std::pair<int, int>, 3> corners) {
    std::array<int, 3> face{};
    for (int k = 0; k < 3; ++k) {
      const auto [i, j] = corners[idx(k)];
      const auto [i_next, j_next] = corners[idx((k + 1) % 3)];
      face[idx(k)] = vertex(q, i, j);
      const Transition t = j == 0 && i > 0 ? seam(previous(q)) : Transition{};
      map.corner_base.push_back(face[idx(k)]);
      map.corner_turn.push_back(static_cast<std::uint8_t>(t.turn));
      map.corner_shift.push_back(t.shift);
      const bool along_u = j == 0 && j_next == 0, along_v = i == 0 && i_next == 0;
      map.transitions.push_back(along_u ? inverse(seam(previous(q))) : along_v ? seam(q) : Transition{});
    }
    mesh.faces.push_back(face);
  };
  for (int q = 0; q < quadrants; ++q) {
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        add_face(q, {{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
        add_face(q, {{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
    }
  }
  link(mesh);
  map.half_integer.assign(map.base.size(), 0);
  map.half_integer[0] = 1;
  return {std::move(mesh), std::move(map)};
}

// A ring cut along angle 0; u grows with the radius, v by `turns` grid units around.
Mapped ring(int around, int cells, double u0, double step, int turns, const std::function<double(double)>& v_of_angle) {
  BandMesh mesh;
  GridMap map;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      mesh.points.push_back((2 + j * step) * Vec2{std::cos(angle), std::sin(angle)});
      map.base.push_back({u0 + j * step, v_of_angle(angle)});
    }
  }
  auto add_face = [&](std::array<std::pair<int, int>, 3> corners) {
    std::array<int, 3> face{};
    for (int k = 0; k < 3; ++k) {
      const auto [i, j] = corners[idx(k)];
      face[idx(k)] = j * around + i % around;
      map.corner_base.push_back(face[idx(k)]);
      map.corner_shift.push_back({0, i == around ? turns : 0});
    }
    mesh.faces.push_back(face);
  };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < around; ++i) {
      add_face({{{i, j}, {i, j + 1}, {i + 1, j + 1}}});
      add_face({{{i, j}, {i + 1, j + 1}, {i + 1, j}}});
    }
  }
  for (auto& face : mesh.faces)
    EXPECT_GT(cross(mesh.points[idx(face[1])] - mesh.points[idx(face[0])], mesh.points[idx(face[2])] - mesh.points[idx(face[0])]),
              0);
  link(mesh);
  map.corner_turn.assign(map.corner_base.size(), 0);
  map.half_integer.assign(map.base.size(), 0);
  map.transitions.resize(mesh.twins.size());
  for (int h = 0; h < static_cast<int>(mesh.twins.size()); ++h) {
    if (mesh.twins[idx(h)] < 0) continue;
    map.transitions[idx(h)].shift = map.corner_shift[idx(next_halfedge(mesh.twins[idx(h)]))] - map.corner_shift[idx(h)];
  }
  return {std::move(mesh), std::move(map)};
}

std::vector<Transition> random_charts(int faces, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Transition> charts(idx(faces));
  for (Transition& t : charts)
    t = {static_cast<int>(random() % 4), {static_cast<int>(random() % 41) - 20, static_cast<int>(random() % 41) - 20}};
  return charts;
}

// Each face in a chart of its own: its old chart followed by charts[face].
GridMap recharted(const Mapped& m, const std::vector<Transition>& charts) {
  GridMap map = m.map;
  for (int c = 0; c < static_cast<int>(map.corner_base.size()); ++c) {
    const Transition t = composed(charts[idx(c / 3)], {map.corner_turn[idx(c)], map.corner_shift[idx(c)]});
    map.corner_turn[idx(c)] = static_cast<std::uint8_t>(t.turn);
    map.corner_shift[idx(c)] = t.shift;
    const int other = m.mesh.twins[idx(c)];
    if (other >= 0)
      map.transitions[idx(c)] = composed(charts[idx(other / 3)], composed(map.transitions[idx(c)], inverse(charts[idx(c / 3)])));
  }
  return map;
}

IsolineGraph traced(const Mapped& m) {
  return trace_isolines(m.mesh, round_map(m.map), {});
}

int count(const IsolineGraph& graph, NodeKind kind) {
  return static_cast<int>(
      std::count_if(graph.nodes.begin(), graph.nodes.end(), [&](const GraphNode& n) { return n.kind == kind; }));
}

int closed_edges(const IsolineGraph& graph) {
  return static_cast<int>(std::count_if(graph.edges.begin(), graph.edges.end(), [](const GraphEdge& e) { return e.from < 0; }));
}

std::vector<int> edge_ends(const IsolineGraph& graph) {
  std::vector<int> ends(graph.nodes.size(), 0);
  for (const GraphEdge& e : graph.edges) {
    if (e.from < 0) continue;
    ++ends[idx(e.from)];
    ++ends[idx(e.to)];
  }
  return ends;
}

bool inside(const BandMesh& mesh, int face, Vec2 p) {
  for (int k = 0; k < 3; ++k) {
    const Vec2 a = mesh.points[idx(mesh.faces[idx(face)][idx(k)])];
    const Vec2 b = mesh.points[idx(mesh.faces[idx(face)][idx((k + 1) % 3)])];
    if (cross(b - a, p - a) < -1e-9) return false;
  }
  return true;
}

bool adjacent(const BandMesh& mesh, int f, int g) {
  for (int k = 0; k < 3; ++k) {
    const int other = mesh.twins[idx(3 * f + k)];
    if (other >= 0 && other / 3 == g) return true;
  }
  return false;
}

void expect_valid_edge(const BandMesh& mesh, const IsolineGraph& graph, const GraphEdge& e) {
  ASSERT_FALSE(e.faces.empty());
  ASSERT_EQ(e.path.size(), e.faces.size() + 1);
  ASSERT_EQ(e.family.size(), e.faces.size());
  ASSERT_EQ(e.from < 0, e.to < 0);
  if (e.from < 0) {
    EXPECT_EQ(e.path.front(), e.path.back());
  } else {
    EXPECT_EQ(e.path.front(), graph.nodes[idx(e.from)].position);
    EXPECT_EQ(e.path.back(), graph.nodes[idx(e.to)].position);
    EXPECT_EQ(e.from_port >= 0, graph.nodes[idx(e.from)].kind == NodeKind::grid);
    EXPECT_EQ(e.to_port >= 0, graph.nodes[idx(e.to)].kind == NodeKind::grid);
  }
  for (std::size_t i = 0; i < e.faces.size(); ++i) {
    ASSERT_TRUE(std::isfinite(e.path[i].x) && std::isfinite(e.path[i].y));
    EXPECT_TRUE(inside(mesh, e.faces[i], e.path[i]) && inside(mesh, e.faces[i], e.path[i + 1]));
    if (i > 0) {
      EXPECT_TRUE(adjacent(mesh, e.faces[i - 1], e.faces[i]));
    }
  }
}

// What holds of every graph, also of folded maps.
void expect_valid(const BandMesh& mesh, const IsolineGraph& graph) {
  std::vector<std::array<int, 4>> ports(graph.nodes.size(), {0, 0, 0, 0});
  for (const GraphEdge& e : graph.edges) {
    expect_valid_edge(mesh, graph, e);
    if (e.from_port >= 0) ++ports[idx(e.from)][idx(e.from_port)];
    if (e.to_port >= 0) ++ports[idx(e.to)][idx(e.to_port)];
  }
  const std::vector<int> ends = edge_ends(graph);
  for (int n = 0; n < static_cast<int>(graph.nodes.size()); ++n) {
    const GraphNode& node = graph.nodes[idx(n)];
    EXPECT_TRUE(inside(mesh, node.face, node.position));
    if (node.kind == NodeKind::grid) {
      EXPECT_EQ(ports[idx(n)], (std::array<int, 4>{1, 1, 1, 1}));
    }
    if (node.kind == NodeKind::boundary) {
      EXPECT_EQ(ends[idx(n)], 1);
    }
  }
}

// A graph without the numbering of its nodes and edges, the direction of its edges and, with the charts given, free of the
// charts.
using Place = std::pair<double, double>;
using FlatEdge = std::tuple<std::vector<Place>, std::vector<int>, std::vector<int>, int, int>;

FlatEdge flattened(const GraphEdge& e, const IsolineGraph& graph, const std::vector<Transition>& charts) {
  auto port = [&](int node, int p) { return p < 0 ? p : (p - charts[idx(graph.nodes[idx(node)].face)].turn + 4) % 4; };
  std::vector<Place> path;
  std::vector<int> family;
  for (const Vec2 p : e.path) path.push_back({p.x, p.y});
  for (std::size_t i = 0; i < e.faces.size(); ++i) family.push_back(e.family[i] ^ (charts[idx(e.faces[i])].turn & 1));
  FlatEdge forward{path, e.faces, family, port(e.from, e.from_port), port(e.to, e.to_port)};
  FlatEdge backward{{path.rbegin(), path.rend()},
                    {e.faces.rbegin(), e.faces.rend()},
                    {family.rbegin(), family.rend()},
                    std::get<4>(forward),
                    std::get<3>(forward)};
  return std::min(forward, backward);
}

FlatEdge flattened_closed(GraphEdge e, const IsolineGraph& graph, const std::vector<Transition>& charts) {
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

std::multiset<FlatEdge> flat_edges(const IsolineGraph& graph, const std::vector<Transition>& charts) {
  std::multiset<FlatEdge> flat;
  for (const GraphEdge& e : graph.edges)
    flat.insert(e.from < 0 ? flattened_closed(e, graph, charts) : flattened(e, graph, charts));
  return flat;
}

std::multiset<std::tuple<NodeKind, int, double, double>> flat_nodes(const IsolineGraph& graph) {
  std::multiset<std::tuple<NodeKind, int, double, double>> flat;
  for (const GraphNode& n : graph.nodes) flat.insert({n.kind, n.face, n.position.x, n.position.y});
  return flat;
}

void expect_chart_invariant(const Mapped& m, unsigned seed) {
  const std::vector<Transition> charts = random_charts(m.mesh.face_count(), seed);
  const IsolineGraph graph = traced(m);
  const IsolineGraph other = trace_isolines(m.mesh, round_map(recharted(m, charts)), {});
  EXPECT_EQ(flat_nodes(graph), flat_nodes(other));
  EXPECT_EQ(flat_edges(graph, std::vector<Transition>(charts.size())), flat_edges(other, charts));
}

void expect_transitions_hold(const BandMesh& mesh, const ExactMap& exact) {
  for (int h = 0; h < static_cast<int>(mesh.twins.size()); ++h) {
    const int other = mesh.twins[idx(h)];
    if (other < 0) continue;
    const Transition& t = exact.transitions[idx(h)];
    EXPECT_EQ(turned(exact.uv[idx(h)], t.turn) + kFixedOne * t.shift, exact.uv[idx(next_halfedge(other))]);
    EXPECT_EQ(turned(exact.uv[idx(next_halfedge(h))], t.turn) + kFixedOne * t.shift, exact.uv[idx(other)]);
  }
}

// Interior vertices moved in the (u, v) plane by up to `size`, in multiples of `grain` where it is not 0.
void perturb(Mapped& m, double size, double grain, unsigned seed) {
  std::mt19937 random(seed);
  auto noise = [&] {
    const double x = size * (2 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1);
    return grain > 0 ? grain * std::round(x / grain) : x;
  };
  const std::vector<std::uint8_t> boundary = [&] {
    std::vector<std::uint8_t> marked(m.mesh.points.size(), 0);
    for (int h = 0; h < static_cast<int>(m.mesh.twins.size()); ++h) {
      if (m.mesh.twins[idx(h)] < 0)
        marked[idx(m.mesh.faces[idx(h / 3)][idx(h % 3)])] = marked[idx(m.mesh.faces[idx(h / 3)][idx((h + 1) % 3)])] = 1;
    }
    return marked;
  }();
  for (std::size_t v = 0; v < m.map.base.size(); ++v) {
    const Vec2 move{noise(), noise()};
    if (!boundary[v] && !m.map.half_integer[v]) m.map.base[v] += move;
  }
}

void expect_grid_counts(const IsolineGraph& graph, int u_lines, int v_lines) {
  EXPECT_EQ(count(graph, NodeKind::grid), u_lines * v_lines);
  EXPECT_EQ(count(graph, NodeKind::boundary), 2 * (u_lines + v_lines));
  EXPECT_EQ(static_cast<int>(graph.edges.size()), u_lines * (v_lines + 1) + v_lines * (u_lines + 1));
}

TEST(RoundMap, keeps_transitions_exactly_and_regular_vertices_off_the_grid) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Mapped m = cone(3 + static_cast<int>(seed % 3), 1, {2.5, -0.5}, 6, 0.5);
    perturb(m, 0.2, seed % 2 ? 0 : 0.25, seed);
    const GridMap map = recharted(m, random_charts(m.mesh.face_count(), seed));
    const ExactMap exact = round_map(map);
    expect_transitions_hold(m.mesh, exact);
    for (int c = 0; c < static_cast<int>(exact.uv.size()); ++c) {
      const IVec2 uv = exact.uv[idx(c)];
      const Vec2 real = map.uv(c);
      EXPECT_NEAR(static_cast<double>(uv.x) / kFixedOne, real.x, 2.0 / kFixedOne);
      EXPECT_NEAR(static_cast<double>(uv.y) / kFixedOne, real.y, 2.0 / kFixedOne);
      if (map.corner_base[idx(c)] == 0) {
        EXPECT_EQ(uv.x % (kFixedOne / 2), 0);
        EXPECT_EQ(uv.y % (kFixedOne / 2), 0);
      } else {
        EXPECT_NE(uv.x % kFixedOne, 0);
        EXPECT_NE(uv.y % kFixedOne, 0);
      }
    }
  }
}

TEST(RoundMap, survives_coordinates_that_mean_nothing) {
  Mapped m = with_one_chart(lattice(3, 3, 1), [](Vec2 p) { return p; });
  m.map.base[4] = {std::numeric_limits<double>::quiet_NaN(), 1e300};
  m.map.base[5] = {-std::numeric_limits<double>::infinity(), 0.3};
  expect_transitions_hold(m.mesh, round_map(m.map));
  expect_valid(m.mesh, traced(m));
}

TEST(Isolines, rectangle_has_the_analytic_counts) {
  const Mapped m = with_one_chart(lattice(20, 14, 0.25), [](Vec2 p) { return p + Vec2{0.3, -0.45}; });  // 0.3..5.3, -0.45..3.05
  const IsolineGraph graph = traced(m);
  expect_valid(m.mesh, graph);
  expect_grid_counts(graph, 5, 4);
}

TEST(Isolines, vertices_and_edges_on_grid_points_keep_the_counts) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    for (const double step : {0.25, 0.5, 1.0, 1.5, 3.0}) {
      for (const Vec2 offset : {Vec2{0, 0}, Vec2{0.5, 0.5}, Vec2{0.25, -0.25}, Vec2{0.5, 0}}) {
        const int columns = static_cast<int>(6 / step);
        const Mapped m = with_one_chart(lattice(columns, columns, step, seed), [&](Vec2 p) { return p + offset; });
        const IsolineGraph graph = traced(m);
        expect_valid(m.mesh, graph);
        expect_grid_counts(graph, 6, 6);
        for (const GraphNode& n : graph.nodes) {
          if (n.kind != NodeKind::grid) continue;
          const Vec2 uv = n.position + offset;
          EXPECT_LT(norm(uv - Vec2{std::round(uv.x), std::round(uv.y)}), 1e-5);
        }
      }
    }
  }
}

TEST(Isolines, sheared_map_has_its_nodes_where_they_belong) {
  const Vec2 u_row{0.83, 0.37}, v_row{-0.21, 1.13}, origin{0.4, -2.7};
  auto uv = [&](Vec2 p) { return Vec2{dot(u_row, p), dot(v_row, p)} + origin; };
  const Mapped m = with_one_chart(lattice(30, 20, 0.2, 3), uv);  // 6 x 4 px
  const IsolineGraph graph = traced(m);
  expect_valid(m.mesh, graph);
  std::vector<Vec2> expected;
  const double det = cross(u_row, v_row);
  for (int k = -20; k <= 20; ++k) {
    for (int l = -20; l <= 20; ++l) {
      const Vec2 d = Vec2{static_cast<double>(k), static_cast<double>(l)} - origin;
      const Vec2 p{(d.x * v_row.y - d.y * u_row.y) / det, (u_row.x * d.y - v_row.x * d.x) / det};
      if (p.x > 0 && p.x < 6 && p.y > 0 && p.y < 4) expected.push_back(p);
    }
  }
  ASSERT_EQ(count(graph, NodeKind::grid), static_cast<int>(expected.size()));
  for (const Vec2 p : expected) {
    const auto near = [&](const GraphNode& n) { return n.kind == NodeKind::grid && norm(n.position - p) < 1e-5; };
    EXPECT_EQ(std::count_if(graph.nodes.begin(), graph.nodes.end(), near), 1);
  }
  for (const GraphEdge& e : graph.edges) {
    const double value = e.family[0] == 0 ? uv(e.path[0]).x : uv(e.path[0]).y;
    for (const Vec2 p : e.path) EXPECT_NEAR(e.family[0] == 0 ? uv(p).x : uv(p).y, std::round(value), 1e-5);
  }
}

TEST(Isolines, ports_point_along_the_axes_of_the_chart) {
  const Mapped m = with_one_chart(lattice(15, 15, 0.3), [](Vec2 p) { return p + Vec2{0.17, 0.13}; });
  const std::array<Vec2, 4> axis{Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}};
  int checked = 0;
  const IsolineGraph graph = traced(m);
  for (const GraphEdge& e : graph.edges) {
    if (e.from_port >= 0) checked += dot(unit(e.path[1] - e.path[0]), axis[idx(e.from_port)]) > 0.999;
    if (e.to_port >= 0) checked += dot(unit(e.path[e.path.size() - 2] - e.path.back()), axis[idx(e.to_port)]) > 0.999;
  }
  EXPECT_EQ(checked, 4 * 16);
}

TEST(Isolines, inverted_map_keeps_counts_and_flips_one_axis) {
  const Mapped m = with_one_chart(lattice(20, 14, 0.25, 5), [](Vec2 p) {
    return Vec2{5.3 - p.x, p.y + 0.45};
  });  // 0.3..5.3, 0.45..3.95
  const IsolineGraph graph = traced(m);
  expect_valid(m.mesh, graph);
  expect_grid_counts(graph, 5, 3);
  for (const GraphEdge& e : graph.edges) {
    if (e.from_port == 0) {
      EXPECT_LT(e.path[1].x, e.path[0].x);
    }
  }
}

TEST(Isolines, ring_without_crossing_lines_is_closed) {
  const Mapped flat = ring(40, 14, 0.3, 0.25, 0, [](double) { return 0.5; });  // no area in the (u, v) plane
  const Mapped folded = ring(40, 14, 0.3, 0.25, 0, [](double a) { return 0.5 + 0.3 * std::sin(a); });
  for (const Mapped& m : {flat, folded}) {
    const IsolineGraph graph = traced(m);
    expect_valid(m.mesh, graph);
    EXPECT_TRUE(graph.nodes.empty());
    ASSERT_EQ(graph.edges.size(), 3U);
    for (const GraphEdge& e : graph.edges) {
      EXPECT_EQ(e.from, -1);
      double length = 0;
      for (std::size_t i = 1; i < e.path.size(); ++i) length += norm(e.path[i] - e.path[i - 1]);
      EXPECT_NEAR(length, 2 * std::numbers::pi * norm(e.path[0]), 0.1);
    }
  }
}

TEST(Isolines, ring_with_a_shift_across_its_cut) {
  const Mapped m = ring(40, 14, 0.3, 0.25, 5, [](double a) { return 0.2 + 5 * a / (2 * std::numbers::pi); });  // u in 0.3..3.8
  expect_transitions_hold(m.mesh, round_map(m.map));
  const IsolineGraph graph = traced(m);
  expect_valid(m.mesh, graph);
  EXPECT_EQ(count(graph, NodeKind::grid), 3 * 5);
  EXPECT_EQ(count(graph, NodeKind::boundary), 2 * 5);
  EXPECT_EQ(graph.edges.size(), 3U * 5U + 5U * 4U);
  EXPECT_EQ(closed_edges(graph), 0);
}

TEST(Isolines, singular_vertex_on_a_grid_point_has_a_ray_a_quadrant) {
  for (const int n : {2, 3, 4, 5, 6}) {
    for (const double step : {0.23, 0.5, 1.15, 2.3}) {
      const int cells = static_cast<int>(std::ceil(2.3 / step));  // 2.3 or 2.5 grid units
      const Mapped m = cone(n, 1, {3, -1}, cells, step);
      expect_transitions_hold(m.mesh, round_map(m.map));
      const IsolineGraph graph = traced(m);
      expect_valid(m.mesh, graph);
      ASSERT_EQ(count(graph, NodeKind::singular), 1);
      EXPECT_EQ(count(graph, NodeKind::grid), 6 * n);
      EXPECT_EQ(count(graph, NodeKind::boundary), 5 * n);
      EXPECT_EQ(static_cast<int>(graph.edges.size()), (4 * 6 * n + n + 5 * n) / 2);
      for (int i = 0; i < static_cast<int>(graph.nodes.size()); ++i) {
        if (graph.nodes[idx(i)].kind != NodeKind::singular) continue;
        EXPECT_EQ(edge_ends(graph)[idx(i)], n);
        EXPECT_EQ(graph.nodes[idx(i)].position, m.mesh.points[0]);
      }
    }
  }
}

TEST(Isolines, singular_vertex_in_a_cell_makes_no_node) {
  for (const int n : {3, 5}) {
    const Mapped m = cone(n, 1, {3.5, -1.5}, 10, 0.23);
    const IsolineGraph graph = traced(m);
    expect_valid(m.mesh, graph);
    EXPECT_EQ(count(graph, NodeKind::singular), 0);
    EXPECT_EQ(count(graph, NodeKind::grid), 4 * n);
    EXPECT_EQ(count(graph, NodeKind::boundary), 4 * n);
    EXPECT_EQ(static_cast<int>(graph.edges.size()), 10 * n);
  }
}

TEST(Isolines, half_turn_vertex_on_one_isoline_has_a_ray_a_chart) {
  for (const int n : {2, 6}) {
    for (const Vec2 apex : {Vec2{1, 0.5}, Vec2{0.5, 1}}) {
      const Mapped m = cone(n, 2, apex, 10, 0.23);
      expect_transitions_hold(m.mesh, round_map(m.map));
      const IsolineGraph graph = traced(m);
      expect_valid(m.mesh, graph);
      ASSERT_EQ(count(graph, NodeKind::singular), 1);
      const auto singular =
          std::find_if(graph.nodes.begin(), graph.nodes.end(), [](const GraphNode& g) { return g.kind == NodeKind::singular; });
      EXPECT_EQ(edge_ends(graph)[static_cast<std::size_t>(singular - graph.nodes.begin())], n / 2);
      // On each of the n / 2 rays 2 grid nodes, beside them 2 x 2 in every quadrant.
      EXPECT_EQ(count(graph, NodeKind::grid), 4 * n + 2 * n / 2);
    }
  }
}

TEST(Isolines, flagged_vertices_next_to_each_other_share_their_isoline) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    for (const double step : {0.5, 1.5, 2.5}) {
      Mapped m = with_one_chart(lattice(8, 8, step, seed), [](Vec2 p) { return p + Vec2{0.5, 1}; });
      std::mt19937 random(seed);
      int on_grid_points = 0, on_isolines = 0;
      for (int v = 0; v < m.mesh.vertex_count(); ++v) {
        const Vec2 p = m.mesh.points[idx(v)];
        if (p.x == 0 || p.y == 0 || p.x == 8 * step || p.y == 8 * step || random() % 2) continue;
        m.map.half_integer[idx(v)] = 1;
        const bool u_whole = std::fmod(p.x + 0.5, 1) == 0, v_whole = std::fmod(p.y, 1) == 0;
        on_grid_points += u_whole && v_whole;
        on_isolines += u_whole != v_whole;
      }
      const IsolineGraph graph = traced(m);
      expect_valid(m.mesh, graph);
      const int lines = static_cast<int>(8 * step);
      EXPECT_EQ(count(graph, NodeKind::grid), lines * lines - on_grid_points);
      EXPECT_EQ(count(graph, NodeKind::singular), on_grid_points + on_isolines);
      EXPECT_EQ(count(graph, NodeKind::boundary), 4 * lines);
      EXPECT_EQ(static_cast<int>(graph.edges.size()), (4 * lines * lines + 2 * on_isolines + 4 * lines) / 2);
      expect_chart_invariant(m, seed);
    }
  }
}

std::int64_t orient(IVec2 a, IVec2 b, IVec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct BruteForce {
  int nodes = 0;
  int signed_nodes = 0;  // those in inverted triangles count -1
  bool ties = false;
};

BruteForce brute_force_nodes(const ExactMap& exact) {
  BruteForce result;
  for (std::size_t c = 0; c < exact.uv.size(); c += 3) {
    const IVec2 p = exact.uv[c], q = exact.uv[c + 1], r = exact.uv[c + 2];
    for (std::int64_t k = -20; k <= 30; ++k) {
      for (std::int64_t l = -20; l <= 30; ++l) {
        const IVec2 x = kFixedOne * IVec2{k, l};
        const std::int64_t a = orient(p, q, x), b = orient(q, r, x), d = orient(r, p, x);
        const bool positive = a > 0 && b > 0 && d > 0, negative = a < 0 && b < 0 && d < 0;
        result.nodes += positive || negative;
        result.signed_nodes += positive - negative;
        result.ties = result.ties || (!positive && !negative && ((a >= 0 && b >= 0 && d >= 0) || (a <= 0 && b <= 0 && d <= 0)));
      }
    }
  }
  return result;
}

TEST(Isolines, folded_maps_match_brute_force) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Mapped m = with_one_chart(lattice(12, 12, 0.45, seed), [](Vec2 p) { return p + Vec2{0.3, 0.2}; });  // 0.3..5.7, 0.2..5.6
    perturb(m, 0.05 * static_cast<double>(seed), 0, seed);
    const IsolineGraph graph = traced(m);
    expect_valid(m.mesh, graph);
    const BruteForce expected = brute_force_nodes(round_map(m.map));
    ASSERT_FALSE(expected.ties);
    EXPECT_EQ(count(graph, NodeKind::grid), expected.nodes);
    EXPECT_EQ(expected.signed_nodes, 25);
    EXPECT_EQ(count(graph, NodeKind::boundary), 20);
    expect_chart_invariant(m, seed);
  }
}

TEST(Isolines, folded_maps_with_ties_and_triangles_without_area_stay_consistent) {
  int ties = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    for (const double grain : {0.25, 0.5}) {
      Mapped m = with_one_chart(lattice(9, 9, 0.5, seed), [](Vec2 p) { return p + Vec2{0.5, 0.25}; });
      perturb(m, 0.25 * (1 + seed % 8), grain, seed);
      // Without the nudge of round_map, vertices would be on isolines; with it, ties are on edges.
      for (Vec2& b : m.map.base) b = {std::fmod(b.x, 1) == 0 ? b.x + 0.5 : b.x, std::fmod(b.y, 1) == 0 ? b.y + 0.5 : b.y};
      const IsolineGraph graph = traced(m);
      expect_valid(m.mesh, graph);
      expect_chart_invariant(m, seed);
      const BruteForce strict = brute_force_nodes(round_map(m.map));
      ties += strict.ties;
      EXPECT_GE(count(graph, NodeKind::grid), strict.nodes);
    }
  }
  EXPECT_GT(ties, 100);
}

TEST(Isolines, folded_cones_stay_consistent) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const int n = 3 + 2 * static_cast<int>(seed % 2);
    Mapped m = cone(n, 1, seed % 3 ? Vec2{1, 2} : Vec2{0.5, 1.5}, 8, 0.33);
    perturb(m, 0.02 * static_cast<double>(seed), seed % 4 ? 0 : 0.25, seed);
    const IsolineGraph graph = traced(m);
    expect_valid(m.mesh, graph);
    expect_chart_invariant(m, seed);
    const std::vector<int> ends = edge_ends(graph);
    for (int i = 0; i < static_cast<int>(graph.nodes.size()); ++i) {
      // A quarter turn maps the rays' directions onto the next ones: their number is odd around an odd cone, folded or not.
      if (graph.nodes[idx(i)].kind == NodeKind::singular) {
        EXPECT_EQ(ends[idx(i)] % 2, 1);
      }
    }
  }
}

TEST(Isolines, recharting_changes_nothing) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    expect_chart_invariant(with_one_chart(lattice(10, 8, 0.4, seed),
                                          [](Vec2 p) {
                                            return Vec2{0.9 * p.x + 0.4 * p.y, p.y - 0.3 * p.x};
                                          }),
                           seed);
    expect_chart_invariant(cone(5, 1, {1, 1}, 6, 0.4), seed);
    expect_chart_invariant(ring(30, 8, 0.3, 0.25, 0, [](double) { return 0.5; }), seed);
    expect_chart_invariant(ring(30, 8, 0.3, 0.25, 3, [](double a) { return 3 * a / (2 * std::numbers::pi); }), seed);
  }
}

TEST(Isolines, absurd_triangles_are_holes) {
  Mapped m = with_one_chart(lattice(20, 20, 0.25), [](Vec2 p) { return p + Vec2{0.3, 0.3}; });
  const int before = count(traced(m), NodeKind::grid);
  m.map.base[220] = {1e6, -1e9};
  const IsolineGraph graph = traced(m);
  expect_valid(m.mesh, graph);
  EXPECT_LE(count(graph, NodeKind::grid), before);
  EXPECT_GE(count(graph, NodeKind::grid), before - 1);  // the hole is half a grid unit wide
}

TEST(Isolines, skipped_components_have_none) {
  BandMesh mesh = lattice(6, 6, 0.5);
  const BandMesh other = lattice(4, 4, 0.5);
  const int offset = mesh.vertex_count();
  for (const Vec2 p : other.points) mesh.points.push_back(p + Vec2{100, 0});
  for (const auto& f : other.faces) mesh.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  mesh.components = 0;
  link(mesh);
  ASSERT_EQ(mesh.components, 2);
  const Mapped m = with_one_chart(mesh, [](Vec2 p) { return p + Vec2{0.5, 0.5}; });
  const ExactMap exact = round_map(m.map);
  expect_grid_counts(trace_isolines(m.mesh, exact, {1}), 3, 3);
  expect_grid_counts(trace_isolines(m.mesh, exact, {0}), 2, 2);
  EXPECT_TRUE(trace_isolines(m.mesh, exact, {0, 1}).edges.empty());
  EXPECT_EQ(count(trace_isolines(m.mesh, exact, {}), NodeKind::grid), 9 + 4);
}

TEST(Isolines, broken_transitions_are_an_error) {
  const Mapped m = with_one_chart(lattice(3, 3, 0.5), [](Vec2 p) { return p; });
  ExactMap exact = round_map(m.map);
  exact.uv[7].x += 1;
  EXPECT_THROW(trace_isolines(m.mesh, exact, {}), Error);
}

}  // namespace
}  // namespace inkgrid
