#include <gtest/gtest.h>

#include <numbers>

#include "chain_checks.h"
#include "ink/slim.h"
#include "refine/ridge.h"

namespace inkgrid {
namespace {

using std::numbers::pi;
using testing::blank;
using testing::chain_along;
using testing::distance_to_line;
using testing::ink_of;
using testing::paint;

constexpr double kWidth = 6;
constexpr RidgeOptions kOptions{1, 1.8, 3};

using Line = std::vector<Vec2>;

// The segment, displaced to its side by `mean` and a wave of amplitude `wave`, px.
Line beside(Vec2 a, Vec2 b, double mean, double wave) {
  const double length = norm(b - a);
  const Vec2 normal = quarter_turn(unit(b - a));
  Line line;
  for (double s = 0; s <= length; s += 1) line.push_back(lerp(a, b, s / length) + (mean + wave * std::sin(s / 9)) * normal);
  return line;
}

// Root of the mean squared distance; `margin` px at both ends of the points are left out.
double rms(const Line& points, const Line& truth, double margin) {
  const auto lengths = lengths_along(points);
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (lengths[k] < margin || lengths.back() - lengths[k] < margin) continue;
    const double d = distance_to_line(points[k], truth);
    sum += d * d;
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(Ridge, ComesBackToTheMiddleOfAStraightStroke) {
  for (const double turn : {0.0, 0.2, 0.7, pi / 2, 2.3}) {
    const Vec2 direction{std::cos(turn), std::sin(turn)};
    const Vec2 a = Vec2{100.3, 100.6} - 70.0 * direction, b = Vec2{100.3, 100.6} + 70.0 * direction;
    Image image = blank(200, 200);
    paint(image, {a, b}, kWidth);
    for (const double mean : {-0.3 * kWidth, 0.0, 0.3 * kWidth}) {
      const double wave = mean == 0 ? 0.3 * kWidth : 0;
      const auto ridges = follow_ridges({chain_along(beside(a, b, mean, wave), kWidth)}, ink_of(image), kOptions);
      ASSERT_EQ(ridges.size(), 1u);
      EXPECT_LT(rms(ridges[0].chain.points, {a, b}, kWidth), 0.15) << turn << " " << mean;
    }
  }
}

TEST(Ridge, ComesBackToTheMiddleOfACircleAndStaysClosed) {
  const Vec2 centre{100.2, 99.7};
  Image image = blank(200, 200);
  paint(image, testing::circle(centre, 60), kWidth);
  for (const double radius : {60 - 0.3 * kWidth, 60 + 0.3 * kWidth}) {
    Chain chain = chain_along(testing::circle(centre, radius), kWidth);
    chain.points.back() = chain.points.front();
    chain.closed = true;
    const auto ridges = follow_ridges({chain}, ink_of(image), kOptions);
    ASSERT_TRUE(ridges[0].chain.closed);
    EXPECT_TRUE(ridges[0].chain.points.front() == ridges[0].chain.points.back());
    double sum = 0;
    for (const Vec2 p : ridges[0].chain.points) sum += (norm(p - centre) - 60) * (norm(p - centre) - 60);
    EXPECT_LT(std::sqrt(sum / static_cast<double>(ridges[0].chain.points.size())), 0.15);
  }
}

TEST(Ridge, MeasuresTheWidthAndTheConfirmedLength) {
  for (const double width : {3.0, 6.0, 9.0}) {
    Image image = blank(200, 100);
    paint(image, {{20, 50.5}, {180, 50.5}}, width);
    const auto ridges = follow_ridges({chain_along({{20, 50}, {180, 50}}, width)}, ink_of(image), kOptions);
    EXPECT_NEAR(ridges[0].chain.width, width, 1);
    EXPECT_NEAR(ridges[0].chain.confirmed, 160, 2 * width);
    EXPECT_EQ(ridges[0].sections.size(), ridges[0].chain.points.size());
  }
}

TEST(Ridge, NothingIsConfirmedOffTheInk) {
  Image image = blank(200, 100);
  paint(image, {{20, 20}, {180, 20}}, kWidth);
  const auto ridges = follow_ridges({chain_along({{20, 80}, {180, 80}}, kWidth)}, ink_of(image), kOptions);
  EXPECT_LT(ridges[0].chain.confirmed, 4);
  for (const Vec2 p : ridges[0].chain.points) EXPECT_NEAR(p.y, 80, 1e-9);
}

TEST(Ridge, StrokesThatTouchSideBySideDoNotMerge) {
  const Line straight{{20, 60}, {240, 60}}, bowed{{20, 90}, {70, 66}, {190, 66}, {240, 90}};
  Image image = blank(260, 120);
  paint(image, straight, kWidth);
  paint(image, bowed, kWidth);
  const auto ridges = follow_ridges(
      {chain_along(beside({20, 60}, {240, 60}, 0.8, 0), kWidth), chain_along({{20, 88}, {70, 65}, {190, 65}, {240, 88}}, kWidth)},
      ink_of(image), kOptions);
  const auto middle_is_near = [](const Line& points, double y) {
    for (const Vec2 p : points)
      if (p.x > 85 && p.x < 175) {
        EXPECT_NEAR(p.y, y, 0.5) << p.x;
      }
  };
  middle_is_near(ridges[0].chain.points, 60);
  middle_is_near(ridges[1].chain.points, 66);
}

// Beside a branch that stands for nothing, a line runs as if it were not there.
TEST(Ridge, ABranchDoesNotBreakTheLine) {
  Image image = blank(200, 100);
  paint(image, {{20, 50}, {180, 50}}, kWidth);
  paint(image, {{100, 57}, {180, 57}}, kWidth);
  const Ink ink = ink_of(image);
  const Line way{{20, 50}, {90, 50}, {110, 54}, {180, 54}};
  RidgeOptions options = kOptions;
  options.stroke_span = 2 * kWidth;
  const auto whole = follow_ridges({chain_along(way, kWidth)}, ink, options)[0].chain.points;
  const Vec2 junction{100, 52};
  const auto parts =
      follow_ridges({chain_along({way[0], way[1], junction}, kWidth, -1, 0),
                     chain_along({way[3], way[2], junction}, kWidth, -1, 0), chain_along({junction, {100, 46}}, kWidth, 0, -1)},
                    ink, options);
  EXPECT_TRUE(parts[0].chain.points.back() == parts[1].chain.points.back()) << "the line is in one piece";
  for (const int part : {0, 1}) EXPECT_LT(rms(parts[static_cast<std::size_t>(part)].chain.points, whole, kWidth), 0.4) << part;
}

TEST(Ridge, ACrossingDoesNotPullTheLineAside) {
  Image image = blank(200, 200);
  paint(image, {{20, 100}, {180, 100}}, kWidth);
  paint(image, {{60, 20}, {140, 180}}, kWidth);
  const auto ridges = follow_ridges({chain_along({{20, 101}, {180, 101}}, kWidth), chain_along({{61, 20}, {141, 180}}, kWidth)},
                                    ink_of(image), kOptions);
  EXPECT_LT(rms(ridges[0].chain.points, {{20, 100}, {180, 100}}, kWidth), 0.15);
  EXPECT_LT(rms(ridges[1].chain.points, {{60, 20}, {140, 180}}, kWidth), 0.15);
}

// A stroke, and a second one beside it from the middle on: the band between them counts as ink.
TEST(Ridge, WhereABundleWidensTheMiddleMovesGently) {
  Image image = blank(300, 100);
  paint(image, {{20, 50}, {280, 50}}, kWidth);
  for (double y = 50; y <= 62; y += 3) paint(image, {{150, y}, {280, y}}, kWidth);
  Ink ink = ink_of(image);
  ink.stroke_width = kWidth;
  const auto points = follow_ridges({chain_along({{22, 50}, {278, 56}}, kWidth)}, ink, kOptions)[0].chain.points;
  EXPECT_NEAR(points[60].y, 50, 0.3);
  EXPECT_NEAR(points[points.size() - 40].y, 56, 0.3);
  double steepest = 0;
  for (std::size_t k = 4; k < points.size(); ++k) steepest = std::max(steepest, std::abs(points[k].y - points[k - 4].y) / 4);
  EXPECT_LT(steepest, 0.35);
}

// The grid has taken two strokes for one line, and the chain has both their ink.
TEST(Ridge, AcrossASlitTheMiddleOfBothIsTaken) {
  Image image = blank(300, 100);
  const double pitch = kWidth + 3;
  for (const double y : {40.0, 40.0 + pitch}) paint(image, {{20, y}, {280, y}}, kWidth);
  const std::vector<Chain> chains{chain_along({{22, 41}, {278, 41}}, kWidth)};
  RidgeOptions options = kOptions;
  options.bridge = 2.5;
  const auto height = [&] { return follow_ridges(chains, ink_of(image), options)[0].chain.points[120].y; };
  EXPECT_NEAR(height(), 40, 0.3) << "paper wider than the bridge ends a stroke";
  options.slit = 2 * options.bridge;
  EXPECT_NEAR(height(), 40 + pitch / 2, 0.3);
}

TEST(Ridge, ASmallLoopDoesNotShrink) {
  const Vec2 centre{60.3, 60.2};
  constexpr RidgeOptions smooth{0.9, 2.7, 0.75 * kWidth};
  for (const double radius : {1.3 * kWidth, 2 * kWidth, 4 * kWidth}) {
    Image image = blank(120, 120);
    paint(image, testing::circle(centre, radius), kWidth);
    Chain loop = chain_along(testing::circle(centre, 1.1 * radius), kWidth);
    loop.closed = true;
    const auto ridges = follow_ridges({loop}, ink_of(image), smooth);
    for (const Vec2 p : ridges[0].chain.points) EXPECT_NEAR(norm(p - centre), radius, 0.1 * radius);
  }
}

// Of two strokes that part slowly slimming leaves a thread in the middle, which is the middle of neither.
TEST(Ridge, AThreadThatSlimmingLeftOfABlotTellsNothing) {
  const double share = 0.6, half = 7.5 * pi / 180;
  const Vec2 fork{60, 100}, arm{std::cos(half), std::sin(half)};
  Image image = blank(220, 200);
  paint(image, {fork - Vec2{40, 0}, fork}, kWidth);
  for (const double side : {1.0, -1.0}) paint(image, {fork, fork + 140 * Vec2{arm.x, side * arm.y}}, kWidth);
  const Ink drawn = ink_of(image), slim = slim_ink(drawn, share);
  const std::vector<Chain> chains{chain_along({fork - Vec2{38, 0}, fork + Vec2{26, 0}}, kWidth)};
  const auto confirmed_in_blot = [&](const RidgeOptions& options) {
    const RidgeChain ridge = follow_ridges(chains, slim, options)[0];
    int count = 0;
    for (std::size_t k = 0; k < ridge.sections.size(); ++k)
      count += ridge.chain.points[k].x > fork.x + 12 && ridge.sections[k].weight > 0;
    EXPECT_GT(ridge.chain.confirmed, 30) << "the stem";
    return count;
  };
  RidgeOptions options = kOptions;
  const int all = confirmed_in_blot(options);
  EXPECT_GE(all, 6);
  options.drawn = &drawn.mask;
  options.taken = drawn.stroke_width - slim.stroke_width;
  EXPECT_LT(confirmed_in_blot(options), all / 2);
}

// Both sides lie in one blot, whose middle is neither's.
TEST(Ridge, SidesOfAnAcuteCornerHaveInkOfTheirOwn) {
  const Vec2 tip{30, 100};
  const Line corner{tip + Vec2{150, -150 * std::tan(0.12)}, tip, tip + Vec2{150, 150 * std::tan(0.12)}};
  Image image = blank(200, 200);
  paint(image, corner, kWidth);
  RidgeOptions options = kOptions;
  const auto farthest = [&] {
    double most = 0;
    const auto ridges = follow_ridges({chain_along(corner, kWidth)}, ink_of(image), options);
    for (const Vec2 p : ridges[0].chain.points)
      if (norm(p - tip) > kWidth) most = std::max(most, distance_to_line(p, corner));
    return most;
  };
  EXPECT_GT(farthest(), 0.15 * kWidth);
  options.corners = true;
  EXPECT_LT(farthest(), 0.1 * kWidth);
}

}  // namespace
}  // namespace inkgrid
