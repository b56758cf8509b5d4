// The isolines on hand-made meshes: analytic counts and positions, brute force on folded maps, random re-charting.
#include <numbers>
#include <random>

#include "graph/isolines.h"
#include "inkgrid/inkgrid.h"
#include "isoline_checks.h"

namespace inkgrid {
namespace {

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
    if (e.from_port >= 0) checked += dot(unit(e.path[1] - e.path[0]), axis[at(e.from_port)]) > 0.999;
    if (e.to_port >= 0) checked += dot(unit(e.path[e.path.size() - 2] - e.path.back()), axis[at(e.to_port)]) > 0.999;
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
        if (graph.nodes[at(i)].kind != NodeKind::singular) continue;
        EXPECT_EQ(edge_ends(graph)[at(i)], n);
        EXPECT_EQ(graph.nodes[at(i)].position, m.mesh.points[0]);
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
        const Vec2 p = m.mesh.points[at(v)];
        if (p.x == 0 || p.y == 0 || p.x == 8 * step || p.y == 8 * step || random() % 2) continue;
        m.map.half_integer[at(v)] = 1;
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
      if (graph.nodes[at(i)].kind == NodeKind::singular) {
        EXPECT_EQ(ends[at(i)] % 2, 1);
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
