// SVG text: what a drawing says, said once, the same everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <locale>
#include <regex>

#include "export/writers.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

Curve line(Vec2 a, Vec2 b, double width = 3) {
  Curve curve;
  curve.segments = {{a, lerp(a, b, 1 / 3.0), lerp(a, b, 2 / 3.0), b}};
  curve.width = width;
  return curve;
}

Drawing drawing_of(std::vector<Curve> curves) {
  Drawing drawing;
  drawing.width = 640;
  drawing.height = 480;
  drawing.curves = std::move(curves);
  return drawing;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

std::string only(const std::string& text, const std::string& pattern) {
  const auto found = matches(text, pattern);
  EXPECT_EQ(found.size(), 1u) << pattern << " in " << text;
  return found.empty() ? "" : found.front();
}

std::string path_of(const Curve& curve) {
  return only(svg_text(drawing_of({curve}), {}, ""), " d=\"([^\"]*)\"");
}

TEST(Svg, SizeIsInPixelsWithoutResolution) {
  const std::string text = svg_text(drawing_of({}), {}, "");
  EXPECT_EQ(only(text, "viewBox=\"([^\"]*)\""), "0 0 640 480");
  EXPECT_EQ(only(text, " width=\"([^\"]*)\""), "640");
  EXPECT_EQ(only(text, " height=\"([^\"]*)\""), "480");
}

TEST(Svg, SizeIsInMillimetresWithResolution) {
  Drawing drawing = drawing_of({});
  drawing.pixels_per_mm = 300 / 25.4;
  const std::string text = svg_text(drawing, {}, "");
  EXPECT_EQ(only(text, "viewBox=\"([^\"]*)\""), "0 0 640 480");
  EXPECT_EQ(only(text, " width=\"([^\"]*)\""), "54.187mm");
  EXPECT_EQ(only(text, " height=\"([^\"]*)\""), "40.64mm");
}

TEST(Svg, OnePathACurveNumberedInOrder) {
  const std::string text = svg_text(drawing_of({line({0, 0}, {1, 0}), line({0, 1}, {1, 1}, 4.25), line({0, 2}, {1, 2})}), {}, "");
  EXPECT_EQ(matches(text, "<path id=\"([^\"]*)\""), (std::vector<std::string>{"curve-1", "curve-2", "curve-3"}));
  EXPECT_EQ(matches(text, "stroke-width=\"([^\"]*)\""), (std::vector<std::string>{"3", "4.25", "3"}));
}

TEST(Svg, SegmentsAreCubics) {
  Curve curve = line({0, 0}, {3, 0});
  curve.segments.push_back({{3, 0}, {4, 0.5}, {5, 1.25}, {6, 1.5}});
  EXPECT_EQ(path_of(curve), "M0,0 C1,0 2,0 3,0 C4,0.5 5,1.25 6,1.5");
}

TEST(Svg, ClosedCurvesEndWithZOpenOnesDoNot) {
  Curve loop;
  loop.closed = true;
  loop.segments = {{{0, 0}, {1, 0}, {2, 1}, {2, 2}}, {{2, 2}, {1, 2}, {0, 1}, {0, 0}}};
  EXPECT_EQ(path_of(loop), "M0,0 C1,0 2,1 2,2 C1,2 0,1 0,0 z");
  loop.closed = false;
  EXPECT_EQ(path_of(loop).find('z'), std::string::npos);
}

TEST(Svg, FillsAreAGroupOfTheirOwnBelowTheCurves) {
  Curve loop;
  loop.closed = true;
  loop.segments = {{{0, 0}, {1, 0}, {2, 1}, {2, 2}}, {{2, 2}, {1, 2}, {0, 1}, {0, 0}}};
  Drawing drawing = drawing_of({line({0, 0}, {1, 0})});
  drawing.fills = {{{loop, loop}}, {{loop}}};
  const std::string text = svg_text(drawing, {}, "");
  const std::string group = only(text, "(<g id=\"fills\"[^>]*>)");
  EXPECT_NE(group.find("fill-rule=\"evenodd\""), std::string::npos);
  EXPECT_NE(group.find("stroke=\"none\""), std::string::npos);
  const std::string data = "M0,0 C1,0 2,1 2,2 C1,2 0,1 0,0 z";
  EXPECT_EQ(only(text, "<path id=\"fill-1\" d=\"([^\"]*)\""), data + " " + data);
  EXPECT_EQ(only(text, "<path id=\"fill-2\" d=\"([^\"]*)\""), data);
  EXPECT_LT(text.find("id=\"fill-2\""), text.find("id=\"curve-1\""));
  EXPECT_EQ(svg_text(drawing_of({}), {}, "").find("fills"), std::string::npos);
}

TEST(Svg, NumbersAreShortest) {
  EXPECT_EQ(path_of(line({100, -0.0001}, {0.1 + 0.2, 1e-9})).substr(0, 7), "M100,0 ");
  const Curve curve = line({1.0004, 2.0006}, {1234.5, 0.0999});
  const std::string data = path_of(curve);
  EXPECT_EQ(data.substr(0, data.find(' ')), "M1,2.001");
  EXPECT_EQ(data.substr(data.rfind(' ')), " 1234.5,0.1");
}

TEST(Svg, NumbersStayWithinHalfAThousandth) {
  for (int i = 0; i < 1000; ++i) {
    const double x = std::sin(i) * std::pow(10, i % 5), y = std::cos(3 * i) * 700;
    const auto numbers = matches(path_of(line({x, y}, {0, 0})), "(-?[0-9.]+)");
    EXPECT_NEAR(std::stod(numbers[0]), x, 0.0005 + 1e-12);
    EXPECT_NEAR(std::stod(numbers[1]), y, 0.0005 + 1e-12);
  }
}

TEST(Svg, EqualPointsAreWrittenEqually) {
  const Vec2 junction{1 / 3.0, 200.0 / 7};
  const auto paths = matches(svg_text(drawing_of({line({0, 0}, junction), line(junction, {9, 9})}), {}, ""), " d=\"([^\"]*)\"");
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].substr(paths[0].rfind(' ') + 1), paths[1].substr(1, paths[1].find(' ') - 1));
}

class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Svg, DoesNotDependOnTheLocale) {
  const Drawing drawing = drawing_of({line({12345.678, 0.5}, {1, 2.25})});
  const std::string before = svg_text(drawing, {}, "x");
  const std::locale old = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  const std::string after = svg_text(drawing, {}, "x");
  std::locale::global(old);
  EXPECT_EQ(before, after);
}

TEST(Svg, DescriptionIsEscaped) {
  const std::string text = svg_text(drawing_of({}), {}, "a < b && c > \"d\"\x01");
  EXPECT_EQ(only(text, "<metadata>(.*)</metadata>"), "a &lt; b &amp;&amp; c &gt; \"d\"");
}

TEST(Svg, CurvesOfUnknownWidthStayVisible) {
  EXPECT_TRUE(matches(svg_text(drawing_of({line({0, 0}, {1, 1}, 0)}), {}, ""), "stroke-width=\"(0)\"").empty());
}

}  // namespace
}  // namespace inkgrid
