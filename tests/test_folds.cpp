#include "graph/folds.h"
#include "isoline_checks.h"

namespace inkgrid {
namespace {

IsolineGraph unfolded(const Mapped& m) {
  return remove_folds(traced(m), m.mesh, round_map(m.map));
}

int sum(const std::vector<int>& values) {
  return std::accumulate(values.begin(), values.end(), 0);
}

// Around two quadrants, isolines meet each other twice with the singular vertex between.
TEST(Folds, unfolded_maps_stay_as_they_are) {
  const std::vector<Mapped> maps{
      with_one_chart(lattice(20, 14, 0.25, 1),
                     [](Vec2 p) {
                       return p + Vec2{0.3, 0.2};
                     }),
      with_one_chart(lattice(20, 14, 0.25, 1),
                     [](Vec2 p) {
                       return Vec2{5.3 - p.x, p.y};
                     }),
      cone(2, 1, {0.5, 0.5}, 10, 0.23),
      cone(2, 2, {0.5, 1}, 10, 0.23),
      cone(3, 1, {1, 2}, 10, 0.23),
      cone(5, 1, {0.5, 0.5}, 10, 0.23),
      ring(40, 14, 0.3, 0.25, 1, [](double a) { return 0.2 + a / (2 * std::numbers::pi); }),
      ring(40, 14, 0.3, 0.25, 0, [](double) { return 0.5; }),
  };
  for (const Mapped& m : maps) {
    const std::vector<Transition> charts(m.mesh.faces.size());
    const IsolineGraph before = traced(m);
    const IsolineGraph after = unfolded(m);
    EXPECT_EQ(flat_nodes(before), flat_nodes(after));
    EXPECT_EQ(flat_edges(before, charts), flat_edges(after, charts));
  }
}

TEST(Folds, folded_squares_become_the_flat_grid) {
  int folded = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    for (const double step : {0.45, 0.2, 0.1}) {
      const int cells = static_cast<int>(5.41 / step);  // from (0.33, 0.24) to beyond (5.6, 5.5)
      Mapped m = with_one_chart(lattice(cells, cells, step, seed), [](Vec2 p) { return p + Vec2{0.33, 0.24}; });
      perturb(m, 0.02 * (1 + seed % 20), 0, seed);
      m.map = recharted(m, random_charts(m.mesh.face_count(), seed));
      folded += count(traced(m), NodeKind::grid) > 25;
      const IsolineGraph graph = unfolded(m);
      expect_valid(m.mesh, graph);
      EXPECT_EQ(count(graph, NodeKind::grid), 25);
      EXPECT_EQ(count(graph, NodeKind::boundary), 20);
      EXPECT_EQ(static_cast<int>(graph.edges.size()) - closed_edges(graph), 60);
    }
  }
  EXPECT_GT(folded, 40);
}

TEST(Folds, heavy_folds_keep_the_ends_of_all_isolines) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Mapped m = cone(3 + 2 * static_cast<int>(seed % 2), 1, seed % 3 ? Vec2{1, 2} : Vec2{0.5, 1.5}, 8, 0.33);
    perturb(m, 0.02 * static_cast<double>(seed), seed % 4 ? 0 : 0.25, seed);
    const IsolineGraph before = traced(m);
    const IsolineGraph after = unfolded(m);
    expect_valid(m.mesh, after);
    EXPECT_EQ(count(after, NodeKind::boundary), count(before, NodeKind::boundary));
    EXPECT_EQ(count(after, NodeKind::singular), count(before, NodeKind::singular));
    const int removed = count(before, NodeKind::grid) - count(after, NodeKind::grid);
    EXPECT_EQ(removed % 2, 0);
    EXPECT_EQ(sum(edge_ends(before)) - sum(edge_ends(after)), 4 * removed);
  }
}

}  // namespace
}  // namespace inkgrid
