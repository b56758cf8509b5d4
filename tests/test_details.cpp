// Small pieces of a coarse drawing that stand alone.
#include <gtest/gtest.h>

#include "drawn_bands.h"
#include "ink/enlarge.h"
#include "inkgrid/session.h"
#include "known_curves.h"
#include "refine/details.h"

namespace inkgrid {
namespace {

using namespace testing;
using std::numbers::pi;

constexpr double kPen = 6, kReach = 3;

const Line kRing = circle({60.3, 60.2}, 10), kLine{{20, 150}, {180, 150}};

Chain chain_of(const Line& line) {
  Chain chain;
  chain.points = resampled(line, 1);
  return chain;
}

Details details_of(const std::vector<Line>& strokes, const std::vector<Chain>& chains, double size = 20) {
  const Ink ink = drawn_ink(strokes, kPen, 200);
  return find_details(ink, ink.mask, chains, kReach, size);
}

TEST(Details, AreWhatStandsAloneAndIsMissed) {
  const Details found = details_of({kRing, kLine}, {chain_of(kLine)});
  ASSERT_EQ(found.pieces.size(), 1u);
  EXPECT_EQ(found.around(60, 50), 1);
  EXPECT_EQ(found.around(60, 150), 0);
  EXPECT_EQ(details_of({kRing, kLine}, {}).pieces.size(), 1u) << "the line is too long";
}

TEST(Details, AreNotWhatTheChainsFollow) {
  EXPECT_TRUE(details_of({kRing, kLine}, {chain_of(kRing), chain_of(kLine)}).pieces.empty());
  EXPECT_EQ(details_of({kRing, kLine}, {chain_of({{55, 60}, {65, 60}})}).pieces.size(), 1u) << "a dash in the ring is no ring";
}

TEST(Details, AreNoLargerThanAsked) {
  EXPECT_TRUE(details_of({kRing, kLine}, {}, 3.5).pieces.empty());
  EXPECT_EQ(details_of({kRing, kLine}, {}, 5).pieces.size(), 1u);
  EXPECT_TRUE(details_of({kRing, kLine}, {}, 0).pieces.empty());
}

TEST(Details, HaveNoOtherInkNearThem) {
  const auto beside = [](double gap) { return Line{{60 + 10 + kPen + gap, 10}, {60 + 10 + kPen + gap, 190}}; };
  EXPECT_TRUE(details_of({kRing, beside(2 * kReach - 2)}, {}).pieces.empty());
  EXPECT_EQ(details_of({kRing, beside(2 * kReach + 2)}, {}).pieces.size(), 1u);
}

TEST(Details, OfSeveralPiecesNearEachOtherAreOne) {
  EXPECT_EQ(details_of({kRing, circle({60 + 20 + kPen + kReach, 60}, 10), kLine}, {chain_of(kLine)}).pieces.size(), 1u);
}

TEST(Details, LongerOnesWereNotDrawnOver) {
  const Ink ink = drawn_ink({circle({100, 100}, 40), circle({100, 100}, 50)}, kPen, 200);
  EXPECT_EQ(find_details(ink, ink.mask, {}, kReach, 20).pieces.size(), 1u);
  EXPECT_TRUE(find_details(ink, drawn_ink({circle({100, 100}, 45)}, kPen + 10, 200).mask, {}, kReach, 20).pieces.empty());
}

// As with a threshold that is not that of the darkness.
TEST(Details, AsDarkAsThePaperAreNone) {
  Ink ink = drawn_ink({kRing, kLine}, kPen, 200);
  std::fill(ink.darkness.data.begin(), ink.darkness.data.end(), 0.0f);
  EXPECT_TRUE(find_details(ink, ink.mask, {}, kReach, 20).pieces.empty());
}

TEST(Details, AreEnlargedInTheirPlace) {
  const Details found = details_of({kRing, kLine}, {chain_of(kLine)});
  ASSERT_EQ(found.pieces.size(), 1u);
  const Ink& piece = found.pieces[0];
  const Ink whole = drawn_ink({kRing}, kPen, 200),
            large = measure_ink(binarise(enlarged(painted({kRing}, kPen, 200, 200)), 128.0));
  EXPECT_EQ(piece.enlargement, kEnlargement);
  EXPECT_NEAR(piece.stroke_width, large.stroke_width, 0.2);
  EXPECT_NEAR(static_cast<double>(piece.pixels), static_cast<double>(large.pixels), 0.03 * static_cast<double>(large.pixels));
  const int x0 = static_cast<int>(piece.origin.x), y0 = static_cast<int>(piece.origin.y);
  int differing = 0;
  for (int y = 0; y < piece.height(); ++y)
    for (int x = 0; x < piece.width(); ++x) differing += piece.mask(x, y) != large.mask(x + 2 * x0, y + 2 * y0);
  EXPECT_LT(differing, 0.03 * static_cast<double>(large.pixels));
}

TEST(Details, TakeThePlaceOfTheChainsAroundThem) {
  const Line dash{{50, 54}, {50, 64}};
  const Details found = details_of({kRing, kLine}, {chain_of(dash), chain_of(kLine)});
  Chains coarse{{{50, 54}, {20, 150}}, {chain_of(dash), chain_of(kLine)}}, fine{{{70, 60}}, {chain_of(kRing)}};
  coarse.chains[0].start_junction = 0;
  coarse.chains[1].start_junction = 1;
  fine.chains[0].start_junction = fine.chains[0].end_junction = 0;
  const Chains all = with_details(coarse, found, {fine});
  ASSERT_EQ(all.chains.size(), 2u);
  EXPECT_EQ(all.chains[0].points, coarse.chains[1].points);
  EXPECT_EQ(all.chains[0].start_junction, 0);
  EXPECT_EQ(all.chains[1].points, fine.chains[0].points);
  EXPECT_EQ(all.chains[1].start_junction, 1);
  EXPECT_EQ(all.junctions, (std::vector<Vec2>{{20, 150}, {70, 60}}));
}

// ---------------------------------------------------------------- whole drawings

constexpr int kSize = 420;

// A box, each side drawn thrice beside itself, and small shapes of the pen within.
Image sketch(const std::vector<Line>& details, double grey = 90) {
  Image image = blank(kSize, kSize);
  const Line corners{{30, 30}, {390, 30}, {390, 390}, {30, 390}, {30, 30}};
  for (std::size_t side = 0; side < 4; ++side)
    for (const double shift : {-4.0, 0.0, 4.0}) {
      const Vec2 along = (corners[side + 1] - corners[side]) / 360, across{-along.y, along.x};
      paint(image, {corners[side] + shift * across - shift * along, corners[side + 1] + shift * across + shift * along}, kPen,
            grey);
    }
  for (const Line& line : details) paint(image, line, kPen, grey);
  return image;
}

Drawing traced_sketch(const Image& image, double details, const ScaleMask* mask = nullptr) {
  Options options;
  options.preset = Preset::rough;
  options.details = details;
  Control control;
  control.mask = mask;
  return vectorize(image, options, control).drawing;
}

std::vector<Line> inside(const Drawing& drawing) {
  std::vector<Line> lines = lines_of(drawing);
  std::erase_if(lines, [](const Line& line) { return norm(line[0] - Vec2{210, 210}) > 150; });
  return lines;
}

struct Shape {
  const char* name;
  Line line;

  friend std::ostream& operator<<(std::ostream& out, const Shape& shape) { return out << shape.name; }
};

class EachDetail : public ::testing::TestWithParam<Shape> {};

TEST_P(EachDetail, OfASketchIsOneCurveOfItsShape) {
  const Line& detail = GetParam().line;
  const Drawing with = traced_sketch(sketch({detail}), Options{}.details), without = traced_sketch(sketch({detail}), 0);
  EXPECT_EQ(inside(with).size(), 1u);
  EXPECT_LT(distance_between(inside(with), {detail}), 0.25 * kPen);
  EXPECT_GT(distance_between(inside(without), {detail}), 0.5 * kPen) << "found without that step, too: the test shows nothing";
}

INSTANTIATE_TEST_SUITE_P(Shapes, EachDetail,
                         ::testing::Values(Shape{"ring", circle({210, 210}, 1.2 * kPen)},
                                           Shape{"larger_ring", circle({200.3, 215.7}, 1.7 * kPen)},
                                           Shape{"hook", {{200, 190}, {200, 206}, {216, 206}}},
                                           Shape{"smile", arc({210, 200}, 1.5 * kPen, 0.1 * pi, 0.9 * pi)},
                                           Shape{"zigzag", {{190, 200}, {199, 216}, {208, 200}, {217, 216}}}),
                         [](const auto& of) { return of.param.name; });

TEST(Details, DrawnOverManyTimesAreOneLine) {
  std::vector<Line> strokes;
  for (const double shift : {-3.0, 0.0, 3.0}) strokes.push_back({{185 - shift, 210 + shift}, {240 + shift, 212 + 1.3 * shift}});
  EXPECT_EQ(inside(traced_sketch(sketch(strokes), Options{}.details)).size(), 1u);
}

TEST(Details, AreMergedWhereAScribbleAsksForThat) {
  const Image image = sketch({circle({210, 210}, 1.7 * kPen)});
  ScaleMask mask{kSize, kSize, std::vector<float>(static_cast<std::size_t>(kSize) * kSize, 1.0f)};
  const auto scribble = [&](float factor) {
    for (int y = 180; y < 240; ++y)
      for (int x = 180; x < 240; ++x) mask.factor[static_cast<std::size_t>(y * kSize + x)] = factor;
  };
  const std::vector<Line> ring{circle({210, 210}, 1.7 * kPen)};
  scribble(0.5);
  EXPECT_LT(distance_between(inside(traced_sketch(image, Options{}.details, &mask)), ring), 0.25 * kPen);
  scribble(2);
  EXPECT_GT(distance_between(inside(traced_sketch(image, Options{}.details, &mask)), ring), 0.5 * kPen);
}

TEST(Details, AreTheSameForAnyNumberOfThreads) {
  std::vector<Line> rings;
  for (const double x : {100.0, 150.0, 200.0, 250.0, 300.0}) rings.push_back(circle({x, 200}, 1.6 * kPen));
  Options one, four;
  one.preset = four.preset = Preset::rough;
  one.threads = 1;
  four.threads = 4;
  const Image image = sketch(rings);
  const Drawing a = vectorize(image, one).drawing, b = vectorize(image, four).drawing;
  ASSERT_EQ(a.curves.size(), b.curves.size());
  EXPECT_EQ(lines_of(a), lines_of(b));
}

}  // namespace
}  // namespace inkgrid
