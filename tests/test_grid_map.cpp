#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

#include "hand_made_maps.h"
#include "map/cut_shifts.h"
#include "map/grid_map.h"

namespace inkgrid {
namespace {

using namespace inkgrid::testing;

GridMapOptions almost_undamped() {
  GridMapOptions options;
  options.damping = 1e-10;
  return options;
}

void expect_transitions(const BandMesh& mesh, const Charts& charts, const GridMap& map) {
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int twin = mesh.twins[at(h)];
    const Transition& across = map.transitions[at(h)];
    if (twin < 0 || !charts.cut[at(h)]) {
      EXPECT_EQ(across, Transition{});
    }
    if (twin < 0) continue;
    EXPECT_EQ(across.turn, charts.turns[at(h)]);
    EXPECT_EQ(inverse(across), map.transitions[at(twin)]);
    const auto expect_same = [&](int here, int there) {
      EXPECT_LT(norm(turned(map.uv(here), across.turn) + real(across.shift) - map.uv(there)), 1e-12) << "halfedge " << h;
      const int vertex = map.corner_base[at(here)];
      ASSERT_EQ(vertex, map.corner_base[at(there)]);
      if (map.half_integer[at(vertex)]) return;
      EXPECT_EQ((map.corner_turn[at(here)] + across.turn) & 3, map.corner_turn[at(there)]);
      EXPECT_EQ(turned(map.corner_shift[at(here)], across.turn) + across.shift, map.corner_shift[at(there)]);
    };
    expect_same(h, next_halfedge(twin));
    expect_same(next_halfedge(h), twin);
  }
}

// Equation (2) from the Jacobian itself.
double alignment_of(const BandMesh& mesh, const Charts& charts, const GridMap& map, double unit) {
  double sum = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto& face = mesh.faces[at(f)];
    const Vec2 e1 = mesh.points[at(face[1])] - mesh.points[at(face[0])], e2 = mesh.points[at(face[2])] - mesh.points[at(face[0])];
    const Vec2 d1 = map.uv(3 * f + 1) - map.uv(3 * f), d2 = map.uv(3 * f + 2) - map.uv(3 * f);
    Eigen::Matrix2d edges, images, frame;
    edges << e1.x, e2.x, e1.y, e2.y;
    images << d1.x, d2.x, d1.y, d2.y;
    const Vec2 s = charts.s[at(f)], t = charts.t[at(f)];
    frame << s.x, t.x, s.y, t.y;
    sum += (images * edges.inverse() * frame * unit * double{mesh.scale[at(f)]} - Eigen::Matrix2d::Identity()).squaredNorm();
  }
  return sum;
}

GridMap solve(const BandMesh& mesh, const Charts& charts, const std::vector<Label>& labels, const Ink& ink,
              const GridMapOptions& options = almost_undamped()) {
  return solve_grid_map(mesh, charts, labels, ink, options, {});
}

constexpr Vec2 kCentre{30, 30};

TEST(GridMap, ConstantFrameGivesAnAffineMap) {
  BandMesh mesh = lattice(12, 7);
  for (float scale : {1.0F, 2.0F}) {
    mesh.scale.assign(mesh.faces.size(), scale);
    Charts charts = charts_of(
        mesh, [](int) { return 0.3; }, no_cut);
    const Vec2 s = direction(0.3), t = direction(0.3 + 1.2);  // an oblique frame
    charts.t.assign(mesh.faces.size(), t);
    GridMapOptions options = almost_undamped();
    options.spacing = 1.5;
    const double unit = 1.5 * 4 * double{scale};
    const GridMap map = solve(mesh, charts, unlabelled(mesh), ink_of(4), options);
    EXPECT_LT(map.alignment_energy, 1e-10);
    for (int c = 0; c < 3 * mesh.face_count(); ++c) {
      const Vec2 difference = unit * (map.uv(c) - map.uv(0));
      const Vec2 offset = mesh.points[at(map.corner_base[at(c)])] - mesh.points[at(map.corner_base[0])];
      EXPECT_LT(norm(difference.x * s + difference.y * t - offset), 1e-6);
    }
    EXPECT_EQ(map.cut_integers, 0);
    EXPECT_EQ(map.snapping_integers, 0);
  }
}

TEST(GridMap, DampingCentresTheCoordinates) {
  const BandMesh mesh = lattice(9, 6);
  const GridMap map = solve(mesh,
                            charts_of(
                                mesh, [](int) { return 0.1; }, no_cut),
                            unlabelled(mesh), ink_of(4), GridMapOptions{});
  Vec2 sum;
  for (int c = 0; c < 3 * mesh.face_count(); ++c) sum += map.uv(c);
  EXPECT_LT(norm(sum), 1e-8);
}

TEST(GridMap, RingHasOnePairOfCutIntegers) {
  const BandMesh mesh = polar(kCentre, 9, 11, 2, 48);
  const auto radial = [&](int f) { return angle_about(kCentre, mesh.barycentre(f)); };
  const Charts charts = charts_of(
      mesh, [&](int f) { return radial(f) > kPi ? radial(f) - 2 * kPi : radial(f); }, ray(kCentre, 0));
  GridMapOptions options = almost_undamped();
  options.spacing = 2 * kPi * 10 / 12.3;  // the middle of the ring is 12.3 grid units long
  const GridMap map = solve(mesh, charts, unlabelled(mesh), ink_of(1), options);
  EXPECT_EQ(map.cuts, 1);
  EXPECT_EQ(map.cut_integers, 2);
  expect_transitions(mesh, charts, map);
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    if (!charts.cut[at(h)]) continue;
    const bool onward = mesh.barycentre(face_of(h)).y < kCentre.y;  // leaves the end of the round for its start
    EXPECT_EQ(map.transitions[at(h)].shift, (IVec2{0, onward ? -12 : 12}));
  }
  EXPECT_NEAR(map.alignment_energy, alignment_of(mesh, charts, map, options.spacing), 1e-9);
}

// The reals minimise equation (4): moving a vertex either way costs the same, and something.
TEST(GridMap, IsStationary) {
  const BandMesh mesh = polar(kCentre, 6, 11, 4, 24);
  const auto turning = [&](int f) { return 0.7 * std::sin(3 * angle_about(kCentre, mesh.barycentre(f))); };
  const Charts charts = charts_of(mesh, turning, ray(kCentre, 0));
  GridMapOptions options;
  options.damping = 0.01;
  GridMap map = solve(mesh, charts, unlabelled(mesh), ink_of(3), options);
  const auto energy = [&] {
    double sum = alignment_of(mesh, charts, map, 3);
    for (int c = 0; c < 3 * mesh.face_count(); ++c) sum += options.damping * norm2(map.uv(c));
    return sum;
  };
  const double best = energy(), step = 1e-3;
  EXPECT_GT(map.alignment_energy, 1);
  EXPECT_NEAR(map.alignment_energy, alignment_of(mesh, charts, map, 3), 1e-9);
  for (Vec2& base : map.base) {
    for (const Vec2 move : {Vec2{step, 0}, Vec2{0, step}}) {
      base += move;
      const double up = energy();
      base -= 2.0 * move;
      const double down = energy();
      base += move;
      EXPECT_GT(std::min(up, down), best);
      EXPECT_NEAR(up, down, 1e-4 * (up - best));
    }
  }
}

struct Line {
  double y = 0, half_width = 1;
  bool holds(Vec2 p) const { return std::abs(p.y - y) < half_width; }
};

// v along the line at height y, from the faces it crosses.
std::vector<double> values_at_height(const BandMesh& mesh, const GridMap& map, double y, int coordinate) {
  std::vector<double> values;
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const Vec2 a = mesh.points[at(map.corner_base[at(h)])], b = mesh.points[at(map.corner_base[at(next_halfedge(h))])];
    if ((a.y - y) * (b.y - y) >= 0) continue;
    const Vec2 uv = lerp(map.uv(h), map.uv(next_halfedge(h)), (y - a.y) / (b.y - a.y));
    values.push_back(coordinate == 0 ? uv.x : uv.y);
  }
  return values;
}

// Lines along x, in charts whose s or t runs along x.
void expect_snapped_lines(double angle, Label label, int coordinate) {
  const BandMesh mesh = lattice(24, 20);
  const std::vector<Line> lines = {{7.03, 3}, {7.03 + 6 * 1.15, 3}};
  const auto distance = [&](Vec2 p) { return std::min(std::abs(p.y - lines[0].y), std::abs(p.y - lines[1].y)); };
  const auto labels = labels_where(mesh, label, [&](Vec2 p) { return lines[0].holds(p) || lines[1].holds(p); });
  const Charts charts = charts_of(
      mesh, [=](int) { return angle; }, no_cut);
  const GridMap map = solve(mesh, charts, labels, ink_of(6, distance), GridMapOptions{});
  EXPECT_EQ(map.snapping_integers, 2);
  std::vector<double> integer(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<double> values = values_at_height(mesh, map, lines[i].y, coordinate);
    ASSERT_GT(values.size(), 20U);
    integer[i] = std::round(values[0]);
    for (double v : values) EXPECT_NEAR(v, integer[i], 0.05);
  }
  EXPECT_EQ(std::abs(integer[1] - integer[0]), 1);
  EXPECT_GT(map.snapping_energy, 0);
  EXPECT_NEAR(map.alignment_energy, alignment_of(mesh, charts, map, 6), 1e-9);
}

TEST(GridMap, LinesSnapV) {
  expect_snapped_lines(0, Label::along_s, 1);
}
TEST(GridMap, LinesSnapU) {
  expect_snapped_lines(kPi / 2, Label::along_t, 0);
}

TEST(GridMap, OneIntegerForEachRegionFamilyAndSideOfACut) {
  const BandMesh mesh = lattice(20, 10);
  const Ink ink = ink_of(4, [](Vec2) { return 0.0; });
  const Charts charts = charts_of(
      mesh, [](int) { return 0.0; }, no_cut);
  const auto count = [&](const Charts& with, const std::vector<Label>& labels, double merge_difference = 0.5) {
    GridMapOptions options;
    options.merge_difference = merge_difference;
    return solve(mesh, with, labels, ink, options).snapping_integers;
  };
  EXPECT_EQ(count(charts, labels_where(mesh, Label::along_s, [](Vec2) { return true; })), 1);
  EXPECT_EQ(count(charts, labels_where(mesh, Label::along_s, [](Vec2 p) { return p.x < 9 || p.x > 14; })), 2);
  auto crossing = labels_where(mesh, Label::along_s, [](Vec2) { return true; });
  for (int f = 0; f < mesh.face_count(); ++f)
    if (mesh.barycentre(f).x > 12) crossing[at(f)] = Label::along_t;
  EXPECT_EQ(count(charts, crossing), 2);
  // Not merged inside of faces: one integer for each vertex on a labelled face.
  EXPECT_EQ(count(charts, labels_where(mesh, Label::along_s, [](Vec2) { return true; }), 0.0), mesh.vertex_count());
  // A chart turned over beyond x = 13 cuts the region.
  const Charts cut = charts_of(
      mesh, [&](int f) { return mesh.barycentre(f).x > 13 ? kPi : 0.0; }, no_cut);
  EXPECT_EQ(count(cut, labels_where(mesh, Label::along_s, [](Vec2) { return true; })), 2);
}

TEST(GridMap, SnapsAcrossACut) {
  const BandMesh mesh = lattice(20, 10);
  const double y = 7.4;
  const Ink ink = ink_of(3, [=](Vec2 p) { return p.y - y; });
  const auto turned_half = [&](int f) { return mesh.barycentre(f).x > 13 ? -kPi / 2 : 0.0; };
  const Charts charts = charts_of(mesh, turned_half, no_cut);
  std::vector<Label> labels = unlabelled(mesh);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (std::abs(mesh.barycentre(f).y - y) < 1.5) labels[at(f)] = mesh.barycentre(f).x > 13 ? Label::along_t : Label::along_s;
  const GridMap map = solve(mesh, charts, labels, ink);
  expect_transitions(mesh, charts, map);
  EXPECT_EQ(map.snapping_integers, 2);
  EXPECT_LT(map.alignment_energy, 1e-6);  // the line fits the grid: nothing but a translation is asked for
  EXPECT_LT(map.snapping_energy, 1);
}

// Frames of index turns / 4 around the middle of a disc.
struct SingularDisc {
  BandMesh mesh = polar(kCentre, 0, 12, 6, 20);
  Charts charts;
  explicit SingularDisc(int turns) {
    charts = charts_of(
        mesh, [&](int f) { return 0.2 + turns * angle_about(kCentre, mesh.barycentre(f)) / 4; }, ray(kCentre, 0));
  }
};

TEST(GridMap, SingularVerticesLieOnMultiplesOfOneHalf) {
  for (int turns : {-2, -1, 1, 2, 3}) {
    const SingularDisc disc(turns);
    const auto labels = labels_where(disc.mesh, Label::along_s, [](Vec2 p) { return p.x < 27 && std::abs(p.y - 30) < 2; });
    const GridMap map = solve(disc.mesh, disc.charts, labels, ink_of(4, [](Vec2 p) { return p.y - 30; }), GridMapOptions{});
    ASSERT_EQ(std::count(map.half_integer.begin(), map.half_integer.end(), 1), 1);
    EXPECT_EQ(map.half_integer[0], 1);
    EXPECT_EQ(map.base[0].x * 2, std::round(map.base[0].x * 2));
    EXPECT_EQ(map.base[0].y * 2, std::round(map.base[0].y * 2));
    EXPECT_EQ(map.cut_integers, 2);
    EXPECT_TRUE(map.failed_components.empty());
    expect_transitions(disc.mesh, disc.charts, map);
    EXPECT_NEAR(map.alignment_energy, alignment_of(disc.mesh, disc.charts, map, 4), 1e-9 * map.alignment_energy);
  }
}

TEST(GridMap, ThreeCutsMeetAtARegularVertex) {
  const BandMesh mesh = polar(kCentre, 0, 12, 6, 12);
  const std::vector<double> rays = {0, kPi / 2, 4 * kPi / 3};
  for (const std::array<int, 3> turns : {std::array{0, 0, 0}, std::array{0, 1, 3}, std::array{2, 1, 0}}) {
    const auto angle = [&](int f) {
      const double a = angle_about(kCentre, mesh.barycentre(f));
      return 0.4 + kPi / 2 * turns[a < rays[1] ? 0U : a < rays[2] ? 1U : 2U];
    };
    const Charts charts = charts_of(mesh, angle, [&](Vec2 a, Vec2 b) {
      return ray(kCentre, rays[0])(a, b) || ray(kCentre, rays[1])(a, b) || ray(kCentre, rays[2])(a, b);
    });
    const GridMap map = solve(mesh, charts, unlabelled(mesh), ink_of(4));
    EXPECT_EQ(map.cuts, 3);
    EXPECT_EQ(map.cut_integers, 4);
    EXPECT_LT(map.alignment_energy, 1e-8);
    expect_transitions(mesh, charts, map);
  }
}

// A cut that ends inside has no translation; one that runs in a circle, with or without a tail, costs nothing either.
TEST(GridMap, CutsWithLooseEndsAndLoops) {
  const BandMesh mesh = polar(kCentre, 0, 12, 6, 12);
  const auto inside = [&](int f) { return norm(mesh.barycentre(f) - kCentre) < 6; };
  const auto outer_ray = [](Vec2 a, Vec2 b) {
    return ray(kCentre, 0)(a, b) && norm(a - kCentre) > 5.9 && norm(b - kCentre) > 5.9;
  };
  const auto solve_cut = [&](double inner_turn, const CutEdge& cut) {
    const Charts charts = charts_of(
        mesh, [&](int f) { return 0.1 + (inside(f) ? inner_turn : 0); }, cut);
    const GridMap map = solve(mesh, charts, unlabelled(mesh), ink_of(4));
    expect_transitions(mesh, charts, map);
    EXPECT_LT(map.alignment_energy, 1e-8);
    return map;
  };
  const GridMap loose = solve_cut(0, outer_ray);
  EXPECT_EQ(loose.cuts, 1);
  EXPECT_EQ(loose.cut_integers, 0);
  const GridMap loop = solve_cut(kPi / 2, no_cut);
  EXPECT_EQ(loop.cuts, 1);
  EXPECT_EQ(loop.cut_integers, 2);
  const GridMap tailed = solve_cut(kPi / 2, outer_ray);
  EXPECT_EQ(tailed.cuts, 2);
  EXPECT_EQ(tailed.cut_integers, 2);
}

// Every face its own chart, turned at random: the same map, with one pair of integers for each face but one, and one for each
// hole.
TEST(GridMap, AnyChartsDescribeTheSameMap) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> quarter(0, 3);
  for (const bool ring : {false, true}) {
    const BandMesh mesh = ring ? polar(kCentre, 4, 9, 3, 9) : lattice(9, 5);
    std::vector<int> turns(mesh.faces.size());
    for (int& turn : turns) turn = quarter(random);
    const Charts charts = charts_of(
        mesh, [&](int f) { return 0.3 + kPi / 2 * turns[at(f)]; }, [](Vec2, Vec2) { return true; });
    const GridMap map = solve(mesh, charts, unlabelled(mesh), ink_of(4));
    expect_transitions(mesh, charts, map);
    EXPECT_EQ(map.cut_integers, 2 * (mesh.face_count() - (ring ? 0 : 1)));
    EXPECT_LT(map.alignment_energy, 1e-7);
  }
}

BandMesh renumbered(const BandMesh& mesh, std::mt19937& random, std::vector<int>& face_at) {
  std::vector<int> vertex_at(mesh.points.size());
  face_at.resize(mesh.faces.size());
  std::iota(vertex_at.begin(), vertex_at.end(), 0);
  std::iota(face_at.begin(), face_at.end(), 0);
  std::shuffle(vertex_at.begin(), vertex_at.end(), random);
  std::shuffle(face_at.begin(), face_at.end(), random);
  std::vector<Vec2> points(mesh.points.size());
  for (std::size_t v = 0; v < points.size(); ++v) points[at(vertex_at[v])] = mesh.points[v];
  std::vector<std::array<int, 3>> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::array<int, 3> face = mesh.faces[at(face_at[f])];
    for (int& v : face) v = vertex_at[at(v)];
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(f % 3), face.end());
    faces.push_back(face);
  }
  return mesh_of(points, faces);
}

TEST(GridMap, NumberingDoesNotMatter) {
  std::mt19937 random(3);
  const BandMesh mesh = polar(kCentre, 0, 12, 6, 20);
  const auto angle = [](Vec2 p) { return 0.2 + angle_about(kCentre, p) / 4 + 0.02 * (p.x - 30); };
  const auto stroke = [](Vec2 p) { return std::abs(p.y - 31.3) < 2; };
  const Ink ink = ink_of(4, [](Vec2 p) { return p.y - 31.3; });
  const auto solve_on = [&](const BandMesh& m) {
    const Charts charts = charts_of(
        m, [&](int f) { return angle(m.barycentre(f)); }, ray(kCentre, 0));
    return solve(m, charts, labels_where(m, Label::along_s, stroke), ink, GridMapOptions{});
  };
  const GridMap expected = solve_on(mesh);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<int> face_at;
    const BandMesh other = renumbered(mesh, random, face_at);
    const GridMap map = solve_on(other);
    EXPECT_NEAR(map.alignment_energy, expected.alignment_energy, 1e-9 * expected.alignment_energy);
    EXPECT_NEAR(map.snapping_energy, expected.snapping_energy, 1e-9 * (1 + expected.snapping_energy));
    EXPECT_EQ(map.snapping_integers, expected.snapping_integers);
    EXPECT_EQ(map.cut_integers, expected.cut_integers);
  }
}

BandMesh side_by_side(const BandMesh& a, const BandMesh& b) {
  std::vector<Vec2> points = a.points;
  std::vector<std::array<int, 3>> faces = a.faces;
  points.insert(points.end(), b.points.begin(), b.points.end());
  for (auto face : b.faces) {
    for (int& v : face) v += a.vertex_count();
    faces.push_back(face);
  }
  return mesh_of(points, faces);
}

TEST(GridMap, AFailedComponentLeavesTheOthersAlone) {
  const BandMesh left = lattice(6, 4), mesh = side_by_side(left, lattice(6, 4, {20, 3}));
  const auto wavy = [&](int f) { return 0.3 * std::sin(mesh.barycentre(f).x + mesh.barycentre(f).y); };
  const GridMap alone = solve(left, charts_of(left, wavy, no_cut), unlabelled(left), ink_of(4));
  Charts charts = charts_of(mesh, wavy, no_cut);
  charts.s[at(left.face_count() + 5)].x = std::nan("");
  const GridMap map = solve(mesh, charts, unlabelled(mesh), ink_of(4));
  EXPECT_EQ(map.failed_components, std::vector<int>{1});
  EXPECT_GT(alone.alignment_energy, 0.1);
  EXPECT_EQ(map.alignment_energy, alone.alignment_energy);
  for (int c = 0; c < 3 * left.face_count(); ++c) EXPECT_EQ(map.uv(c), alone.uv(c));
  for (int c = 3 * left.face_count(); c < 3 * mesh.face_count(); ++c) EXPECT_EQ(map.uv(c), Vec2{});
}

TEST(GridMap, ReportsFromTheCallersThreadAndStopsWhenAsked) {
  BandMesh mesh = lattice(6, 4);
  for (int i = 1; i < 9; ++i) mesh = side_by_side(mesh, lattice(6, 4, {3, 3.0 + 6 * i}));
  const Charts charts = charts_of(
      mesh, [](int) { return 0.0; }, no_cut);
  Control control;
  double last = 0;
  control.progress = [&, caller = std::this_thread::get_id()](const char* stage, double fraction) {
    EXPECT_STREQ(stage, "grid map");
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  solve_grid_map(mesh, charts, unlabelled(mesh), ink_of(4), {}, control);
  EXPECT_EQ(last, 1);
  std::stop_source stop;
  control.stop = stop.get_token();
  stop.request_stop();
  try {
    solve_grid_map(mesh, charts, unlabelled(mesh), ink_of(4), {}, control);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

TEST(GridMap, EmptyMesh) {
  const BandMesh mesh;
  const GridMap map = solve(mesh, {}, {}, ink_of(4));
  EXPECT_TRUE(map.base.empty());
  EXPECT_EQ(map.alignment_energy, 0);
}

}  // namespace
}  // namespace inkgrid
