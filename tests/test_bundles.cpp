// Strokes side by side: which are one line, what is filled between them, and what becomes of them in the whole method.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/polyline.h"
#include "drawings.h"
#include "pipeline.h"
#include "refine/bundles.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::paint;

constexpr double kPen = 5;

Flank flank(double gap, double length) {
  Flank f;
  f.gap = gap;
  f.length = length;
  f.clearance = 100;
  return f;
}

TEST(OneLine, ApartIsLessLikelyAndLongIsMoreLikely) {
  double before = 1;
  for (double gap = 0.5 * kPen; gap < 8 * kPen; gap += kPen) {
    const double p = one_line(flank(gap, 100), 0.2, kPen);
    EXPECT_LT(p, before) << gap;
    EXPECT_LT(p, one_line(flank(gap, 200), 0.2, kPen)) << gap;
    before = p;
  }
}

TEST(OneLine, EndsAndMeetingsAndRoomBehindSpeakForIt) {
  const Flank plain = flank(2 * kPen, 60);
  Flank ends = plain, other = plain, meeting = plain, crowded = plain;
  ends.own_ends = 1;
  other.other_ends = 1;
  meeting.meetings = 1;
  crowded.clearance = 2 * kPen;
  for (const double sketchy : {0.0, 0.2, 0.5}) {
    EXPECT_GT(one_line(ends, sketchy, kPen), one_line(plain, sketchy, kPen));
    EXPECT_GT(one_line(other, sketchy, kPen), one_line(plain, sketchy, kPen));
    EXPECT_GT(one_line(meeting, sketchy, kPen), one_line(plain, sketchy, kPen));
    EXPECT_LT(one_line(crowded, sketchy, kPen), one_line(plain, sketchy, kPen));
  }
  EXPECT_GT(one_line(plain, 0.5, kPen), one_line(plain, 0.1, kPen));
}

// Logits by hand from the weights that were fitted.
TEST(OneLine, FollowsTheFittedRule) {
  Flank f = flank(2 * kPen, 60);
  EXPECT_NEAR(one_line(f, 0.2, kPen), 1 / (1 + std::exp(1.4914)), 1e-4);
  f.own_ends = 1;
  EXPECT_NEAR(one_line(f, 0.2, kPen), 1 / (1 + std::exp(-0.2896)), 1e-4);
  EXPECT_FALSE(are_one_line(f, 0.2, kPen)) << "at 57 %";
  f.meetings = 1;
  EXPECT_NEAR(one_line(f, 0.2, kPen), 1 / (1 + std::exp(-0.9216)), 1e-4);
  EXPECT_TRUE(are_one_line(f, 0.2, kPen)) << "at 72 %";
  f.clearance = 5 * kPen;
  EXPECT_NEAR(one_line(f, 0.2, kPen), 1 / (1 + std::exp(0.1894)), 1e-4) << "half of the clearance that counts";
}

TEST(OneLine, DoesNotDependOnTheSizeOfTheDrawing) {
  const Flank small = flank(10, 60);
  Flank large = flank(30, 180);
  large.clearance = 3 * small.clearance;
  EXPECT_NEAR(one_line(small, 0.2, kPen), one_line(large, 0.2, 3 * kPen), 1e-12);
}

// A circle in arcs of 100 degrees, by turns `spread` px inside and outside, each beside the next for 40 degrees.
Image sketched_circle(double spread, double radius = 90) {
  Image image = blank(260, 260);
  for (int k = 0; k < 6; ++k) {
    std::vector<Vec2> arc;
    for (double a = 60 * k - 50; a <= 60 * k + 50; a += 2) {
      const double t = a * std::numbers::pi / 180, r = radius + (k % 2 ? 0.5 : -0.5) * spread;
      arc.push_back({130 + r * std::cos(t), 130 + r * std::sin(t)});
    }
    paint(image, arc, kPen);
  }
  return image;
}

Stages run(const Image& image, BundleMode mode, const ScaleMask* mask = nullptr) {
  Options options;
  options.preset = Preset::rough;
  options.bundles = mode;
  Control control;
  control.mask = mask;
  return run_stages(image, options, control);
}

double length_of(const Stages& stages) {
  return std::accumulate(stages.chains.chains.begin(), stages.chains.chains.end(), 0.0,
                         [](double sum, const Chain& c) { return sum + lengths_along(c.points).back(); });
}

TEST(Bundles, AreJoinedWithAWarningInACleanDrawing) {
  Options options;
  options.bundles = BundleMode::join;
  const auto is_of_bundles = [](const std::string& warning) { return warning.starts_with("bundles are joined"); };
  for (const Preset preset : {Preset::rough, Preset::clean}) {
    options.preset = preset;
    const Report report = vectorize(sketched_circle(9), options).report;
    EXPECT_GT(report.bundles, 0);
    EXPECT_EQ(std::any_of(report.warnings.begin(), report.warnings.end(), is_of_bundles), preset == Preset::clean);
  }
}

TEST(Bundles, AnOverdrawnCircleBecomesOneRound) {
  const double round = 2 * std::numbers::pi * 90;
  for (const double spread : {9.0, 12.0, 15.0}) {
    const Stages kept = run(sketched_circle(spread), BundleMode::keep), joined = run(sketched_circle(spread), BundleMode::join);
    EXPECT_GT(joined.report.bundles, 0) << spread;
    EXPECT_GT(length_of(kept), 1.3 * round) << spread;
    EXPECT_NEAR(length_of(joined), round, 0.1 * round) << spread;
    for (const Chain& chain : joined.chains.chains)
      for (const Vec2 p : chain.points) EXPECT_NEAR(norm(p - Vec2{130, 130}), 90, 0.5 * spread + 0.5 * kPen) << spread;
  }
}

TEST(Bundles, LinesThatEndTogetherStayApart) {
  Image image = blank(300, 120);
  paint(image, {{40, 50}, {260, 50}}, kPen);
  paint(image, {{40, 66}, {260, 66}}, kPen);
  const Stages stages = run(image, BundleMode::join);
  EXPECT_EQ(stages.report.bundles, 0);
  EXPECT_EQ(stages.drawing.curves.size(), 2u);
}

TEST(Bundles, OnlyRoughDrawingsAreJoinedUnasked) {
  EXPECT_EQ(run(sketched_circle(12), BundleMode::automatic).report.bundles,
            run(sketched_circle(12), BundleMode::join).report.bundles);
  Options told;
  told.preset = Preset::rough;
  told.spacing = 1.5;
  EXPECT_EQ(vectorize(sketched_circle(12), told).report.bundles, 0);
  Options clean;
  clean.preset = Preset::clean;
  EXPECT_EQ(vectorize(sketched_circle(12), clean).report.bundles, 0);
}

TEST(Bundles, PurpleKeepsTheStrokesApart) {
  const Image image = sketched_circle(12);
  const Stages kept = run(image, BundleMode::keep), joined = run(image, BundleMode::join);
  const ScaleMask purple{image.width, image.height, std::vector<float>(image.grey.size(), 0.5f)};
  const JoinedInk asked = join_bundles(joined.ink, joined.bundles, &purple);
  EXPECT_EQ(asked.ink.mask.data, joined.ink.mask.data);
  EXPECT_EQ(asked.scale.factor, std::vector<float>(image.grey.size(), 1.0f));
  EXPECT_GT(length_of(run(image, BundleMode::join, &purple)), 0.9 * length_of(kept));
}

TEST(Bundles, JoinedInkHoldsTheInkAndIsAsCoarseAsTheBundleIsWide) {
  const Stages stages = run(sketched_circle(12), BundleMode::join);
  const JoinedInk joined = join_bundles(stages.ink, stages.bundles, nullptr);
  EXPECT_EQ(joined.ink.stroke_width, stages.ink.stroke_width);
  for (std::size_t i = 0; i < joined.ink.mask.data.size(); ++i)
    ASSERT_EQ(joined.ink.mask.data[i], stages.ink.mask.data[i] | stages.bundles.slits.data[i]);
  const auto [least, most] = std::minmax_element(joined.scale.factor.begin(), joined.scale.factor.end());
  EXPECT_EQ(*least, 1);
  const double wide = (12 + kPen) / stages.ink.stroke_width;  // depths are taken along rows and columns
  EXPECT_GT(*most, 0.8 * wide);
  EXPECT_LT(*most, std::numbers::sqrt2 * wide);
}

TEST(Bundles, ABlankOrSingleLineDrawingHasNone) {
  EXPECT_EQ(find_bundles({}, run(sketched_circle(12), BundleMode::keep).ink).count, 0);
  Image image = blank(200, 100);
  paint(image, {{20, 50}, {180, 50}}, kPen);
  EXPECT_EQ(run(image, BundleMode::join).report.bundles, 0);
}

}  // namespace
}  // namespace inkgrid
