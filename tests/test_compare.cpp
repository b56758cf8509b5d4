// The measures on curves whose answers are known.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/comparison_text.h"
#include "export/export.h"
#include "inkgrid/inkgrid.h"
#include "svg_files.h"

namespace inkgrid {
namespace {

using testing::page;
using testing::stroke;
using testing::strokes;

constexpr double kStep = 0.5;       // px, between samples
constexpr double kTolerance = 2.0;  // px: half the pen of the test pages

// A line of 300 px, and what a share of it may be off by for the steps between samples.
const std::string kLine = "M50 100H350";
constexpr double kLength = 300, kShare = 2 * kStep / kLength;

TEST(Compare, IdenticalCurvesAgree) {
  const SvgText drawing = strokes("M20 50C100 0 200 200 380 60", "M200 20V280", "M30 200A60 60 0 1 0 30 200.5", kLine);
  const Comparison c = compare_svg(drawing, drawing);
  for (const double one :
       {c.length.f1, c.length.precision, c.length.recall, c.without_tangents.f1, c.f1_half_tolerance, c.duplicate_ratio,
        c.junctions.f1, c.ends.f1, c.length_ratio, c.segments_ratio, c.curves_ratio, c.benchmark.f_score.f1})
    EXPECT_NEAR(one, 1, 1e-9);
  for (const double zero : {c.chamfer, c.hausdorff95, c.benchmark.chamfer, c.benchmark.hausdorff, c.filled_share})
    EXPECT_EQ(zero, 0);
  EXPECT_GT(c.junctions.truth, 0);
  EXPECT_GT(c.ends.truth, 0);
}

// Beside the line, so that each of its points is off by as much.
TEST(Compare, ShiftAcross) {
  for (const double shift : {0.4, 0.9, 1.1, 1.9, 2.1, 5.0, 30.0}) {
    const Comparison c = compare_svg(strokes("M50 " + std::to_string(100 + shift) + "H350"), strokes(kLine));
    EXPECT_EQ(c.length.f1, shift < kTolerance ? 1 : 0) << shift;
    EXPECT_EQ(c.f1_half_tolerance, shift < kTolerance / 2 ? 1 : 0) << shift;
    EXPECT_NEAR(c.chamfer, std::min(shift, 20.0), 1e-9);
    EXPECT_NEAR(c.hausdorff95, shift, 1e-9);
    EXPECT_NEAR(c.benchmark.chamfer, shift, 1e-9);
    EXPECT_NEAR(c.benchmark.hausdorff, shift, 1e-9);
    EXPECT_EQ(c.benchmark.f_score.f1, shift < 0.8 ? 1 : 0) << shift;  // 2 thousandths of 400 px
    EXPECT_EQ(c.ends.f1, shift <= 2 * kTolerance + 2 ? 1 : 0) << shift;
  }
}

// Along the line: the part that sticks out is not found, but for the tolerance.
TEST(Compare, ShiftAlong) {
  for (const double shift : {10.0, 60.0, 150.0}) {
    const Comparison c = compare_svg(strokes("M" + std::to_string(50 + shift) + " 100h300"), strokes(kLine));
    const double share = (kLength - shift + kTolerance) / kLength;
    EXPECT_NEAR(c.length.precision, share, kShare);
    EXPECT_NEAR(c.length.recall, share, kShare);
    EXPECT_NEAR(c.length.f1, share, kShare);
    EXPECT_NEAR(c.benchmark.hausdorff, shift, kStep);
    EXPECT_NEAR(c.benchmark.chamfer, shift * shift / 2 / kLength, kStep);
    EXPECT_NEAR(c.hausdorff95, shift - 0.05 * kLength, shift > 0.05 * kLength ? kStep : 10);
  }
}

TEST(Compare, MissingHalf) {
  const Comparison c = compare_svg(strokes("M50 100h150"), strokes(kLine));
  EXPECT_EQ(c.length.precision, 1);
  EXPECT_NEAR(c.length.recall, 0.5 + kTolerance / kLength, kShare);
  EXPECT_NEAR(c.length_ratio, 0.5, 1e-9);
  EXPECT_NEAR(c.duplicate_ratio, 150 / (150 + kTolerance), kShare);
  EXPECT_EQ(c.ends.precision, 0.5);
  EXPECT_EQ(c.ends.recall, 0.5);
}

TEST(Compare, DoubledCurves) {
  const std::string curve = "M20 50C100 0 200 200 380 60";
  const Comparison c = compare_svg(page(stroke(curve) + stroke(curve, "transform='translate(0.5 0.5)'")), strokes(curve));
  EXPECT_NEAR(c.length.f1, 1, 1e-9);
  EXPECT_NEAR(c.duplicate_ratio, 2, 1e-3);
  EXPECT_NEAR(c.length_ratio, 2, 1e-3);
  EXPECT_EQ(c.curves_ratio, 2);
}

// Only the places of a curve that crosses the truth agree.
TEST(Compare, CrossingCurvesAgreeInPlaceAlone) {
  const Comparison c = compare_svg(strokes("M200 0V200"), strokes(kLine));
  EXPECT_EQ(c.length.f1, 0);
  EXPECT_NEAR(c.without_tangents.precision, 2 * kTolerance / 200, 2 * kStep / 200);
  EXPECT_NEAR(c.without_tangents.recall, 2 * kTolerance / kLength, kShare);
}

TEST(Compare, TangentsMayDifferByThirtyDegrees) {
  for (const double degrees : {0.0, 20.0, 29.0, 31.0, 60.0, 89.0}) {
    const std::string turn = "transform='rotate(" + std::to_string(degrees) + " 200 100)'";
    const Comparison there = compare_svg(page(stroke("M199 100H201", turn)), strokes(kLine));
    const Comparison back = compare_svg(page(stroke("M201 100H199", turn)), strokes(kLine));
    EXPECT_EQ(there.length.precision, degrees < 30 ? 1 : 0) << degrees;
    EXPECT_EQ(there.without_tangents.precision, 1) << degrees;
    EXPECT_EQ(back.length.precision, there.length.precision) << degrees;
  }
}

TEST(Compare, ToleranceComesFromKindAndPen) {
  const std::tuple<const char*, double, double> cases[] = {{"clean", 2, 1.5}, {"clean", 8, 4},          {"rough", 1, 3},
                                                           {"rough", 4, 6},   {"oversketched", 10, 15}, {"other", 8, 4}};
  for (const auto& [set, pen, tolerance] : cases) {
    const SvgText truth =
        page(stroke(kLine), "viewBox='0 0 400 300' data-set='" + std::string(set) + "' data-pen='" + std::to_string(pen) + "'");
    EXPECT_NEAR(compare_svg(truth, truth).tolerance, tolerance, 1e-9) << set;
  }
  const SvgText plain = page(stroke(kLine, "stroke-width='6'") + stroke(kLine, "stroke-width='9'"), "viewBox='0 0 400 300'");
  EXPECT_NEAR(compare_svg(plain, plain).pen, 7.5, 1e-9);
  EXPECT_EQ(compare_svg(plain, plain).set, "clean");
}

TEST(Compare, ToleranceAsAsked) {
  const SvgText truth = strokes(kLine), result = strokes("M50 105H350");
  EXPECT_EQ(compare_svg(result, truth, {.tolerance = 4.9, .tolerance_pens = {}}).length.f1, 0);
  EXPECT_EQ(compare_svg(result, truth, {.tolerance = 5.1, .tolerance_pens = {}}).length.f1, 1);
  EXPECT_NEAR(compare_svg(result, truth, {.tolerance = {}, .tolerance_pens = 2}).tolerance, 8, 1e-9);
  EXPECT_NEAR(compare_svg(result, truth, {.tolerance = {}, .tolerance_pens = 0.1}).tolerance, 1.5, 1e-9);
  EXPECT_EQ(compare_svg(result, truth, {.tolerance = {}, .tolerance_pens = {}, .distance = 12.4}).benchmark.f_score.f1, 0);
  EXPECT_EQ(compare_svg(result, truth, {.tolerance = {}, .tolerance_pens = {}, .distance = 12.6}).benchmark.f_score.f1, 1);
  for (const double bad : {0.0, -1.0, std::nan(""), 1e9}) {
    EXPECT_THROW(compare_svg(result, truth, {.tolerance = bad, .tolerance_pens = {}}), Error);
    EXPECT_THROW(compare_svg(result, truth, {.tolerance = {}, .tolerance_pens = bad}), Error);
    EXPECT_THROW(compare_svg(result, truth, {.tolerance = {}, .tolerance_pens = {}, .distance = bad}), Error);
  }
}

TEST(Compare, NothingFound) {
  const Comparison c = compare_svg(page(""), strokes(kLine));
  for (const double zero :
       {c.length.precision, c.length.recall, c.length.f1, c.duplicate_ratio, c.length_ratio, c.benchmark.f_score.f1, c.ends.f1})
    EXPECT_EQ(zero, 0);
  EXPECT_EQ(c.chamfer, 20);
  for (const double diagonal : {c.hausdorff95, c.benchmark.chamfer, c.benchmark.hausdorff}) EXPECT_NEAR(diagonal, 500, 1e-9);
  EXPECT_EQ(c.junctions.f1, 1);  // none here, none there
}

TEST(Compare, Counts) {
  const Comparison c =
      compare_svg(page(stroke("M0 0L30 0L30 40M0 50Q5 50 10 50") + "<circle r='5' cx='9' cy='9' fill='red'/>"), strokes(kLine));
  EXPECT_EQ(c.result.elements, 2);
  EXPECT_EQ(c.result.curves, 3);
  EXPECT_EQ(c.result.lines, 2);
  EXPECT_EQ(c.result.quadratics, 1);
  EXPECT_EQ(c.result.cubics, 4);
  EXPECT_EQ(c.segments_ratio, 7);
  EXPECT_EQ(c.curves_ratio, 3);
  EXPECT_NEAR(c.filled_share, 1 / 3.0, 1e-9);
  const double circle = 10 * std::numbers::pi;
  EXPECT_NEAR(c.result.length, 80 + circle, 0.02);
  EXPECT_NEAR(c.result.mean_length, (80 + circle) / 3, 0.01);
  EXPECT_NEAR(c.result.median_length, circle, 0.02);
}

TEST(Compare, OverdrawnCurvesHaveARecallOfTheirOwn) {
  const SvgText truth = page(stroke(kLine, "data-strokes='3'") + stroke("M50 200H350"));
  EXPECT_EQ(compare_svg(strokes("M50 200H350"), truth).recall_overdrawn, 0);
  EXPECT_EQ(compare_svg(strokes(kLine), truth).recall_overdrawn, 1);
  EXPECT_NEAR(compare_svg(strokes(kLine), truth).length.recall, 0.5, 1e-9);
  EXPECT_FALSE(compare_svg(strokes(kLine), strokes(kLine)).recall_overdrawn.has_value());
}

struct Counted {
  const char* what;
  std::vector<std::string> curves;
  int junctions;
  int ends;
};

TEST(BranchPoints, AreCounted) {
  const Counted cases[] = {
      {"a line", {kLine}, 0, 2},
      {"a line in three pieces", {"M50 100H150", "M150 100H220L300 100", "M350 100H300"}, 0, 2},
      {"a corner of two lines", {"M50 100H150", "M150 100V200"}, 0, 2},
      {"a closed curve", {"M100 100A50 50 0 0 1 200 100A50 50 0 0 1 100 100Z"}, 0, 0},
      {"a curve that ends where it began", {"M100 100A50 50 0 0 1 200 100A50 50 0 0 1 100 100.0005"}, 0, 0},
      {"a crossing", {kLine, "M200 20V200"}, 1, 4},
      {"a T", {kLine, "M200 100V200"}, 1, 3},
      {"a T that stops short", {kLine, "M200 104V200"}, 0, 4},
      {"a T that goes on a little", {kLine, "M200 97V200"}, 1, 3},
      {"a Y", {"M200 100L100 50", "M200 100L300 50", "M200 100V200"}, 1, 3},
      {"an X of two corners", {"M100 50L200 100L300 50", "M100 150L200 100L300 150"}, 1, 4},
      {"a star of six",
       {"M200 100H350", "M200 100H50", "M200 100L270 30", "M200 100L130 30", "M200 100L270 170", "M200 100L130 170"},
       1,
       6},
      {"a loop", {"M50 100C400 100 0 200 0 250"}, 0, 2},
      {"a curve that crosses itself", {"M50 200C450 0 -50 0 350 200"}, 1, 2},
      {"circles that cross",
       {"M100 100a50 50 0 0 1 100 0a50 50 0 0 1 -100 0", "M150 100a50 50 0 0 1 100 0a50 50 0 0 1 -100 0"},
       2,
       0},
      {"a tail at the seam", {"M100 100a50 50 0 0 1 100 0a50 50 0 0 1 -100 0", "M100 100H20"}, 1, 1},
      {"a tail opposite the seam", {"M100 100a50 50 0 0 1 100 0a50 50 0 0 1 -100 0", "M200 100H290"}, 1, 1},
      {"a line drawn twice", {kLine, kLine}, 0, 0},
      {"a dot", {"M100 100a1 1 0 0 1 2 0a1 1 0 0 1 -2 0"}, 0, 0},
  };
  for (const Counted& c : cases) {
    std::string content;
    for (const std::string& data : c.curves) content += stroke(data);
    const Comparison comparison = compare_svg(page(content), page(content));
    EXPECT_EQ(comparison.junctions.result, c.junctions) << c.what;
    EXPECT_EQ(comparison.ends.result, c.ends) << c.what;
  }
}

TEST(BranchPoints, TouchWithinAQuarterOfABroadPenOnCleanPagesAndWithinTheToleranceOnOthers) {
  const auto junctions = [](const std::string& set, const std::string& start) {
    const SvgText drawing =
        page(stroke(kLine) + stroke("M200 " + start + "V250"), "viewBox='0 0 400 300' data-pen='20' data-set='" + set + "'");
    return compare_svg(drawing, drawing).junctions.result;
  };
  EXPECT_EQ(junctions("clean", "105"), 1);
  EXPECT_EQ(junctions("clean", "107"), 0);
  EXPECT_EQ(junctions("rough", "107"), 1);
}

TEST(BranchPoints, OfALattice) {
  std::string content;
  for (int k = 0; k < 7; ++k) content += stroke("M20 " + std::to_string(40 + 30 * k) + "H380");
  for (int k = 0; k < 9; ++k) content += stroke("M" + std::to_string(40 + 40 * k) + " 10V270");
  const Comparison c = compare_svg(page(content), page(content));
  EXPECT_EQ(c.junctions.truth, 7 * 9);
  EXPECT_EQ(c.ends.truth, 2 * (7 + 9));
}

TEST(BranchPoints, AreMatchedOneToOne) {
  const SvgText truth = strokes(kLine, "M200 20V200");
  const Comparison two = compare_svg(strokes(kLine, "M199 20V200", "M240 20V200"), truth);
  EXPECT_EQ(two.junctions.precision, 0.5);
  EXPECT_EQ(two.junctions.recall, 1);
  EXPECT_NEAR(two.junctions.f1, 2 / 3.0, 1e-12);
  EXPECT_EQ(compare_svg(strokes(kLine, "M205 20V200"), truth).junctions.f1, 1);
  EXPECT_EQ(compare_svg(strokes(kLine, "M207 20V200"), truth).junctions.f1, 0);
}

// A drawing with something of everything, and a result that is wrong in several ways.
const std::string kTruth = stroke("M30 40C120 10 220 190 370 60") + stroke("M200 20V280") +
                           stroke("M60 200a40 40 0 0 1 80 0a40 40 0 0 1 -80 0") + stroke("M140 200H360L360 120");
const std::string kResult = stroke("M30 41C120 12 220 189 371 61") + stroke("M201.3 20V150") + stroke("M198.6 145V290") +
                            stroke("M60 200a40 40 0 0 1 80 0a40 40 0 0 1 -80 0") + stroke("M141 203L300 190") +
                            stroke("M300 20h30v33");

std::vector<double> all_measures(const Comparison& c) {
  return {c.length.precision,
          c.length.recall,
          c.without_tangents.precision,
          c.without_tangents.recall,
          c.f1_half_tolerance,
          c.duplicate_ratio,
          c.chamfer,
          c.hausdorff95,
          c.junctions.precision,
          c.junctions.recall,
          c.ends.precision,
          c.ends.recall,
          c.length_ratio,
          c.benchmark.chamfer,
          c.benchmark.hausdorff,
          c.benchmark.f_score.f1,
          c.result.median_length};
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double difference, const char* what) {
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], difference) << what << ", measure " << i;
}

TEST(Compare, MotionsOfBothSidesChangeNothing) {
  const auto measured = [](const std::string& transform) {
    const auto moved = [&](const std::string& content) {
      return page("<g transform='" + transform + "'>" + content + "</g>", "viewBox='-500 -500 1000 1000' data-pen='4'");
    };
    return all_measures(compare_svg(moved(kResult), moved(kTruth)));
  };
  const auto still = measured("");
  for (const char* transform : {"rotate(90)", "rotate(180)", "scale(-1 1)", "translate(-31.25 17)"})
    expect_near(measured(transform), still, 1e-3, transform);
  expect_near(measured("rotate(37)"), still, 0.01, "rotate(37)");
}

TEST(Compare, SidesChangePlaces) {
  const Comparison there = compare_svg(page(kResult), page(kTruth)), back = compare_svg(page(kTruth), page(kResult));
  EXPECT_EQ(there.length.precision, back.length.recall);
  EXPECT_EQ(there.length.f1, back.length.f1);
  EXPECT_EQ(there.junctions.precision, back.junctions.recall);
  EXPECT_EQ(there.ends.f1, back.ends.f1);
  EXPECT_NEAR(there.duplicate_ratio, 1 / back.duplicate_ratio, 1e-9);
  EXPECT_EQ(there.chamfer, back.chamfer);
  EXPECT_EQ(there.benchmark.hausdorff, back.benchmark.hausdorff);
}

TEST(Compare, DrawingsAreTheirSvg) {
  Drawing drawing;
  drawing.width = 400;
  drawing.height = 300;
  Curve curve;
  curve.segments = {{{20, 50}, {100, 0}, {200, 200}, {380, 60}}, {{380, 60}, {390, 70}, {300, 100}, {300, 200}}};
  curve.width = 3;
  drawing.curves = {curve};
  const Comparison direct = compare_drawing(drawing, page(kTruth));
  const Comparison through_text =
      compare_svg({"drawing.svg", export_drawing(drawing, export_format("svg"), {}, "")}, page(kTruth));
  EXPECT_EQ(comparison_json(direct), comparison_json(through_text));
}

TEST(Compare, NamesTheFileThatIsWrong) {
  const auto complaint = [](const SvgText& result, const SvgText& truth) -> std::string {
    try {
      compare_svg(result, truth);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::file);
      return error.what();
    }
    return "";
  };
  const SvgText good = strokes(kLine);
  EXPECT_NE(complaint({"r.svg", "text"}, good).find("'r.svg'"), std::string::npos);
  EXPECT_NE(complaint(good, {"t.svg", "text"}).find("'t.svg'"), std::string::npos);
  EXPECT_NE(complaint({"long.svg", page(stroke("M0 0H900000000")).text}, good).find("too long"), std::string::npos);
}

TEST(Compare, CurvesThatCrossTooOftenAreRefused) {
  std::string data;
  for (int i = 0; i < 3500; ++i) {
    const double angle = i * std::numbers::pi / 3500, x = 10 * std::cos(angle), y = 10 * std::sin(angle);
    data += "M" + std::to_string(200 - x) + " " + std::to_string(150 - y) + "L" + std::to_string(200 + x) + " " +
            std::to_string(150 + y);
  }
  EXPECT_THROW(compare_svg(strokes(data), strokes(kLine)), Error);
}

TEST(ComparisonText, JsonHoldsTheMeasures) {
  const Comparison c = compare_svg(page(kResult), page(kTruth));
  const auto json = nlohmann::json::parse(comparison_json(c));
  EXPECT_EQ(json.at("f1"), c.length.f1);
  EXPECT_EQ(json.at("junctions").at("precision"), c.junctions.precision);
  EXPECT_EQ(json.at("ends").at("truth"), c.ends.truth);
  EXPECT_EQ(json.at("truth").at("segments"), c.truth.segments);
  EXPECT_EQ(json.at("benchmark").at("hausdorff"), c.benchmark.hausdorff);
  EXPECT_TRUE(json.at("recall_overdrawn").is_null());
}

TEST(ComparisonText, WarnsOfOutlines) {
  const SvgText outline = page("<path d='M50 98H350V102H50Z'/>");
  EXPECT_NE(comparison_text(compare_svg(outline, strokes(kLine))).find("outlines"), std::string::npos);
  EXPECT_EQ(comparison_text(compare_svg(strokes(kLine), strokes(kLine))).find("outlines"), std::string::npos);
}

}  // namespace
}  // namespace inkgrid
