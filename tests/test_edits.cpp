// Hand edits: what is deleted, split and joined, that everything else stays as it was, and that places find their curves again.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/cubic.h"
#include "project/edits.h"

namespace inkgrid {
namespace {

Cubic straight(Vec2 a, Vec2 b) {
  return {a, lerp(a, b, 1 / 3.0), lerp(a, b, 2 / 3.0), b};
}

Curve polyline(const std::vector<Vec2>& points, int start = -1, int end = -1) {
  Curve curve;
  for (std::size_t i = 1; i < points.size(); ++i) curve.segments.push_back(straight(points[i - 1], points[i]));
  curve.start_junction = start;
  curve.end_junction = end;
  curve.width = 2;
  curve.coverage = 1;
  return curve;
}

Curve circle(Vec2 centre, double radius) {
  const double k = radius * 0.5522847498;
  const Vec2 axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  Curve curve;
  for (int i = 0; i < 4; ++i) {
    const Vec2 u = axes[i], v = axes[(i + 1) % 4];
    curve.segments.push_back(
        {centre + radius * u, centre + radius * u + k * v, centre + radius * v + k * u, centre + radius * v});
  }
  curve.closed = true;
  return curve;
}

// Three branches that meet in junction 0 at (50, 50), and a curve between it and junction 1, where a fifth ends too.
Drawing tree() {
  Drawing drawing;
  drawing.width = drawing.height = 200;
  drawing.junctions = {{50, 50}, {100, 50}};
  drawing.curves = {polyline({{0, 50}, {50, 50}}, -1, 0), polyline({{50, 0}, {50, 50}}, -1, 0),
                    polyline({{50, 50}, {100, 50}}, 0, 1), polyline({{100, 50}, {150, 20}}, 1, -1),
                    polyline({{100, 50}, {150, 80}}, 1, -1)};
  for (Curve& curve : drawing.curves) curve.id = 1000 + static_cast<std::uint64_t>(&curve - drawing.curves.data());
  return drawing;
}

Edit removal(Vec2 at) {
  return {EditKind::remove, at, {}, 8};
}
Edit split(Vec2 at) {
  return {EditKind::split, at, {}, 8};
}
Edit join(Vec2 at, Vec2 to) {
  return {EditKind::join, at, to, 8};
}

Drawing edited(const Drawing& drawing, std::vector<Edit> edits) {
  const Edited result = apply_edits(drawing, edits);
  EXPECT_TRUE(result.missed.empty());
  return result.drawing;
}

double length_of(const Curve& curve) {
  double length = 0;
  for (const Cubic& c : curve.segments)
    for (int i = 0; i < 200; ++i) length += norm(point_on(c, (i + 1) / 200.0) - point_on(c, i / 200.0));
  return length;
}

double total_length(const Drawing& drawing) {
  double length = 0;
  for (const Curve& curve : drawing.curves) length += length_of(curve);
  return length;
}

// What every drawing promises (include/inkgrid/drawing.h).
void check(const Drawing& drawing) {
  std::vector<int> ends(drawing.junctions.size(), 0);
  for (const Curve& curve : drawing.curves) {
    ASSERT_FALSE(curve.segments.empty());
    for (std::size_t i = 1; i < curve.segments.size(); ++i) EXPECT_EQ(curve.segments[i - 1].p3, curve.segments[i].p0);
    if (curve.closed) {
      EXPECT_EQ(curve.segments.back().p3, curve.segments.front().p0);
      EXPECT_EQ(curve.start_junction, -1);
      EXPECT_EQ(curve.end_junction, -1);
    }
    for (const auto& [junction, point] :
         {std::pair{curve.start_junction, curve.segments.front().p0}, std::pair{curve.end_junction, curve.segments.back().p3}}) {
      ASSERT_LT(junction, static_cast<int>(drawing.junctions.size()));
      if (junction < 0) continue;
      ++ends[static_cast<std::size_t>(junction)];
      EXPECT_EQ(drawing.junctions[static_cast<std::size_t>(junction)], point);
    }
  }
  for (const int count : ends) EXPECT_GE(count, 1);
}

void expect_equal(const Curve& a, const Curve& b) {
  EXPECT_EQ(a.id, b.id);
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    EXPECT_EQ(a.segments[i].p0, b.segments[i].p0);
    EXPECT_EQ(a.segments[i].p1, b.segments[i].p1);
    EXPECT_EQ(a.segments[i].p2, b.segments[i].p2);
    EXPECT_EQ(a.segments[i].p3, b.segments[i].p3);
  }
  EXPECT_EQ(a.closed, b.closed);
  EXPECT_EQ(a.width, b.width);
}

TEST(Places, NearestIsThatOfADenseSearch) {
  Drawing drawing;
  Curve wave;
  wave.segments = {{{10, 10}, {60, -40}, {20, 120}, {90, 60}}, {{90, 60}, {130, 30}, {140, 90}, {160, 20}}};
  drawing.curves = {circle({80, 110}, 30), wave};
  for (int x = -20; x < 200; x += 13)
    for (int y = -20; y < 180; y += 11) {
      const Vec2 p{static_cast<double>(x), static_cast<double>(y)};
      double least = 1e9;
      for (const Curve& curve : drawing.curves)
        for (const Cubic& c : curve.segments)
          for (int i = 0; i <= 2000; ++i) least = std::min(least, norm(point_on(c, i / 2000.0) - p));
      const auto place = nearest_place(drawing, p, 1e9);
      ASSERT_TRUE(place);
      EXPECT_NEAR(place->distance, least, 0.01) << x << ", " << y;
      EXPECT_LE(place->distance, least + 1e-9);
      const Curve& curve = drawing.curves[static_cast<std::size_t>(place->curve)];
      EXPECT_EQ(point_on(curve.segments[static_cast<std::size_t>(place->segment)], place->t), place->point);
      EXPECT_FALSE(nearest_place(drawing, p, 0.99 * place->distance));
    }
}

TEST(Places, OfEquallyNearCurvesTheFirst) {
  EXPECT_EQ(nearest_place(tree(), {50, 50}, 1)->curve, 0);
  EXPECT_FALSE(nearest_place(Drawing{}, {0, 0}, 1e9));
}

TEST(Anchors, EachCurveIsFoundAgainAtItsOwn) {
  Drawing drawing = tree();
  drawing.curves.push_back(circle({150, 150}, 20));
  for (int i = 0; i < static_cast<int>(drawing.curves.size()); ++i) {
    const auto place = nearest_place(drawing, anchor_of(drawing, i), 1);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->curve, i);
    EXPECT_LT(place->distance, 1e-6);
  }
}

TEST(Anchors, AreFarFromOtherCurves) {
  // The nearest other curve is as far as it gets: 15 px from a point of the middle of curve 2, not 0 as at its ends.
  const Drawing drawing = tree();
  Drawing others = drawing;
  others.curves.erase(others.curves.begin() + 2);
  EXPECT_GT(nearest_place(others, anchor_of(drawing, 2), 1e9)->distance, 20);
}

TEST(Anchors, OfAnEndAreInItsHalf) {
  const Drawing drawing = tree();
  for (const bool at_end : {false, true})
    for (int i = 0; i < 5; ++i) {
      const Curve& curve = drawing.curves[static_cast<std::size_t>(i)];
      const Vec2 p = anchor_of_end(drawing, i, at_end), a = curve.segments.front().p0, b = curve.segments.back().p3;
      EXPECT_EQ(nearest_place(drawing, p, 1)->curve, i);
      EXPECT_EQ(norm(p - b) < norm(p - a), at_end);
    }
}

TEST(Edits, NoneChangesNothing) {
  const Drawing before = tree(), after = edited(before, {});
  EXPECT_EQ(after.junctions, before.junctions);
  ASSERT_EQ(after.curves.size(), before.curves.size());
  for (std::size_t i = 0; i < before.curves.size(); ++i) expect_equal(after.curves[i], before.curves[i]);
}

TEST(Delete, TakesTheNearestCurveAndLeavesTheOthers) {
  const Drawing before = tree(), after = edited(before, {removal({25, 53})});
  check(after);
  ASSERT_EQ(after.curves.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) expect_equal(after.curves[i], before.curves[i + 1]);
  EXPECT_EQ(after.junctions, before.junctions);
}

TEST(Delete, AJunctionThatJoinsNothingMoreIsDropped) {
  const Drawing after = edited(tree(), {removal({25, 50}), removal({50, 25})});
  check(after);
  ASSERT_EQ(after.junctions.size(), 1u);
  EXPECT_EQ(after.junctions[0], (Vec2{100, 50}));
  EXPECT_EQ(after.curves[0].start_junction, -1);
  EXPECT_EQ(after.curves[0].end_junction, 0);
}

TEST(Delete, TheLastCurveLeavesNothing) {
  std::vector<Edit> edits;
  for (int i = 0; i < 5; ++i) edits.push_back({EditKind::remove, {75, 50}, {}, 1e6});
  const Drawing after = edited(tree(), edits);
  EXPECT_TRUE(after.curves.empty());
  EXPECT_TRUE(after.junctions.empty());
}

TEST(Delete, BeyondTheToleranceIsMissed) {
  const Edit far{EditKind::remove, {25, 70}, {}, 19.9}, near{EditKind::remove, {25, 70}, {}, 20.1};
  const Edited result = apply_edits(tree(), std::vector<Edit>{far, near, far});
  EXPECT_EQ(result.missed, (std::vector<int>{0, 2}));
  EXPECT_EQ(result.drawing.curves.size(), 4u);
}

TEST(Split, PartsLieOnTheCurveAndShareAJunction) {
  const Drawing before = tree(), after = edited(before, {split({20, 51})});
  check(after);
  ASSERT_EQ(after.curves.size(), 6u);
  EXPECT_EQ(after.curves[0].segments.back().p3, after.curves[1].segments.front().p0);
  EXPECT_NEAR(norm(after.curves[0].segments.back().p3 - Vec2{20, 50}), 0, 1e-6);
  EXPECT_EQ(after.curves[0].end_junction, 2);
  EXPECT_EQ(after.curves[1].start_junction, 2);
  EXPECT_EQ(after.curves[1].end_junction, 0);
  EXPECT_NEAR(total_length(after), total_length(before), 1e-6);
  for (std::size_t i = 2; i < 6; ++i) expect_equal(after.curves[i], before.curves[i - 1]);
}

TEST(Split, AtAJointCutsNoSegment) {
  Drawing drawing;
  drawing.curves = {polyline({{0, 0}, {40, 0}, {40, 30}, {80, 30}})};
  const Drawing after = edited(drawing, {split({41, -1})});
  check(after);
  ASSERT_EQ(after.curves.size(), 2u);
  EXPECT_EQ(after.curves[0].segments.size(), 1u);
  EXPECT_EQ(after.curves[1].segments.size(), 2u);
}

TEST(Split, AClosedCurveOpensAtThePlace) {
  Drawing drawing;
  drawing.curves = {circle({50, 50}, 30)};
  for (const double angle : {0.0, 0.3, 1.5707963267948966, 4.0}) {
    const Drawing after = edited(drawing, {split(Vec2{50, 50} + 33 * Vec2{std::cos(angle), std::sin(angle)})});
    check(after);
    ASSERT_EQ(after.curves.size(), 1u);
    const Curve& curve = after.curves[0];
    EXPECT_FALSE(curve.closed);
    EXPECT_EQ(curve.start_junction, 0);
    EXPECT_EQ(curve.end_junction, 0);
    EXPECT_NEAR(norm(curve.segments.front().p0 - (Vec2{50, 50} + 30 * Vec2{std::cos(angle), std::sin(angle)})), 0, 0.02);
    EXPECT_NEAR(length_of(curve), length_of(drawing.curves[0]), 1e-3);
  }
}

TEST(Split, AtAnEndIsMissed) {
  EXPECT_EQ(apply_edits(tree(), std::vector<Edit>{split({0, 50}), split({-3, 50}), split({0.4, 50}), split({49.6, 51})}).missed,
            (std::vector<int>{0, 1, 2, 3}));
  EXPECT_TRUE(apply_edits(tree(), std::vector<Edit>{split({0.6, 50})}).missed.empty());
}

TEST(Join, EndsThatMeetBecomeOneCurveWithoutANewSegment) {
  // Branches 0 and 2 run into each other at junction 0; branch 1 goes on ending there.
  const Drawing before = tree(), after = edited(before, {join({40, 50}, {60, 50})});
  check(after);
  ASSERT_EQ(after.curves.size(), 4u);
  EXPECT_EQ(after.curves[0].segments.size(), 2u);
  EXPECT_EQ(after.curves[0].start_junction, -1);
  EXPECT_EQ(after.curves[0].end_junction, 1);
  EXPECT_EQ(after.curves[1].end_junction, 0);
  EXPECT_EQ(after.junctions, before.junctions);
  EXPECT_NEAR(total_length(after), total_length(before), 1e-9);
}

TEST(Join, OfTheLastTwoEndsDropsTheJunction) {
  const Drawing after = edited(tree(), {removal({50, 20}), join({40, 50}, {60, 50})});
  check(after);
  EXPECT_EQ(after.junctions, (std::vector<Vec2>{{100, 50}}));
  EXPECT_EQ(after.curves[0].end_junction, 0);
}

TEST(Join, EveryPairOfEndsWhateverTheirDirection) {
  for (const bool turn_first : {false, true})
    for (const bool turn_second : {false, true}) {
      Drawing drawing;
      drawing.curves = {turn_first ? polyline({{40, 0}, {0, 0}}) : polyline({{0, 0}, {40, 0}}),
                        turn_second ? polyline({{100, 0}, {50, 0}}) : polyline({{50, 0}, {100, 0}})};
      const Drawing after = edited(drawing, {join({38, 1}, {52, 1})});
      check(after);
      ASSERT_EQ(after.curves.size(), 1u);
      ASSERT_EQ(after.curves[0].segments.size(), 3u);
      EXPECT_EQ(after.curves[0].segments.front().p0, (Vec2{0, 0}));
      EXPECT_EQ(after.curves[0].segments.back().p3, (Vec2{100, 0}));
      EXPECT_NEAR(length_of(after.curves[0]), 100, 1e-9);  // the bridge goes straight on
    }
}

TEST(Join, BridgeLeavesAlongBothTangents) {
  Drawing drawing;
  drawing.curves = {polyline({{0, 0}, {40, 0}}), polyline({{60, 20}, {60, 60}})};
  const Curve curve = edited(drawing, {join({38, 0}, {60, 24})}).curves[0];
  ASSERT_EQ(curve.segments.size(), 3u);
  EXPECT_NEAR(cross(unit(curve.segments[1].p1 - curve.segments[1].p0), {1, 0}), 0, 1e-12);
  EXPECT_GT(curve.segments[1].p1.x, 40);
  EXPECT_NEAR(cross(unit(curve.segments[1].p3 - curve.segments[1].p2), {0, 1}), 0, 1e-12);
  EXPECT_LT(curve.segments[1].p2.y, 20);
}

TEST(Join, AGapOfATenthOfAPixelIsBridged) {
  Drawing drawing;
  drawing.curves = {polyline({{0, 0}, {40, 0}}), polyline({{40.1, 0}, {80, 0}})};
  const Drawing after = edited(drawing, {join({38, 0}, {42, 0})});
  check(after);
  EXPECT_EQ(after.curves[0].segments.size(), 3u);
}

TEST(Join, WidthIsTheMeanByLength) {
  Drawing drawing;
  drawing.curves = {polyline({{0, 0}, {30, 0}}), polyline({{30, 0}, {120, 0}})};
  drawing.curves[0].width = 6;
  drawing.curves[0].coverage = 0.6;
  const Drawing after = edited(drawing, {join({25, 0}, {40, 0})});
  EXPECT_NEAR(after.curves[0].width, 3, 1e-9);
  EXPECT_NEAR(after.curves[0].coverage, 0.9, 1e-9);
}

TEST(Join, BothEndsOfOneCurveCloseIt) {
  Drawing drawing;
  drawing.curves = {polyline({{0, 0}, {40, 0}, {40, 40}, {0, 40}})};
  const Drawing after = edited(drawing, {join({2, 0}, {2, 40})});
  check(after);
  ASSERT_EQ(after.curves.size(), 1u);
  EXPECT_TRUE(after.curves[0].closed);
  EXPECT_EQ(after.curves[0].segments.size(), 4u);
}

TEST(Join, SplitUndoesItAndItUndoesASplit) {
  const Drawing before = tree();
  const Drawing again = edited(before, {split({20, 50}), join({15, 50}, {25, 50})});
  check(again);
  ASSERT_EQ(again.curves.size(), before.curves.size());
  EXPECT_EQ(again.junctions, before.junctions);
  EXPECT_NEAR(length_of(again.curves[0]), length_of(before.curves[0]), 1e-9);
  Drawing ring;
  ring.curves = {circle({50, 50}, 30)};
  const Drawing closed = edited(ring, {split({80, 50}), join({79, 60}, {79, 40})});
  check(closed);
  EXPECT_TRUE(closed.curves[0].closed);
  EXPECT_TRUE(closed.junctions.empty());
}

TEST(Join, OfOneEndWithItselfOrWithAClosedCurveIsMissed) {
  Drawing drawing = tree();
  drawing.curves.push_back(circle({150, 150}, 20));
  EXPECT_EQ(
      apply_edits(drawing, std::vector<Edit>{join({5, 50}, {6, 50}), join({5, 50}, {170, 150}), join({5, 50}, {5, 120})}).missed,
      (std::vector<int>{0, 1, 2}));
}

std::set<std::uint64_t> ids_of(const Drawing& drawing) {
  std::set<std::uint64_t> ids;
  for (const Curve& curve : drawing.curves) EXPECT_TRUE(ids.insert(curve.id).second);
  return ids;
}

TEST(Edits, ChangedCurvesHaveNewIdsThatAreTheSameAgain) {
  const std::set<std::uint64_t> before = ids_of(tree());
  for (const Edit& edit : {split({20, 50}), join({40, 50}, {60, 50})}) {
    const Drawing after = edited(tree(), {edit});
    const std::set<std::uint64_t> ids = ids_of(after);
    EXPECT_EQ(ids, ids_of(edited(tree(), {edit})));
    for (const Curve& curve : after.curves) {
      const bool kept = std::any_of(before.begin(), before.end(), [&](std::uint64_t id) { return id == curve.id; });
      EXPECT_EQ(kept, curve.segments.size() == 1 && length_of(curve) > 45);
    }
  }
}

TEST(Edits, MeanTheSameCurvesAfterTheDrawingMovedALittle) {
  const Drawing before = tree();
  Drawing moved = before;
  const auto shift = [](Vec2 p) { return p + Vec2{1.5, -1}; };
  for (Vec2& p : moved.junctions) p = shift(p);
  for (Curve& curve : moved.curves)
    for (Cubic& c : curve.segments) c = {shift(c.p0), shift(c.p1), shift(c.p2), shift(c.p3)};
  const std::vector<Edit> edits{removal(anchor_of(before, 1)),
                                join(anchor_of_end(before, 0, true), anchor_of_end(before, 2, false)),
                                split(anchor_of(before, 4))};
  const Drawing here = edited(before, edits), there = edited(moved, edits);
  ASSERT_EQ(there.curves.size(), here.curves.size());
  for (std::size_t i = 0; i < here.curves.size(); ++i) {
    EXPECT_EQ(there.curves[i].start_junction, here.curves[i].start_junction);
    EXPECT_EQ(there.curves[i].end_junction, here.curves[i].end_junction);
    EXPECT_NEAR(norm(there.curves[i].segments.back().p3 - here.curves[i].segments.back().p3), 1.8, 1.5);
  }
}

}  // namespace
}  // namespace inkgrid
