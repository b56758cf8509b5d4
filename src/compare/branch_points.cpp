#include "compare/branch_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/at.h"
#include "compare/crossings.h"

namespace inkgrid {
namespace {

// Greedy clusters of a radius, those with most points first; their means.
std::vector<Vec2> merged(const std::vector<Vec2>& points, double radius) {
  const PointTree tree(points);
  std::vector<std::vector<int>> neighbours;
  neighbours.reserve(points.size());
  for (const Vec2 point : points) neighbours.push_back(tree.within(point, radius));
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return neighbours[at(a)].size() > neighbours[at(b)].size(); });
  std::vector<bool> taken(points.size());
  std::vector<Vec2> means;
  for (const int i : order) {
    if (taken[at(i)]) continue;
    Vec2 sum;
    int count = 0;
    for (const int j : neighbours[at(i)]) {
      if (taken[at(j)]) continue;
      taken[at(j)] = true;
      sum += points[at(j)];
      ++count;
    }
    means.push_back(sum / count);
  }
  return means;
}

std::vector<Vec2> open_ends(const CurveSamples& samples) {
  std::vector<Vec2> ends;
  for (std::size_t k = 0; k < samples.polylines.size(); ++k) {
    if (samples.closed[k]) continue;
    ends.push_back(samples.polylines[k].front());
    ends.push_back(samples.polylines[k].back());
  }
  return ends;
}

// Samples in a row of one curve that lie inside the circle.
struct Run {
  int curve = 0;
  bool at_start = false;  // of its curve
  bool at_end = false;
  double distance = 0;  // to the centre, px

  bool at_seam(const CurveSamples& samples) const { return samples.closed[at(curve)] && (at_start || at_end); }
};

Run run_of(const CurveSamples& samples, const std::vector<int>& inside, std::size_t begin, std::size_t end, Vec2 centre) {
  const int first = inside[begin], last = inside[end - 1];
  Run run{samples.curves[at(first)], first == 0, last + 1 == samples.size(), norm(samples.points[at(first)] - centre)};
  run.at_start = run.at_start || samples.curves[at(first - 1)] != run.curve;
  run.at_end = run.at_end || samples.curves[at(last + 1)] != run.curve;
  for (std::size_t i = begin; i < end; ++i) run.distance = std::min(run.distance, norm(samples.points[at(inside[i])] - centre));
  return run;
}

std::vector<Run> runs_inside(const CurveSamples& samples, Vec2 centre, double radius) {
  const std::vector<int> inside = samples.tree.within(centre, radius);
  std::vector<Run> runs;
  for (std::size_t begin = 0, end = 0; begin < inside.size(); begin = end) {
    for (end = begin + 1; end < inside.size(); ++end)
      if (inside[end] != inside[end - 1] + 1 || samples.curves[at(inside[end])] != samples.curves[at(inside[begin])]) break;
    runs.push_back(run_of(samples, inside, begin, end, centre));
  }
  return runs;
}

// How often curves that come as near as `near` leave the circle.  The seam of a closed curve is no end: its two halves are
// near together.
int branches(const CurveSamples& samples, const std::vector<Run>& runs, double near) {
  int count = 0;
  for (const Run& run : runs) {
    if (run.at_start && run.at_end && run.at_seam(samples)) continue;  // a small closed curve inside the circle
    bool is_near = run.distance <= near;
    if (run.at_seam(samples)) {
      for (const Run& other : runs)
        is_near = is_near || (other.curve == run.curve && other.at_seam(samples) && other.distance <= near);
      count += is_near;
    } else if (is_near) {
      count += !run.at_start + !run.at_end;
    }
  }
  return count;
}

void keep_far_from(std::vector<Vec2>& points, const std::vector<Vec2>& centres, double radius) {
  const PointTree tree(centres);
  std::erase_if(points, [&](Vec2 p) { return !tree.within(p, radius).empty(); });
}

}  // namespace

BranchPoints find_branch_points(const CurveSamples& samples, double touch) {
  std::vector<std::vector<Vec2>> polylines;
  for (const auto& polyline : samples.polylines) polylines.push_back(thinned(polyline));
  const double radius = 1.5 * touch + 1, near = touch + kSampleStep / 2;
  const auto branches_at = [&](Vec2 p) { return branches(samples, runs_inside(samples, p, radius), near); };
  std::vector<Vec2> crossing_junctions, touching_junctions, ends;
  for (const Vec2 p : merged(crossings(polylines), touch)) {
    const int count = branches_at(p);
    if (count >= 3) crossing_junctions.push_back(p);
    if (count == 1) ends.push_back(p);
  }
  for (const Vec2 p : merged(open_ends(samples), touch)) {
    const int count = branches_at(p);
    if (count >= 3) touching_junctions.push_back(p);
    if (count == 1) ends.push_back(p);
  }
  keep_far_from(touching_junctions, crossing_junctions, radius);
  std::vector<Vec2> junctions = std::move(crossing_junctions);
  junctions.insert(junctions.end(), touching_junctions.begin(), touching_junctions.end());
  keep_far_from(ends, junctions, radius);
  return {merged(junctions, radius), ends};
}

PointAgreement match_points(const std::vector<Vec2>& result, const std::vector<Vec2>& truth, double radius) {
  const PointTree tree(truth);
  std::vector<std::tuple<double, int, int>> pairs;
  for (int i = 0; i < static_cast<int>(result.size()); ++i)
    for (const int j : tree.within(result[at(i)], radius)) pairs.emplace_back(norm(result[at(i)] - truth[at(j)]), i, j);
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> result_taken(result.size()), truth_taken(truth.size());
  int count = 0;
  for (const auto& [distance, i, j] : pairs) {
    if (result_taken[at(i)] || truth_taken[at(j)]) continue;
    result_taken[at(i)] = truth_taken[at(j)] = true;
    ++count;
  }
  PointAgreement agreement;
  agreement.result = static_cast<int>(result.size());
  agreement.truth = static_cast<int>(truth.size());
  agreement.precision = result.empty() ? (truth.empty() ? 1 : 0) : static_cast<double>(count) / agreement.result;
  agreement.recall = truth.empty() ? 1 : static_cast<double>(count) / agreement.truth;
  agreement.f1 = harmonic_mean(agreement.precision, agreement.recall);
  return agreement;
}

double harmonic_mean(double a, double b) {
  return a + b > 0 ? 2 * a * b / (a + b) : 0;
}

}  // namespace inkgrid
