// The whole program on small drawings whose curves are known.
#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <string>

#include "known_curves.h"

namespace inkgrid {
namespace {

using namespace testing;
using std::numbers::pi;

constexpr double kWidth = 6;

Image painted(const std::vector<Line>& lines, int width = 200, int height = 200) {
  return testing::painted(lines, kWidth, width, height);
}

Vec2 start_of(const Curve& curve) {
  return curve.segments.front().p0;
}
Vec2 end_of(const Curve& curve) {
  return curve.segments.back().p3;
}

std::vector<double> coordinates(const Drawing& drawing) {
  std::vector<double> all;
  const auto add = [&](Vec2 p) { all.insert(all.end(), {p.x, p.y}); };
  for (const Vec2 p : drawing.junctions) add(p);
  for (const auto& curve : drawing.curves) {
    for (const auto& s : curve.segments)
      for (const Vec2 p : {s.p0, s.p1, s.p2, s.p3}) add(p);
    all.insert(all.end(), {curve.width, curve.coverage, curve.closed ? 1.0 : 0.0, static_cast<double>(curve.start_junction),
                           static_cast<double>(curve.end_junction)});
  }
  return all;
}

// What drawing.h promises of every drawing.
void expect_sound(const Drawing& drawing) {
  for (const double v : coordinates(drawing)) ASSERT_TRUE(std::isfinite(v));
  for (const auto& curve : drawing.curves) {
    ASSERT_FALSE(curve.segments.empty());
    for (std::size_t i = 0; i + 1 < curve.segments.size(); ++i) EXPECT_TRUE(curve.segments[i].p3 == curve.segments[i + 1].p0);
    if (curve.closed) {
      EXPECT_TRUE(end_of(curve) == start_of(curve));
      EXPECT_EQ(std::max(curve.start_junction, curve.end_junction), -1);
    }
    const auto shares = [&](int junction, Vec2 end) {
      ASSERT_LT(junction, static_cast<int>(drawing.junctions.size()));
      EXPECT_TRUE(junction < 0 || drawing.junctions[static_cast<std::size_t>(junction)] == end);
    };
    shares(curve.start_junction, start_of(curve));
    shares(curve.end_junction, end_of(curve));
    EXPECT_GE(curve.coverage, 0);
    EXPECT_LE(curve.coverage, 1);
  }
}

Drawing traced(const Image& image, const Options& options = {}) {
  Drawing drawing = vectorize(image, options).drawing;
  expect_sound(drawing);
  return drawing;
}

// Strokes that cross, meet, end and bend.
const std::vector<Line>& mixed() {
  static const std::vector<Line> lines{
      {{20, 40}, {180, 60}}, {{110, 20}, {90, 120}}, arc({110, 140}, 40, 0.2, 2.6), {{25, 80}, {40, 180}}};
  return lines;
}

TEST(Pipeline, ALineIsOneCurve) {
  for (const Line& line : {Line{{30, 60}, {170, 130}}, Line{{30, 100.5}, {170, 100.5}}, Line{{90.2, 30}, {90.2, 170}}}) {
    const Drawing drawing = traced(painted({line}));
    ASSERT_EQ(drawing.curves.size(), 1u);
    EXPECT_LT(distance_between(lines_of(drawing), {line}), 1);
    const auto& curve = drawing.curves[0];
    const bool forward = norm(start_of(curve) - line[0]) < norm(end_of(curve) - line[0]);
    EXPECT_LT(norm((forward ? start_of(curve) : end_of(curve)) - line[0]), 1);
    EXPECT_LT(norm((forward ? end_of(curve) : start_of(curve)) - line[1]), 1);
    EXPECT_NEAR(curve.width, kWidth, 1);
  }
}

TEST(Pipeline, ACircleIsOneClosedCurve) {
  const Line truth = circle({100.3, 99.8}, 60);
  const Drawing drawing = traced(painted({truth}));
  ASSERT_EQ(drawing.curves.size(), 1u);
  EXPECT_TRUE(drawing.curves[0].closed);
  EXPECT_LT(distance_between(lines_of(drawing), {truth}), 0.5);
}

TEST(Pipeline, ACrossingIsOneJunctionOfFourCurves) {
  const std::vector<Line> truth{{{30, 40}, {170, 160}}, {{40, 170}, {160, 30}}};
  const Drawing drawing = traced(painted(truth));
  EXPECT_EQ(drawing.junctions.size(), 1u);
  EXPECT_EQ(drawing.curves.size(), 4u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 1);
}

TEST(Pipeline, ATeeIsOneJunctionOfThreeCurves) {
  const std::vector<Line> truth{{{30, 60}, {170, 60}}, {{95, 60}, {105, 170}}};
  const Drawing drawing = traced(painted(truth));
  ASSERT_EQ(drawing.junctions.size(), 1u);
  EXPECT_LT(norm(drawing.junctions[0] - Vec2{95, 60}), 1);
  EXPECT_EQ(drawing.curves.size(), 3u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 1);
}

TEST(Pipeline, ASquareHasItsCorners) {
  const Line square{{50, 50}, {150, 50}, {150, 150}, {50, 150}, {50, 50}};
  const Drawing drawing = traced(painted({square}));
  ASSERT_EQ(drawing.curves.size(), 1u);
  EXPECT_TRUE(drawing.curves[0].closed);
  for (std::size_t k = 0; k < 4; ++k) {
    double least = 1e9;
    for (const auto& segment : drawing.curves[0].segments) least = std::min(least, norm(segment.p0 - square[k]));
    EXPECT_LT(least, 1) << k;
  }
  EXPECT_LT(distance_between(lines_of(drawing), {square}), 1);
}

TEST(Pipeline, TheReportCountsPartsAndHolesOfTheBand) {
  const Report report = vectorize(painted({circle({55, 60}, 30), circle({140, 60}, 35), {{20, 160}, {180, 170}}})).report;
  EXPECT_EQ(report.components, 3);
  EXPECT_EQ(report.holes, 2);
}

TEST(Pipeline, LinesApartStayTwo) {
  const std::vector<Line> truth{{{30, 80}, {170, 90}}, {{30, 100}, {170, 110}}};
  const Drawing drawing = traced(painted(truth));
  EXPECT_EQ(drawing.curves.size(), 2u);
  EXPECT_LT(distance_between(lines_of(drawing), truth), 1);
}

TEST(Pipeline, OverdrawnStrokesAreOneCurve) {
  Image image = blank(200, 120);
  Line above, below;
  for (double x = 25; x <= 175; x += 1) {
    above.push_back({x, 58.5 + 1.5 * std::sin(x / 9)});
    below.push_back({x, 61.5 - 1.5 * std::sin(x / 13)});
  }
  paint(image, above, 4);
  paint(image, below, 4);
  Options options;
  options.preset = Preset::rough;
  const Drawing drawing = traced(image, options);
  EXPECT_EQ(drawing.curves.size(), 1u);
  EXPECT_LT(distance_between(lines_of(drawing), {{{25, 60}, {175, 60}}}), 3);
}

TEST(Pipeline, BlankPaperGivesAWarning) {
  const Result result = vectorize(blank(120, 80));
  EXPECT_TRUE(result.drawing.curves.empty());
  EXPECT_TRUE(result.drawing.junctions.empty());
  EXPECT_EQ(result.drawing.width, 120);
  EXPECT_EQ(result.drawing.height, 80);
  EXPECT_EQ(result.report.warnings.size(), 1u);
}

TEST(Pipeline, SmallSheetsOfOneToneGiveTheWarningToo) {
  for (const int grey : {0, 128, 255})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 30}, {30, 1}, {4, 5}}) {
      const Result result = vectorize(blank(width, height, static_cast<std::uint8_t>(grey)));
      EXPECT_EQ(result.report.warnings.size(), 1u) << grey << ": " << width << " x " << height;
      EXPECT_EQ(result.report.fills, 0) << grey << ": " << width << " x " << height;
    }
}

TEST(Pipeline, TheResultIsTheSameForAnyNumberOfThreads) {
  const Image image = painted(mixed());
  Options one, two;
  one.threads = 1;
  two.threads = 2;
  const auto expected = coordinates(traced(image, one));
  EXPECT_FALSE(expected.empty());
  EXPECT_TRUE(coordinates(traced(image, two)) == expected);
  EXPECT_TRUE(coordinates(traced(image, one)) == expected);
}

Image moved(const Image& image, int width, int height, auto from) {
  Image result = blank(width, height);
  const auto index = [](const Image& i, int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(i.width) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto [sx, sy] = from(x, y);
      result.grey[index(result, x, y)] = image.grey[index(image, sx, sy)];
    }
  return result;
}

void expect_equal_after(const Image& turned, auto back) {
  const Drawing expected = traced(painted(mixed(), 200, 190)), found = traced(turned);
  EXPECT_EQ(found.curves.size(), expected.curves.size());
  EXPECT_EQ(found.junctions.size(), expected.junctions.size());
  auto lines = lines_of(found);
  for (auto& line : lines)
    for (Vec2& p : line) p = back(p);
  EXPECT_LT(distance_between(lines, lines_of(expected)), 1);
}

TEST(Pipeline, AMirroredDrawingIsTracedAlike) {
  const Image image = painted(mixed(), 200, 190);
  expect_equal_after(moved(image, 200, 190,
                           [](int x, int y) {
                             return std::pair{199 - x, y};
                           }),
                     [](Vec2 p) {
                       return Vec2{200 - p.x, p.y};
                     });
}

TEST(Pipeline, ADrawingOnItsSideIsTracedAlike) {
  const Image image = painted(mixed(), 200, 190);
  expect_equal_after(moved(image, 190, 200,
                           [](int x, int y) {
                             return std::pair{y, 189 - x};
                           }),
                     [](Vec2 p) {
                       return Vec2{p.y, 190 - p.x};
                     });
}

TEST(Pipeline, PureNoiseGivesASoundDrawing) {
  std::mt19937 random(7);
  Image image = blank(64, 64);
  for (auto& g : image.grey) g = static_cast<std::uint8_t>(random() >> 24);
  traced(image);
}

TEST(Pipeline, UniformImagesGiveSoundDrawings) {
  for (const int grey : {0, 128, 255})
    for (const auto& [width, height] : {std::pair{64, 64}, {1, 1}, {1, 30}, {30, 1}, {2, 2}}) {
      SCOPED_TRACE(std::to_string(grey) + ": " + std::to_string(width) + " x " + std::to_string(height));
      traced(blank(width, height, static_cast<std::uint8_t>(grey)));
    }
}

TEST(Pipeline, LinesOfOnePixelsHeightGiveSoundDrawings) {
  for (const bool upright : {false, true}) {
    Image image = blank(upright ? 1 : 60, upright ? 60 : 1);
    for (std::size_t k = 20; k < 40; ++k) image.grey[k] = 0;
    traced(image);
  }
}

TEST(Pipeline, ADotIsNotLost) {
  const Drawing drawing = traced(painted({{{50, 50}, {50, 50}}}, 100, 100));
  ASSERT_FALSE(drawing.curves.empty());
  EXPECT_LT(farthest(lines_of(drawing), {{{50, 50}, {50, 50}}}), kWidth);
}

TEST(Pipeline, AStopRequestIsHeard) {
  const Image image = painted(mixed());
  const auto code_of = [&](const Control& control) {
    try {
      vectorize(image, {}, control);
    } catch (const Error& error) {
      return static_cast<int>(error.code());
    }
    return 0;
  };
  std::stop_source before;
  before.request_stop();
  Control control;
  control.stop = before.get_token();
  EXPECT_EQ(code_of(control), static_cast<int>(ErrorCode::cancelled));

  for (const char* stage : {"frame field", "grid map", "isolines"}) {
    std::stop_source during;
    control.stop = during.get_token();
    control.progress = [&](const char* name, double) {
      if (std::string(name) == stage) during.request_stop();
    };
    EXPECT_EQ(code_of(control), static_cast<int>(ErrorCode::cancelled)) << stage;
  }
}

TEST(Pipeline, ProgressAscendsInEachStageAndOverThem) {
  std::vector<std::pair<std::string, double>> seen;
  Control control;
  control.progress = [&](const char* name, double fraction) { seen.emplace_back(name, fraction); };
  vectorize(painted(mixed()), {}, control);
  ASSERT_GT(seen.size(), 5u);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_GE(seen[k].second, 0) << seen[k].first;
    EXPECT_LE(seen[k].second, 1) << seen[k].first;
    if (k == 0) continue;
    EXPECT_GE(seen[k].second, seen[k - 1].second) << seen[k - 1].first << " then " << seen[k].first;
  }
}

TEST(Pipeline, RefusesWhatIsNoDrawing) {
  const auto refused = [](const Image& image, const ScaleMask* mask) {
    Control control;
    control.mask = mask;
    try {
      vectorize(image, {}, control);
    } catch (const Error& error) {
      return error.code() == ErrorCode::usage;
    }
    return false;
  };
  EXPECT_TRUE(refused({}, nullptr));
  Image torn = blank(10, 10);
  torn.grey.pop_back();
  EXPECT_TRUE(refused(torn, nullptr));
  const ScaleMask other{5, 5, std::vector<float>(25, 1)};
  EXPECT_TRUE(refused(blank(10, 10), &other));
}

}  // namespace
}  // namespace inkgrid
