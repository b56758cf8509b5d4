#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "base/sample.h"
#include "drawn_bands.h"
#include "ink/band_mesh.h"

namespace inkgrid {
namespace {

using std::numbers::pi;
using testing::drawn_ink;
using testing::holes;

using Line = std::vector<Vec2>;
using Lines = std::vector<Line>;

std::array<Vec2, 3> corners(const BandMesh& mesh, int f) {
  const auto& t = mesh.faces[at(f)];
  return {mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])]};
}

double area(const BandMesh& mesh, int f) {
  const auto p = corners(mesh, f);
  return cross(p[1] - p[0], p[2] - p[0]) / 2;
}

double circumdiameter(const BandMesh& mesh, int f) {
  const auto p = corners(mesh, f);
  return norm(p[1] - p[0]) * norm(p[2] - p[1]) * norm(p[0] - p[2]) / (2 * area(mesh, f));
}

// Left of the middle one factor, right of it the other.
ScaleMask halves(int size, float left, float right) {
  ScaleMask mask{size, size, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) mask.factor.push_back(2 * x < size ? left : right);
  return mask;
}

double factor_at(const ScaleMask* mask, Vec2 p) {
  if (!mask) return 1;
  const int x = std::clamp(static_cast<int>(std::floor(p.x)), 0, mask->width - 1);
  const int y = std::clamp(static_cast<int>(std::floor(p.y)), 0, mask->height - 1);
  return static_cast<double>(mask->factor[at(y * mask->width + x)]);
}

double distance_to_ink(const Ink& ink, Vec2 p) {
  double least = 1e300;
  for (int y = 0; y < ink.height(); ++y)
    for (int x = 0; x < ink.width(); ++x)
      if (ink.mask(x, y)) least = std::min(least, norm(p - Vec2{x + 0.5, y + 0.5}));
  return least;
}

// Per pixel: triangles that hold its centre, grown by a tolerance (px) that is negative where they must not overlap.
Raster<int> covers(const BandMesh& mesh, int size, double tolerance) {
  Raster<int> count(size, size, 0);
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto p = corners(mesh, f);
    const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = std::max(0, static_cast<int>(y0) - 1); y <= std::min(size - 1, static_cast<int>(y1) + 1); ++y)
      for (int x = std::max(0, static_cast<int>(x0) - 1); x <= std::min(size - 1, static_cast<int>(x1) + 1); ++x) {
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k)
          inside &= cross(unit(p[(k + 1) % 3] - p[k]), Vec2{x + 0.5, y + 0.5} - p[k]) > -tolerance;
        count(x, y) += inside;
      }
  }
  return count;
}

void expect_linked(const BandMesh& mesh) {
  const std::size_t faces = mesh.faces.size();
  ASSERT_EQ(mesh.twins.size(), 3 * faces);
  ASSERT_EQ(mesh.component.size(), faces);
  ASSERT_EQ(mesh.scale.size(), faces);
  ASSERT_EQ(mesh.on_ink.size(), faces);
  ASSERT_EQ(mesh.in_stroke.size(), faces);
  const auto end = [&](int h) { return mesh.faces[at(face_of(h))][at(h % 3)]; };
  std::set<std::pair<int, int>> sides;
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    ASSERT_TRUE(sides.insert({end(h), end(next_halfedge(h))}).second);
    const int twin = mesh.twins[at(h)];
    if (twin < 0) continue;
    ASSERT_EQ(mesh.twins[at(twin)], h);
    ASSERT_EQ(end(twin), end(next_halfedge(h)));
    ASSERT_EQ(end(next_halfedge(twin)), end(h));
    ASSERT_EQ(mesh.component[at(face_of(h))], mesh.component[at(face_of(twin))]);
  }
  for (int h = 0; h < 3 * mesh.face_count(); ++h)
    if (mesh.twins[at(h)] < 0) {
      ASSERT_EQ(sides.count({end(next_halfedge(h)), end(h)}), 0u) << "an edge that is not linked";
    }
}

// A walk over the faces around a vertex, both ways from one of them, meets all of them.
void expect_one_fan_a_vertex(const BandMesh& mesh) {
  std::vector<int> corners_of(mesh.points.size(), 0), any(mesh.points.size(), -1);
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int v = mesh.faces[at(face_of(h))][at(h % 3)];
    ++corners_of[at(v)];
    any[at(v)] = h;
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    ASSERT_GT(corners_of[v], 0) << "a vertex without a face";
    int met = 1;
    int h = any[v];
    for (h = mesh.twins[at(previous_halfedge(h))]; h >= 0 && h != any[v]; h = mesh.twins[at(previous_halfedge(h))]) ++met;
    if (h < 0)
      for (h = mesh.twins[at(any[v])]; h >= 0; h = mesh.twins[at(next_halfedge(h))]) ++met;
    ASSERT_EQ(met, corners_of[v]);
  }
}

void expect_shaped(const BandMesh& mesh, const Ink& ink, const ScaleMask* mask, const BandOptions& options) {
  for (int f = 0; f < mesh.face_count(); ++f) {
    ASSERT_GT(area(mesh, f), 0);
    const Vec2 b = mesh.barycentre(f);
    const double factor = factor_at(mask, b);
    ASSERT_DOUBLE_EQ(static_cast<double>(mesh.scale[at(f)]), factor);
    ASSERT_LE(circumdiameter(mesh, f), options.mesh_size * ink.stroke_width * factor * (1 + 1e-9));
    ASSERT_EQ(mesh.on_ink[at(f)] != 0, nearest_inside(ink.mask, b) != 0);
    if (mesh.on_ink[at(f)]) {
      ASSERT_TRUE(mesh.in_stroke[at(f)]);
    }
  }
  const auto grown = covers(mesh, ink.width(), 1e-9), shrunk = covers(mesh, ink.width(), -1e-9);
  for (std::size_t i = 0; i < grown.data.size(); ++i) {
    if (ink.mask.data[i]) {
      ASSERT_GE(grown.data[i], 1) << "ink outside the band at pixel " << i;
    }
    ASSERT_LE(shrunk.data[i], 1) << "overlapping triangles at pixel " << i;
  }
}

void expect_valid(const BandMesh& mesh, const Ink& ink, const ScaleMask* mask = nullptr, const BandOptions& options = {}) {
  expect_linked(mesh);
  expect_one_fan_a_vertex(mesh);
  expect_shaped(mesh, ink, mask, options);
}

Lines scribble(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(20, 180);
  Lines lines;
  for (int k = 0; k < 7; ++k)
    lines.push_back({{place(random), place(random)}, {place(random), place(random)}, {place(random), place(random)}});
  return lines;
}

const Lines kRing{testing::circle({100, 100}, 60)};
const Lines kStroke{{{30, 50}, {170, 140}}};

class BandMeshes : public ::testing::TestWithParam<std::pair<float, float>> {};

TEST_P(BandMeshes, ValidAndFineEnough) {
  const auto [left, right] = GetParam();
  const ScaleMask mask = halves(200, left, right);
  const ScaleMask* const given = left == 1 && right == 1 ? nullptr : &mask;
  for (const Lines& lines : {kStroke, kRing, scribble(1), scribble(2), scribble(3), scribble(4)}) {
    const Ink ink = drawn_ink(lines, 9, 200);
    for (const BandOptions options : {BandOptions{}, BandOptions{1.5, 0.5}, BandOptions{0.3, 0.4}}) {
      const BandMesh mesh = build_band(ink, given, options);
      expect_valid(mesh, ink, given, options);
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BandMesh, BandMeshes,
                         ::testing::Values(std::pair{1.f, 1.f}, std::pair{0.5f, 0.5f}, std::pair{2.f, 2.f}, std::pair{0.5f, 1.f},
                                           std::pair{1.f, 2.f}, std::pair{2.f, 0.5f}));

TEST(BandMesh, BarycentresAreWithinReachOfTheInk) {
  // The distance between pixel centres is interpolated: up to 0.3 px more than the distance itself.
  for (const double reach : {0.3, 1.0})
    for (const float factor : {0.5f, 1.0f, 2.0f}) {
      const Ink ink = drawn_ink(kStroke, 8, 200);
      const ScaleMask mask = halves(200, factor, factor);
      const BandMesh mesh = build_band(ink, &mask, {reach, 0.25});
      const double limit = reach * ink.stroke_width * static_cast<double>(factor);
      double farthest = 0;
      for (int f = 0; f < mesh.face_count(); ++f) farthest = std::max(farthest, distance_to_ink(ink, mesh.barycentre(f)));
      EXPECT_LE(farthest, limit + 0.3) << reach << ' ' << factor;
      EXPECT_GE(farthest, limit - 0.25 * ink.stroke_width * static_cast<double>(factor)) << reach << ' ' << factor;
    }
}

TEST(BandMesh, PaperWithinReachIsCovered) {
  const Ink ink = drawn_ink(kStroke, 8, 200);
  const BandOptions options{1.0, 0.25};
  const auto covered = covers(build_band(ink, nullptr, options), 200, 1e-9);
  const double surely = (options.reach - options.mesh_size / 2) * ink.stroke_width - 0.5,
               hardly = (options.reach + options.mesh_size / 2) * ink.stroke_width + 0.5;
  for (std::size_t i = 0; i < covered.data.size(); ++i) {
    const auto gap = static_cast<double>(ink.gap.data[i]);
    if (gap < surely) {
      ASSERT_GE(covered.data[i], 1);
    }
    if (gap > hardly) {
      ASSERT_EQ(covered.data[i], 0);
    }
  }
}

TEST(BandMesh, HolesAndComponents) {
  struct Case {
    const char* name;
    Lines lines;
    int components, holes;
  };
  const Lines cross{{{30, 100}, {170, 100}}, {{100, 30}, {100, 170}}};
  const Lines eight{testing::circle({60, 100}, 35), testing::circle({130, 100}, 35)};
  const Lines grid{{{30, 60}, {170, 60}}, {{30, 140}, {170, 140}}, {{60, 30}, {60, 170}}, {{140, 30}, {140, 170}}};
  for (const Case& c : {Case{"disc", {{{100, 100}, {100.01, 100}}}, 1, 0}, Case{"ring", kRing, 1, 1}, Case{"cross", cross, 1, 0},
                        Case{"eight", eight, 1, 2}, Case{"grid", grid, 1, 1},
                        Case{"two strokes", {{{30, 60}, {170, 60}}, {{30, 140}, {170, 140}}}, 2, 0},
                        Case{"ring in a ring", {testing::circle({100, 100}, 70), testing::circle({100, 100}, 30)}, 2, 2}}) {
    const Ink ink = drawn_ink(c.lines, 6, 200);
    const BandMesh mesh = build_band(ink, nullptr, {});
    EXPECT_EQ(mesh.components, c.components) << c.name;
    EXPECT_EQ(holes(mesh), c.holes) << c.name;
    EXPECT_EQ(std::set<int>(mesh.component.begin(), mesh.component.end()).size(), at(c.components)) << c.name;
  }
}

TEST(BandMesh, ASlitUpToAQuarterWiderThanTheBandIsNoHole) {
  const double pen = 6, reach = 0.5;
  for (const auto& [paper, expected] : {std::pair{5.0, 0}, {7.6, 0}, {9.5, 1}}) {
    const double half = (pen + paper) / 2;
    const Lines slot{{{30, 100 - half}, {170, 100 - half}, {170, 100 + half}, {30, 100 + half}, {30, 100 - half}}};
    EXPECT_EQ(holes(build_band(drawn_ink(slot, pen, 200), nullptr, {reach, 0.25})), expected) << paper;
  }
}

TEST(BandMesh, AFilledDiscHasNoHole) {
  const Ink ink = drawn_ink({{{100, 100}, {100.01, 100}}}, 100, 200);
  const BandMesh mesh = build_band(ink, nullptr, {});
  expect_valid(mesh, ink);
  EXPECT_EQ(mesh.vertex_count() - testing::edge_count(mesh) + mesh.face_count(), 1);
}

TEST(BandMesh, MaskedHalvesAreFinerAndCoarser) {
  const Ink ink = drawn_ink({{{20, 90}, {180, 110}}}, 16, 200);
  const ScaleMask mask = halves(200, 0.5f, 2.0f);
  const BandMesh mesh = build_band(ink, &mask, {});
  double area_sum[2] = {}, widest[2] = {};
  int count[2] = {};
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Vec2 b = mesh.barycentre(f);
    // Far from the middle and from the rims, where triangles are split to fit the finer half.
    if (std::abs(b.x - 100) < 20) continue;
    const int side = b.x > 100;
    area_sum[side] += area(mesh, f);
    ++count[side];
    widest[side] = std::max(widest[side], std::abs(cross(b - Vec2{20, 90}, unit({160, 20}))));
  }
  ASSERT_GT(count[0], 0);
  ASSERT_GT(count[1], 0);
  EXPECT_NEAR((area_sum[1] / count[1]) / (area_sum[0] / count[0]), 16, 1);
  EXPECT_NEAR(widest[0], 8 + 0.15 * ink.stroke_width, 0.2 * ink.stroke_width);
  EXPECT_NEAR(widest[1], 8 + 0.6 * ink.stroke_width, 0.2 * ink.stroke_width);
}

TEST(BandMesh, PaperBetweenCloseStrokesIsInStroke) {
  // Strokes of 8 px, rows of ink 66..73 and 80..87: 6 rows of paper; reach 0.5: paper up to 8 px wide is closed.
  const Ink ink = drawn_ink({{{30, 70}, {170, 70}}, {{30, 84}, {170, 84}}, {{30, 140}, {170, 140}}}, 8, 200);
  const BandMesh mesh = build_band(ink, nullptr, {0.5, 0.25});
  int between = 0, beside = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Vec2 b = mesh.barycentre(f);
    if (b.x < 40 || b.x > 160 || mesh.on_ink[at(f)]) continue;
    const bool slit = b.y > 74 && b.y < 80;
    EXPECT_EQ(mesh.in_stroke[at(f)] != 0, slit) << b.x << ' ' << b.y;
    ++(slit ? between : beside);
  }
  EXPECT_GT(between, 100);
  EXPECT_GT(beside, 100);
  EXPECT_EQ(mesh.components, 2);
}

TEST(BandMesh, BoundaryVerticesAreThoseOfOpenEdges) {
  const BandMesh mesh = build_band(drawn_ink(kRing, 9, 200), nullptr, {});
  // An interior vertex has as many edges as faces, a boundary vertex one more.
  std::vector<std::set<int>> neighbours(mesh.points.size());
  std::vector<std::size_t> faces(mesh.points.size(), 0);
  for (const auto& t : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      ++faces[at(t[k])];
      neighbours[at(t[k])].insert({t[(k + 1) % 3], t[(k + 2) % 3]});
    }
  const auto boundary = boundary_vertices(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) ASSERT_EQ(boundary[v] != 0, neighbours[v].size() == faces[v] + 1);
}

TEST(BandMesh, PaperAloneHasNoBand) {
  const BandMesh mesh = build_band(testing::drawn_ink(testing::blank(40, 40)), nullptr, {});
  EXPECT_EQ(mesh.face_count(), 0);
  EXPECT_EQ(mesh.vertex_count(), 0);
  EXPECT_EQ(mesh.components, 0);
}

TEST(BandMesh, InkAtTheBorderIsCovered) {
  const Ink ink =
      drawn_ink({{{20, 2}, {180, 2}}, {{-20, 100}, {220, 100}}, {{198, 20}, {198, 80}}, {{30, 199}, {170, 199}}}, 10, 200);
  expect_valid(build_band(ink, nullptr, {}), ink);
}

}  // namespace
}  // namespace inkgrid
