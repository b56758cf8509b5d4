// Running again from the middle: the same result as from the start, and no more work than a change asks for.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "drawings.h"
#include "inkgrid/session.h"
#include "pipeline.h"
#include "printing.h"
#include "report_json.h"

namespace inkgrid {
namespace {

using testing::blank;
using testing::circle;
using testing::paint;

// Crossing strokes, a circle apart from them, and a blot in it; a stroke with a gap.
Image drawing() {
  Image image = blank(130, 80);
  for (const double x : {20.0, 45.0}) paint(image, {{x, 10}, {x, 70}}, 4);
  for (const double y : {25.0, 55.0}) paint(image, {{8, y}, {60, y}}, 4);
  paint(image, {{20, 25}, {45, 55}}, 4);
  paint(image, circle({97, 42}, 22), 3.4);
  paint(image, {{97, 42}, {97, 42}}, 18);
  paint(image, {{66, 4}, {108, 4}}, 4);
  paint(image, {{100, 11}, {126, 11}}, 4);
  paint(image, {{66, 74}, {90, 74}}, 4);
  paint(image, {{97, 74}, {124, 74}}, 4);
  return image;
}

// Another value for each option, that shows in the drawing above.
std::string other_value(std::string_view name) {
  static const std::pair<std::string_view, const char*> kValues[] = {{"preset", "rough"},
                                                                     {"threshold", "60"},
                                                                     {"faintest", "0.8"},
                                                                     {"soften", "2"},
                                                                     {"fills", "trace"},
                                                                     {"bundles", "join"},
                                                                     {"reach", "0.5"},
                                                                     {"mesh-size", "0.6"},
                                                                     {"degenerate-angle", "80"},
                                                                     {"degenerate-ratio", "0.9"},
                                                                     {"field-rounds", "0"},
                                                                     {"degenerate-fraction", "0.9"},
                                                                     {"label-length", "1"},
                                                                     {"label-ratio", "0.1"},
                                                                     {"spacing", "1.3"},
                                                                     {"snap", "3"},
                                                                     {"snap-sigma", "0.5"},
                                                                     {"damping", "0.01"},
                                                                     {"merge-difference", "0.01"},
                                                                     {"gap", "0"},
                                                                     {"details", "0"},
                                                                     {"coverage-bins", "1000"},
                                                                     {"tolerance", "0.02"},
                                                                     {"threads", "1"}};
  for (const auto& [option, value] : kValues)
    if (option == name) return value;
  ADD_FAILURE() << name << " has no other value in this test";
  return "1";
}

// Coarse, and with frames called degenerate that are not, so that the field takes rounds.
Options usual() {
  Options options;
  options.mesh_size = 0.45;
  options.spacing = 0.8;  // from a cell of a pen on, the spacing slims no strokes
  options.degenerate_angle = 60;
  options.field_rounds = 3;
  return options;
}

Options with(std::string_view name, std::string_view value) {
  Options options = usual();
  set_option(options, option_row(name), value);
  return options;
}

// Everything that a stage made, as numbers.
class Numbers {
 public:
  void add(double value) { values_.push_back(value); }
  void add(Vec2 p) { values_.insert(values_.end(), {p.x, p.y}); }
  void add(IVec2 p) { values_.insert(values_.end(), {static_cast<double>(p.x), static_cast<double>(p.y)}); }
  void add(Complex z) { values_.insert(values_.end(), {z.real(), z.imag()}); }
  void add(Label label) { add(static_cast<double>(label)); }
  void add(const Transition& t) {
    add(static_cast<double>(t.turn));
    add(t.shift);
  }
  void add(const std::array<int, 3>& face) {
    for (const int v : face) add(static_cast<double>(v));
  }
  void add(const GraphEdge& e) {
    for (const int i : {e.from, e.to, e.from_port, e.to_port}) add(static_cast<double>(i));
    add(e.path);
    add(e.family);
  }
  void add(const Chain& c) {
    add(c.points);
    for (const double value : {c.closed ? 1.0 : 0.0, c.width, c.coverage, c.confirmed}) add(value);
    for (const int j : {c.start_junction, c.end_junction}) add(static_cast<double>(j));
  }
  void add(const Curve& c) {
    for (const Cubic& s : c.segments)
      for (const Vec2 p : {s.p0, s.p1, s.p2, s.p3}) add(p);
    for (const double value : {c.closed ? 1.0 : 0.0, c.width, c.coverage, static_cast<double>(c.id >> 32)}) add(value);
    for (const int j : {c.start_junction, c.end_junction}) add(static_cast<double>(j));
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add_all(values);
  }
  template <class Value>
  void add(const Pixels<Value>& values) {
    add_all(values);
  }

  const std::vector<double>& values() const { return values_; }

 private:
  template <class Values>
  void add_all(const Values& values) {
    add(static_cast<double>(values.size()));
    for (const auto& value : values) add(value);
  }

  std::vector<double> values_;
};

// By stage: Stage::ink first.
std::vector<std::vector<double>> numbers_of(const Stages& s) {
  std::vector<Numbers> n(static_cast<std::size_t>(Stage::none));
  const auto of = [&](Stage stage) -> Numbers& { return n[static_cast<std::size_t>(stage)]; };
  of(Stage::ink).add(s.fills.region.data);
  of(Stage::ink).add(s.ink.mask.data);
  of(Stage::ink).add(s.ink.stroke_width);
  of(Stage::bundles).add(s.bundles.slits.data);
  of(Stage::bundles).add(s.bundles.count);
  of(Stage::slim).add(s.slim.mask.data);
  of(Stage::slim).add(s.slim.darkness.data);
  of(Stage::slim).add(s.bundle_scale.factor);
  of(Stage::band).add(s.mesh.points);
  of(Stage::band).add(s.mesh.faces);
  of(Stage::band).add(s.mesh.scale);
  of(Stage::band).add(s.mesh.in_stroke);
  of(Stage::field).add(s.field.c0);
  of(Stage::field).add(s.field.c2);
  of(Stage::charts).add(s.charts.s);
  of(Stage::charts).add(s.charts.turns);
  of(Stage::charts).add(s.charts.cut);
  of(Stage::labels).add(s.labels);
  of(Stage::map).add(s.map.base);
  of(Stage::map).add(s.map.corner_shift);
  of(Stage::map).add(s.map.transitions);
  of(Stage::isolines).add(s.exact.uv);
  of(Stage::isolines).add(s.graph.edges);
  of(Stage::chains).add(s.chains.chains);
  of(Stage::chains).add(s.chains.junctions);
  of(Stage::fit).add(s.drawing.curves);
  of(Stage::fit).add(s.drawing.junctions);
  for (const Fill& fill : s.drawing.fills) of(Stage::fit).add(fill.outlines);
  std::vector<std::vector<double>> values;
  for (const Numbers& numbers : n) values.push_back(numbers.values());
  return values;
}

void expect_same(const Stages& found, const Stages& expected) {
  const auto a = numbers_of(found), b = numbers_of(expected);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i] == b[i]) << stage_name(static_cast<Stage>(i));
  Report r = found.report, e = expected.report;
  EXPECT_EQ(r.warnings, e.warnings);
  EXPECT_EQ(std::tie(r.preset, r.reach, r.spacing, r.gap, r.threshold, r.stroke_width, r.ink_pixels),
            std::tie(e.preset, e.reach, e.spacing, e.gap, e.threshold, e.stroke_width, e.ink_pixels));
  EXPECT_EQ(std::tie(r.vertices, r.triangles, r.components, r.holes, r.cuts, r.cut_integers, r.snapping_integers),
            std::tie(e.vertices, e.triangles, e.components, e.holes, e.cuts, e.cut_integers, e.snapping_integers));
  EXPECT_EQ(std::tie(r.alignment_energy, r.snapping_energy, r.nodes, r.edges, r.curves, r.segments),
            std::tie(e.alignment_energy, e.snapping_energy, e.nodes, e.edges, e.curves, e.segments));
  EXPECT_EQ(std::tie(found.drawing.width, found.drawing.height, found.drawing.pixels_per_mm),
            std::tie(expected.drawing.width, expected.drawing.height, expected.drawing.pixels_per_mm));
}

class EachOption : public ::testing::TestWithParam<OptionRow> {};

TEST_P(EachOption, GivesTheSameAsFromTheStart) {
  const Image image = drawing();
  const Options changed = with(GetParam().name, other_value(GetParam().name));
  Stages stages = run_stages(image, usual(), {});
  rerun_stages(stages, image, changed, {});
  expect_same(stages, run_stages(image, changed, {}));
  rerun_stages(stages, image, usual(), {});
  expect_same(stages, run_stages(image, usual(), {}));
}

TEST_P(EachOption, IsFirstReadByItsStage) {
  const Image image = drawing();
  Options first = usual(), changed = with(GetParam().name, other_value(GetParam().name));
  if (GetParam().name == "details") first.spacing = changed.spacing = 5;            // that misses the circle
  if (GetParam().name == "preset") first.spacing = changed.spacing = std::nullopt;  // a spacing leaves the preset less to say
  const auto before = numbers_of(run_stages(image, first, {})), after = numbers_of(run_stages(image, changed, {}));
  for (std::size_t stage = 0; stage < static_cast<std::size_t>(GetParam().stage); ++stage)
    EXPECT_TRUE(before[stage] == after[stage]) << "changes " << stage_name(static_cast<Stage>(stage));
  if (GetParam().stage != Stage::none) {
    const auto stage = static_cast<std::size_t>(GetParam().stage);
    EXPECT_FALSE(before[stage] == after[stage]) << "leaves " << stage_name(GetParam().stage);
  }
  EXPECT_EQ(first_stage_changed(first, changed), GetParam().stage);
}

INSTANTIATE_TEST_SUITE_P(Table, EachOption, ::testing::ValuesIn(option_table().begin(), option_table().end()));

std::set<std::string> stages_run(const Stages& stages) {
  std::set<std::string> names;
  for (const auto& [name, seconds] : stages.report.seconds) names.insert(name);
  return names;
}

TEST(Rerun, KeepsTheBandWhereNoSpacingSlimsStrokes) {
  const Image image = drawing();
  const Options wide = with("spacing", "0.8"), close = with("spacing", "0.7"), slim = with("spacing", "0.6");
  Stages stages = run_stages(image, close, {});
  rerun_stages(stages, image, wide, {});
  EXPECT_FALSE(stages_run(stages).contains("band"));
  expect_same(stages, run_stages(image, wide, {}));
  rerun_stages(stages, image, close, {});
  EXPECT_FALSE(stages_run(stages).contains("band"));
  rerun_stages(stages, image, slim, {});
  EXPECT_TRUE(stages_run(stages).contains("band"));
  rerun_stages(stages, image, close, {});
  EXPECT_TRUE(stages_run(stages).contains("band"));
  expect_same(stages, run_stages(image, close, {}));
}

// As a slider is dragged: strokes are slimmed in steps.
TEST(Rerun, KeepsSlimmedStrokesAndTheirLabelsWithinAStep) {
  const Image image = drawing();
  Options slim = usual(), near = usual(), slimmer = usual();
  slim.spacing = near.spacing = slimmer.spacing = std::nullopt;
  Stages stages = run_stages(image, slim, {});
  slim.spacing = 0.8 * stages.report.spacing;
  near.spacing = 0.75 * stages.report.spacing;
  slimmer.spacing = 0.6 * stages.report.spacing;
  rerun_stages(stages, image, slim, {});
  ASSERT_FALSE(stages.slim.mask.data.empty());
  rerun_stages(stages, image, near, {});
  EXPECT_FALSE(stages_run(stages).contains("slim ink"));
  EXPECT_FALSE(stages_run(stages).contains("labels"));
  EXPECT_TRUE(stages_run(stages).contains("grid map"));
  expect_same(stages, run_stages(image, near, {}));
  rerun_stages(stages, image, slimmer, {});
  EXPECT_TRUE(stages_run(stages).contains("slim ink"));
  expect_same(stages, run_stages(image, slimmer, {}));
}

TEST(Rerun, KeepsSlimmedStrokesWhereOnlyTheBandChanges) {
  const Image image = drawing();
  Options slim = with("spacing", "0.6");
  Stages stages = run_stages(image, slim, {});
  ASSERT_TRUE(stages_run(stages).contains("slim ink"));
  ASSERT_FALSE(stages.slim.mask.data.empty());
  slim.reach = 0.4;
  rerun_stages(stages, image, slim, {});
  EXPECT_FALSE(stages_run(stages).contains("slim ink"));
  EXPECT_TRUE(stages_run(stages).contains("band"));
  expect_same(stages, run_stages(image, slim, {}));
}

TEST(Rerun, RunsOnlyWhatComesAfterTheChange) {
  const Image image = drawing();
  Stages stages = run_stages(image, usual(), {});
  const std::set<std::string> all = stages_run(stages);
  rerun_stages(stages, image, usual(), {});
  EXPECT_TRUE(stages_run(stages).empty());
  rerun_stages(stages, image, with("tolerance", "0.05"), {});
  EXPECT_EQ(stages_run(stages), std::set<std::string>{"fit"});
  rerun_stages(stages, image, with("spacing", "1"), {});
  EXPECT_FALSE(stages_run(stages).contains("labels"));
  EXPECT_TRUE(stages_run(stages).contains("grid map"));
  rerun_stages(stages, image, with("reach", "0.4"), {});
  EXPECT_FALSE(stages_run(stages).contains("ink"));
  EXPECT_TRUE(stages_run(stages).contains("band"));
  rerun_stages(stages, image, with("threshold", "128"), {});
  EXPECT_EQ(stages_run(stages), all);
}

// What `auto` stands for already is no change.
TEST(Rerun, GivenWhatWasChosenRunsNothing) {
  const Image image = drawing();
  Stages stages = run_stages(image, usual(), {});
  Options given = usual();
  given.preset = Preset::clean;
  given.reach = stages.report.reach;
  given.spacing = stages.report.spacing;
  given.gap = stages.report.gap;
  ASSERT_EQ(stages.report.preset, "clean");
  rerun_stages(stages, image, given, {});
  EXPECT_TRUE(stages_run(stages).empty());
}

ScaleMask scribbled(const Image& image, std::mt19937& random) {
  ScaleMask mask{image.width, image.height, std::vector<float>(image.grey.size(), 1)};
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int x0 = below(image.width), y0 = below(image.height), size = 10 + below(30);
  const float factor = below(2) ? 0.5F : 2.0F;
  for (int y = y0; y < std::min(y0 + size, image.height); ++y)
    for (int x = x0; x < std::min(x0 + size, image.width); ++x)
      mask.factor[static_cast<std::size_t>(y * image.width + x)] = factor;
  return mask;
}

TEST(Rerun, ManyChangesInARowGiveTheSameAsTheLastAlone) {
  const Image image = drawing();
  std::mt19937 random(3);
  Stages stages;
  Options options = usual();
  std::optional<ScaleMask> mask;
  for (int change = 0; change < 50; ++change) {
    const auto rows = option_table();
    const OptionRow& row = rows[random() % rows.size()];
    const bool scribble = random() % 4 == 0, back = random() % 3 == 0;
    if (scribble)
      mask = back ? std::nullopt : std::optional(scribbled(image, random));
    else
      set_option(options, row, back ? option_text(usual(), row) : other_value(row.name));
    Control control;
    control.mask = mask ? &*mask : nullptr;
    rerun_stages(stages, image, options, control);
    SCOPED_TRACE(std::to_string(change) + (scribble ? " scribble" : " " + std::string(row.name)));
    expect_same(stages, run_stages(image, options, control));
    if (::testing::Test::HasFailure()) return;
  }
}

// The picture of a fine pen is enlarged where it is taken for a clean one.
Image fine_drawing() {
  Image image = blank(90, 60);
  for (int k = 0; k < 4; ++k) paint(image, {{10.0 + 6 * k, 8}, {14.0 + 6 * k, 50}}, 2);
  paint(image, {{6, 30}, {44, 26}}, 2);
  paint(image, circle({66, 30}, 14), 2);
  paint(image, {{66, 30}, {66, 30}}, 8);
  return image;
}

TEST(Rerun, AFinePenIsEnlargedWithWhateverIsAskedOfIt) {
  const Image image = fine_drawing();
  ScaleMask mask{image.width, image.height, std::vector<float>(image.grey.size(), 1)};
  for (int y = 20; y < 34; ++y)
    for (int x = 8; x < 24; ++x) mask.factor[static_cast<std::size_t>(y * image.width + x)] = 2;
  Control scribbled;
  scribbled.mask = &mask;
  Options rough, fine;
  rough.preset = Preset::rough;
  fine.spacing = 0.5;
  Stages stages;
  for (const auto& [options, control] :
       {std::pair(Options{}, Control{}), {Options{}, scribbled}, {fine, scribbled}, {rough, Control{}}, {Options{}, Control{}}}) {
    rerun_stages(stages, image, options, control);
    expect_same(stages, run_stages(image, options, control));
    EXPECT_EQ(stages.report.enlargement, options.preset == Preset::rough ? 1 : 2);
    EXPECT_EQ(stages.drawing.width, image.width);
    ASSERT_EQ(stages.drawing.fills.size(), 1u);
    EXPECT_NEAR(stages.drawing.fills[0].outlines[0].segments[0].p0.x, 66, 5);
  }
  const std::vector<Curve> curves = stages.drawing.curves;
  rerun_stages(stages, image, with("tolerance", "0.11"), {});
  rerun_stages(stages, image, {}, {});
  EXPECT_EQ(stages.drawing.curves.size(), curves.size());
}

TEST(Rerun, AnotherImageStartsAnew) {
  Image image = drawing();
  Stages stages = run_stages(image, usual(), {});
  paint(image, {{68, 10}, {68, 70}}, 4);
  rerun_stages(stages, image, usual(), {});
  expect_same(stages, run_stages(image, usual(), {}));
  const Image paper = blank(50, 40);
  for (int k = 0; k < 2; ++k) {
    rerun_stages(stages, paper, {}, {});
    EXPECT_TRUE(stages.drawing.curves.empty());
    EXPECT_EQ(stages.report.warnings.size(), 1u);
  }
  rerun_stages(stages, image, usual(), {});
  expect_same(stages, run_stages(image, usual(), {}));
}

TEST(Rerun, AnExceptionLeavesEverythingAsItWas) {
  const Image image = drawing();
  Stages stages = run_stages(image, usual(), {});
  const Stages before = stages;
  Options refused = usual();
  refused.spacing = -1;
  EXPECT_THROW(rerun_stages(stages, image, refused, {}), Error);
  for (const char* stage : {"ink", "frame field", "grid map"}) {
    std::stop_source source;
    Control control;
    control.stop = source.get_token();
    control.progress = [&](const char* name, double) {
      if (std::string(name) == stage) source.request_stop();
    };
    Options other = with("threshold", "90");
    EXPECT_THROW(rerun_stages(stages, image, other, control), Error) << stage;
    EXPECT_THROW(rerun_stages(stages, image, with("spacing", "1.1"), control), Error) << stage;
    expect_same(stages, before);
  }
  rerun_stages(stages, image, with("spacing", "1.1"), {});
  expect_same(stages, run_stages(image, with("spacing", "1.1"), {}));
}

TEST(Session, IsVectorizeWithAMemory) {
  const Image image = drawing();
  Session session(image);
  const auto expect_equal = [](const Drawing& a, const Drawing& b) {
    Numbers found, expected;
    found.add(a.curves);
    expected.add(b.curves);
    EXPECT_TRUE(found.values() == expected.values());
  };
  expect_equal(session.run(usual()).drawing, vectorize(image, usual()).drawing);
  const Result looser = session.run(with("tolerance", "0.3"));
  EXPECT_EQ(looser.report.seconds.size(), 1u);
  expect_equal(looser.drawing, vectorize(image, with("tolerance", "0.3")).drawing);
}

// All that is told of a run but how long it took.
std::string told(Report report) {
  report.seconds.clear();
  return report_json(usual(), report);
}

TEST(Vectorize, IsTheSameWhereNoStageIsKept) {
  Image ink = blank(40, 40, 0), speck = blank(40, 40);
  paint(speck, {{20, 20}, {20, 20}}, 4);
  for (const Image& image : {drawing(), ink, blank(40, 40), speck})
    for (const Options& options :
         {usual(), with("preset", "rough"), with("bundles", "join"), with("spacing", "0.5"), with("fills", "trace")}) {
      const Stages kept = run_stages(image, options, {});
      const Result result = vectorize(image, options);
      Numbers found, expected;
      found.add(result.drawing.curves);
      expected.add(kept.drawing.curves);
      EXPECT_TRUE(found.values() == expected.values());
      EXPECT_EQ(told(result.report), told(kept.report));
    }
}

TEST(CurveIds, AreDifferentAndSurviveAnotherFit) {
  Session session(drawing());
  const Drawing before = session.run(usual()).drawing, after = session.run(with("tolerance", "0.4")).drawing;
  std::set<std::uint64_t> ids;
  for (const Curve& curve : before.curves) EXPECT_TRUE(ids.insert(curve.id).second);
  ASSERT_EQ(after.curves.size(), before.curves.size());
  for (const Curve& curve : after.curves) EXPECT_TRUE(ids.contains(curve.id));
}

}  // namespace
}  // namespace inkgrid
