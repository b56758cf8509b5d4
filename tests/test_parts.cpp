// Scribbles solved locally: what they touch, what is kept, and that the pieces fit.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "chain_checks.h"
#include "drawn_bands.h"
#include "pipeline.h"
#include "scribbles/assembled.h"
#include "scribbles/parts.h"
#include "scribbles/window.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::circle;
using testing::drawn_ink;
using testing::paint;

ScaleMask mask_with(int width, int height, float factor, const std::function<bool(int, int)>& scribbled) {
  ScaleMask mask{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) mask.factor.push_back(scribbled(x, y) ? factor : 1);
  return mask;
}

TEST(Touched, DistancesRunAlongTheStroke) {
  // A hairpin: its arms are 30 px apart, and far along the stroke.
  const Ink ink = drawn_ink({{{20, 40}, {160, 40}, {160, 70}, {20, 70}}}, 6, 200);
  const ScaleMask mask = mask_with(200, 200, 0.5f, [](int x, int y) { return x >= 60 && x < 70 && y < 55; });
  const auto parts = touched_parts(mask, {}, ink, 0.3, 120);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(distance_at(parts[0], {65, 40.5}), 0);
  EXPECT_NEAR(static_cast<double>(distance_at(parts[0], {100.5, 40.5})), 31, 3);
  EXPECT_NEAR(static_cast<double>(distance_at(parts[0], {159.5, 60})), 110, 12);
  EXPECT_EQ(distance_at(parts[0], {65, 70}), kUnreached);
  EXPECT_EQ(distance_at(parts[0], {65, 55}), kUnreached);
  EXPECT_EQ(distance_at(parts[0], {-5, 40}), kUnreached);
}

TEST(Touched, BeyondTheEdgeTheBandIsThatOfTheEdge) {
  const Ink ink = drawn_ink({{{-10, 40}, {100, 40}}}, 6, 200);
  const auto parts = touched_parts(mask_with(200, 200, 0.5f, [](int x, int) { return x < 10; }), {}, ink, 0.3, 50);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(distance_at(parts[0], {-0.5, 40.5}), 0);
  EXPECT_EQ(distance_at(parts[0], {-3, 40.5}), 0);
  EXPECT_EQ(distance_at(parts[0], {-0.5, 60.5}), kUnreached);
  EXPECT_EQ(distance_at(parts[0], {200.5, 40.5}), kUnreached);
}

TEST(Touched, PartsAreThoseThatTheBandConnects) {
  const Ink ink = drawn_ink({{{20, 40}, {180, 40}}, {{20, 80}, {180, 80}}}, 6, 200);
  const auto over_both = [](int x, int) { return x >= 95 && x < 105; };
  EXPECT_EQ(touched_parts(mask_with(200, 200, 0.5f, over_both), {}, ink, 0.3, 30).size(), 2u);
  const auto twice_on_one = [](int x, int y) { return y < 60 && (std::abs(x - 60) < 5 || std::abs(x - 140) < 5); };
  EXPECT_EQ(touched_parts(mask_with(200, 200, 2.0f, twice_on_one), {}, ink, 0.3, 30).size(), 2u);
  EXPECT_EQ(touched_parts(mask_with(200, 200, 2.0f, twice_on_one), {}, ink, 0.3, 45).size(), 1u);
  const auto on_paper = [](int, int y) { return y > 120; };
  EXPECT_TRUE(touched_parts(mask_with(200, 200, 2.0f, on_paper), {}, ink, 0.3, 45).empty());
}

TEST(Touched, TheBandIsWiderWhereStrokesAreBundled) {
  const Ink ink = drawn_ink({{{20, 40}, {180, 40}}}, 6, 200);
  const ScaleMask mask = mask_with(200, 200, 0.5f, [](int x, int) { return std::abs(x - 60) < 5; });
  const ScaleMask bundles = mask_with(200, 200, 2.0f, [](int x, int) { return x >= 100; });
  const auto parts = touched_parts(mask, bundles, ink, 0.3, 120);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(distance_at(parts[0], {80.5, 49.5}), kUnreached);
  EXPECT_LT(distance_at(parts[0], {120.5, 49.5}), 80);
  EXPECT_EQ(distance_at(parts[0], {120.5, 52.5}), kUnreached);
}

TEST(Window, HoldsTheInkThatIsReached) {
  const Ink ink = drawn_ink({{{20, 40}, {180, 40}}, {{20, 60}, {180, 60}}}, 6, 200);
  const ScaleMask mask = mask_with(200, 200, 0.5f, [](int x, int y) { return std::abs(x - 100) < 4 && y < 50; });
  const auto parts = touched_parts(mask, {}, ink, 0.3, 20);
  ASSERT_EQ(parts.size(), 1u);
  const Ink window = window_of(ink, parts[0]);
  const ScaleMask crop = window_of(mask, parts[0]);
  ASSERT_EQ(crop.width, window.width());
  ASSERT_EQ(crop.height, window.height());
  long pixels = 0;
  for (int y = 0; y < window.height(); ++y)
    for (int x = 0; x < window.width(); ++x) {
      const int wx = x + static_cast<int>(window.origin.x), wy = y + static_cast<int>(window.origin.y);
      const bool reached = distance_at(parts[0], {wx + 0.5, wy + 0.5}) < kUnreached;
      EXPECT_EQ(window.mask(x, y) != 0, reached && ink.mask(wx, wy));
      EXPECT_EQ(window.darkness(x, y), ink.darkness(wx, wy));
      if (reached) {
        EXPECT_EQ(window.gap(x, y), ink.gap(wx, wy));
      }
      EXPECT_EQ(crop.factor[window.mask.index(x, y)], mask.factor[ink.mask.index(wx, wy)]);
      pixels += window.mask(x, y);
    }
  EXPECT_EQ(window.pixels, pixels);
  EXPECT_EQ(window.stroke_width, ink.stroke_width);
}

constexpr int kWide = 240, kHigh = 160;

// A grid of strokes and a circle apart.
Image drawing() {
  Image image = blank(kWide, kHigh);
  for (const double x : {40.0, 90.0}) paint(image, {{x, 10}, {x, 150}}, 5);
  for (const double y : {45.0, 110.0}) paint(image, {{15, y}, {140, y}}, 5);
  paint(image, circle({195, 80}, 30), 5);
  return image;
}

ScaleMask scribble_at(Vec2 centre, double radius, float factor) {
  return mask_with(kWide, kHigh, factor, [&](int x, int y) { return norm(Vec2{x + 0.5, y + 0.5} - centre) < radius; });
}

Stages with_mask(const ScaleMask& mask, const Options& options = {}) {
  Control control;
  control.mask = &mask;
  return run_stages(drawing(), options, control);
}

// The width of the strokes that the grid sees, over that of the pen.
double slimness(const Stages& stages) {
  return grid_ink(stages).stroke_width / stages.ink.stroke_width;
}

class EachFactor : public ::testing::TestWithParam<float> {};

TEST_P(EachFactor, WhatIsKnownIsKeptToTheLastDigit) {
  const Stages s = with_mask(scribble_at({90, 45}, 9, GetParam()));
  ASSERT_EQ(s.parts.size(), 1u);
  ASSERT_TRUE(s.parts[0]->local);
  const Known& known = s.parts[0]->window.known;
  const Stages& window = s.parts[0]->window.stages;
  std::vector<std::uint8_t> free(window.mesh.points.size(), 0);
  int kept = 0, solved = 0;
  for (int f = 0; f < window.mesh.face_count(); ++f)
    for (const int v : window.mesh.faces[static_cast<std::size_t>(f)])
      if (!known.faces[static_cast<std::size_t>(f)]) free[static_cast<std::size_t>(v)] = 1;
  for (int f = 0; f < window.mesh.face_count(); ++f) {
    const auto i = static_cast<std::size_t>(f);
    if (!known.faces[i]) continue;
    const auto old = static_cast<std::size_t>(face_of(known.corners[3 * i]));
    EXPECT_TRUE(window.charts.s[i] == s.charts.s[old]);
    EXPECT_EQ(window.labels[i], s.labels[old]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(known.corners[3 * i + k]);
      EXPECT_LT(norm(window.mesh.points[static_cast<std::size_t>(window.mesh.faces[i][k])] -
                     s.mesh.points[static_cast<std::size_t>(s.mesh.faces[corner / 3][corner % 3])]),
                1e-9);
      if (free[static_cast<std::size_t>(window.mesh.faces[i][k])]) continue;
      EXPECT_TRUE(window.exact.uv[3 * i + k] == s.exact.uv[corner]) << "face " << f;
      ++kept;
    }
  }
  for (const auto v : free) solved += v;
  EXPECT_GT(kept, 500);
  EXPECT_GT(solved, 500);
}

TEST_P(EachFactor, TheWholeIsAValidMesh) {
  const Stages s = with_mask(scribble_at({90, 45}, 9, GetParam()));
  const Stages whole = assembled(s);
  const BandMesh& mesh = whole.mesh;
  double area = 0;
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int twin = mesh.twins[static_cast<std::size_t>(h)];
    const auto vertex = [&](int c) { return mesh.faces[static_cast<std::size_t>(face_of(c))][static_cast<std::size_t>(c % 3)]; };
    if (h % 3 == 0)
      area += cross(mesh.points[static_cast<std::size_t>(vertex(h + 1))] - mesh.points[static_cast<std::size_t>(vertex(h))],
                    mesh.points[static_cast<std::size_t>(vertex(h + 2))] - mesh.points[static_cast<std::size_t>(vertex(h))]) /
              2;
    if (twin < 0) continue;
    ASSERT_EQ(mesh.twins[static_cast<std::size_t>(twin)], h);
    EXPECT_EQ(vertex(h), vertex(next_halfedge(twin)));
    EXPECT_EQ(vertex(next_halfedge(h)), vertex(twin));
    EXPECT_EQ((whole.charts.turns[static_cast<std::size_t>(h)] + whole.charts.turns[static_cast<std::size_t>(twin)]) % 4, 0);
  }
  // The band of the same mask, built at once, has the same parts and covers the same paper.
  const ScaleMask mask = scribble_at({90, 45}, 9, GetParam());
  const BandMesh at_once = build_band(s.slim, &mask, {*s.inputs.settled.reach / slimness(s), s.inputs.settled.mesh_size});
  EXPECT_EQ(mesh.components, at_once.components);
  EXPECT_EQ(testing::holes(mesh), testing::holes(at_once));
  double area_at_once = 0;
  for (const auto& t : at_once.faces)
    area_at_once += cross(at_once.points[static_cast<std::size_t>(t[1])] - at_once.points[static_cast<std::size_t>(t[0])],
                          at_once.points[static_cast<std::size_t>(t[2])] - at_once.points[static_cast<std::size_t>(t[0])]) /
                    2;
  // Triangles on the rim are bisected or not as their neighbours outside the band ask for.
  EXPECT_NEAR(area, area_at_once, 1e-3 * area);
  EXPECT_EQ(s.report.triangles, mesh.face_count());
  EXPECT_EQ(s.report.components, mesh.components);
}

// Isolines go on over the seam: every edge of the graph ends in a node or is closed, and no boundary node lies inside the band.
TEST_P(EachFactor, IsolinesGoOnOverTheSeam) {
  const Stages whole = assembled(with_mask(scribble_at({90, 45}, 9, GetParam())));
  const auto boundary = boundary_vertices(whole.mesh);
  int crossing = 0;
  for (const GraphNode& node : whole.graph.nodes) {
    if (node.kind != NodeKind::boundary) continue;
    int on_boundary = 0;
    for (const int v : whole.mesh.faces[static_cast<std::size_t>(node.face)])
      on_boundary += boundary[static_cast<std::size_t>(v)];
    EXPECT_GE(on_boundary, 2);
    ++crossing;
  }
  EXPECT_GT(crossing, 10);
}

// The frozen rim leaves the scribbled place the freedom that it needs.
TEST_P(EachFactor, ChainsAreWhereTheyAreWhenAllIsSolvedAtOnce) {
  const ScaleMask mask = scribble_at({90, 45}, 9, GetParam());
  const Stages s = with_mask(mask);
  const Stages whole = assembled(s);
  const Options& options = s.inputs.settled;
  const Ink& ink = s.slim;
  const BandMesh mesh = build_band(ink, &mask, {*options.reach / slimness(s), options.mesh_size});
  const FrameField field = solve_field(mesh, ink, {}, {});
  const Charts charts = comb_charts(mesh, field);
  const auto labels = label_strokes(mesh, charts, ink, {});
  const GridMapOptions map_options{
      *options.spacing / slimness(s), options.snap, options.snap_sigma, options.damping, options.merge_difference, 1};
  const GridMap map = solve_grid_map(mesh, charts, labels, ink, map_options, {});
  const Chains at_once = chain_strokes(trace_isolines(mesh, round_map(map), {}), mesh, spread_labels(mesh, charts, labels), ink);
  const Chains local = chain_strokes(whole.graph, whole.mesh, spread_labels(whole.mesh, whole.charts, whole.labels), ink);
  const auto farthest = [](const Chains& from, const Chains& to) {
    double most = 0;
    for (const Chain& c : from.chains)
      for (const Vec2 p : c.points) {
        double least = 1e9;
        for (const Chain& d : to.chains) least = std::min(least, testing::distance_to_line(p, d.points));
        most = std::max(most, least);
      }
    return most;
  };
  EXPECT_LT(farthest(local, at_once), 0.6 * ink.stroke_width);
  EXPECT_LT(farthest(at_once, local), 0.6 * ink.stroke_width);
}

INSTANTIATE_TEST_SUITE_P(Factors, EachFactor, ::testing::Values(0.25f, 0.5f, 0.7f, 1.5f, 2.0f));

std::vector<std::uint64_t> ids(const Drawing& drawing) {
  std::vector<std::uint64_t> result;
  for (const Curve& curve : drawing.curves) result.push_back(curve.id);
  return result;
}

// Index in `after` of each curve of `before`, or -1.
std::vector<int> kept(const Drawing& before, const Drawing& after) {
  const auto now = ids(after);
  std::vector<int> result;
  for (const std::uint64_t id : ids(before)) {
    const auto found = std::find(now.begin(), now.end(), id);
    result.push_back(found == now.end() ? -1 : static_cast<int>(found - now.begin()));
  }
  return result;
}

bool same_curve(const Curve& a, const Curve& b) {
  if (a.segments.size() != b.segments.size()) return false;
  for (std::size_t k = 0; k < a.segments.size(); ++k) {
    const Cubic &s = a.segments[k], &t = b.segments[k];
    if (!(s.p0 == t.p0 && s.p1 == t.p1 && s.p2 == t.p2 && s.p3 == t.p3)) return false;
  }
  return a.closed == b.closed && a.width == b.width && a.coverage == b.coverage;
}

TEST_P(EachFactor, CurvesThatAScribbleDoesNotTouchStayInOrderAndDoNotMove) {
  const Drawing before = run_stages(drawing(), {}, {}).drawing;
  const Drawing after = with_mask(scribble_at({90, 45}, 9, GetParam())).drawing;
  const auto places = kept(before, after);
  int last = -1, stayed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Curve& curve = before.curves[i];
    double least = 1e9;
    for (const Cubic& s : curve.segments)
      for (int k = 0; k <= 20; ++k) {
        const double t = k / 20.0, r = 1 - t;
        least = std::min(least,
                         norm(r * r * r * s.p0 + 3 * r * r * t * s.p1 + 3 * r * t * t * s.p2 + t * t * t * s.p3 - Vec2{90, 45}));
      }
    if (least > 40) {
      EXPECT_GE(places[i], 0) << "the curve " << least << " px away is another";
    }
    if (places[i] < 0) continue;
    EXPECT_GT(places[i], last);
    last = places[i];
    EXPECT_TRUE(same_curve(curve, after.curves[static_cast<std::size_t>(last)]));
    ++stayed;
  }
  EXPECT_GT(stayed, 4);
  EXPECT_LT(stayed, static_cast<int>(places.size()));
}

// A scribble over one of several parts of the band leaves the others alone, whatever the order of the scribbles.
TEST(Parts, ScribblesOnDifferentComponentsAreIndependent) {
  ScaleMask one = scribble_at({40, 110}, 9, 0.5f), other = scribble_at({195, 50}, 9, 2.0f), both = one;
  for (std::size_t i = 0; i < both.factor.size(); ++i)
    if (other.factor[i] != 1) both.factor[i] = other.factor[i];
  const Stages first = with_mask(one), second = with_mask(other), together = with_mask(both);
  ASSERT_EQ(together.parts.size(), 2u);
  const auto on_the_right = [](const Curve& c) { return c.segments[0].p0.x > 155; };
  for (const Curve& curve : together.drawing.curves) {
    const auto& alone = on_the_right(curve) ? second.drawing.curves : first.drawing.curves;
    EXPECT_TRUE(std::any_of(alone.begin(), alone.end(), [&](const Curve& c) { return same_curve(c, curve); }));
  }
}

TEST(Parts, AreUsedAgain) {
  const ScaleMask one = scribble_at({40, 110}, 9, 0.5f);
  ScaleMask both = one;
  const ScaleMask other = scribble_at({195, 50}, 9, 2.0f);
  for (std::size_t i = 0; i < both.factor.size(); ++i)
    if (other.factor[i] != 1) both.factor[i] = other.factor[i];
  Stages stages = with_mask(one);
  const auto part = stages.parts.at(0);
  Control control;
  control.mask = &both;
  rerun_stages(stages, drawing(), {}, control);
  EXPECT_NE(std::find(stages.parts.begin(), stages.parts.end(), part), stages.parts.end());
  Options closer;
  closer.tolerance = 0.05;
  rerun_stages(stages, drawing(), closer, control);
  EXPECT_NE(std::find(stages.parts.begin(), stages.parts.end(), part), stages.parts.end());
  Options wider;
  wider.spacing = 0.9;
  rerun_stages(stages, drawing(), wider, control);
  EXPECT_EQ(std::find(stages.parts.begin(), stages.parts.end(), part), stages.parts.end());
}

TEST(Parts, AMaskOfOnesIsNone) {
  const Stages none = run_stages(drawing(), {}, {});
  const Stages ones = with_mask(scribble_at({90, 45}, 9, 1.0f));
  EXPECT_TRUE(ones.parts.empty());
  EXPECT_EQ(ids(ones.drawing), ids(none.drawing));
}

// All of it under one scribble: nothing is kept.
TEST(Parts, AStrokeThatLeavesTheImageIsScribbledAtItsEdge) {
  Image image = blank(kWide, kHigh);
  paint(image, {{-10, 60}, {kWide + 10, 60}}, 5);
  paint(image, {{80, -10}, {80, kHigh + 10}}, 5);
  for (const Vec2 edge : {Vec2{0, 60}, Vec2{kWide, 60}, Vec2{80, 0}, Vec2{80, kHigh}})
    for (const float factor : {0.5f, 2.0f}) {
      const ScaleMask mask = scribble_at(edge, 14, factor);
      Control control;
      control.mask = &mask;
      const Stages s = run_stages(image, {}, control);
      ASSERT_EQ(s.parts.size(), 1u);
      EXPECT_TRUE(s.parts[0]->local);
      const Stages& window = s.parts[0]->window.stages;
      for (int f = 0; f < window.mesh.face_count(); ++f)
        if (norm(window.mesh.barycentre(f) - edge) < 10) {
          EXPECT_FALSE(s.parts[0]->window.known.faces[static_cast<std::size_t>(f)]) << "under the scribble nothing is kept";
        }
      Stages whole;
      ASSERT_NO_THROW(whole = assembled(s)) << edge.x << ", " << edge.y << " times " << factor;
      EXPECT_FALSE(whole.graph.edges.empty());
    }
}

class EachBundle : public ::testing::TestWithParam<int> {};

// The band of a bundle is wider than that of its pen, its triangles are larger, and a scribble over it replaces all of it.
TEST_P(EachBundle, AScribbleOverItFitsWhatIsAroundIt) {
  Image image = blank(kWide, kHigh);
  for (int k = 0; k < GetParam(); ++k) paint(image, {{20 + 9.0 * k, 60 + 9.0 * k}, {220 - 9.0 * k, 70 + 9.0 * k}}, 5);
  Options options;
  options.preset = Preset::rough;
  options.bundles = BundleMode::join;
  for (int x = 40; x <= 200; x += 20)
    for (const float factor : {0.5f, 2.0f}) {
      const ScaleMask mask = scribble_at({static_cast<double>(x), 70}, 14, factor);
      Control control;
      control.mask = &mask;
      const Stages s = run_stages(image, options, control);
      ASSERT_GT(s.bundles.count, 0);
      EXPECT_NO_THROW(assembled(s)) << x << " times " << factor;
    }
}

INSTANTIATE_TEST_SUITE_P(Strokes, EachBundle, ::testing::Values(3, 4));

TEST(Parts, ChainsThatNowhereFitTheOldOnesTakeTheirPlace) {
  Stages plain = with_mask(scribble_at({90, 45}, 9, 0.5f));
  plain.parts.clear();
  Window window;
  Chain out_of_the_image;
  out_of_the_image.points = {{90, 45}, {90, -60}};
  window.stages.plain.chains = {out_of_the_image};
  const Scribbled scribbled = solve_scribbles(plain, [&](const ScaleMask&, const TouchedPart&, double) { return window; });
  ASSERT_EQ(scribbled.parts.size(), 1u);
  EXPECT_FALSE(scribbled.parts[0]->local);
  ASSERT_EQ(scribbled.chains.chains.size(), 1u);
  EXPECT_EQ(scribbled.chains.chains[0].points, out_of_the_image.points);
}

TEST(Parts, AScribbleOverEverythingSolvesEverything) {
  const Stages s = with_mask(scribble_at({120, 80}, 500, 0.5f));
  for (const auto& part : s.parts)
    for (const auto known : part->window.known.faces) EXPECT_FALSE(known);
  EXPECT_GE(s.drawing.curves.size(), 9u);
}

}  // namespace
}  // namespace inkgrid
