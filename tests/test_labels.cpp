#include <gtest/gtest.h>

#include <cmath>

#include "drawn_bands.h"
#include "map/labels.h"

namespace inkgrid {
namespace {

using Lines = std::vector<std::vector<Vec2>>;

struct Labelled {
  Ink ink;
  BandMesh mesh;
  Charts charts;
  std::vector<Label> labels;

  bool has_label(int f) const { return labels[static_cast<std::size_t>(f)] != Label::none; }
  // Between the direction a face is labelled with and d, 0 .. 90 degrees.
  double degrees_off(int f, Vec2 d) const {
    const auto i = static_cast<std::size_t>(f);
    const Vec2 along = labels[i] == Label::along_s ? charts.s[i] : charts.t[i];
    return std::atan2(std::abs(cross(along, d)), std::abs(dot(along, d))) * 180 / std::numbers::pi;
  }
};

Labelled labelled(const Lines& lines, double width, double reach = 0.3) {
  Labelled l;
  l.ink = testing::drawn_ink(lines, width, 300);
  l.mesh = build_band(l.ink, nullptr, {reach, 0.25});
  l.charts = comb_charts(l.mesh, solve_field(l.mesh, l.ink, {}, {}));
  l.labels = label_strokes(l.mesh, l.charts, l.ink, {});
  return l;
}

// Every face on ink where `where` holds is labelled with a direction within 10 degrees of `along`; returns how many.
template <class Where, class Along>
int expect_along(const Labelled& l, Where where, Along along) {
  int seen = 0;
  for (int f = 0; f < l.mesh.face_count(); ++f) {
    const Vec2 p = l.mesh.barycentre(f);
    if (!l.mesh.on_ink[static_cast<std::size_t>(f)] || !where(p)) continue;
    ++seen;
    EXPECT_TRUE(l.has_label(f)) << p.x << ' ' << p.y;
    if (l.has_label(f)) {
      EXPECT_LT(l.degrees_off(f, along(p)), 10) << p.x << ' ' << p.y;
    }
  }
  return seen;
}

class StraightLine : public ::testing::TestWithParam<double> {};

TEST_P(StraightLine, IsLabelledAlongItself) {
  const double a = GetParam() * std::numbers::pi / 180;
  const Vec2 middle{150, 150}, d{std::cos(a), std::sin(a)};
  const Labelled l = labelled({{middle - 110 * d, middle + 110 * d}}, 10);
  EXPECT_GT(expect_along(
                l, [&](Vec2 p) { return norm(p - middle) < 95; }, [&](Vec2) { return d; }),
            200);
}

INSTANTIATE_TEST_SUITE_P(Labels, StraightLine, ::testing::Values(0.0, 25.0, 45.0, 90.0, 140.0));

// Ink that is thickened by a pixel leaves no paper between them.
TEST(Labels, StrokesOfTwoPixelsTwoPixelsApart) {
  Lines lines;
  for (int k = 0; k < 12; ++k) lines.push_back({{60, 101.0 + 4 * k}, {240, 101.0 + 4 * k}});
  const Labelled l = labelled(lines, 2);
  EXPECT_GT(expect_along(
                l, [](Vec2 p) { return p.x > 80 && p.x < 220 && p.y > 110 && p.y < 137; },
                [](Vec2) {
                  return Vec2{1, 0};
                }),
            100);
}

TEST(Labels, BothArmsOfAnL) {
  const Labelled l = labelled({{{60, 60}, {60, 240}, {240, 240}}}, 10);
  EXPECT_GT(expect_along(
                l, [](Vec2 p) { return p.y > 80 && p.y < 225; },
                [](Vec2) {
                  return Vec2{0, 1};
                }),
            100);
  EXPECT_GT(expect_along(
                l, [](Vec2 p) { return p.x > 75 && p.x < 220; },
                [](Vec2) {
                  return Vec2{1, 0};
                }),
            100);
}

TEST(Labels, ACircleAllAround) {
  const Vec2 middle{150, 150};
  const Labelled l = labelled({testing::circle(middle, 90)}, 10);
  EXPECT_GT(expect_along(
                l, [](Vec2) { return true; }, [&](Vec2 p) { return quarter_turn(p - middle); }),
            500);
}

TEST(Labels, PaperHasNone) {
  const Labelled l = labelled({{{60, 60}, {60, 240}, {240, 240}}}, 10, 1);
  int paper = 0;
  for (int f = 0; f < l.mesh.face_count(); ++f) {
    if (l.mesh.on_ink[static_cast<std::size_t>(f)]) continue;
    ++paper;
    EXPECT_FALSE(l.has_label(f));
  }
  EXPECT_GT(paper, 100);
}

TEST(Labels, TheMiddleOfACrossingIsUndecided) {
  const Vec2 middle{150, 150};
  const Labelled l = labelled({{{50, 150}, {250, 150}}, {{150, 50}, {150, 250}}}, 12);
  int inner = 0;
  for (int f = 0; f < l.mesh.face_count(); ++f) {
    const Vec2 p = l.mesh.barycentre(f);
    if (norm(p - middle) > 3) continue;
    ++inner;
    EXPECT_FALSE(l.has_label(f)) << p.x << ' ' << p.y;
  }
  EXPECT_GT(inner, 5);
  EXPECT_GT(expect_along(
                l, [](Vec2 p) { return std::abs(p.x - 150) > 15 && std::abs(p.x - 150) < 90; },
                [](Vec2) {
                  return Vec2{1, 0};
                }),
            100);
}

TEST(Labels, AShortCrossBarDoesNotStopALongLine) {
  const Vec2 middle{150, 150};
  const Labelled l = labelled({{{50, 150}, {250, 150}}, {{150, 138}, {150, 162}}}, 8);
  EXPECT_GT(expect_along(
                l, [&](Vec2 p) { return norm(p - middle) < 3; },
                [](Vec2) {
                  return Vec2{1, 0};
                }),
            5);
}

TEST(SpreadLabels, ReachThePaperBetweenCloseStrokesAndNothingElse) {
  const Labelled before = labelled({{{40, 150}, {260, 150}}, {{40, 164}, {260, 164}}}, 8, 0.5);
  Labelled after = before;
  after.labels = spread_labels(before.mesh, before.charts, before.labels);
  int slit = 0;
  for (int f = 0; f < before.mesh.face_count(); ++f) {
    const auto i = static_cast<std::size_t>(f);
    const Vec2 p = before.mesh.barycentre(f);
    if (before.mesh.on_ink[i]) {
      EXPECT_EQ(after.labels[i], before.labels[i]);
    } else if (p.x > 50 && p.x < 250) {
      const bool between = p.y > 154 && p.y < 160;
      EXPECT_EQ(after.has_label(f), between) << p.x << ' ' << p.y;
      if (!between) continue;
      ++slit;
      EXPECT_LT(after.degrees_off(f, {1, 0}), 10) << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(slit, 100);
}

TEST(SpreadLabels, FollowTheTurnsOfCuts) {
  // Two faces of one stroke, the second in a chart turned by a quarter: the same line is along t there.
  BandMesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  mesh.twins = {-1, -1, 3, 2, -1, -1};
  mesh.on_ink = {1, 0};
  mesh.in_stroke = {1, 1};
  Charts charts;
  charts.turns.assign(6, 0);
  for (const int turn : {0, 1, 2, 3}) {
    charts.turns[2] = static_cast<std::uint8_t>(turn);
    charts.turns[3] = static_cast<std::uint8_t>((4 - turn) % 4);
    const Label same = turn % 2 ? Label::along_t : Label::along_s, other = turn % 2 ? Label::along_s : Label::along_t;
    EXPECT_EQ(spread_labels(mesh, charts, {Label::along_s, Label::none})[1], same);
    EXPECT_EQ(spread_labels(mesh, charts, {Label::along_t, Label::none})[1], other);
  }
  mesh.in_stroke[1] = 0;
  EXPECT_EQ(spread_labels(mesh, charts, {Label::along_s, Label::none})[1], Label::none);
}

}  // namespace
}  // namespace inkgrid
