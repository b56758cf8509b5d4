#include <limits>

#include "isoline_checks.h"
#include "map/exact_map.h"

namespace inkgrid {
namespace {

TEST(ExactMap, keeps_transitions_exactly_and_regular_vertices_off_the_grid) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Mapped m = cone(3 + static_cast<int>(seed % 3), 1, {2.5, -0.5}, 6, 0.5);
    perturb(m, 0.2, seed % 2 ? 0 : 0.25, seed);
    const GridMap map = recharted(m, random_charts(m.mesh.face_count(), seed));
    const ExactMap exact = round_map(map);
    expect_transitions_hold(m.mesh, exact);
    for (int c = 0; c < static_cast<int>(exact.uv.size()); ++c) {
      const IVec2 uv = exact.uv[at(c)];
      const Vec2 real = map.uv(c);
      EXPECT_NEAR(static_cast<double>(uv.x) / kFixedOne, real.x, 2.0 / kFixedOne);
      EXPECT_NEAR(static_cast<double>(uv.y) / kFixedOne, real.y, 2.0 / kFixedOne);
      if (map.corner_base[at(c)] == 0) {
        EXPECT_EQ(uv.x % (kFixedOne / 2), 0);
        EXPECT_EQ(uv.y % (kFixedOne / 2), 0);
      } else {
        EXPECT_NE(uv.x % kFixedOne, 0);
        EXPECT_NE(uv.y % kFixedOne, 0);
      }
    }
  }
}

TEST(ExactMap, survives_coordinates_that_mean_nothing) {
  Mapped m = with_one_chart(lattice(3, 3, 1), [](Vec2 p) { return p; });
  m.map.base[4] = {std::numeric_limits<double>::quiet_NaN(), 1e300};
  m.map.base[5] = {-std::numeric_limits<double>::infinity(), 0.3};
  expect_transitions_hold(m.mesh, round_map(m.map));
  expect_valid(m.mesh, traced(m));
}

}  // namespace
}  // namespace inkgrid
