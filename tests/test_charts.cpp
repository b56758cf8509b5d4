#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <tuple>

#include "base/union_find.h"
#include "drawn_bands.h"
#include "hand_made_maps.h"
#include "map/charts.h"

namespace inkgrid {
namespace {

using testing::kPi;

constexpr Vec2 kCentre{0, 0};

// z^4 = e^(i angle(p)) at every vertex: a cross field at a quarter of this angle; none where angle() is not a number.
FrameField crosses(const BandMesh& mesh, const std::function<double(Vec2)>& angle) {
  FrameField field;
  for (const Vec2 p : mesh.points) {
    const double a = angle(p);
    field.c0.push_back(std::isnan(a) ? Complex(0) : -std::polar(1.0, a));
    field.c2.push_back(0);
  }
  return field;
}

// A field that turns by `quarters` quarter turns about the centre.
FrameField about_centre(const BandMesh& mesh, int quarters) {
  return crosses(mesh, [&](Vec2 p) { return norm(p) < 1e-9 ? std::nan("") : quarters * std::atan2(p.y, p.x) + 0.3; });
}

int origin(const BandMesh& mesh, int h) {
  return mesh.faces[at(face_of(h))][at(h % 3)];
}

double degrees(Vec2 a, Vec2 b) {
  return std::abs(std::atan2(cross(a, b), dot(a, b))) * 180 / kPi;
}

// Frames that are not orthogonal may differ by more than 45 degrees in one direction, for less in the other.
void expect_turns_of_frames(const BandMesh& mesh, const Charts& charts, bool orthogonal) {
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int twin = mesh.twins[at(h)];
    if (twin < 0) {
      ASSERT_EQ(charts.turns[at(h)], 0);
      ASSERT_EQ(charts.cut[at(h)], 0);
      continue;
    }
    ASSERT_EQ((charts.turns[at(h)] + charts.turns[at(twin)]) % 4, 0);
    ASSERT_EQ(charts.cut[at(h)], charts.cut[at(twin)]);
    ASSERT_TRUE(charts.cut[at(h)] || charts.turns[at(h)] == 0);
    const std::size_t f = at(face_of(h)), g = at(face_of(twin));
    Vec2 s = charts.s[g], t = charts.t[g];
    const auto turn = [&] { std::tie(s, t) = std::pair{t, -s}; };
    for (int k = 0; k < charts.turns[at(h)]; ++k) turn();
    if (orthogonal) {
      ASSERT_LT(degrees(charts.s[f], s), 45);
      ASSERT_LT(degrees(charts.t[f], t), 45);
    }
    const auto agreement = [&] { return dot(charts.s[f], s) + dot(charts.t[f], t); };
    const double chosen = agreement();
    for (int k = 0; k < 3; ++k) {
      turn();
      ASSERT_LE(agreement(), chosen + 1e-9) << "another turn fits better";
    }
  }
}

// Opened along the cuts each component is a disc: connected, and of Euler characteristic 1.
void expect_discs(const BandMesh& mesh, const Charts& charts) {
  UnionFind pieces(mesh.face_count()), fans(3 * mesh.face_count());
  int edges = 0;
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int twin = mesh.twins[at(h)];
    if (twin < 0 || charts.cut[at(h)]) {
      ++edges;
      continue;
    }
    edges += h < twin;
    pieces.unite(face_of(h), face_of(twin));
    fans.unite(h, next_halfedge(twin));
  }
  int piece_count = 0, vertices = 0;
  for (int f = 0; f < mesh.face_count(); ++f) piece_count += pieces.find(f) == f;
  for (int h = 0; h < 3 * mesh.face_count(); ++h) vertices += fans.find(h) == h;
  EXPECT_EQ(piece_count, mesh.components);
  EXPECT_EQ(vertices - edges + mesh.face_count(), mesh.components);
}

std::vector<int> cut_degrees(const BandMesh& mesh, const Charts& charts) {
  std::vector<int> degree(mesh.points.size(), 0);
  for (int h = 0; h < 3 * mesh.face_count(); ++h) degree[at(origin(mesh, h))] += charts.cut[at(h)];
  return degree;
}

int cut_edges(const Charts& charts) {
  return static_cast<int>(std::count(charts.cut.begin(), charts.cut.end(), 1)) / 2;
}

// Cuts lead somewhere, and singular vertices lie on them.
void expect_no_loose_cuts(const BandMesh& mesh, const Charts& charts) {
  const auto boundary = boundary_vertices(mesh);
  const auto degree = cut_degrees(mesh, charts);
  for (std::size_t v = 0; v < degree.size(); ++v) {
    if (degree[v] == 1) {
      ASSERT_TRUE(boundary[v] || charts.singular[v]);
    }
    if (charts.singular[v]) {
      ASSERT_GT(degree[v], 0);
      ASSERT_FALSE(boundary[v]);
    }
  }
}

Charts checked_charts(const BandMesh& mesh, const FrameField& field, bool orthogonal = true) {
  const Charts charts = comb_charts(mesh, field);
  EXPECT_EQ(charts.turns.size(), 3 * mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    EXPECT_NEAR(norm(charts.s[f]), 1, 1e-12);
    EXPECT_NEAR(norm(charts.t[f]), 1, 1e-12);
    EXPECT_GT(cross(charts.s[f], charts.t[f]), 0);
  }
  EXPECT_EQ(charts.singularities, std::count_if(charts.singular.begin(), charts.singular.end(), [](auto k) { return k != 0; }));
  expect_turns_of_frames(mesh, charts, orthogonal);
  expect_discs(mesh, charts);
  expect_no_loose_cuts(mesh, charts);
  return charts;
}

Charts drawn_charts(const std::vector<std::vector<Vec2>>& lines, BandMesh& mesh, bool orthogonal = true) {
  const Ink ink = testing::drawn_ink(lines, 9, 200);
  mesh = build_band(ink, nullptr, {});
  return checked_charts(mesh, solve_field(mesh, ink, {}, {}), orthogonal);
}

TEST(Charts, ADiscWithoutSingularitiesNeedsNoCut) {
  const BandMesh mesh = testing::polar(kCentre, 0, 10, 8, 24);
  const Charts charts = checked_charts(mesh, crosses(mesh, [](Vec2 p) { return 0.2 * p.x; }));
  EXPECT_EQ(charts.singularities, 0);
  EXPECT_EQ(cut_edges(charts), 0);
}

TEST(Charts, AQuarterTurnAboutAVertexIsOneSingularityWithACutToTheBoundary) {
  const BandMesh mesh = testing::polar(kCentre, 0, 10, 8, 24);
  for (const int quarters : {1, -1, 2}) {
    const Charts charts = checked_charts(mesh, about_centre(mesh, quarters));
    EXPECT_EQ(charts.singularities, 1);
    EXPECT_NE(charts.singular[0], 0);
    EXPECT_EQ(charts.singular[0] % 2, std::abs(quarters) % 2);
    const auto degree = cut_degrees(mesh, charts);
    EXPECT_EQ(degree[0], 1);
    EXPECT_GE(cut_edges(charts), 8);
    // One path: two ends.
    EXPECT_EQ(std::count(degree.begin(), degree.end(), 1), 2);
    EXPECT_EQ(*std::max_element(degree.begin(), degree.end()), 2);
  }
}

TEST(Charts, OppositeTurnsAboutAVertexAreInverse) {
  const BandMesh mesh = testing::polar(kCentre, 0, 10, 8, 24);
  const Charts left = checked_charts(mesh, about_centre(mesh, 1)), right = checked_charts(mesh, about_centre(mesh, -1));
  EXPECT_EQ((left.singular[0] + right.singular[0]) % 4, 0);
}

TEST(Charts, TwoSingularitiesOfADisc) {
  // z^4 = (p - a) (p - b), a and b vertices of the mesh.
  const BandMesh mesh = testing::polar(kCentre, 0, 10, 10, 24);
  const Vec2 a{4, 0}, b{-5, 0};
  const auto is = [](Vec2 p, Vec2 q) { return norm(p - q) < 1e-9; };
  const Charts charts = checked_charts(mesh, crosses(mesh, [&](Vec2 p) {
                                         if (is(p, a) || is(p, b)) return std::nan("");
                                         const Vec2 product = (p - a) * (p - b);
                                         return std::atan2(product.y, product.x);
                                       }));
  EXPECT_EQ(charts.singularities, 2);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    EXPECT_EQ(charts.singular[v] != 0, is(mesh.points[v], a) || is(mesh.points[v], b));
}

TEST(Charts, ARingHasOneCutBetweenItsBoundaries) {
  const BandMesh mesh = testing::polar(kCentre, 6, 10, 5, 36);
  for (const int quarters : {0, 1, 2, 3, 4}) {
    const Charts charts = checked_charts(mesh, about_centre(mesh, quarters));
    EXPECT_EQ(charts.singularities, 0);
    const auto degree = cut_degrees(mesh, charts);
    std::vector<double> radii;
    for (std::size_t v = 0; v < degree.size(); ++v) {
      EXPECT_LE(degree[v], 2);
      if (degree[v] == 1) radii.push_back(norm(mesh.points[v]));
    }
    ASSERT_EQ(radii.size(), 2u) << quarters;
    EXPECT_NEAR(*std::min_element(radii.begin(), radii.end()), 6, 1e-9);
    EXPECT_NEAR(*std::max_element(radii.begin(), radii.end()), 10, 1e-9);
    // What the frame turns by around the ring is the turn of every edge of the cut.
    std::set<int> turns;
    for (std::size_t h = 0; h < charts.cut.size(); ++h)
      if (charts.cut[h]) turns.insert(std::min<int>(charts.turns[h], 4 - charts.turns[h]));
    const int way = quarters % 4;
    EXPECT_EQ(turns, std::set<int>{std::min(way, 4 - way)}) << quarters;
  }
}

TEST(Charts, CutsOfDrawingsAreAsManyAsHolesAndSingularities) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(20, 180);
  for (int k = 0; k < 6; ++k) {
    std::vector<std::vector<Vec2>> lines{testing::circle({80 + 10.0 * k, 100}, 40)};
    for (int i = 0; i < 6; ++i) lines.push_back({{place(random), place(random)}, {place(random), place(random)}});
    BandMesh mesh;
    const Charts charts = drawn_charts(lines, mesh, false);
    // Euler's formula for the graph of the cuts, its ends on the boundary left out.
    const auto degree = cut_degrees(mesh, charts);
    const auto boundary = boundary_vertices(mesh);
    int inner = 0;
    for (std::size_t v = 0; v < degree.size(); ++v) inner += degree[v] > 0 && !boundary[v];
    EXPECT_EQ(cut_edges(charts) - inner, testing::holes(mesh));
    EXPECT_GT(testing::holes(mesh), 0);
  }
}

TEST(Charts, ADrawnStrokeNeedsNoCut) {
  BandMesh mesh;
  const Charts charts = drawn_charts({testing::arc({100, 100}, 60, 0, 5)}, mesh);
  EXPECT_EQ(charts.singularities, 0);
  EXPECT_EQ(cut_edges(charts), 0);
}

}  // namespace
}  // namespace inkgrid
