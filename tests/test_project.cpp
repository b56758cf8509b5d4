// Scribbles, base64 and the project file: what is written is read back, and what is wrong is refused in a sentence.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/decimal.h"
#include "drawings.h"
#include "inkgrid/inkgrid.h"
#include "options.h"
#include "project/project.h"

namespace inkgrid {
namespace {

using Json = nlohmann::json;

// A cross of two strokes as a PGM file.
std::string cross_file() {
  Image image = testing::blank(160, 120);
  testing::paint(image, {{20, 60}, {140, 60}}, 6);
  testing::paint(image, {{80, 15}, {80, 105}}, 6);
  return "P5 160 120 255\n" + std::string(image.grey.begin(), image.grey.end());
}

Project sample() {
  Project project;
  project.drawing = {"cross.pgm", cross_file()};
  project.mask = ImageFile{"m.png", std::string("\0\xff\n\"", 4)};
  project.options.spacing = 1.25;
  project.options.preset = Preset::rough;
  project.options.field_rounds = 7;
  project.options.damping = 1 / 3.0;
  project.scribbles = {
      {ScribbleKind::less, 12.5, {{1, 2}, {1 / 3.0, -4}}}, {ScribbleKind::erase, 3, {{7, 8}}}, {ScribbleKind::more, 0, {}}};
  project.edits = {
      {EditKind::remove, {30, 60}, {}, 8}, {EditKind::join, {1, 2}, {3, 4}, 2.5}, {EditKind::split, {100, 60}, {}, 8}};
  return project;
}

std::string sentence_of(const std::string& text) {
  try {
    parse_project(text, "p.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::file);
    return error.what();
  }
  return "";
}

// The sentence about the sample project with one member changed; null takes it away.
std::string sentence_with(const std::string& pointer, const Json& value) {
  Json json = Json::parse(project_text(sample()));
  const Json::json_pointer place(pointer);
  json[place] = value;
  if (value.is_null()) json[place.parent_pointer()].erase(place.back());
  return sentence_of(json.dump());
}

TEST(Base64, KnownAnswers) {
  // RFC 4648, section 10.
  for (const auto& [bytes, text] : {std::pair{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

TEST(Base64, ReadsBackAllBytes) {
  std::string bytes;
  for (int i = 0; i < 700; ++i) {
    EXPECT_EQ(from_base64(base64(bytes)), bytes);
    bytes += static_cast<char>(i * 37 + i / 256);
  }
}

TEST(Base64, RefusesAllElse) {
  for (const char* text :
       {"Z", "Zg", "Zg=", "Zg===", "====", "Zh==", "Zm9=", "Zm9v\n", "Zm 9", "Z=9v", "Zm9v=", "\xff\xff\xff\xff", "Zg==Zg=="})
    EXPECT_FALSE(from_base64(text)) << text;
}

double distance_to_stroke(const Scribble& scribble, Vec2 p) {
  double least = norm(scribble.points.front() - p);
  for (std::size_t i = 1; i < scribble.points.size(); ++i)
    least = std::min(least, testing::distance_to_segment(p, scribble.points[i - 1], scribble.points[i]));
  return least;
}

TEST(Scribbles, PixelsAreThoseWithinTheBrush) {
  const std::vector<Scribble> scribbles{{ScribbleKind::more, 7.3, {{10, 10}, {60.2, 33}, {58, 70}, {-20, 40}}},
                                        {ScribbleKind::less, 4, {{30, 30}}},
                                        {ScribbleKind::less, 9, {{70, 5}, {70, 5}, {120, 5}}},
                                        {ScribbleKind::erase, 5.5, {{0, 0}, {80, 60}}},
                                        {ScribbleKind::more, 300, {{1000, 30}}},
                                        {ScribbleKind::less, 0.4, {{11, 51}, {61, 51}}}};
  const float factors[] = {2, 0.5f, 0.5f, 1, 2, 0.5f};
  ScaleMask mask{80, 60, std::vector<float>(80 * 60, 1.0f)};
  paint_scribbles(mask, scribbles);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      float expected = 1;
      bool on_rim = false;
      for (std::size_t i = 0; i < scribbles.size(); ++i) {
        const double beyond = distance_to_stroke(scribbles[i], {x + 0.5, y + 0.5}) - scribbles[i].radius;
        on_rim |= std::abs(beyond) < 1e-9;
        if (beyond <= 0) expected = factors[i];
      }
      if (on_rim) continue;
      EXPECT_EQ(mask.factor[static_cast<std::size_t>(80 * y + x)], expected) << x << ", " << y;
    }
}

TEST(Scribbles, OneWithoutPointsPaintsNothing) {
  ScaleMask mask{8, 6, std::vector<float>(48, 1.0f)};
  paint_scribbles(mask, std::vector<Scribble>{{ScribbleKind::more, 5, {}}});
  EXPECT_EQ(mask.factor, std::vector<float>(48, 1.0f));
}

TEST(Project, ReadsBackAllThatIsWritten) {
  const Project before = sample();
  const std::string text = project_text(before);
  const Project after = parse_project(text, "p.json");
  EXPECT_EQ(project_text(after), text);
  EXPECT_EQ(after.drawing.name, before.drawing.name);
  EXPECT_EQ(after.drawing.bytes, before.drawing.bytes);
  EXPECT_EQ(after.mask->bytes, before.mask->bytes);
  EXPECT_EQ(command_line_text(after.options), command_line_text(before.options));
  ASSERT_EQ(after.scribbles.size(), before.scribbles.size());
  for (std::size_t i = 0; i < before.scribbles.size(); ++i) {
    EXPECT_EQ(after.scribbles[i].kind, before.scribbles[i].kind);
    EXPECT_EQ(after.scribbles[i].radius, before.scribbles[i].radius);
    EXPECT_EQ(after.scribbles[i].points, before.scribbles[i].points);
  }
  ASSERT_EQ(after.edits.size(), before.edits.size());
  for (std::size_t i = 0; i < before.edits.size(); ++i) {
    EXPECT_EQ(after.edits[i].kind, before.edits[i].kind);
    EXPECT_EQ(after.edits[i].at, before.edits[i].at);
    EXPECT_EQ(after.edits[i].to, before.edits[i].to);
    EXPECT_EQ(after.edits[i].tolerance, before.edits[i].tolerance);
  }
}

TEST(Project, EveryOptionThatIsNoDefaultReadsBack) {
  for (const OptionRow& row : option_table()) {
    Project project;
    const std::map<std::string_view, std::string> words = {{"preset", "clean"}, {"fills", "drop"}, {"bundles", "keep"}};
    set_option(project.options, row, words.contains(row.name) ? words.at(row.name) : shortest(row.most));
    ASSERT_FALSE(is_default(project.options, row)) << row.name;
    const Project after = parse_project(project_text(project), "p.json");
    EXPECT_EQ(command_line_text(after.options), command_line_text(project.options));
  }
}

TEST(Project, DefaultsAreNotWritten) {
  EXPECT_EQ(Json::parse(project_text({})).at("options"), Json::object());
}

TEST(Project, DrawingIsAllThatItNeeds) {
  const Project project =
      parse_project(R"({"format": "inkgrid-project", "version": 1, "drawing": {"name": "a", "data": "Zm9v"}})", "p.json");
  EXPECT_EQ(project.drawing.bytes, "foo");
  EXPECT_TRUE(project.scribbles.empty() && project.edits.empty() && !project.mask);
  EXPECT_EQ(command_line_text(project.options), "");
}

TEST(Project, WhatIsNoProjectIsRefusedByName) {
  for (const std::string text : {"", "{", "[]", "null", "3", "{\"format\": 3}", "{\"format\": \"inkgrid-graph\", \"version\": 1}",
                                 "\xff\xfe", "{\"format\": \"inkgrid-project\", \"version\": 1e999}"})
    EXPECT_EQ(sentence_of(text).substr(0, 8), "'p.json'") << text;
  const std::string whole = project_text(sample());
  for (std::size_t length = 0; length + 2 < whole.size(); length += 1 + whole.size() / 60)
    EXPECT_NE(sentence_of(whole.substr(0, length)), "") << length;
}

TEST(Project, DeepNestingIsRefused) {
  EXPECT_NE(sentence_of(std::string(1'000'000, '[')), "");
  EXPECT_NE(sentence_of(std::string(200'000, '[') + std::string(200'000, ']')), "");
}

TEST(Project, SaysWhatIsWrongAndWhere) {
  const auto expect = [](const std::string& pointer, const Json& value, const std::string& part) {
    const std::string sentence = sentence_with(pointer, value);
    EXPECT_NE(sentence.find(part), std::string::npos) << pointer << ": " << sentence;
  };
  expect("/version", 2, "version");
  expect("/version", "1", "version");
  expect("/version", 1.5, "version");
  expect("/drawing", nullptr, "lacks 'drawing'");
  expect("/drawing", "x", "drawing must be an object");
  expect("/drawing/data", "Zm9", "base64");
  expect("/drawing/data", 3, "drawing.data");
  expect("/drawing/name", nullptr, "drawing lacks 'name'");
  expect("/mask/data", "Zm9v!", "base64");
  expect("/surprise", 1, "'surprise'");
  expect("/options", 1, "options must be an object");
  expect("/options/spacing", 1e9, "spacing must be a number from 0.1 to 100");
  expect("/options/spacing", true, "options.spacing must be a number or a text");
  expect("/options/preset", "tidy", "'tidy'");
  expect("/options/field-rounds", 2.5, "field-rounds must be a whole number");
  expect("/options/colour", 1, "'colour'");
  expect("/scribbles", Json::object(), "scribbles must be a list");
  expect("/scribbles/0/kind", "lots", "scribbles[0].kind is 'lots'");
  expect("/scribbles/0/radius", -1, "scribbles[0].radius must be a number from 0 to 1000000");
  expect("/scribbles/0/radius", 1e300, "scribbles[0].radius");
  expect("/scribbles/1/points/0", Json::array({1}), "scribbles[1].points[0] must be two numbers");
  expect("/scribbles/0/points/1", Json::array({1, "2"}), "scribbles[0].points[1][1] must be a number");
  expect("/scribbles/0/points/1", Json::array({1, 1e17}), "scribbles[0].points[1][1] must be a number");
  expect("/scribbles/0/points", Json(std::vector<std::vector<int>>(200'001, {0, 0})), "points");
  expect("/scribbles/0/colour", "red", "scribbles[0] holds 'colour'");
  expect("/edits/0/kind", "remove", "edits[0].kind is 'remove'");
  expect("/edits/0/at", nullptr, "edits[0] lacks 'at'");
  expect("/edits/1/to", nullptr, "edits[1] lacks 'to'");
  expect("/edits/1/tolerance", -2, "edits[1].tolerance");
}

TEST(Project, MaskIsThatOfImageAndScribbles) {
  Project project;
  const Image image = testing::blank(20, 10);
  EXPECT_FALSE(project_mask(project, image));
  project.mask = ImageFile{"grey.pgm", "P5 20 10 255\n" + std::string(200, '\x40')};  // grey 64: factor 2
  EXPECT_EQ(project_mask(project, image)->factor, std::vector<float>(200, 2.0f));
  project.scribbles = {{ScribbleKind::erase, 100, {{0, 0}}}};
  EXPECT_EQ(project_mask(project, image)->factor, std::vector<float>(200, 1.0f));
  project.mask.reset();
  project.scribbles = {{ScribbleKind::less, 100, {{0, 0}}}};
  EXPECT_EQ(project_mask(project, image)->factor, std::vector<float>(200, 0.5f));
}

TEST(Project, RunIsTheMethodAndThenTheEdits) {
  Project project;
  project.drawing = {"cross.pgm", cross_file()};
  project.options.preset = Preset::clean;
  const Image image = project_image(project);
  const Stages plain = run_project(project, image, {});
  const Result direct = vectorize(image, project.options);
  ASSERT_EQ(plain.drawing.curves.size(), 4u);
  EXPECT_EQ(plain.drawing.curves.size(), direct.drawing.curves.size());

  project.edits = {
      {EditKind::remove, {30, 60}, {}, 8}, {EditKind::join, {80, 30}, {80, 90}, 8}, {EditKind::split, {10, 10}, {}, 8}};
  const Stages edited = run_project(project, image, {});
  EXPECT_EQ(edited.drawing.curves.size(), 2u);
  EXPECT_EQ(edited.report.curves, 2);
  EXPECT_EQ(edited.report.warnings.size(), plain.report.warnings.size() + 1);
  EXPECT_NE(edited.report.warnings.back().find("1 hand edit "), std::string::npos);
}

}  // namespace
}  // namespace inkgrid
