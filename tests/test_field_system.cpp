#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "base/at.h"
#include "drawn_bands.h"
#include "field/field_system.h"

namespace inkgrid {
namespace {

using Complex = std::complex<double>;
using testing::drawn_ink;

using Lines = std::vector<std::vector<Vec2>>;

const Lines kCrossing{testing::circle({80, 80}, 50), {{20, 30}, {150, 120}}, {{90, 10}, {70, 150}}};

// Left of the middle at half the size, right of it at twice.
ScaleMask halves(int size) {
  ScaleMask mask{size, size, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) mask.factor.push_back(2 * x < size ? 0.5F : 2.0F);
  return mask;
}

std::vector<ComplexPair> random_pairs(std::mt19937& random, int size) {
  std::normal_distribution<double> normal;
  std::vector<ComplexPair> x(at(size));
  for (auto& pair : x) pair = {{normal(random), normal(random)}, {normal(random), normal(random)}};
  return x;
}

std::vector<ComplexPair> at_vertices(const FieldSpace& space, const std::vector<ComplexPair>& x) {
  std::vector<ComplexPair> y;
  for (const auto& [a, b] : space.nodes) y.push_back({0.5 * (x[at(a)].p + x[at(b)].p), 0.5 * (x[at(a)].q + x[at(b)].q)});
  return y;
}

Complex dot(const std::vector<ComplexPair>& a, const std::vector<ComplexPair>& b) {
  Complex sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::conj(a[i].p) * b[i].p + std::conj(a[i].q) * b[i].q;
  return sum;
}

TEST(CoarseSpace, HasAboutAQuarterOfTheVertices) {
  const BandMesh mesh = build_band(drawn_ink(kCrossing, 8, 160), nullptr, {});
  const FieldSpace space = coarse_space(mesh);
  EXPECT_EQ(space.nodes.size(), mesh.points.size());
  EXPECT_GT(space.size, mesh.vertex_count() / 4);
  EXPECT_LT(space.size, mesh.vertex_count() / 2);
}

// Points of the plane themselves are interpolated exactly: there is a place for each node that explains all vertices.
TEST(CoarseSpace, ReproducesPositions) {
  const ScaleMask mask = halves(160);
  const Ink ink = drawn_ink(kCrossing, 8, 160);
  for (const ScaleMask* given : {static_cast<const ScaleMask*>(nullptr), &mask}) {
    const BandMesh mesh = build_band(ink, given, {});
    const FieldSpace space = coarse_space(mesh);
    std::map<int, Vec2> place;
    for (std::size_t v = 0; v < space.nodes.size(); ++v)
      if (space.nodes[v][0] == space.nodes[v][1]) place[space.nodes[v][0]] = mesh.points[v];
    const std::size_t own = place.size();
    EXPECT_GT(own, at(space.size) / 2);
    // A node that is no vertex lies opposite to the other one of each vertex between them.
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t v = 0; v < space.nodes.size(); ++v)
        for (const auto& [from, to] : {std::pair{0, 1}, {1, 0}}) {
          const int known = space.nodes[v][at(from)], other = space.nodes[v][at(to)];
          if (place.contains(known) && !place.contains(other)) place[other] = 2 * mesh.points[v] - place[known];
        }
    EXPECT_GT(place.size(), own);
    for (std::size_t v = 0; v < space.nodes.size(); ++v) {
      const auto [a, b] = space.nodes[v];
      if (place.contains(a) && place.contains(b)) {
        ASSERT_LT(norm(0.5 * (place[a] + place[b]) - mesh.points[v]), 1e-9);
      }
    }
  }
}

TEST(CoarseSpace, PartsThatTheBandDoesNotConnectShareNoNode) {
  // Two strokes whose bands are nearer to each other than a side of the coarse lattice.
  const double width = 10, apart = 1.9 * width;
  const BandMesh mesh =
      build_band(drawn_ink(Lines{{{20, 60}, {140, 70}}, {{20, 60 + apart}, {140, 70 + apart}}}, width, 160), nullptr, {});
  ASSERT_EQ(mesh.components, 2);
  const FieldSpace space = coarse_space(mesh);
  std::vector<int> owner(at(space.size), -1);
  double gap = 1e9;
  for (int f = 0; f < mesh.face_count(); ++f)
    for (const int v : mesh.faces[at(f)]) {
      for (const int node : space.nodes[at(v)]) {
        int& component = owner[at(node)];
        ASSERT_TRUE(component < 0 || component == mesh.component[at(f)]);
        component = mesh.component[at(f)];
      }
      if (mesh.component[at(f)] == 0)
        for (int g = 0; g < mesh.face_count(); ++g)
          if (mesh.component[at(g)] == 1) gap = std::min(gap, norm(mesh.barycentre(g) - mesh.points[at(v)]));
    }
  EXPECT_LT(gap, 0.5 * width) << "the test's drawing";
}

TEST(CoarseSpace, AMeshWithoutLatticeHasItsVertices) {
  BandMesh mesh = build_band(drawn_ink(kCrossing, 8, 160), nullptr, {});
  mesh.lattice.clear();
  const FieldSpace space = coarse_space(mesh);
  EXPECT_EQ(space.size, mesh.vertex_count());
}

TEST(FieldSystem, OnCoarseNodesIsTheOneOnVerticesRestricted) {
  std::mt19937 random(9);
  const ScaleMask mask = halves(160);
  const Ink ink = drawn_ink(kCrossing, 8, 160);
  for (const ScaleMask* given : {static_cast<const ScaleMask*>(nullptr), &mask}) {
    const BandMesh mesh = build_band(ink, given, {});
    const FieldSpace space = coarse_space(mesh);
    const FieldSystem coarse = assemble_field(mesh, space, ink), fine = assemble_field(mesh, vertex_space(mesh), ink);
    EXPECT_EQ(coarse.orthogonality, fine.orthogonality);
    for (int trial = 0; trial < 5; ++trial) {
      const auto x = random_pairs(random, space.size), y = random_pairs(random, space.size);
      const auto px = at_vertices(space, x), py = at_vertices(space, y);
      const double scale = std::abs(dot(px, fine.matrix.times(px)));
      // The trace of orthogonality is lumped, 1e-6 of its weight.
      EXPECT_LT(std::abs(dot(x, coarse.matrix.times(y)) - dot(px, fine.matrix.times(py))), 1e-5 * scale);
      EXPECT_LT(std::abs(dot(x, coarse.right) - dot(px, fine.right)), 1e-9 * std::abs(dot(px, fine.right)));
    }
  }
}

// The matrix is that of the complex unknowns, |tau^4 + c2 tau^2 + c0|^2: a field that follows one direction exactly leaves none
// of the alignment energy, and the others leave it.
TEST(FieldSystem, AlignmentVanishesForTheTrueDirectionOnly) {
  const Vec2 along = unit(Vec2{120, 50});
  const Ink ink = drawn_ink(Lines{{{-50, 40}, {190, 140}}}, 10, 160);
  const BandMesh mesh = build_band(ink, nullptr, {});
  const FieldSystem system = assemble_field(mesh, vertex_space(mesh), ink);
  // The energy of the constant polynomial (z^2 - a^2) (z^2 - b^2), but for a constant.
  const auto energy = [&](Vec2 a, Vec2 b) {
    const Complex a2 = Complex(a.x, a.y) * Complex(a.x, a.y), b2 = Complex(b.x, b.y) * Complex(b.x, b.y);
    const Complex c0 = a2 * b2, c2 = -(a2 + b2), i(0, 1);
    const std::vector<ComplexPair> x(mesh.points.size(), ComplexPair{0.5 * (c0 + c2), 0.5 * (c0 - c2) / i});
    return (dot(x, system.matrix.times(x)) - 2.0 * dot(system.right, x)).real();
  };
  const auto turned_by = [](Vec2 d, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return d * Vec2{std::cos(angle), std::sin(angle)};
  };
  const double right = energy(along, quarter_turn(along)), whole = energy({0, 0}, {0, 0}) - right;
  EXPECT_GT(whole, 0);
  EXPECT_NEAR(energy(along, turned_by(along, 40)), right, 0.01 * whole) << "whatever the other direction is";
  EXPECT_GT(energy(turned_by(along, 45), turned_by(along, -45)), right + 0.9 * whole);
  EXPECT_GT(energy(turned_by(along, 10), turned_by(along, 100)), right + 0.05 * whole);
}

}  // namespace
}  // namespace inkgrid
