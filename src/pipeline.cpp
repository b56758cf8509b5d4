// The method from drawing to curves, section 3: each line is a stage, and each stage is a file of its name.
#include "pipeline.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"
#include "fit/fit_outlines.h"
#include "graph/folds.h"
#include "ink/enlarge.h"
#include "ink/grain.h"
#include "ink/pen_strokes.h"
#include "ink/preset.h"
#include "options.h"
#include "refine/details.h"
#include "refine/ends.h"
#include "refine/leftovers.h"
#include "refine/refinement.h"
#include "reuse.h"
#include "run_report.h"
#include "scribbles/assembled.h"
#include "scribbles/parts.h"
#include "scribbles/window.h"
#include "settings.h"
#include "stopwatch.h"

namespace inkgrid {
namespace {

constexpr double kCornerSpan = 1.5;  // of the slimmed stroke: what the ridge rounds
constexpr double kScoutMesh = 0.5;   // strokes
constexpr double kCoarse = 1;        // strokes: a larger grid spacing does not resolve details of a pen
constexpr double kSlit = 2;          // reaches, of the band from both sides: two strokes of one line leave no more between them

// What a run leaves behind: all that its stages made, for pictures and for running again, or only what the next stages need.
enum class Keep { stages, result };

template <class... Values>
void release(Keep keep, Values&... values) {
  if (keep == Keep::result) ((values = {}), ...);
}

void validate_input(const Image& image, const ScaleMask* mask) {
  const auto size = static_cast<std::size_t>(std::max(0, image.width)) * static_cast<std::size_t>(std::max(0, image.height));
  if (size == 0 || image.grey.size() != size) throw Error(ErrorCode::usage, "the image is empty, or its pixels do not fill it");
  if (mask && (mask->width != image.width || mask->height != image.height))
    throw Error(ErrorCode::usage, "the mask is " + std::to_string(mask->width) + " x " + std::to_string(mask->height) +
                                      " pixels, but the drawing is " + std::to_string(image.width) + " x " +
                                      std::to_string(image.height));
}

// From the band to the chains, strokes are the slimmed ones: lengths in strokes in their widths.
double slimness(const Stages& stages) {
  return grid_ink(stages).stroke_width / stages.ink.stroke_width;
}

BandMesh band_of(const Stages& stages, const ScaleMask* mask) {
  const Options& options = stages.inputs.settled;
  return build_band(grid_ink(stages), mask, {*options.reach / slimness(stages), options.mesh_size, options.threads});
}

// `known`: what is kept of the band's solution, if anything.
void run_to_map(Stage first, Stages& stages, Stopwatch& run, const Control& control, const Known* known, Keep keep) {
  const Options& options = stages.inputs.settled;
  const FieldOptions field_options{options.degenerate_angle, options.degenerate_ratio, options.degenerate_fraction,
                                   options.field_rounds, options.threads};
  if (first <= Stage::field)
    stages.field = run("frame field", 0.32, [&] { return solve_field(stages.mesh, grid_ink(stages), field_options, control); });
  if (first <= Stage::charts)
    stages.charts = run("charts", 0.56, [&] { return comb_charts(stages.mesh, stages.field, known, options.threads); });
  report_mesh(stages.mesh, stages.report);
  report_field(stages.field, stages.charts, stages.report);
  release(keep, stages.field);
  const LabelOptions label_options{options.label_length, options.label_ratio, options.threads};
  if (first <= Stage::labels)
    stages.labels =
        run("labels", 0.58, [&] { return label_strokes(stages.mesh, stages.charts, grid_ink(stages), label_options, known); });
  const GridMapOptions map_options{*options.spacing / slimness(stages),
                                   options.snap,
                                   options.snap_sigma,
                                   options.damping,
                                   options.merge_difference,
                                   options.threads};
  if (first <= Stage::map)
    stages.map = run("grid map", 0.62, [&] {
      return solve_grid_map(stages.mesh, stages.charts, stages.labels, grid_ink(stages), map_options, part_of(control, 0.62, 0.9),
                            known, std::move(stages.map.plans));
    });
}

struct Strokes {
  Fills fills;
  Ink ink;
};

Strokes measure_strokes(const Image& image, const Options& options, int enlargement, Stopwatch& run) {
  Strokes strokes;
  Binarisation binarisation =
      run("threshold", 0.0, [&] { return binarise(image, options.threshold, enlargement, options.faintest); });
  if (options.fills != FillMode::trace) {
    strokes.fills = run("fills", 0.03, [&] { return find_fills(binarisation); });
    binarisation = without_fills(std::move(binarisation), strokes.fills);
  }
  strokes.ink = run("ink", 0.06, [&] { return measure_ink(std::move(binarisation), enlargement); });
  return strokes;
}

// Of a picture made from the drawing, as one stage.
Strokes measure_made(const Image& image, const Options& options, int enlargement, const Control& control) {
  Report unread;
  Control quiet;
  quiet.stop = control.stop;
  Stopwatch run(quiet, unread);
  return measure_strokes(image, options, enlargement, run);
}

// How much the picture is softened, px.  A threshold means just what is darker.
double softening_of(const Image& image, const Ink& ink, const Options& options) {
  if (options.soften || options.threshold) return options.soften.value_or(0);
  return grain_of(image, ink, options.threads, options.faintest);
}

double pen_width(const Strokes& strokes, const Options& options) {
  return options.fills == FillMode::trace ? find_pen_strokes(strokes.ink.mask, strokes.ink.darkness).width
                                          : strokes.fills.stroke_width;
}

Look look_of(const Ink& ink, double pen_width, double softening) {
  return {choose_preset(ink, pen_width), has_fine_pen(pen_width, ink), pen_width > 0 && has_fine_paper(ink), softening};
}

void run_ink(const Image& image, Stages& stages, Stopwatch& run, const Control& control) {
  const Options& options = stages.inputs.options;
  Strokes strokes = measure_strokes(image, options, 1, run);
  const double softening = run("grain", 0.065, [&] { return softening_of(image, strokes.ink, options); });
  Image soft;
  if (softening > 0)
    strokes = run("softened ink", 0.067, [&] {
      soft = softened(image, softening, options.threads);
      return measure_made(soft, options, 1, control);
    });
  const Image& drawn = softening > 0 ? soft : image;
  if (strokes.ink.pixels > 0) stages.look = look_of(strokes.ink, pen_width(strokes, options), softening);
  if (enlargement_for(stages.look, options) > 1) {
    Strokes finer = run("enlarged ink", 0.07, [&] { return measure_made(enlarged(drawn), options, kEnlargement, control); });
    if (finer.ink.pixels > 0)
      strokes = std::move(finer);
    else  // rims all over the picture are taken for grain
      stages.look.fine_pen = stages.look.fine_paper = false;
  }
  stages.fills = std::move(strokes.fills);
  stages.ink = std::move(strokes.ink);
}

Chains chain_on_ink(Stages& stages, Stopwatch& run, Keep keep) {
  const Options& options = stages.inputs.settled;
  Chains chains = run("chains", 0.94, [&] {
    const auto labels = spread_labels(stages.mesh, stages.charts, stages.labels);
    return chain_strokes(stages.graph, stages.mesh, labels, grid_ink(stages));
  });
  release(keep, stages.mesh, stages.charts, stages.labels, stages.graph);
  const double slim = slimness(stages);
  chains = run("refinement", 0.95, [&] {
    const double reach = *options.reach / slim, slit = options.bundles == BundleMode::join ? kSlit * reach : 0;
    return refine_on_ink(
        chains, grid_ink(stages), covered_ink(stages).mask,
        {stages.ink.stroke_width, reach, *options.spacing / slim, *options.gap, slit, options.coverage_bins, options.threads});
  });
  if (slim < 1) {
    chains = with_widths_on(std::move(chains), stages.ink, *options.reach, *options.spacing, options.threads);
    chains = attach_ends(std::move(chains), stages.ink, deep_ends(stages.ink.stroke_width));
  }
  if (options.bundles != BundleMode::join) return chains;
  return refine_bundles(std::move(chains), {stages.ink.width(), stages.ink.height(), stages.ink.stroke_width,
                                            stages.bundles.sketchiness, options.threads});
}

// Half the width of paper that the band bridges, px.
double reach_of(const Stages& stages) {
  return std::max(1.0, *stages.inputs.settled.reach * stages.ink.stroke_width);
}

Chains chains_with_marks(Stages& stages) {
  return mark_leftovers(std::move(stages.plain), covered_ink(stages), reach_of(stages));
}

void run_to_chains(Stage first, Stages& stages, Stopwatch& run, Keep keep) {
  report_map(stages.map, stages.report);
  if (first <= Stage::isolines) {
    const std::vector<int> failed = stages.map.failed_components;
    stages.exact = run("exact map", 0.9, [&] {
      return keep == Keep::result ? round_map(std::move(stages.map)) : round_map(stages.map, stages.inputs.settled.threads);
    });
    stages.graph = run("isolines", 0.92, [&] {
      return remove_folds(trace_isolines(stages.mesh, stages.exact, failed), stages.mesh, stages.exact);
    });
  }
  report_graph(stages.graph, stages.report);
  release(keep, stages.exact);
  if (first <= Stage::chains) stages.plain = chain_on_ink(stages, run, keep);
}

// Bundles joined, but for those under a mask that asks for detail there, and strokes slimmed; empty where neither changes the
// ink.
JoinedInk ground_of(const Stages& stages, const ScaleMask* mask, std::optional<Slimming> slimming) {
  if (stages.bundles.count == 0) return {slimming ? slim_ink(stages.ink, std::move(*slimming)) : Ink{}, {}};
  JoinedInk joined = join_bundles(stages.ink, stages.bundles, mask);
  return {slimming ? slim_ink(joined.ink, slimming->share) : std::move(joined.ink), std::move(joined.scale)};
}

// Changes two owners' inks over, and back at the end of its life.
class Borrowed {
 public:
  Borrowed(Ink& from, Ink& to) : from_(from), to_(to) { std::swap(from_, to_); }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  ~Borrowed() { std::swap(from_, to_); }

 private:
  Ink& from_;
  Ink& to_;
};

// A first pass with the usual options, whatever those of this run are: what was drawn for one line is a property of the drawing.
// Its mesh is coarse, as its chains are only looked at from stroke to stroke.
Bundles scout_bundles(Stages& stages, const Control& control) {
  Stages scout;
  const PresetValues values = preset_values(Preset::rough, stages.ink.stroke_width, stages.ink.enlargement);
  Options& options = scout.inputs.settled;
  options.reach = values.reach;
  options.spacing = values.spacing;
  options.gap = values.gap;
  options.mesh_size = kScoutMesh;
  options.threads = stages.inputs.options.threads;
  const Borrowed ink(stages.ink, scout.ink);
  scout.mesh = band_of(scout, nullptr);
  Control within;
  within.stop = control.stop;
  if (control.progress) within.progress = [&](const char*, double done) { control.progress("bundles", 0.08 + 0.2 * done); };
  Stopwatch run(within, scout.report);
  run_to_map(Stage::field, scout, run, within, nullptr, Keep::result);
  run_to_chains(Stage::isolines, scout, run, Keep::result);
  return find_bundles(chains_with_marks(scout).chains, scout.ink, options.threads);
}

void move_by(Vec2 shift, Stages& stages) {
  const auto move = [&](std::vector<Vec2>& points) {
    for (Vec2& p : points) p += shift;
  };
  move(stages.mesh.points);
  for (GraphNode& node : stages.graph.nodes) node.position += shift;
  for (GraphEdge& edge : stages.graph.edges) move(edge.path);
  for (Chain& chain : stages.plain.chains) move(chain.points);
  move(stages.plain.junctions);
}

// Of a piece of ink as a clean drawing of its own.
Chains chains_of_detail(const Ink& piece, const Options& settled, const Control& control) {
  Stages stages;
  stages.ink = piece;
  const PresetValues values = preset_values(Preset::clean, piece.stroke_width, piece.enlargement);
  Options& options = stages.inputs.settled = settled;
  options.reach = values.reach;
  options.spacing = values.spacing;
  options.bundles = BundleMode::keep;
  options.threads = 1;
  stages.slim = ground_of(stages, nullptr, slimming_of(stages.ink, values.spacing)).ink;
  stages.mesh = band_of(stages, nullptr);
  Stopwatch run(control, stages.report);
  run_to_map(Stage::field, stages, run, control, nullptr, Keep::result);
  run_to_chains(Stage::isolines, stages, run, Keep::result);
  stages.plain = scaled(chains_with_marks(stages), 1.0 / kEnlargement);
  move_by(piece.origin, stages);
  return std::move(stages.plain);
}

bool is_coarse(const Stages& stages) {
  return *stages.inputs.settled.spacing > kCoarse;
}

// Those of a coarse grid with those of its details.
Chains chains_with_details(Stages& stages, const Control& control) {
  const Options& options = stages.inputs.settled;
  const Details details =
      find_details(stages.ink, covered_ink(stages).mask, stages.plain.chains, reach_of(stages), options.details);
  std::vector<Chains> solved(details.pieces.size());
  Control quiet;
  quiet.stop = control.stop;
  for_ranges(options.threads, static_cast<int>(solved.size()), 1, [&](int first, int last) {
    for (int k = first; k < last; ++k) solved[at(k)] = chains_of_detail(details.pieces[at(k)], options, quiet);
  });
  return with_details(std::move(stages.plain), details, solved);
}

ScaleMask product(ScaleMask a, const ScaleMask& b) {
  std::transform(a.factor.begin(), a.factor.end(), b.factor.begin(), a.factor.begin(), std::multiplies<float>());
  return a;
}

bool asks_for_detail(const ScaleMask& mask) {
  return std::any_of(mask.factor.begin(), mask.factor.end(), [](float factor) { return factor < 1; });
}

bool asks_for_less(const ScaleMask& mask) {
  return std::any_of(mask.factor.begin(), mask.factor.end(), [](float factor) { return factor > 1; });
}

// As many rounds of re-weighting as around the window, so that the fields agree where they meet.
Window solve_window(const Stages& around, const JoinedInk* ground, const ScaleMask& mask, const TouchedPart& part, double margin,
                    const Control& control) {
  Window window;
  Stages& stages = window.stages;
  stages.ink = window_of(around.ink, part);
  if (const Ink& grid = ground ? ground->ink : grid_ink(around); &grid != &around.ink) stages.slim = window_of(grid, part);
  stages.bundles.count = around.bundles.count;
  stages.bundles.sketchiness = around.bundles.sketchiness;
  stages.inputs.settled = around.inputs.settled;
  if (asks_for_detail(mask)) stages.inputs.settled.bundles = BundleMode::keep;
  stages.inputs.settled.field_rounds = around.field.rounds;
  stages.inputs.settled.degenerate_fraction = 0;
  const ScaleMask scale = ground ? product(mask, window_of(ground->scale, part)) : mask;
  stages.mesh = band_of(stages, &scale);
  window.known = known_from({around.mesh, around.charts, around.labels, around.map}, stages.mesh,
                            [&](Vec2 p) { return static_cast<double>(distance_at(part, p + stages.ink.origin)) > margin; });
  Control quiet;
  quiet.stop = control.stop;
  Stopwatch run(quiet, stages.report);
  run_to_map(Stage::field, stages, run, quiet, &window.known, Keep::stages);
  run_to_chains(Stage::isolines, stages, run, Keep::stages);
  if (is_coarse(stages) && !asks_for_less(mask)) stages.plain = chains_with_details(stages, control);
  stages.plain = chains_with_marks(stages);
  move_by(stages.ink.origin, stages);
  stages.ink = {};
  stages.slim = {};
  return window;
}

Chains with_scribbles(Stages& stages, const Control& control) {
  if (!stages.inputs.mask) {
    stages.parts.clear();
    return stages.plain;
  }
  std::optional<JoinedInk> ground;
  if (stages.bundles.count > 0)
    ground = ground_of(stages, &*stages.inputs.mask, slimming_of(stages.ink, *stages.inputs.settled.spacing));
  Scribbled scribbled = solve_scribbles(stages, [&](const ScaleMask& mask, const TouchedPart& part, double margin) {
    return solve_window(stages, ground ? &*ground : nullptr, mask, part, margin, control);
  });
  stages.parts = std::move(scribbled.parts);
  return std::move(scribbled.chains);
}

std::vector<Fill> fitted_fills(const Stages& stages) {
  const Options& options = stages.inputs.options;
  if (options.fills != FillMode::layer) return {};
  return fit_outlines(stages.fills, options.tolerance, pixel_of(stages));
}

FitOptions fit_options_of(const Stages& stages) {
  const Options& options = stages.inputs.settled;
  const double width = stages.ink.stroke_width, corner = std::min(width, kCornerSpan * grid_ink(stages).stroke_width);
  return {options.tolerance * width * pixel_of(stages), corner * pixel_of(stages), options.threads, width * pixel_of(stages)};
}

Drawing fitted_curves(const Stages& stages, const std::vector<Curve>& before) {
  const double pixel = pixel_of(stages);
  const auto depth = [&](Vec2 p) { return pixel * depth_at(stages.ink.mask, p / pixel, stages.ink.stroke_width); };
  return fit_curves(stages.chains, fit_options_of(stages), depth, before);
}

// Curves of an earlier run, and what they were fitted with.
struct FittedBefore {
  FitOptions options;
  const std::vector<Curve>& curves;
};

void run_from(Stage first, Stages& stages, const FittedBefore& before, Stopwatch& run, const Control& control, Keep keep) {
  if (first <= Stage::bundles && stages.inputs.settled.bundles == BundleMode::join)
    stages.bundles = run("bundles", 0.08, [&] { return scout_bundles(stages, control); });
  if (first <= Stage::slim) {
    JoinedInk ground = run("slim ink", 0.28, [&] {
      std::optional<Slimming> slimming = slimming_of(stages.ink, *stages.inputs.settled.spacing);
      if (slimming || stages.bundles.count > 0) release(keep, stages.ink.depth, stages.ink.rise);
      return ground_of(stages, nullptr, std::move(slimming));
    });
    stages.slim = std::move(ground.ink);
    stages.bundle_scale = std::move(ground.scale);
  }
  if (first <= Stage::band) {
    const ScaleMask* scale = stages.bundle_scale.factor.empty() ? nullptr : &stages.bundle_scale;
    stages.mesh = run("band", 0.3, [&] { return band_of(stages, scale); });
  }
  release(keep, stages.ink.depth, stages.slim.depth, stages.bundle_scale);
  run_to_map(first, stages, run, control, nullptr, keep);
  run_to_chains(first, stages, run, keep);
  if (first <= Stage::chains) {
    if (is_coarse(stages)) stages.plain = run("details", 0.96, [&] { return chains_with_details(stages, control); });
    stages.plain = run("leftovers", 0.965, [&] { return chains_with_marks(stages); });
  }
  if (first <= Stage::scribbles)
    stages.chains = run("scribbles", 0.97, [&] {
      Chains chains = reach_fills(with_scribbles(stages, control), stages.fills, 1.5 * stages.ink.stroke_width);
      for (Chain& chain : chains.chains) chain.coverage = ink_coverage(chain, covered_ink(stages));
      return scaled(std::move(chains), pixel_of(stages));
    });
  if (!stages.parts.empty()) report_mesh(assembled_mesh(stages), stages.report);
  report_leftovers(stages.chains, stages.ink.stroke_width * pixel_of(stages), stages.report);
  if (first <= Stage::fit) {
    const bool same = first > Stage::ink && fit_options_of(stages) == before.options;
    stages.drawing = run("fit", 0.98, [&] { return fitted_curves(stages, same ? before.curves : std::vector<Curve>{}); });
    stages.drawing.fills = fitted_fills(stages);
  }
  count_curves(stages.drawing, stages.report);
}

void report_choice(const Stages& stages, Report& report) {
  const Options& options = stages.inputs.settled;
  report.preset = options.preset == Preset::rough ? "rough" : "clean";
  report.reach = *options.reach;
  report.spacing = *options.spacing;
  report.gap = *options.gap;
  report.bundles = stages.bundles.count;
  if (options.preset == Preset::clean && report.bundles > 0)
    report.warnings.push_back("bundles are joined in a clean drawing, where lines side by side are mostly meant to be two");
}

// As rerun_stages; only where all is kept `stages` may hold stages of an earlier run.
void run_again(Stages& stages, const Image& image, const Options& options, const Control& control, Keep keep) {
  validate(options);
  validate_input(image, control.mask);
  Stages made;
  made.inputs = {image, control.mask ? std::optional(*control.mask) : std::nullopt, options, options};
  Stopwatch run(control, made.report);
  const bool known = is_ink_of(stages, made.inputs);
  release(keep, made.inputs.image);
  if (!known) run_ink(image, made, run, control);
  const Stages& measured = known ? stages : made;
  const bool blank = measured.ink.pixels == 0;
  if (made.inputs.mask && measured.ink.enlargement > 1) made.inputs.mask = enlarged(*made.inputs.mask);
  if (!blank) settle(made.inputs, measured);
  const Stage first = blank && known ? Stage::none : first_stage_changed(stages, made.inputs);
  const FittedBefore before{fit_options_of(stages), stages.drawing.curves};
  move_kept(first, stages, made);
  if (Stage::charts < first && first <= Stage::map) made.map.plans = stages.map.plans;
  if (Stage::chains < first) made.parts = stages.parts;  // of use as long as what they are parts of is the same
  report_ink(made.ink, made.fills, made.look.softening, made.report);
  try {
    if (!blank) run_from(first, made, before, run, control, keep);
  } catch (...) {
    move_kept(first, made, stages);
    throw;
  }
  if (!blank) report_choice(made, made.report);
  if (blank && made.fills.count == 0) made.report.warnings = {"the drawing holds no ink: the result is empty"};
  if (blank) made.drawing.fills = fitted_fills(made);
  made.drawing.width = image.width;
  made.drawing.height = image.height;
  made.drawing.pixels_per_mm = image.pixels_per_mm;
  stages = std::move(made);
}

}  // namespace

void rerun_stages(Stages& stages, const Image& image, const Options& options, const Control& control) {
  run_again(stages, image, options, control, Keep::stages);
}

Stages run_stages(const Image& image, const Options& options, const Control& control) {
  Stages stages;
  rerun_stages(stages, image, options, control);
  return stages;
}

Result vectorize(const Image& image, const Options& options, const Control& control) {
  Stages stages;
  run_again(stages, image, options, control, control.mask ? Keep::stages : Keep::result);
  return {std::move(stages.drawing), std::move(stages.report)};
}

const char* version() {
  return INKGRID_VERSION;
}

}  // namespace inkgrid
