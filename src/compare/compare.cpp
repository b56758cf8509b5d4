// What:   agreement of two sets of curves (include/inkgrid/compare.h).
// Source: Yan et al. 2020 for the benchmark's measures; the others are defined in docs/EVALUATION.md.
// Cost:   a few questions to a k-d tree for each half pixel of curve.
#include "inkgrid/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/at.h"
#include "compare/branch_points.h"
#include "compare/curve_samples.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr double kSameDirection = 30 * std::numbers::pi / 180;
constexpr double kFar = 20;             // px: a larger distance counts as this in the Chamfer mean
constexpr double kMostOfLength = 0.95;  // of Hausdorff 95

bool is_rough(const std::string& set) {
  return set.starts_with("rough") || set.starts_with("over");
}

double default_tolerance(const std::string& set, double pen) {
  return is_rough(set) ? std::max(3.0, 1.5 * pen) : std::max(1.5, 0.5 * pen);
}

double chosen_tolerance(const CompareOptions& options, const std::string& set, double pen) {
  if (options.tolerance) return *options.tolerance;
  if (options.tolerance_pens) return std::max(1.5, *options.tolerance_pens * pen);
  return default_tolerance(set, pen);
}

// How near an end must come to a curve to touch it.  With a broad pen, half its width would be far too much.
double touching_distance(const std::string& set, double pen, double tolerance) {
  return (is_rough(set) ? tolerance : std::min(tolerance, std::max(1.5, 0.25 * pen))) + 0.5;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

double pen_of(const SvgDocument& document) {
  if (document.pen) return *document.pen;
  std::vector<double> widths;
  for (const SvgCurve& curve : document.curves) widths.push_back(curve.stroke_width);
  return widths.empty() ? 1 : median(std::move(widths));
}

// Which samples of one side the other side has.
using Found = std::vector<bool>;

bool same_direction(double a, double b) {
  const double difference = std::abs(a - b);
  return std::min(difference, std::numbers::pi - difference) <= kSameDirection;
}

// Is there a point of `there` nearer than `tolerance` whose tangent agrees?
Found found_with_tangents(const CurveSamples& here, const CurveSamples& there, double tolerance) {
  Found found;
  for (std::size_t i = 0; i < here.points.size(); ++i)
    found.push_back(there.tree.any_within(here.points[i], tolerance,
                                          [&](int j) { return same_direction(here.angles[i], there.angles[at(j)]); }));
  return found;
}

Found found_within(const std::vector<double>& distances, double tolerance) {
  Found found;
  for (const double distance : distances) found.push_back(distance < tolerance);
  return found;
}

double found_length(const CurveSamples& samples, const Found& found) {
  double length = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i]) length += samples.weights[i];
  return length;
}

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

Agreement agreement(double precision, double recall) {
  return {precision, recall, harmonic_mean(precision, recall)};
}

// Both sides with the distance of each sample to the other side.
struct Pair {
  const CurveSamples& result;
  const CurveSamples& truth;
  std::vector<double> from_result{};  // px; infinite where the other side is empty
  std::vector<double> from_truth{};

  Agreement agree(const Found& in_truth, const Found& in_result) const {
    return agreement(ratio(found_length(result, in_truth), result.length), ratio(found_length(truth, in_result), truth.length));
  }
  bool has_both() const { return result.size() > 0 && truth.size() > 0; }
};

std::vector<double> distances(const CurveSamples& here, const CurveSamples& there) {
  std::vector<double> all;
  for (const Vec2 point : here.points) all.push_back(there.tree.distance(point));
  return all;
}

double mean_distance(const CurveSamples& samples, const std::vector<double>& distances, double cap) {
  double sum = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) sum += samples.weights[i] * std::min(distances[i], cap);
  return sum / samples.length;
}

// The mean of both directions.
double chamfer(const Pair& pair, double cap) {
  return (mean_distance(pair.result, pair.from_result, cap) + mean_distance(pair.truth, pair.from_truth, cap)) / 2;
}

// The distance that a share of the length does not exceed.
double percentile(const CurveSamples& samples, const std::vector<double>& distances, double share) {
  std::vector<std::size_t> order(distances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  double length = 0;
  for (const std::size_t i : order) {
    length += samples.weights[i];
    if (length >= share * samples.length) return distances[i];
  }
  return distances[order.back()];
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

CurveCounts count_curves(const SvgDocument& document, const CurveSamples& samples) {
  CurveCounts counts;
  counts.elements = document.elements;
  counts.curves = static_cast<int>(document.curves.size());
  for (const SvgCurve& curve : document.curves)
    for (const PathSegment& segment : curve.segments)
      ++(segment.degree == 1 ? counts.lines : segment.degree == 2 ? counts.quadratics : counts.cubics);
  counts.segments = counts.lines + counts.quadratics + counts.cubics;
  counts.length = samples.length;
  std::vector<double> lengths(samples.polylines.size());
  for (std::size_t i = 0; i < samples.points.size(); ++i) lengths[at(samples.curves[i])] += samples.weights[i];
  counts.mean_length = ratio(samples.length, static_cast<double>(lengths.size()));
  counts.median_length = median(std::move(lengths));
  return counts;
}

void compare_lengths(Comparison& c, const Pair& pair) {
  const Found in_truth = found_with_tangents(pair.result, pair.truth, c.tolerance);
  const Found in_result = found_with_tangents(pair.truth, pair.result, c.tolerance);
  c.length = pair.agree(in_truth, in_result);
  c.without_tangents = pair.agree(found_within(pair.from_result, c.tolerance), found_within(pair.from_truth, c.tolerance));
  c.f1_half_tolerance = pair.agree(found_with_tangents(pair.result, pair.truth, c.tolerance / 2),
                                   found_with_tangents(pair.truth, pair.result, c.tolerance / 2))
                            .f1;
  c.duplicate_ratio = ratio(found_length(pair.result, in_truth), found_length(pair.truth, in_result));
  Found overdrawn, found_overdrawn;
  for (std::size_t i = 0; i < in_result.size(); ++i) {
    overdrawn.push_back(pair.truth.overdrawn[at(pair.truth.curves[i])]);
    found_overdrawn.push_back(overdrawn[i] && in_result[i]);
  }
  if (const double whole = found_length(pair.truth, overdrawn); whole > 0)
    c.recall_overdrawn = found_length(pair.truth, found_overdrawn) / whole;
}

void compare_distances(Comparison& c, const Pair& pair, Extent page) {
  c.benchmark.f_score =
      pair.agree(found_within(pair.from_result, c.benchmark.distance), found_within(pair.from_truth, c.benchmark.distance));
  if (!pair.has_both()) {
    c.chamfer = kFar;
    c.hausdorff95 = c.benchmark.chamfer = c.benchmark.hausdorff = std::hypot(page.width, page.height);
    return;
  }
  c.chamfer = chamfer(pair, kFar);
  c.hausdorff95 =
      std::max(percentile(pair.result, pair.from_result, kMostOfLength), percentile(pair.truth, pair.from_truth, kMostOfLength));
  c.benchmark.chamfer = chamfer(pair, std::numeric_limits<double>::infinity());
  c.benchmark.hausdorff = std::max(largest(pair.from_result), largest(pair.from_truth));
}

void compare_branch_points(Comparison& c, const Pair& pair) {
  const double touch = touching_distance(c.set, c.pen, c.tolerance), radius = 2 * c.tolerance + 2;
  const BranchPoints result = find_branch_points(pair.result, touch), truth = find_branch_points(pair.truth, touch);
  c.junctions = match_points(result.junctions, truth.junctions, radius);
  c.ends = match_points(result.ends, truth.ends, radius);
}

void compare_counts(Comparison& c) {
  c.length_ratio = ratio(c.result.length, c.truth.length);
  c.segments_ratio = static_cast<double>(c.result.segments) / std::max(1, c.truth.segments);
  c.curves_ratio = static_cast<double>(c.result.curves) / std::max(1, c.truth.curves);
}

double filled_share(const SvgDocument& document) {
  const auto filled = std::count_if(document.curves.begin(), document.curves.end(), [](const SvgCurve& c) { return c.filled; });
  return ratio(static_cast<double>(filled), static_cast<double>(document.curves.size()));
}

void validate(const CompareOptions& options) {
  const auto refuse_unless_positive = [](double value, const char* name) {
    if (!(value > 0 && value < 1e6)) throw Error(ErrorCode::usage, std::string("the ") + name + " must be a positive number");
  };
  refuse_unless_positive(options.tolerance.value_or(1), "tolerance");
  refuse_unless_positive(options.tolerance_pens.value_or(1), "tolerance in pen widths");
  refuse_unless_positive(options.distance, "distance");
}

Comparison compare_documents(const SvgDocument& result, const std::string& result_name, const SvgDocument& truth,
                             const std::string& truth_name, const CompareOptions& options) {
  Comparison c;
  c.set = truth.set.empty() ? "clean" : truth.set;
  c.pen = pen_of(truth);
  c.tolerance = chosen_tolerance(options, c.set, c.pen);
  c.benchmark.distance = options.distance / 1000 * std::max(truth.page.width, truth.page.height);
  for (const std::string& note : result.notes) c.notes.push_back("of the result, " + note);
  for (const std::string& note : truth.notes) c.notes.push_back("of the truth, " + note);
  const CurveSamples result_samples = sample_curves(result.curves, result_name);
  const CurveSamples truth_samples = sample_curves(truth.curves, truth_name);
  Pair pair{result_samples, truth_samples};
  pair.from_result = distances(result_samples, truth_samples);
  pair.from_truth = distances(truth_samples, result_samples);
  compare_lengths(c, pair);
  compare_distances(c, pair, truth.page);
  compare_branch_points(c, pair);
  c.result = count_curves(result, result_samples);
  c.truth = count_curves(truth, truth_samples);
  compare_counts(c);
  c.filled_share = filled_share(result);
  return c;
}

}  // namespace

Comparison compare_svg(const SvgText& result, const SvgText& truth, const CompareOptions& options) {
  validate(options);
  const SvgDocument meant = read_svg(truth);
  return compare_documents(read_svg(result, meant.page), result.name, meant, truth.name, options);
}

Comparison compare_drawing(const Drawing& result, const SvgText& truth, const CompareOptions& options) {
  validate(options);
  SvgDocument document;
  for (const Curve& curve : result.curves) {
    SvgCurve& copy = document.curves.emplace_back();
    for (const Cubic& c : curve.segments) copy.segments.push_back({{c.p0, c.p1, c.p2, c.p3}, 3});
    copy.stroke_width = curve.width;
  }
  document.elements = static_cast<int>(document.curves.size());
  return compare_documents(document, "the drawing", read_svg(truth), truth.name, options);
}

}  // namespace inkgrid
