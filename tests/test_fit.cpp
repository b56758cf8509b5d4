#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fit/fit.h"
#include "fit/fit_spline.h"
#include "lines_to_fit.h"

namespace inkgrid {
namespace {

using namespace inkgrid::testing;
using Cubics = std::vector<Cubic>;

constexpr FitOptions kOptions{0.6, 6};

Line sampled(const Cubics& cubics, int steps = 64) {
  Line line;
  for (const Cubic& c : cubics)
    for (int i = 0; i <= steps; ++i) line.push_back(point_on(c, static_cast<double>(i) / steps));
  return line;
}

// The largest distance of a point of `a` from the polyline `b`.
double reach(const Line& a, const Line& b) {
  double worst = 0;
  for (const Vec2 p : a) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < b.size(); ++i) nearest = std::min(nearest, distance_to_segment(p, b[i], b[i + 1]));
    worst = std::max(worst, nearest);
  }
  return worst;
}

double distance_both_ways(const Cubics& cubics, const Line& line) {
  const Line curve = sampled(cubics);
  return std::max(reach(line, curve), reach(curve, line));
}

double turn_at_joint(const Cubic& a, const Cubic& b) {
  const Vec2 u = a.p3 - a.p2, v = b.p1 - b.p0;
  return std::abs(std::atan2(cross(u, v), dot(u, v)));
}

void expect_chain(const Cubics& cubics, const Line& line, bool closed) {
  ASSERT_FALSE(cubics.empty());
  for (std::size_t i = 0; i + 1 < cubics.size(); ++i) EXPECT_TRUE(cubics[i].p3 == cubics[i + 1].p0) << "joint " << i;
  for (const Cubic& c : cubics)
    for (const Vec2 p : {c.p0, c.p1, c.p2, c.p3}) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  if (closed) {
    EXPECT_TRUE(cubics.back().p3 == cubics.front().p0);
  } else {
    EXPECT_TRUE(cubics.front().p0 == line.front());
    EXPECT_TRUE(cubics.back().p3 == line.back());
  }
}

void expect_smooth(const Cubics& cubics, bool closed) {
  for (std::size_t i = 0; i + (closed ? 0 : 1) < cubics.size(); ++i)
    EXPECT_LT(turn_at_joint(cubics[i], cubics[(i + 1) % cubics.size()]), 1e-9) << "joint " << i;
}

void expect_fair(const Cubics& cubics) {
  for (const Cubic& c : cubics) {
    const Line line = sampled({c}, 200);
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i) length += norm(line[i] - line[i - 1]);
    EXPECT_LE(norm(c.p1 - c.p0), length);
    EXPECT_LE(norm(c.p3 - c.p2), length);
    EXPECT_GT(norm(c.p1 - c.p0), 0.01 * length);
    EXPECT_GT(norm(c.p3 - c.p2), 0.01 * length);
    for (std::size_t i = 2; i < line.size(); ++i)
      EXPECT_GT(dot(unit(line[i] - line[i - 1]), unit(line[i - 1] - line[i - 2])), 0.7) << "a fold";
  }
}

struct Shape {
  const char* name;
  Line line;
  bool closed;
  int most;  // segments
};

std::vector<Shape> smooth_shapes() {
  return {{"line", dense({{10, 20}, {230, 70}}), false, 1},
          {"short line", dense({{10, 20}, {13, 21}}), false, 1},
          {"quarter arc", dense_arc({5, 5}, 100, 0.2, 0.2 + pi / 2), false, 1},
          {"small quarter arc", dense_arc({5, 5}, 15, 0.2, 0.2 + pi / 2), false, 1},
          {"half circle", dense_arc({5, 5}, 100, 0.2, 0.2 + pi), false, 2},
          {"circle 100", full_circle({110, 110}, 100), true, 4},
          {"circle 20", full_circle({30, 30}, 20), true, 4},
          {"circle 7.5", full_circle({30, 30}, 7.5), true, 4},
          {"ellipse", ellipse(110, 50), true, 4},
          {"s", s_curve(), false, 2},
          {"rounded rectangle", rounded_rectangle(200, 120, 30), true, 8},
          {"small rounded rectangle", rounded_rectangle(80, 60, 12), true, 8},
          {"hook", joined({dense({{10, 100}, {90, 100}}), dense_arc({90, 60}, 40, pi / 2, -pi / 2), dense({{90, 20}, {30, 20}})}),
           false, 4}};
}

TEST(Fit, SmoothShapesTakeFewSegmentsWithinTheTolerance) {
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    const Cubics cubics = fit_polyline(shape.line, shape.closed, kOptions);
    expect_chain(cubics, shape.line, shape.closed);
    expect_smooth(cubics, shape.closed);
    expect_fair(cubics);
    EXPECT_LE(static_cast<int>(cubics.size()), shape.most);
    EXPECT_LE(distance_both_ways(cubics, shape.line), kOptions.tolerance + 0.02);
  }
}

TEST(Fit, NoiseAddsNeitherCornersNorSegments) {
  for (const Shape& shape : smooth_shapes())
    for (const unsigned seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(shape.name);
      SCOPED_TRACE(seed);
      const Line line = noisy(shape.line, shape.closed, seed);
      const Cubics cubics = fit_polyline(line, shape.closed, kOptions);
      expect_chain(cubics, line, shape.closed);
      expect_smooth(cubics, shape.closed);
      expect_fair(cubics);
      EXPECT_LE(static_cast<int>(cubics.size()), shape.most + (shape.most > 1 ? 1 : 0));
      EXPECT_LE(reach(line, sampled(cubics)), kOptions.tolerance + 0.02);
      EXPECT_LE(distance_both_ways(cubics, shape.line), kOptions.tolerance);  // the truth, which is nearer than the noise
    }
}

TEST(Fit, AStraightLineHasItsHandlesAtThirds) {
  const Vec2 a{10, 20}, b{230, 70};
  const Cubics exact = fit_polyline(dense({a, b}), false, kOptions);
  ASSERT_EQ(exact.size(), 1u);
  EXPECT_LT(norm(exact[0].p1 - lerp(a, b, 1.0 / 3)), 1e-9);
  EXPECT_LT(norm(exact[0].p2 - lerp(a, b, 2.0 / 3)), 1e-9);
  Line line = noisy(dense({a, b}), false, 5);
  line.front() = a, line.back() = b;
  const Cubics rough = fit_polyline(line, false, kOptions);
  ASSERT_EQ(rough.size(), 1u);
  EXPECT_LT(norm(rough[0].p1 - lerp(a, b, 1.0 / 3)), 1e-9);
}

TEST(Fit, JointsFallWhereLinesTurnIntoArcs) {
  const double r = 30, w = 200, h = 120;
  const Line transitions{{r, 0}, {w - r, 0}, {w, r}, {w, h - r}, {w - r, h}, {r, h}, {0, h - r}, {0, r}};
  for (const double noise : {0.0, 0.25}) {
    SCOPED_TRACE(noise);
    const Cubics cubics = fit_polyline(noisy(rounded_rectangle(w, h, r), true, 4, noise), true, kOptions);
    ASSERT_EQ(cubics.size(), 8u);
    for (const Vec2 p : transitions) {
      double nearest = 1e9;
      for (const Cubic& c : cubics) nearest = std::min(nearest, norm(c.p0 - p));
      EXPECT_LT(nearest, noise > 0 ? r / 2 : r / 5) << p.x << ", " << p.y;
    }
  }
}

TEST(Fit, TheCurveIsCentredInTheNoise) {
  const Vec2 centre{110, 110};
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Cubics cubics = fit_polyline(noisy(full_circle(centre, 100), true, seed), true, {1.5, 6});
    double squares = 0;
    const Line curve = sampled(cubics);
    for (const Vec2 p : curve) squares += std::pow(norm(p - centre) - 100, 2);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(curve.size())), 0.12);
  }
}

struct Cornered {
  const char* name;
  Line vertices;
  bool closed;
};

std::vector<Cornered> cornered_shapes() {
  return {{"right angle", {{10, 10}, {100, 10}, {100, 100}}, false},
          {"55 degree turn", {{10, 10}, {100, 10}, {100 + 90 * std::cos(0.96), 10 + 90 * std::sin(0.96)}}, false},
          {"zigzag", {{10, 10}, {40, 60}, {70, 10}, {100, 60}, {130, 10}, {140, 60}, {150, 10}}, false},
          {"square", {{10, 10}, {60, 10}, {60, 60}, {10, 60}, {10, 10}}, true},
          {"small square", {{10, 10}, {22, 10}, {22, 22}, {10, 22}, {10, 10}}, true},
          {"five-pointed star", star_vertices(5, 100, 40), true},
          {"star of 20 degrees", star_vertices(9, 100, 38), true}};
}

void expect_corners(const Cubics& cubics, const Cornered& shape) {
  EXPECT_EQ(cubics.size(), shape.vertices.size() - 1);
  for (const Vec2 vertex : shape.vertices) {
    double nearest = 1e9;
    for (const Cubic& c : cubics) nearest = std::min({nearest, norm(c.p0 - vertex), norm(c.p3 - vertex)});
    EXPECT_LT(nearest, 0.5) << vertex.x << ", " << vertex.y;
  }
}

TEST(Fit, CornersStaySharpAndInPlace) {
  for (const Cornered& shape : cornered_shapes())
    for (const unsigned seed : {0u, 1u, 2u, 3u}) {
      SCOPED_TRACE(shape.name);
      SCOPED_TRACE(seed);
      Line line = dense(shape.vertices);
      if (seed > 0) line = noisy(line, shape.closed, seed, 0.15);
      const Cubics cubics = fit_polyline(line, shape.closed, kOptions);
      expect_chain(cubics, line, shape.closed);
      expect_corners(cubics, shape);
      EXPECT_LE(reach(sampled(cubics), line), kOptions.tolerance);
    }
}

TEST(Fit, RoundedCornersAreSharpened) {
  for (const double radius : {1.0, 2.0, 3.0})
    for (const unsigned seed : {0u, 1u, 2u}) {
      SCOPED_TRACE(radius);
      Line line = joined({dense({{10, 10}, {100 - radius, 10}}), dense_arc({100 - radius, 10 + radius}, radius, -pi / 2, 0),
                          dense({{100, 10 + radius}, {100, 100}})});
      if (seed > 0) line = noisy(line, false, seed);
      const Cubics cubics = fit_polyline(line, false, kOptions);
      ASSERT_EQ(cubics.size(), 2u);
      EXPECT_LT(norm(cubics[0].p3 - Vec2{100, 10}), 0.5);
    }
}

TEST(Fit, BendsOfAStrokeWidthAndMoreAreNotCorners) {
  for (const double radius : {8.0, 12.0, 20.0}) {
    SCOPED_TRACE(radius);
    const Line line = joined({dense({{10, 10}, {100 - radius, 10}}), dense_arc({100 - radius, 10 + radius}, radius, -pi / 2, 0),
                              dense({{100, 10 + radius}, {100, 100}})});
    expect_smooth(fit_polyline(line, false, kOptions), false);
  }
}

TEST(Fit, ASeamMovesToACorner) {
  // A drop: a circle's arc with two tangents that meet at (0, 0), begun on the arc.
  const double opening = 0.5, radius = 50, far = radius / std::sin(opening);
  const Vec2 centre{far, 0}, tip{0, 0};
  const Vec2 up = centre + radius * Vec2{-std::sin(opening), std::cos(opening)};
  const Vec2 down = centre + radius * Vec2{-std::sin(opening), -std::cos(opening)};
  const double last = std::atan2(up.y - centre.y, up.x - centre.x);
  Line line = joined({dense_arc(centre, radius, 0, last), dense({up, tip, down}), dense_arc(centre, radius, -last, 0)});
  line.back() = line.front();
  const Cubics cubics = fit_polyline(line, true, kOptions);
  expect_chain(cubics, line, true);
  EXPECT_LT(norm(cubics.front().p0 - tip), 0.5);
  EXPECT_LE(cubics.size(), 5u);
  for (std::size_t i = 0; i + 1 < cubics.size(); ++i) EXPECT_LT(turn_at_joint(cubics[i], cubics[i + 1]), 1e-9);
  EXPECT_GT(turn_at_joint(cubics.back(), cubics.front()), 1);
}

TEST(Fit, FollowsMotionsAndScale) {
  const Vec2 rotation{std::cos(0.7), std::sin(0.7)}, shift{31.7, -12.3};
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    const Line line = noisy(shape.line, shape.closed, 9);
    const Cubics plain = fit_polyline(line, shape.closed, kOptions);
    const Line moved = mapped(line, rotation, shift);
    const Cubics turned = fit_polyline(moved, shape.closed, kOptions);
    EXPECT_EQ(turned.size(), plain.size());
    EXPECT_LT(distance_both_ways(turned, mapped(sampled(plain), rotation, shift)), kOptions.tolerance / 2);
    const Cubics larger =
        fit_polyline(mapped(line, {7, 0}, {0, 0}), shape.closed, {7 * kOptions.tolerance, 7 * kOptions.corner_span});
    EXPECT_EQ(larger.size(), plain.size());
    EXPECT_LT(distance_both_ways(larger, mapped(sampled(plain), {7, 0}, {0, 0})), 7 * kOptions.tolerance / 2);
  }
}

TEST(Fit, ReversalChangesNothing) {
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    Line line = noisy(shape.line, shape.closed, 9);
    const Cubics forward = fit_polyline(line, shape.closed, kOptions);
    std::ranges::reverse(line);
    const Cubics backward = fit_polyline(line, shape.closed, kOptions);
    EXPECT_EQ(forward.size(), backward.size());
    EXPECT_LT(distance_both_ways(forward, sampled(backward)), kOptions.tolerance / 2);
  }
}

TEST(Fit, ALargerToleranceNeverTakesMoreSegments) {
  for (const Shape& shape : smooth_shapes()) {
    SCOPED_TRACE(shape.name);
    const Line line = noisy(shape.line, shape.closed, 11, 0.1);
    std::size_t before = 1000;
    for (const double tolerance : {0.3, 0.6, 1.2, 2.4, 4.8}) {
      const std::size_t count = fit_polyline(line, shape.closed, {tolerance, 6}).size();
      EXPECT_LE(count, before) << tolerance;
      before = count;
    }
  }
}

TEST(Fit, RandomSmoothCurvesStayWithinTheTolerance) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const Line truth = smooth_walk(seed, 300 + 20 * static_cast<int>(seed));
    const Line line = seed % 2 ? truth : noisy(truth, false, seed);
    const double tolerance = seed % 3 ? 0.6 : 1.2;
    const Cubics cubics = fit_polyline(line, false, {tolerance, 6});
    expect_chain(cubics, line, false);
    expect_smooth(cubics, false);
    EXPECT_LE(reach(line, sampled(cubics)), tolerance + 0.02);
    EXPECT_LE(reach(sampled(cubics), line), tolerance + 0.02);
    EXPECT_LE(static_cast<double>(cubics.size()), 2 + static_cast<double>(truth.size()) / 40);
  }
}

TEST(Fit, NoiseBeyondTheToleranceIsFollowedAllTheSame) {
  const Line line = noisy(dense({{10, 20}, {90, 30}}), false, 3);
  const Cubics cubics = fit_polyline(line, false, {0.15, 6});
  expect_chain(cubics, line, false);
  EXPECT_GT(cubics.size(), 4u);
  EXPECT_LE(reach(line, sampled(cubics)), 0.4);
}

TEST(Fit, JaggedLinesAreFollowedBothWays) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Line line{{100, 100}};
    double angle = 0;
    const double step = 1 + 3 * uniform(random), jag = 2 * uniform(random);
    for (int i = 0; i < 80; ++i) {
      angle += jag * (uniform(random) - 0.5);
      line.push_back(line.back() + step * Vec2{std::cos(angle), std::sin(angle)});
    }
    line.push_back(line[line.size() - 2]);  // a hook back over the last step
    const Cubics cubics = fit_polyline(line, false, {1.2, 8});
    expect_chain(cubics, line, false);
    EXPECT_LE(distance_both_ways(cubics, line), 1.2 + 8 / 2.0);  // or a sharpened corner away
  }
}

TEST(Fit, DegenerateInputsGiveFiniteCurves) {
  const Vec2 a{3, 4}, b{10, 4};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(fit_polyline({}, false, kOptions).empty());
  EXPECT_TRUE(fit_polyline(Line{{nan, 1}, {2, nan}}, false, kOptions).empty()) << "nothing is finite";
  for (const bool closed : {false, true})
    for (const Line& line : std::vector<Line>{{a},
                                              {a, a},
                                              {a, a, a, a},
                                              {a, b},
                                              {a, b, a},
                                              {a, a, b, b},
                                              {a, b, a, b, a},
                                              {a, {nan, 1}, b},
                                              {a, a + Vec2{1e-14, 0}, b},
                                              {a, a + Vec2{1e-9, 0}, a + Vec2{0, 1e-9}, a}}) {
      SCOPED_TRACE(line.size());
      const Cubics cubics = fit_polyline(line, closed, kOptions);
      expect_chain(cubics, line, closed && cubics.size() > 1);
    }
  const Cubics point = fit_polyline(Line{a, a, a}, true, kOptions);
  ASSERT_EQ(point.size(), 1u);
  EXPECT_TRUE(point[0].p0 == a && point[0].p3 == a);
}

// Sides that meet at a right angle, a corner that the chain cuts, and ink of 20 px around a sharp or a rounded line.
TEST(Fit, ACutCornerIsAnArcWhereTheInkIsRounded) {
  const Line cut = joined({dense({{10, 100}, {90, 100}}), dense_arc({90, 95}, 5, pi / 2, 0), dense({{95, 95}, {95, 20}})});
  for (const double radius : {0.0, 10.0}) {
    const Line drawn = radius == 0
                           ? Line{{10, 100}, {95, 100}, {95, 20}}
                           : joined({Line{{10, 100}, {85, 100}}, dense_arc({85, 90}, 10, pi / 2, 0), Line{{95, 90}, {95, 20}}});
    const auto depth = [&](Vec2 p) { return std::max(0.0, 10 - reach({p}, drawn)); };
    const Cubics cubics = fit_polyline(cut, false, {0.6, 12}, depth);
    const double sharpest = reach({{95, 100}}, sampled(cubics));
    if (radius == 0) {
      EXPECT_LT(sharpest, 0.3);
    } else {
      EXPECT_GT(sharpest, 1.5);
      expect_smooth(cubics, false);
    }
  }
}

TEST(Fit, CurvesKeepWhatChainsKnow) {
  Chains chains;
  chains.junctions = {{10, 10}, {90, 40}};
  Line loop = full_circle({60, 60}, 40);
  chains.chains.push_back({dense({{10, 10}, {90, 40}}), false, 0, 1, 3.5, 0.9});
  chains.chains.push_back({loop, true, -1, -1, 2.5, 1});
  chains.junctions.push_back(loop.front());
  chains.chains.push_back({loop, true, 2, 2, 2.5, 1});
  const Drawing drawing = fit_curves(chains, kOptions);
  ASSERT_EQ(drawing.curves.size(), 3u);
  EXPECT_EQ(drawing.junctions.size(), 3u);
  const Curve& line = drawing.curves[0];
  EXPECT_EQ(line.start_junction, 0);
  EXPECT_EQ(line.end_junction, 1);
  EXPECT_EQ(line.width, 3.5);
  EXPECT_EQ(line.coverage, 0.9);
  EXPECT_TRUE(line.segments.front().p0 == drawing.junctions[0]);
  EXPECT_TRUE(line.segments.back().p3 == drawing.junctions[1]);
  EXPECT_TRUE(drawing.curves[1].closed);
  EXPECT_TRUE(drawing.curves[2].segments.front().p0 == drawing.junctions[2]);
  EXPECT_TRUE(drawing.curves[2].segments.back().p3 == drawing.junctions[2]);
}

// A line that strokes relay each other on: it moves by a pixel and a half over five.
Line relayed_line() {
  Line line;
  for (int x = 0; x <= 200; ++x) line.push_back({x + 0.0, 1.5 * std::tanh((x - 100) / 2.5)});
  return line;
}

TEST(Fit, WideChainsAreSmootherWithinFourTolerances) {
  FitOptions options = kOptions;
  options.usual_width = 4;
  const Line line = relayed_line();
  const auto cubics_of = [&](double width) {
    Chains chains;
    chains.chains.push_back({line, false, -1, -1, width, 1});
    return fit_curves(chains, options).curves.front().segments;
  };
  const Cubics usual = cubics_of(4), wide = cubics_of(12);
  EXPECT_LE(distance_both_ways(usual, line), 1.05 * options.tolerance);
  EXPECT_EQ(usual.size(), cubics_of(2).size());
  EXPECT_LT(wide.size(), usual.size());
  EXPECT_LE(distance_both_ways(wide, line), 1.05 * 4 * options.tolerance);
}

TEST(Fit, CurvesOfAnEarlierRunAreTakenOverFromChainsOfTheSameWidthOnly) {
  FitOptions options = kOptions;
  options.usual_width = 4;
  Chains chains;
  chains.chains.push_back({relayed_line(), false, -1, -1, 4, 1});
  const Drawing before = fit_curves(chains, options);
  chains.chains[0].width = 12;
  const auto again = fit_curves(chains, options, {}, before.curves).curves.front().segments;
  const auto anew = fit_curves(chains, options).curves.front().segments;
  ASSERT_EQ(again.size(), anew.size());
  EXPECT_NE(again.size(), before.curves.front().segments.size());
}

// The deviation of a single segment from the points of its own curve.
double own_deviation(const Cubic& c) {
  const Vec2 out = c.p1 - c.p0, in = c.p3 - c.p2;
  const SmoothSpline spline{{c.p0, c.p3}, {std::atan2(out.y, out.x), std::atan2(in.y, in.x)}, {{norm(out), norm(in)}}, false};
  const Samples samples = sample_polyline(sampled({c}, 200), false, 1);
  Feet feet;
  for (const double arc : samples.arc) feet.push_back(arc / samples.arc.back());
  return deviations(spline, feet, samples).front();
}

TEST(Fit, ACurveThatTurnsThereAndBackAtOnceIsNone) {
  EXPECT_TRUE(std::isinf(own_deviation({{0, 0}, {150, 66}, {-8, 2}, {165, 104}})));
  EXPECT_FALSE(std::isinf(own_deviation({{0, 0}, {60, 17}, {100, 80}, {165, 104}})));
  EXPECT_FALSE(std::isinf(own_deviation({{0, 0}, {40, 90}, {60, -90}, {100, 0}})));
}

}  // namespace
}  // namespace inkgrid
