// Reading SVG: every way to write a curve gives the curve that was meant, and what is no SVG is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compare/svg_document.h"
#include "inkgrid/inkgrid.h"
#include "svg_files.h"

namespace inkgrid {
namespace {

using testing::page;
using testing::stroke;

std::vector<SvgCurve> curves_of(const std::string& content) {
  return read_svg(page(content)).curves;
}

// All control points, in order.
std::vector<Vec2> points_of(const std::vector<SvgCurve>& curves) {
  std::vector<Vec2> points;
  for (const SvgCurve& curve : curves)
    for (const PathSegment& segment : curve.segments)
      for (int i = 0; i <= segment.degree; ++i) points.push_back(segment.points[static_cast<std::size_t>(i)]);
  return points;
}

void expect_same(const std::vector<SvgCurve>& a, const std::vector<SvgCurve>& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  const auto p = points_of(a), q = points_of(b);
  ASSERT_EQ(p.size(), q.size()) << what;
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_LT(norm(p[i] - q[i]), 1e-9) << what << ", point " << i;
}

Vec2 on_cubic(const PathSegment& s, double t) {
  const double u = 1 - t;
  return u * u * u * s.points[0] + 3 * u * u * t * s.points[1] + 3 * u * t * t * s.points[2] + t * t * t * s.points[3];
}

TEST(SvgPath, EveryCommandIsItsAbsoluteForm) {
  const std::pair<const char*, const char*> forms[] = {
      {"m10 20 30 5 -4 6", "M10,20 L40,25 L36,31"},
      {"M10 20H50V70h-5v-6", "M10,20 L50,20 L50,70 L45,70 L45,64"},
      {"M1 2l3 4zl1 1", "M1,2 L4,6 L1,2 M1,2 L2,3"},
      {"M1 2c1 0 2 1 3 3s1 4 5 5", "M1,2 C2,2 3,3 4,5 C5,7 5,9 9,10"},
      {"M1 2C1 5 2 6 3 7S8 8 9 3", "M1,2 C1,5 2,6 3,7 C4,8 8,8 9,3"},
      {"M1 2S8 8 9 3", "M1,2 C1,2 8,8 9,3"},
      {"M1 2q3 4 5 6t7 1", "M1,2 Q4,6 6,8 Q8,10 13,9"},
      {"M1 2Q4 6 6 8T13 9T20 20", "M1,2 Q4,6 6,8 Q8,10 13,9 Q18,8 20,20"},
      {"M1 2T6 8", "M1,2 Q1,2 6,8"},
      {"M1 2Q4 6 6 8S9 9 5 5", "M1,2 Q4,6 6,8 C6,8 9,9 5,5"},
      {"M.5.5-1-1e1 2.E+0,3", "M0.5,0.5 L-1,-10 L2,3"},
      {"M0 0a25 25 0 0150-25", "M0,0 A25,25 0 0 1 50,-25"},
      {"M0 0a25 25 0 11.5.5", "M0,0 A25,25 0 1 1 0.5,0.5"},
      {"M0 0A0 5 0 0 1 9 9", "M0,0 L9,9"},
      {"M0 0A-5 5 0 0 1 5 5", "M0,0 A5,5 0 0 1 5,5"},
      {"M7 7A5 5 0 0 1 7 7L8 8", "M7,7 L8,8"},
  };
  for (const auto& [shorter, longer] : forms) expect_same(curves_of(stroke(shorter)), curves_of(stroke(longer)), shorter);
}

TEST(SvgPath, ClosingReturnsToTheStartOnce) {
  EXPECT_EQ(curves_of(stroke("M0 0L9 0L9 9Z"))[0].segments.size(), 3u);
  EXPECT_EQ(curves_of(stroke("M0 0L9 0L9 9L0 0Z"))[0].segments.size(), 3u);
}

TEST(SvgPath, AnErrorEndsThePathAndIsNoted) {
  const SvgDocument document = read_svg(page(stroke("M0 0L9 0L9 x L5 5") + stroke("M1 1L2 2")));
  EXPECT_EQ(document.curves[0].segments.size(), 1u);
  EXPECT_EQ(document.curves[1].segments.size(), 1u);
  EXPECT_EQ(document.notes.size(), 1u);
  EXPECT_TRUE(read_svg(page(stroke("M0 0L9 0"))).notes.empty());
}

// Samples of the arc lie on an ellipse of these radii and turn, and run round its centre as the flags say.
TEST(SvgPath, ArcsLieOnTheirEllipse) {
  const Vec2 start{100, 120}, end{160, 90};
  const double rx = 60, ry = 45, degrees = 25;
  for (const bool large : {false, true})
    for (const bool sweep : {false, true}) {
      const std::string flags = std::to_string(large) + ' ' + std::to_string(sweep);
      const auto curves = curves_of(stroke("M100 120A60 45 25 " + flags + " 160 90"));
      ASSERT_EQ(curves.size(), 1u);
      const SubPath& arc = curves[0].segments;
      EXPECT_EQ(arc.front().front(), start);
      EXPECT_EQ(arc.back().back(), end);
      // In the frame where the ellipse is the unit circle, three samples give the centre.
      const Vec2 turn{std::cos(degrees * std::numbers::pi / 180), -std::sin(degrees * std::numbers::pi / 180)};
      const auto round = [&](Vec2 p) { return Vec2{(turn * p).x / rx, (turn * p).y / ry}; };
      const Vec2 a = round(start), b = round(end), middle = (a + b) / 2;
      const double half = norm(b - a) / 2, height = std::sqrt(1 - half * half);
      const Vec2 centre = middle + (large == sweep ? -1 : 1) * height * quarter_turn(unit(b - a));
      double turned = 0;
      Vec2 before = a - centre;
      for (const PathSegment& segment : arc)
        for (int k = 1; k <= 20; ++k) {
          const Vec2 now = round(on_cubic(segment, k / 20.0)) - centre;
          EXPECT_NEAR(norm(now), 1, 3e-4) << flags;
          turned += std::atan2(cross(before, now), dot(before, now));
          before = now;
        }
      EXPECT_EQ(turned > 0, sweep) << flags;
      EXPECT_EQ(std::abs(turned) > std::numbers::pi, large) << flags;
    }
}

TEST(SvgPath, RadiiThatAreTooSmallGrow) {
  const auto curves = curves_of(stroke("M100 100A1 1 0 0 1 180 100"));
  for (const PathSegment& segment : curves[0].segments)
    for (int k = 0; k <= 10; ++k) EXPECT_NEAR(norm(on_cubic(segment, k / 10.0) - Vec2{140, 100}), 40, 0.02);
}

TEST(SvgShapes, AreTheirPaths) {
  const std::string ink = "fill='none' stroke='black' ";
  const std::pair<std::string, const char*> forms[] = {
      {"<line " + ink + "x1='1' y1='2' x2='3' y2='4'/>", "M1 2L3 4"},
      {"<line " + ink + "x1='10%' y1='10%' x2='1in' y2='3pt'/>", "M40 30L96 4"},
      {"<polyline " + ink + "points='1,2 3,4 5 6'/>", "M1 2L3 4L5 6"},
      {"<polygon " + ink + "points='1,2 3,4 5 6'/>", "M1 2L3 4L5 6Z"},
      {"<rect " + ink + "x='1' y='2' width='30' height='40'/>", "M1 2L31 2L31 42L1 42Z"},
      {"<rect " + ink + "x='1' y='2' width='30' height='40' rx='5'/>",
       "M6 2H26A5 5 0 0 1 31 7V37A5 5 0 0 1 26 42H6A5 5 0 0 1 1 37V7A5 5 0 0 1 6 2"},
      {"<rect " + ink + "x='1' y='2' width='30' height='40' rx='5' ry='99'/>",
       "M6 2H26A5 20 0 0 1 31 22A5 20 0 0 1 26 42H6A5 20 0 0 1 1 22A5 20 0 0 1 6 2"},
      {"<circle " + ink + "cx='50' cy='60' r='7'/>", "M57 60A7 7 0 0 1 50 67A7 7 0 0 1 43 60A7 7 0 0 1 50 53A7 7 0 0 1 57 60"},
      {"<ellipse " + ink + "cx='50' cy='60' rx='7' ry='3'/>",
       "M57 60A7 3 0 0 1 50 63A7 3 0 0 1 43 60A7 3 0 0 1 50 57A7 3 0 0 1 57 60"},
  };
  for (const auto& [shape, path] : forms) expect_same(curves_of(shape), curves_of(stroke(path)), shape);
}

TEST(SvgShapes, WithoutSizeAreNothing) {
  EXPECT_TRUE(
      curves_of("<rect width='0' height='5' stroke='red'/><circle r='0' stroke='red'/><polyline points='3 4' stroke='red'/>")
          .empty());
}

TEST(SvgTransforms, AreTheirMatrix) {
  const std::pair<const char*, const char*> forms[] = {
      {"translate(3 4)", "matrix(1 0 0 1 3 4)"},
      {"translate(3)", "matrix(1 0 0 1 3 0)"},
      {"scale(2)", "matrix(2 0 0 2 0 0)"},
      {"scale(2, -3)", "matrix(2 0 0 -3 0 0)"},
      {"rotate(90)", "matrix(0 1 -1 0 0 0)"},
      {"rotate(90 10 20)", "matrix(0 1 -1 0 30 10)"},
      {"skewX(45)", "matrix(1 0 1 1 0 0)"},
      {"skewY(45)", "matrix(1 1 0 1 0 0)"},
      {"translate(10,0) rotate(90) , scale(2)", "matrix(0 2 -2 0 10 0)"},
      {"scale(2)translate(10)", "matrix(2 0 0 2 20 0)"},
      {"wobble(3)", "matrix(1 0 0 1 0 0)"},
  };
  const std::string data = "M5 6L70 9C1 2 3 40 5 60";
  for (const auto& [form, matrix] : forms)
    expect_same(curves_of(stroke(data, "transform='" + std::string(form) + "'")),
                curves_of(stroke(data, "transform='" + std::string(matrix) + "'")), form);
  expect_same(curves_of(stroke("M1 2L3 4", "transform='matrix(1 2 3 4 5 6)'")), curves_of(stroke("M12 16L20 28")), "matrix");
}

TEST(SvgTransforms, OfGroupsApplyFromTheInside) {
  expect_same(curves_of("<g transform='translate(10 0)'><g transform='rotate(90)'>" + stroke("M1 0L2 0") + "</g></g>"),
              curves_of(stroke("M10 1L10 2")), "groups");
}

TEST(SvgTransforms, ScaleStrokeWidths) {
  EXPECT_NEAR(curves_of("<g transform='scale(2 8)'>" + stroke("M0 0L1 1", "stroke-width='3'") + "</g>")[0].stroke_width, 12,
              1e-12);
}

TEST(SvgStructure, UsesSymbolsAndNestedPages) {
  const std::string line = stroke("M1 1L2 2", "id='a'");
  expect_same(curves_of("<defs>" + line + "</defs><use href='#a' x='10' y='20'/>"), curves_of(stroke("M11 21L12 22")), "use");
  expect_same(curves_of("<symbol id='s'>" + line + "</symbol><use xlink:href='#s' transform='scale(2)'/>"),
              curves_of(stroke("M2 2L4 4")), "symbol, with a prefix that is not declared");
  expect_same(curves_of("<svg x='10' y='20' width='40' height='40' viewBox='0 0 4 4'>" + line + "</svg>"),
              curves_of(stroke("M20 30L30 40")), "nested page");
  EXPECT_TRUE(curves_of("<g id='g'><use href='#g'/></g><use href='#missing'/>").empty());
}

TEST(SvgStructure, WhatIsNotDrawnDoesNotCount) {
  const std::string seen = stroke("M0 0L9 9"), other = stroke("M5 5L6 6");
  for (const char* wrapper : {"defs", "clipPath", "mask", "marker", "pattern", "symbol", "metadata", "foreignObject"}) {
    const std::string tag = wrapper;
    expect_same(curves_of("<" + tag + ">" + other + "</" + tag + ">" + seen), curves_of(seen), tag);
  }
  expect_same(curves_of("<g display='none'>" + other + "</g>" + seen), curves_of(seen), "display");
  expect_same(curves_of("<g visibility='hidden'>" + other + "</g>" + seen), curves_of(seen), "visibility");
  expect_same(curves_of("<path fill='none' d='M5 5L6 6'/>" + seen), curves_of(seen), "unpainted");
  expect_same(curves_of("<path fill='none' stroke='red' stroke-width='0' d='M5 5L6 6'/>" + seen), curves_of(seen), "no width");
  expect_same(curves_of("<rect width='400' height='300' fill='white'/>" + seen), curves_of(seen), "paper");
  EXPECT_EQ(curves_of("<rect width='400' height='300' stroke='black'/>" + seen).size(), 2u);
}

TEST(SvgStructure, AllCountsWhereNothingIsPainted) {
  const SvgDocument document = read_svg(page("<path fill='none' d='M5 5L6 6'/>"));
  EXPECT_EQ(document.curves.size(), 1u);
  EXPECT_EQ(document.notes.size(), 1u);
}

TEST(SvgStyles, AttributeRuleAndStyleInThisOrder) {
  const auto stroke_width = [](const std::string& css, const std::string& attributes) {
    const std::string style = "<style>/* { */ " + css + "</style>";
    return curves_of(style + "<g class='k'><path stroke='black' d='M0 0L1 1' " + attributes + "/></g>").at(0).stroke_width;
  };
  EXPECT_EQ(stroke_width("", "stroke-width='2'"), 2);
  EXPECT_EQ(stroke_width("path{stroke-width:3}", "stroke-width='2'"), 3);
  EXPECT_EQ(stroke_width(".a { stroke-width : 4px !important }", "stroke-width='2' class='b a'"), 4);
  EXPECT_EQ(stroke_width("#i,.z{stroke-width:5}", "id='i'"), 5);
  EXPECT_EQ(stroke_width("path.a{stroke-width:6} path.b{stroke-width:7}", "class='a'"), 6);
  EXPECT_EQ(stroke_width("g .a{stroke-width:6}", "class='a'"), 6);
  EXPECT_EQ(stroke_width("g>.a{stroke-width:6}", "class='a'"), 1);
  EXPECT_EQ(stroke_width("@media print { .a { stroke-width: 8 } }", "class='a'"), 8);
  EXPECT_EQ(stroke_width(".a{stroke-width:9}", "class='a' style='stroke-width:10'"), 10);
  EXPECT_EQ(stroke_width("", "stroke-width='bold'"), 1);
}

TEST(SvgStyles, AreInherited) {
  const auto curves = curves_of("<g stroke='red' stroke-width='3' fill='none'>" + std::string("<path d='M0 0L1 1'/>") +
                                "<path stroke='inherit' stroke-width='2mm' d='M0 0L1 1'/></g><path d='M0 0L9 0L9 9'/>");
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[0].stroke_width, 3);
  EXPECT_NEAR(curves[1].stroke_width, 2 * 96 / 25.4, 1e-12);
  EXPECT_FALSE(curves[1].filled);
  EXPECT_TRUE(curves[2].filled);
}

// Where the corners of the viewBox come to lie.
struct Fitted {
  const char* attributes;
  Extent page;
  Vec2 first, last;
};

TEST(SvgPage, IsFilledAsAsked) {
  const Fitted cases[] = {
      {"viewBox='10 20 40 30'", {40, 30}, {0, 0}, {40, 30}},
      {"viewBox='10 20 40 30' width='80' height='60'", {80, 60}, {0, 0}, {80, 60}},
      {"viewBox='10,20,40,30' width='80px' height='90'", {80, 90}, {0, 15}, {80, 75}},
      {"viewBox='10 20 40 30' width='80' height='90' preserveAspectRatio='xMinYMin meet'", {80, 90}, {0, 0}, {80, 60}},
      {"viewBox='10 20 40 30' width='80' height='90' preserveAspectRatio='xMaxYMax'", {80, 90}, {0, 30}, {80, 90}},
      {"viewBox='10 20 40 30' width='80' height='90' preserveAspectRatio='xMidYMid slice'", {80, 90}, {-20, 0}, {100, 90}},
      {"viewBox='10 20 40 30' width='80' height='90' preserveAspectRatio='none'", {80, 90}, {0, 0}, {80, 90}},
      {"viewBox='10 20 40 30' width='200mm' height='150mm'", {40, 30}, {0, 0}, {40, 30}},
      {"viewBox='10 20 40 30' width='100%' height='100%'", {40, 30}, {0, 0}, {40, 30}},
      {"width='80' height='60'", {80, 60}, {10, 20}, {50, 50}},
      {"width='1in' height='2in'", {96, 192}, {10, 20}, {50, 50}},
  };
  for (const Fitted& c : cases) {
    const SvgDocument document = read_svg(page(stroke("M10 20L50 50"), c.attributes));
    EXPECT_NEAR(document.page.width, c.page.width, 1e-9) << c.attributes;
    EXPECT_NEAR(document.page.height, c.page.height, 1e-9) << c.attributes;
    EXPECT_LT(norm(document.curves[0].segments[0].front() - c.first), 1e-9) << c.attributes;
    EXPECT_LT(norm(document.curves[0].segments[0].back() - c.last), 1e-9) << c.attributes;
  }
}

TEST(SvgPage, OfAnotherSizeIsFittedToTheOneGiven) {
  const auto end_on = [](const char* attributes, std::size_t notes) {
    const SvgDocument document = read_svg(page(stroke("M0 0L40 30"), attributes), Extent{800, 600});
    EXPECT_EQ(document.notes.size(), notes) << attributes;
    return document.curves[0].segments[0].back();
  };
  EXPECT_EQ(end_on("viewBox='0 0 40 30'", 0), (Vec2{800, 600}));
  EXPECT_EQ(end_on("viewBox='0 0 40 30' width='40' height='30'", 1), (Vec2{800, 600}));
  EXPECT_EQ(end_on("viewBox='0 0 40 30' width='804' height='603'", 0), (Vec2{804, 603}));
  EXPECT_EQ(end_on("width='40' height='30'", 1), (Vec2{800, 600}));
  EXPECT_NEAR(end_on("width='880' height='660'", 1).x, 40 * 800 / 880.0, 1e-9);
  EXPECT_EQ(end_on("width='40' height='40'", 1), (Vec2{40, 30}));
  EXPECT_EQ(end_on("width='40' height='33'", 1), (Vec2{40, 30}));
}

TEST(SvgPage, SaysPenSetAndOverdrawnCurves) {
  const SvgDocument document = read_svg(page(stroke("M0 0L9 9", "data-strokes='3'") + stroke("M0 0L9 9", "data-strokes='1'"),
                                             "viewBox='0 0 40 30' data-pen='3.5' data-set='rough'"));
  EXPECT_EQ(document.pen, 3.5);
  EXPECT_EQ(document.set, "rough");
  EXPECT_TRUE(document.curves[0].overdrawn);
  EXPECT_FALSE(document.curves[1].overdrawn);
}

TEST(SvgFile, EncodingsEntitiesAndPrefixes) {
  const std::string line = "<path stroke='black' d='M1 1L2 2'/>";
  for (const std::string& text : {
           "<?xml version='1.0' encoding='ISO-8859-1'?><svg viewBox='0 0 9 9'><!-- \xe9 -->" + line + "</svg>",
           std::string("\xef\xbb\xbf<svg viewBox='0 0 9 9'>") + line + "</svg>",
           "<!DOCTYPE svg [<!ENTITY box '0 0 9 9'>]><svg viewBox='&box;'>" + line + "</svg>",
           std::string("<s:svg viewBox='0 0 9 9'><s:path stroke='black' d='M1 1L2 2'/></s:svg>"),
       })
    EXPECT_EQ(read_svg({"a.svg", text}).curves.size(), 1u) << text;
}

TEST(SvgFile, CoordinatesBeyondReasonAreLeftOut) {
  const auto curves = curves_of(stroke("M0 0L9 9L1e300 1e400L5 5") + stroke("M0 0L1e-400 1") + stroke("M0 0L9 9L1e10 0"));
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[0].segments.size(), 1u);
  EXPECT_EQ(curves[1].segments[0].back(), (Vec2{0, 1}));
  EXPECT_EQ(curves[2].segments.size(), 1u);
}

void expect_refused(const std::string& text, const std::string& reason) {
  try {
    read_svg({"bad.svg", text});
    ADD_FAILURE() << "accepted: " << text.substr(0, 60);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::file);
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find("'bad.svg'"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(reason), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(SvgFile, WhatIsNoSvgIsRefused) {
  expect_refused("", "no element");
  expect_refused("\x89PNG\r\n\x1a\n", "line 1");
  expect_refused("<svg viewBox='0 0 9 9'>\n<g></svg>", "line 2");
  expect_refused("<svg viewBox='0 0 9 9'/><svg/>", "no SVG");
  expect_refused("<html><body/></html>", "<html>");
  expect_refused("<svg><path d='M0 0L1 1'/></svg>", "size");
  expect_refused("<svg viewBox='0 0 0 9' width='5'/>", "size");
  expect_refused("<svg viewBox='0 0 9 9'>" + repeated("<g>", 1000) + repeated("</g>", 1000) + "</svg>", "nested");
}

TEST(SvgFile, UsesOfUsesDoNotExplode) {
  std::string text = "<svg viewBox='0 0 9 9'><g id='g0'/>";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "<use href='#g" + std::to_string(i - 1) + "'/>";
    text += "<g id='g" + std::to_string(i) + "'>" + before + before + before + "</g>";
  }
  expect_refused(text + "</svg>", "too many");
}

}  // namespace
}  // namespace inkgrid
