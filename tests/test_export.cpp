// The table of formats and their options, and what each format must say.  Programs that read them are in
// tests/cli/test_formats.py.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/cubic.h"
#include "export/export.h"
#include "export/writers.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

using Json = nlohmann::json;

Curve outline(Vec2 centre, double radius) {
  Curve curve;
  curve.closed = true;
  const Vec2 start = centre - Vec2{radius, 0}, middle = centre + Vec2{radius, 0}, up{0, 1.3 * radius};
  curve.segments = {{start, start - up, middle - up, middle}, {middle, middle + up, start + up, start}};
  return curve;
}

// An arch, a loop, and a filled ring; the arch ends in a junction at (30, 40).
Drawing sample() {
  Drawing drawing;
  drawing.width = 120;
  drawing.height = 90;
  drawing.junctions = {{30, 40}};
  Curve arch;
  arch.segments = {{{30, 40}, {40, 10}, {80, 10}, {90, 40}}, {{90, 40}, {93, 49}, {95, 60}, {95.125, 70}}};
  arch.width = 3.5;
  arch.coverage = 0.75;
  arch.start_junction = 0;
  Curve loop;
  loop.segments = {{{60, 50}, {90, 50}, {90, 80}, {60, 80}}, {{60, 80}, {30, 80}, {30, 50}, {60, 50}}};
  loop.closed = true;
  loop.width = 2;
  loop.coverage = 1;
  loop.id = 18446744073709551615u;
  drawing.curves = {arch, loop};
  drawing.fills = {{{outline({20, 70}, 15), outline({20, 70}, 5)}}};
  return drawing;
}

std::string written(std::string_view format, const Drawing& drawing, const ExportOptions& options = {}) {
  return export_drawing(drawing, export_format(format), options, "inkgrid (test) \\ \x01");
}

TEST(ExportTable, FormatsAreFoundByTheirNames) {
  std::set<std::string_view> names;
  for (const ExportFormat& format : export_formats()) {
    EXPECT_EQ(&export_format(format.name), &format);
    EXPECT_NE(format.media_type.find('/'), std::string_view::npos);
    names.insert(format.name);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"svg", "pdf", "eps", "dxf", "json", "png"}));
  EXPECT_EQ(export_formats().front().name, "svg");
  EXPECT_THROW(export_format("SVG "), Error);
}

TEST(ExportTable, EveryOptionReadsBackWhatItWrites) {
  const std::map<std::string_view, std::string> other{{"unit", "inch"},          {"resolution", "300"}, {"stroke-width", "0.25"},
                                                      {"dxf-curves", "splines"}, {"flatness", "0.5"},   {"png-scale", "2"}};
  ASSERT_EQ(export_option_table().size(), other.size());
  for (const ExportOptionRow& row : export_option_table()) {
    ExportOptions options;
    const std::string by_default = option_text(options, row);
    set_option(options, row, other.at(row.name));
    EXPECT_EQ(option_text(options, row), other.at(row.name));
    set_option(options, row, by_default);
    EXPECT_EQ(option_text(options, row), by_default);
    EXPECT_THROW(set_option(options, row, "rubbish"), Error);
    EXPECT_THROW(set_option(options, row, ""), Error);
    EXPECT_EQ(option_text(options, row), by_default);
  }
}

TEST(ExportTable, OptionsOutOfRangeAreRefusedWhateverTheFormat) {
  ExportOptions options;
  for (const double bad : {0.0, -1.0, 1e9, std::nan("")}) {
    for (double* value : {&options.flatness, &options.png_scale}) {
      const double good = std::exchange(*value, bad);
      EXPECT_THROW(written("svg", sample(), options), Error) << bad;
      *value = good;
    }
    for (std::optional<double>* value : {&options.resolution, &options.stroke_width}) {
      *value = bad;
      EXPECT_THROW(written("json", sample(), options), Error) << bad;
      value->reset();
    }
  }
  EXPECT_NO_THROW(written("svg", sample(), options));
}

TEST(Export, NoFormatWritesWhatIsNoNumber) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300})
    for (const ExportFormat& format : export_formats()) {
      Drawing drawing = sample();
      drawing.curves[0].segments[1].p2.y = bad;
      EXPECT_THROW(written(format.name, drawing), Error) << format.name;
      drawing = sample();
      drawing.fills[0].outlines[1].segments[0].p1.x = bad;
      EXPECT_THROW(written(format.name, drawing), Error) << format.name;
    }
}

TEST(Export, AnEmptyDrawingIsAFileOfEveryFormat) {
  Drawing drawing;
  drawing.width = drawing.height = 1;
  for (const ExportFormat& format : export_formats()) EXPECT_GT(written(format.name, drawing).size(), 50u) << format.name;
}

TEST(Pdf, EveryObjectIsWhereTheTableSaysAndTheStreamAsLongAsItSays) {
  const std::string text = written("pdf", sample());
  const auto number_after = [&](const std::string& mark) { return std::stoul(text.substr(text.rfind(mark) + mark.size())); };
  const std::size_t table = number_after("startxref\n");
  EXPECT_EQ(text.substr(table, 5), "xref\n");
  const std::size_t count = number_after("/Size ");
  const std::size_t entries = text.find('\n', table + 5) + 1;
  for (std::size_t i = 1; i < count; ++i) {
    const std::size_t begin = std::stoul(text.substr(entries + 20 * i, 10));
    const std::string head = std::to_string(i) + " 0 obj";
    EXPECT_EQ(text.substr(begin, head.size()), head);
  }
  const std::size_t stream = text.find("stream\n") + 7;
  EXPECT_EQ(text.substr(stream + number_after("/Length "), 9), "endstream");
}

TEST(Pdf, DescriptionCannotEndItsString) {
  EXPECT_NE(written("pdf", sample()).find("/Subject (inkgrid \\(test\\) \\\\ )"), std::string::npos);
}

TEST(Eps, StructureIsThatOfAnEncapsulatedFile) {
  const std::string text = written("eps", sample());
  EXPECT_EQ(text.substr(0, 24), "%!PS-Adobe-3.0 EPSF-3.0\n");
  EXPECT_NE(text.find("%%BoundingBox: 0 0 90 68\n"), std::string::npos);  // 90 px are 67.5 points
  EXPECT_NE(text.find("%%HiResBoundingBox: 0 0 90 67.5\n"), std::string::npos);
  EXPECT_EQ(text.substr(text.size() - 6), "%%EOF\n");
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes.at(at + k));
  return value;
}

long count_of(std::string_view part, const std::string& text) {
  long count = 0;
  for (auto place = text.find(part); place != std::string::npos; place = text.find(part, place + part.size())) ++count;
  return count;
}

TEST(Dxf, AClosedPolylineDoesNotRepeatItsFirstPoint) {
  Drawing drawing = sample();
  drawing.curves.erase(drawing.curves.begin());
  drawing.fills.clear();
  ExportOptions options;
  options.flatness = 100;  // a chord a segment
  EXPECT_EQ(
      count_of("\r\nVERTEX\r\n", written("dxf", drawing, options)) + count_of("\nVERTEX\n", written("dxf", drawing, options)), 2);
}

TEST(Png, SizeIsThatOfTheDrawingTimesTheScale) {
  ExportOptions options;
  for (const double scale : {0.1, 1.0, 2.5}) {
    options.png_scale = scale;
    const std::string bytes = written("png", sample(), options);
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    EXPECT_EQ(big_endian(bytes, 16), std::lround(120 * scale));
    EXPECT_EQ(big_endian(bytes, 20), std::lround(90 * scale));
  }
}

TEST(Png, TooLargeIsRefused) {
  Drawing strip;
  strip.width = 40000;
  strip.height = 1;
  EXPECT_THROW(written("png", strip), Error);
}

Vec2 point_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>()};
}

TEST(Graph, HoldsTheDrawingToTheLastDigit) {
  Drawing drawing = sample();
  drawing.pixels_per_mm = 300 / 25.4;
  drawing.curves[0].segments[0].p1 = {1 / 3.0, std::sqrt(2)};
  const Json json = Json::parse(written("json", drawing));
  EXPECT_EQ(json.at("pixels_per_mm").get<double>(), drawing.pixels_per_mm);
  EXPECT_EQ(point_of(json.at("junctions").at(0).at("at")), drawing.junctions[0]);
  ASSERT_EQ(json.at("curves").size(), drawing.curves.size());
  for (std::size_t i = 0; i < drawing.curves.size(); ++i) {
    const Json& written_curve = json.at("curves").at(i);
    const Curve& curve = drawing.curves[i];
    EXPECT_EQ(written_curve.at("id"), i + 1);
    EXPECT_EQ(written_curve.at("key"), std::to_string(curve.id));
    EXPECT_EQ(written_curve.at("closed"), curve.closed);
    EXPECT_EQ(written_curve.at("width").get<double>(), curve.width);
    EXPECT_EQ(written_curve.at("coverage").get<double>(), curve.coverage);
    const Json& points = written_curve.at("points");
    ASSERT_EQ(points.size(), 3 * curve.segments.size() + 1);
    for (std::size_t k = 0; k < curve.segments.size(); ++k) {
      const Cubic& c = curve.segments[k];
      const Vec2 expected[] = {c.p0, c.p1, c.p2, c.p3};
      for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(point_of(points.at(3 * k + n)), expected[n]);
    }
  }
  ASSERT_EQ(json.at("fills").size(), 1u);
  const Json& outlines = json.at("fills").at(0).at("outlines");
  ASSERT_EQ(outlines.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(outlines.at(i).size(), 7u);
    EXPECT_EQ(point_of(outlines.at(i).at(4)), drawing.fills[0].outlines[i].segments[1].p1);
  }
  EXPECT_EQ(json.at("curves").at(0).at("start"), 1);
  EXPECT_TRUE(json.at("curves").at(0).at("end").is_null());
}

TEST(Cubics, ChordsStayWithinTheTolerance) {
  const Cubic cubics[] = {
      {{0, 0}, {100, 0}, {0, 100}, {100, 100}}, {{0, 0}, {50, 90}, {50, 90}, {100, 0}}, {{0, 0}, {90, 9}, {10, 9}, {100, 0}}};
  for (const Cubic& cubic : cubics)
    for (const double tolerance : {10.0, 1.0, 0.05}) {
      const int chords = chords_within(cubic, tolerance);
      for (int i = 0; i < chords; ++i)
        for (int k = 1; k < 16; ++k) {
          const double t = (i + k / 16.0) / chords;
          const Vec2 chord = lerp(point_on(cubic, i * 1.0 / chords), point_on(cubic, (i + 1.0) / chords), k / 16.0);
          EXPECT_LE(norm(point_on(cubic, t) - chord), tolerance * (1 + 1e-9));
        }
    }
  EXPECT_EQ(chords_within({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, 0.01), 1);
}

TEST(Cubics, PartsAreTheWholeAndMeet) {
  const Cubic cubic{{0, 0}, {10, 40}, {70, -20}, {100, 30}};
  for (const double t : {0.0, 0.3, 0.5, 1.0}) {
    const auto [before, after] = cut(cubic, t);
    EXPECT_EQ(before.p3, after.p0);
    EXPECT_EQ(before.p0, cubic.p0);
    EXPECT_EQ(after.p3, cubic.p3);
    for (const double s : {0.2, 0.7}) {
      EXPECT_NEAR(norm(point_on(before, s) - point_on(cubic, s * t)), 0, 1e-12);
      EXPECT_NEAR(norm(point_on(after, s) - point_on(cubic, t + s * (1 - t))), 0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace inkgrid
