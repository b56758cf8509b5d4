// How near curves are to those that were meant: measures for research, in pixels of the truth's page (docs/EVALUATION.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inkgrid/drawing.h"

namespace inkgrid {

struct SvgText {
  std::string name;  // for messages
  std::string text;
};

struct CompareOptions {
  // How near is near enough, px; unset: from the kind of drawing and the width of its pen, both of which the truth may say
  // (data-set, data-pen): 1.5 px or half a pen, for rough and oversketched drawings 3 px or one and a half pens.
  std::optional<double> tolerance;
  std::optional<double> tolerance_pens;  // the same in pen widths, at least 1.5 px; only where tolerance is unset
  double distance = 2;                   // of the benchmark's F-score, thousandths of the page's longer side
};

struct Agreement {
  double precision = 0;  // share of the result that the truth confirms
  double recall = 0;     // share of the truth that the result has
  double f1 = 0;         // harmonic mean of both
};

struct PointAgreement : Agreement {
  int result = 0;  // how many points there are
  int truth = 0;
};

// Lengths in px.
struct CurveCounts {
  int elements = 0;
  int curves = 0;  // sub-paths
  int segments = 0;
  int lines = 0;
  int quadratics = 0;
  int cubics = 0;
  double length = 0;
  double mean_length = 0;    // of a curve
  double median_length = 0;  // of a curve
};

// The measures of Yan et al., "A Benchmark for Rough Sketch Cleanup" (SIGGRAPH Asia 2020), on curves: no tangents, no caps.
struct BenchmarkMeasures {
  double distance = 0;  // px
  Agreement f_score;
  double chamfer = 0;    // px
  double hausdorff = 0;  // px
};

struct Comparison {
  double tolerance = 0;  // px
  double pen = 0;        // px
  std::string set;       // kind of drawing
  CurveCounts result;
  CurveCounts truth;

  Agreement length;            // places and tangents agree within the tolerance
  Agreement without_tangents;  // places agree
  double f1_half_tolerance = 0;
  std::optional<double> recall_overdrawn;  // of curves that stand for several strokes, where the truth has any
  double duplicate_ratio = 0;              // 1 is ideal, 2: every line twice
  double chamfer = 0;                      // px, each distance 20 px at most
  double hausdorff95 = 0;                  // px, 95 % of either side are nearer
  PointAgreement junctions;
  PointAgreement ends;
  double length_ratio = 0;  // of the result to the truth, like those below
  double segments_ratio = 0;
  double curves_ratio = 0;
  double filled_share = 0;  // of the result's curves: an outline rather than a centre line above one half
  BenchmarkMeasures benchmark;

  std::vector<std::string> notes;  // on reading the files, one sentence each
};

// Throws Error{usage} for an option out of range, Error{file} for a text that is no SVG, has no size, or asks for too much.
Comparison compare_svg(const SvgText& result, const SvgText& truth, const CompareOptions& options = {});

// The same of a drawing of the truth's size.
Comparison compare_drawing(const Drawing& result, const SvgText& truth, const CompareOptions& options = {});

}  // namespace inkgrid
