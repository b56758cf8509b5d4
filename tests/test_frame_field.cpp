#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "drawn_bands.h"
#include "field/frame_field.h"

namespace inkgrid {
namespace {

using std::numbers::pi;
using testing::drawn_ink;

using Lines = std::vector<std::vector<Vec2>>;

constexpr Vec2 kMiddle{150, 150};

struct Field {
  Ink ink;
  BandMesh mesh;
  FrameField field;

  Frame at(int v) const { return frame_of(field.c0[static_cast<std::size_t>(v)], field.c2[static_cast<std::size_t>(v)]); }
  // The polynomial interpolated at a point of the band.
  Frame within(Vec2 p) const {
    for (const auto& t : mesh.faces) {
      const Vec2 a = point(t[0]), b = point(t[1]), c = point(t[2]);
      const double area = cross(b - a, c - a);
      const double weight[] = {cross(b - p, c - p) / area, cross(c - p, a - p) / area, cross(a - p, b - p) / area};
      if (*std::min_element(weight, weight + 3) < -1e-9) continue;
      Complex c0 = 0, c2 = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        c0 += weight[k] * field.c0[static_cast<std::size_t>(t[k])];
        c2 += weight[k] * field.c2[static_cast<std::size_t>(t[k])];
      }
      return frame_of(c0, c2);
    }
    ADD_FAILURE() << "outside the band: " << p.x << ' ' << p.y;
    return {};
  }
  Vec2 point(int v) const { return mesh.points[static_cast<std::size_t>(v)]; }
};

Field solved(const Lines& lines, double width, const FieldOptions& options = {}) {
  Field f;
  f.ink = drawn_ink(lines, width, 300);
  f.mesh = build_band(f.ink, nullptr, {});
  f.field = solve_field(f.mesh, f.ink, options, {});
  return f;
}

Vec2 direction(double degrees) {
  return {std::cos(degrees * pi / 180), std::sin(degrees * pi / 180)};
}

std::vector<Vec2> bar(double degrees, double half_length = 110) {
  return {kMiddle - half_length * direction(degrees), kMiddle + half_length * direction(degrees)};
}

// Between two lines, 0 .. 90 degrees.
double degrees_between(Vec2 a, Vec2 b) {
  return std::atan2(std::abs(cross(a, b)), std::abs(dot(a, b))) * 180 / pi;
}

double degrees_off(const Frame& frame, Vec2 d) {
  return std::min(degrees_between(frame.a, d), degrees_between(frame.b, d));
}

// How far the frames are apart as pairs of lines.
double degrees_off(const Frame& a, const Frame& b) {
  return std::min(std::max(degrees_between(a.a, b.a), degrees_between(a.b, b.b)),
                  std::max(degrees_between(a.a, b.b), degrees_between(a.b, b.a)));
}

double part_degenerate(const Field& f, const FieldOptions& options) {
  int count = 0;
  for (int v = 0; v < f.mesh.vertex_count(); ++v) {
    const Frame frame = f.at(v);
    const double a = norm(frame.a), b = norm(frame.b);
    count += degrees_between(frame.a, frame.b) < options.degenerate_angle ||
             std::min(a, b) < options.degenerate_ratio * std::max(a, b);
  }
  return static_cast<double>(count) / f.mesh.vertex_count();
}

TEST(FrameOf, RootsOfThePolynomial) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 2000; ++k) {
    const double size = std::pow(10.0, normal(random));
    const Complex c0 = size * Complex(normal(random), normal(random)), c2 = Complex(normal(random), normal(random));
    const Frame frame = frame_of(c0, c2);
    const Complex a(frame.a.x, frame.a.y), b(frame.b.x, frame.b.y);
    const double scale = std::abs(c0) + std::norm(c2);
    EXPECT_LT(std::abs(a * a * a * a + c2 * a * a + c0), 1e-12 * scale);
    EXPECT_LT(std::abs(b * b * b * b + c2 * b * b + c0), 1e-12 * scale);
    EXPECT_LT(std::abs(a * a + b * b + c2), 1e-12 * std::sqrt(scale)) << "one root twice";
  }
}

TEST(FrameOf, SmallRootsAreKeptBesideLargeOnes) {
  const Complex a = std::polar(1e4, 0.3), b = std::polar(1e-4, 1.1);
  const Frame frame = frame_of(a * a * b * b, -(a * a + b * b));
  EXPECT_LT(degrees_between(frame.b, {b.real(), b.imag()}), 1e-6);
  EXPECT_NEAR(norm(frame.b), 1e-4, 1e-12);
}

TEST(FrameOf, DoubleAndNullRootsAreFinite) {
  for (const auto& [c0, c2] : {std::pair<Complex, Complex>{0, 0}, {0, -1}, {1, -2}, {0, Complex(0, 3)}}) {
    const Frame frame = frame_of(c0, c2);
    EXPECT_TRUE(std::isfinite(norm(frame.a)) && std::isfinite(norm(frame.b)));
  }
}

class StraightLine : public ::testing::TestWithParam<double> {};

TEST_P(StraightLine, OneDirectionRunsAlongIt) {
  for (const double width : {6.0, 14.0}) {
    const Field f = solved({bar(GetParam())}, width);
    int seen = 0;
    for (int v = 0; v < f.mesh.vertex_count(); ++v) {
      // The round caps have tangents of their own.
      if (norm(f.point(v) - kMiddle) > 100) continue;
      ++seen;
      ASSERT_LT(degrees_off(f.at(v), direction(GetParam())), 1) << width << " at " << f.point(v).x << ' ' << f.point(v).y;
    }
    EXPECT_GT(seen, 100);
  }
}

TEST_P(StraightLine, TheOtherDirectionCrossesIt) {
  const Field f = solved({bar(GetParam())}, 10);
  for (int v = 0; v < f.mesh.vertex_count(); ++v) {
    if (norm(f.point(v) - kMiddle) > 90) continue;
    ASSERT_GT(degrees_between(f.at(v).a, f.at(v).b), 30);
  }
}

INSTANTIATE_TEST_SUITE_P(FrameField, StraightLine, ::testing::Values(0.0, 17.0, 30.0, 45.0, 71.0, 90.0, 133.0));

TEST(FrameField, BothArmsOfACrossing) {
  const double width = 10;
  const Field f = solved({bar(10), bar(70)}, width);
  int near = 0;
  for (int v = 0; v < f.mesh.vertex_count(); ++v) {
    const Vec2 p = f.point(v) - kMiddle;
    if (norm(p) > width) continue;
    ++near;
    EXPECT_LT(degrees_off(f.at(v), direction(10)), 10) << p.x << ' ' << p.y;
    EXPECT_LT(degrees_off(f.at(v), direction(70)), 10) << p.x << ' ' << p.y;
  }
  EXPECT_GT(near, 50);
}

TEST(FrameField, ACircleIsFollowedAllAround) {
  const Field f = solved({testing::circle(kMiddle, 90)}, 10);
  for (int v = 0; v < f.mesh.vertex_count(); ++v)
    ASSERT_LT(degrees_off(f.at(v), quarter_turn(f.point(v) - kMiddle)), 2) << f.point(v).x << ' ' << f.point(v).y;
}

TEST(FrameField, TurnsWithTheDrawing) {
  const Vec2 turn = direction(37);
  const auto turned = [&](Vec2 p) { return kMiddle + turn * (p - kMiddle); };
  const Lines lines{testing::arc(kMiddle, 80, 0.2, 2.8), {{80, 130}, {220, 150}}, {{150, 60}, {170, 200}}};
  Lines turned_lines = lines;
  for (auto& line : turned_lines)
    for (Vec2& p : line) p = turned(p);
  const Field before = solved(lines, 10), after = solved(turned_lines, 10);
  for (const auto& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double step = 2 / std::max(2.0, norm(line[i + 1] - line[i]));
      for (double t = 0; t < 1; t += step) {
        const Vec2 p = lerp(line[i], line[i + 1], t);
        const Frame frame = before.within(p), image = after.within(turned(p));
        // No tangent fixes the direction across a lone stroke: it follows the smoothness, and with it the lattice, a little.
        EXPECT_LT(degrees_off(image, {turn * frame.a, turn * frame.b}), 10) << p.x << ' ' << p.y;
        const bool a_runs_along =
            degrees_between(frame.a, line[i + 1] - line[i]) < degrees_between(frame.b, line[i + 1] - line[i]);
        EXPECT_LT(degrees_off(image, turn * (a_runs_along ? frame.a : frame.b)), 2) << p.x << ' ' << p.y;
      }
    }
}

TEST(FrameField, ReweightingEndsBelowTheStop) {
  const FieldOptions options;
  for (const Lines& lines : {Lines{bar(20)}, Lines{bar(10), bar(70)}, Lines{testing::circle(kMiddle, 90), bar(0)},
                             Lines{bar(0), bar(40), bar(80), bar(120)}}) {
    const Field f = solved(lines, 8, options);
    ASSERT_LE(f.field.rounds, options.rounds);
    EXPECT_LT(f.field.degenerate_fraction, options.degenerate_fraction);
    EXPECT_DOUBLE_EQ(f.field.degenerate_fraction, part_degenerate(f, options));
  }
}

TEST(FrameField, ReweightingIsWhatRemovesDegenerateFrames) {
  // Arms 20 degrees apart: nearer to each other than the directions of a frame may be.
  const Lines lines{bar(0), bar(20)};
  FieldOptions none;
  none.rounds = 0;
  const Field raw = solved(lines, 8, none);
  EXPECT_EQ(raw.field.rounds, 0);
  EXPECT_GT(raw.field.degenerate_fraction, none.degenerate_fraction);
  EXPECT_DOUBLE_EQ(raw.field.degenerate_fraction, part_degenerate(raw, none));
  const Field f = solved(lines, 8);
  EXPECT_GT(f.field.rounds, 0);
  EXPECT_LT(f.field.degenerate_fraction, none.degenerate_fraction);
}

TEST(FrameField, StopsWhenAsked) {
  const Ink ink = drawn_ink({bar(20)}, 8, 300);
  const BandMesh mesh = build_band(ink, nullptr, {});
  std::stop_source source;
  source.request_stop();
  Control control;
  control.stop = source.get_token();
  try {
    solve_field(mesh, ink, {}, control);
    FAIL() << "went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

TEST(FrameField, NoBandNoField) {
  const Field f = solved({}, 8);
  EXPECT_TRUE(f.field.c0.empty());
  EXPECT_TRUE(f.field.c2.empty());
}

}  // namespace
}  // namespace inkgrid
