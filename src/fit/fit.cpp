#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "base/at.h"
#include "base/digest.h"
#include "base/parallel.h"
#include "fit/fit_samples.h"
#include "fit/fit_span.h"
#include "fit/fit_spline.h"

namespace inkgrid {
namespace {

constexpr double kSpanLimit = 0.85;  // of the tolerance: for spans fitted on their own, since smooth joints cost a little
constexpr double kWorth = 0.8;       // tolerance^2 * corner_span: squared error times length that justifies another segment
constexpr int kClosedSegments = 4;   // at least, on a closed smooth curve
constexpr int kRecuts = 10;          // of a stretch that stays outside the tolerance
constexpr double kRecutFactor = 0.75;
constexpr int kStepsBetweenChecks = 6, kRefineRounds = 6, kPolishSteps = 30;  // of least squares
constexpr double kStraight = 0.12;  // of the tolerance: added to the error of the curve that a line is compared with

constexpr double kLoosening = 2;  // tolerances a usual width that a chain is wider
constexpr double kLoosest = 4;    // tolerances

Cubic straight(Vec2 a, Vec2 b) {
  return {a, lerp(a, b, 1.0 / 3), lerp(a, b, 2.0 / 3), b};
}

double worth_of_segment(const FitOptions& options) {
  return kWorth * options.tolerance * options.tolerance * options.corner_span;
}

CutOptions cut_options(const FitOptions& options) {
  return {kSpanLimit * options.tolerance, worth_of_segment(options), options.corner_span / 2, kClosedSegments};
}

struct SplineFit {
  SmoothSpline spline;
  Feet feet;
};

std::vector<double> arc_weights(const Samples& samples) {
  std::vector<double> weights(samples.points.size(), 0);
  for (std::size_t i = 1; i < weights.size(); ++i) {
    const double half = (samples.arc[i] - samples.arc[i - 1]) / 2;
    weights[i - 1] += half, weights[i] += half;
  }
  return weights;
}

Vec2 end_direction(Vec2 handle, Vec2 chord) {
  return norm(handle) > 0.02 * norm(chord) ? unit(handle) : unit(chord);
}

// A smooth spline through the cuts, from the cubics between them.  Cuts of a closed stretch may lie in its second turn.
SplineFit initial_fit(const Samples& samples, const std::vector<int>& cuts) {
  const int n = static_cast<int>(cuts.size()) - 1, last = static_cast<int>(samples.points.size()) - 1;
  const Samples turns = samples.closed ? two_turns(samples) : samples;
  SplineFit fit;
  fit.spline.closed = samples.closed;
  fit.feet.assign(samples.points.size(), 0);
  std::vector<Vec2> directions(at(n + 1));
  for (int k = 0; k < n; ++k) {
    const int a = cuts[at(k)], b = cuts[at(k + 1)];
    const Cubic c = fit_span(turns, a, b).cubic;
    directions[at(k)] += norm(c.p3 - c.p0) * end_direction(c.p1 - c.p0, c.p3 - c.p0);
    directions[at(k + 1)] += norm(c.p3 - c.p0) * end_direction(c.p3 - c.p2, c.p3 - c.p0);
    fit.spline.joints.push_back(turns.points[at(a)]);
    const double start = turns.arc[at(a)], length = turns.arc[at(b)] - start;
    const auto handle = [&](Vec2 v) { return std::clamp(norm(v), 0.1 * length, 0.6 * length); };
    fit.spline.handles.push_back({handle(c.p1 - c.p0), handle(c.p3 - c.p2)});
    for (int i = a; i < b; ++i) fit.feet[at(i % last)] = k + (turns.arc[at(i)] - start) / length;
  }
  if (samples.closed) {
    directions.front() += directions.back(), directions.pop_back();
    fit.feet.back() = fit.feet.front();
  } else {
    fit.spline.joints.push_back(samples.points.back());
    fit.feet.back() = n;
  }
  for (const Vec2 d : directions) fit.spline.angles.push_back(std::atan2(d.y, d.x));
  return fit;
}

// Least squares until the tolerance holds; where they settle outside of it, the points furthest away gain weight.
bool refine_within(SplineFit& fit, const Samples& samples, double tolerance, RefineOptions options) {
  std::vector<double> weights = arc_weights(samples);
  options.most_steps = kStepsBetweenChecks;
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRefineRounds; ++round) {
    refine_spline(fit.spline, fit.feet, samples, weights, options);
    const double largest = std::ranges::max(deviations(fit.spline, fit.feet, samples));
    if (largest <= tolerance) return true;
    if (round > 0 && largest > 1.5 * tolerance && largest > 0.8 * before) return false;
    if (round > 0 && round % 2 == 0 && largest > 0.97 * before) return false;
    before = largest;
    if (round == 0) continue;
    const std::vector<double> gaps = distances(fit.spline, fit.feet, samples);
    for (std::size_t i = 0; i < gaps.size(); ++i) weights[i] *= std::max(1.0, std::pow(1.5 * gaps[i] / tolerance, 4));
  }
  return false;
}

// Some consecutive segments with the points that lie along them, to be changed between ends that keep place and direction.
struct Stretch {
  SplineFit fit;
  Samples samples;
  std::vector<std::size_t> numbers;  // of its points; its first and last sample are joints instead
  int first = 0, count = 0;          // the segments it replaces
  RefineOptions options;
  bool whole = false;  // all of the closed spline
};

// Rotates ascending numbers below `count`, taken as a circle, to start after the widest gap.
void start_after_gap(std::vector<std::size_t>& numbers, std::size_t count) {
  if (numbers.empty()) return;
  std::size_t start = 0, widest = numbers.front() + count - numbers.back();
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (numbers[i] - numbers[i - 1] > widest) widest = numbers[i] - numbers[i - 1], start = i;
  std::rotate(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(start), numbers.end());
}

// Of a closed spline, segments before its seam are reached by moving the seam; one of few segments is a stretch as a whole.
Stretch cut_out(SplineFit& fit, const Samples& samples, int first, int count) {
  const int n = fit.spline.segments();
  Stretch stretch;
  if (samples.closed) {
    rotate_seam(fit.spline, fit.feet, (first + n) % n);
    first = 0;
    if (count + 2 > n) return {fit, samples, {}, 0, n, {}, true};
  }
  stretch.first = std::max(first, 0);
  stretch.count = std::min(first + count, n) - stretch.first;
  stretch.options.pin_start_angle = samples.closed || stretch.first > 0;
  stretch.options.pin_end_angle = samples.closed || stretch.first + stretch.count < n;
  for (int k = stretch.first; k <= stretch.first + stretch.count; ++k) {
    stretch.fit.spline.joints.push_back(fit.spline.joints[at(k)]);
    stretch.fit.spline.angles.push_back(fit.spline.angles[at(k)]);
    if (k < stretch.first + stretch.count) stretch.fit.spline.handles.push_back(fit.spline.handles[at(k)]);
  }
  std::vector<std::size_t>& numbers = stretch.numbers;
  for (std::size_t i = 0; i + (samples.closed ? 1 : 0) < fit.feet.size(); ++i)
    if (fit.feet[i] >= stretch.first && fit.feet[i] <= stretch.first + stretch.count) numbers.push_back(i);
  if (samples.closed) start_after_gap(numbers, fit.feet.size() - 1);
  const auto add = [&](Vec2 p, double foot) {
    const double step = stretch.samples.points.empty() ? 0 : norm(p - stretch.samples.points.back());
    stretch.samples.arc.push_back(stretch.samples.arc.empty() ? 0 : stretch.samples.arc.back() + step);
    stretch.samples.points.push_back(p);
    stretch.fit.feet.push_back(foot);
  };
  add(stretch.fit.spline.joints.front(), 0);
  for (const std::size_t i : numbers) add(samples.points[i], fit.feet[i] - stretch.first);
  add(stretch.fit.spline.joints.back(), stretch.count);
  return stretch;
}

void put_back(SplineFit& fit, const Stretch& stretch) {
  if (stretch.whole) {
    fit = stretch.fit;
    return;
  }
  const auto& [joints, angles, handles, closed] = stretch.fit.spline;
  const int after = stretch.first + stretch.count, growth = stretch.fit.spline.segments() - stretch.count;
  const auto replace = [&](auto& all, const auto& part, int past) {
    all.erase(all.begin() + stretch.first, all.begin() + past);
    all.insert(all.begin() + stretch.first, part.begin(), part.end());
  };
  replace(fit.spline.joints, joints, after + 1);
  replace(fit.spline.angles, angles, after + 1);
  replace(fit.spline.handles, handles, after);
  for (double& foot : fit.feet)
    if (foot > after) foot += growth;
  for (std::size_t i = 0; i < stretch.numbers.size(); ++i) fit.feet[stretch.numbers[i]] = stretch.first + stretch.fit.feet[i + 1];
  if (fit.spline.closed) fit.feet.back() = fit.feet.front();
}

// Refines; while that fails, cuts the stretch anew, ever finer.  What nothing makes smooth (a line that turns back on itself) is
// left as the finest cuts give it, close to the points.
void mend(Stretch& stretch, const FitOptions& options) {
  const double first = stretch.fit.spline.angles.front(), last = stretch.fit.spline.angles.back();
  CutOptions cutting = cut_options(options);
  for (int round = 0; round <= kRecuts; ++round) {
    const SplineFit unrefined = stretch.fit;
    if (refine_within(stretch.fit, stretch.samples, options.tolerance, stretch.options)) return;
    stretch.fit = unrefined;
    if (round == kRecuts) return;
    cutting.limit *= kRecutFactor;
    cutting.shortest *= kRecutFactor;
    cutting.worth *= kRecutFactor;
    stretch.fit = initial_fit(stretch.samples, cut_into_spans(stretch.samples, cutting));
    if (stretch.options.pin_start_angle) stretch.fit.spline.angles.front() = first;
    if (stretch.options.pin_end_angle) stretch.fit.spline.angles.back() = last;
  }
}

// Mends each run of failing segments, between one good segment on either side.
void mend_failing(SplineFit& fit, const Samples& samples, const FitOptions& options) {
  std::vector<double> worst = deviations(fit.spline, fit.feet, samples);
  const auto rotate = [&](std::ptrdiff_t by) { std::rotate(worst.begin(), worst.begin() + by, worst.end()); };
  const auto good = [&](double w) { return w <= options.tolerance; };
  if (const auto seam = std::ranges::find_if(worst, good); samples.closed && seam != worst.end()) {
    rotate_seam(fit.spline, fit.feet, static_cast<int>(seam - worst.begin()));
    rotate(seam - worst.begin());
  }
  while (true) {
    const auto failing = std::ranges::find_if_not(worst, good), after = std::find_if(failing, worst.end(), good);
    if (failing == worst.end()) return;
    const int n = fit.spline.segments(), before = static_cast<int>(failing - worst.begin()) - 1;
    Stretch stretch = cut_out(fit, samples, before, static_cast<int>(after - failing) + 2);
    if (samples.closed) rotate((before + n) % n);
    mend(stretch, options);
    put_back(fit, stretch);
    const auto start = worst.erase(worst.begin() + stretch.first, worst.begin() + stretch.first + stretch.count);
    worst.insert(start, at(stretch.fit.spline.segments()), 0.0);
  }
}

// False where not even a free cubic along the two segments at a joint stays within the tolerance.
bool may_join(const Stretch& stretch, int joint, double tolerance) {
  int first = -1, last = -1;
  for (int i = 0; i < static_cast<int>(stretch.fit.feet.size()); ++i) {
    const double foot = stretch.fit.feet[at(i)];
    if (foot < joint - 1 || foot > joint + 1) continue;
    if (first < 0) first = i;
    if (last >= 0 && i > last + 2) return true;  // over the seam: no range of points
    last = i;
  }
  return first < 0 || last - first < 4 || fit_span(stretch.samples, first, last).largest <= tolerance;
}

double squared_error(const SplineFit& fit, const Samples& samples) {
  const std::vector<double> gaps = distances(fit.spline, fit.feet, samples), weights = arc_weights(samples);
  double sum = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) sum += weights[i] * gaps[i] * gaps[i];
  return sum;
}

// Leaves out each smooth joint without which the tolerance holds and the error grows by less than a segment is worth.
void drop_joints(SplineFit& fit, const Samples& samples, const FitOptions& options) {
  const int least = samples.closed ? kClosedSegments : 1;
  int kept = 0;
  for (int k = 1; fit.spline.segments() > least && kept < fit.spline.segments();) {
    if (!samples.closed && k >= fit.spline.segments()) return;
    Stretch stretch = cut_out(fit, samples, k - 2, 4);
    const int joint = samples.closed ? 2 : k - stretch.first;
    const double most = squared_error(stretch.fit, stretch.samples) + worth_of_segment(options);
    if (may_join(stretch, joint, options.tolerance)) {
      join_segments(stretch.fit.spline, stretch.fit.feet, joint);
      if (refine_within(stretch.fit, stretch.samples, options.tolerance, stretch.options) &&
          squared_error(stretch.fit, stretch.samples) <= most) {
        put_back(fit, stretch);
        kept = 0, k = std::max(1, k - 1);
        continue;
      }
    }
    ++kept;
    k = samples.closed ? 3 : k + 1;
  }
}

// A single segment that a straight line explains as well becomes one.
void straighten(SplineFit& fit, const Samples& samples, double tolerance) {
  if (fit.spline.closed || fit.spline.segments() != 1) return;
  const Vec2 a = fit.spline.joints[0], b = fit.spline.joints[1], u = unit(b - a);
  const std::vector<double> gaps = distances(fit.spline, fit.feet, samples), weights = arc_weights(samples);
  double curved = 0, line = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const Vec2 v = samples.points[i] - a;
    const double d = norm(v - std::clamp(dot(v, u), 0.0, norm(b - a)) * u);
    if (d > tolerance) return;
    curved += weights[i] * gaps[i] * gaps[i], line += weights[i] * d * d;
  }
  const double allowance = kStraight * tolerance;
  if (line > 1.5 * curved + samples.arc.back() * allowance * allowance) return;
  fit.spline.angles.assign(2, std::atan2(u.y, u.x));
  fit.spline.handles[0] = {norm(b - a) / 3, norm(b - a) / 3};
}

// The least squares of the whole, unless they leave the tolerance.
void polish(SplineFit& fit, const Samples& samples, double tolerance) {
  SplineFit polished = fit;
  RefineOptions options;
  options.most_steps = kPolishSteps;
  refine_spline(polished.spline, polished.feet, samples, arc_weights(samples), options);
  if (std::ranges::max(deviations(polished.spline, polished.feet, samples)) <= tolerance) fit = polished;
}

std::vector<Cubic> fit_smooth(const Samples& samples, const FitOptions& options) {
  if (samples.points.size() < 3) return {straight(samples.points.front(), samples.points.back())};
  SplineFit fit = initial_fit(samples, cut_into_spans(samples, cut_options(options)));
  RefineOptions rough;
  rough.most_steps = kStepsBetweenChecks;
  refine_spline(fit.spline, fit.feet, samples, arc_weights(samples), rough);
  mend_failing(fit, samples, options);
  drop_joints(fit, samples, options);
  polish(fit, samples, options.tolerance);
  straighten(fit, samples, options.tolerance);
  return cubics_of(fit.spline);
}

// The points between two corners, the second one perhaps a turn later, without those that cut them.
Samples side_between(const Samples& samples, const Corner& from, const Corner& to) {
  Samples side;
  const double turn = samples.arc.back(), end = to.arc + (to.arc <= from.arc ? turn : 0);
  const double room = 0.25 * (end - from.arc);
  const double low = from.arc + std::min(from.rounded, room), high = end - std::min(to.rounded, room);
  const auto add = [&](Vec2 p) {
    const double step = side.points.empty() ? 0 : norm(p - side.points.back());
    if (!side.points.empty() && step < 1e-9 * turn) return;
    side.arc.push_back(side.points.empty() ? 0 : side.arc.back() + step);
    side.points.push_back(p);
  };
  add(from.point);
  for (const double shift : {0.0, turn}) {
    const auto first = std::ranges::partition_point(samples.arc, [&](double arc) { return arc + shift <= low; });
    for (auto i = at(first - samples.arc.begin()); i < samples.arc.size() && samples.arc[i] + shift < high; ++i)
      add(samples.points[i]);
  }
  if (side.points.size() > 1 && norm(to.point - side.points.back()) < 1e-9 * turn) side.points.pop_back(), side.arc.pop_back();
  const double step = norm(to.point - side.points.back());
  side.arc.push_back(side.arc.back() + step);
  side.points.push_back(to.point);
  return side;
}

// A closed chain on a junction must pass through it, so its seam stays there.
template <class Line>
bool has_free_seam(const Line& line) {
  return line.closed && line.start_junction < 0 && line.end_junction < 0;
}

// Curves by the digest of their points.
class Fitted {
 public:
  explicit Fitted(const std::vector<Curve>& curves) {
    for (const Curve& curve : curves) by_id_.emplace(curve.id, &curve);
  }

  const Curve* find(std::uint64_t id, const Chain& chain) const {
    const auto found = by_id_.find(id);
    if (found == by_id_.end()) return nullptr;
    const Curve& curve = *found->second;
    return curve.width == chain.width && has_free_seam(curve) == has_free_seam(chain) ? &curve : nullptr;
  }

 private:
  std::map<std::uint64_t, const Curve*> by_id_;
};

// Where the middle of several strokes runs is a matter of taste; that it is smooth is not.
FitOptions options_for(const Chain& chain, FitOptions options) {
  if (options.usual_width > 0)
    options.tolerance *= std::clamp(1 + kLoosening * (chain.width / options.usual_width - 1), 1.0, kLoosest);
  return options;
}

Curve curve_of(const Chain& chain, const FitOptions& options, const InkDepth& depth, const Fitted& before) {
  const std::uint64_t id = digest(chain.points);
  const Curve* const known = before.find(id, chain);
  return {known ? known->segments : fit_polyline(chain.points, has_free_seam(chain), options_for(chain, options), depth),
          chain.closed,
          chain.width,
          chain.coverage,
          chain.start_junction,
          chain.end_junction,
          id};
}

}  // namespace

std::vector<Cubic> fit_polyline(std::span<const Vec2> points, bool closed, const FitOptions& options, const InkDepth& depth) {
  const Samples samples = sample_polyline(points, closed, options.corner_span / 8);
  if (samples.points.empty()) return {};
  if (samples.points.size() < 3) return {straight(samples.points.front(), samples.points.back())};
  std::vector<Corner> corners = find_corners(samples, options.corner_span, depth);
  if (samples.closed && corners.empty()) return fit_smooth(samples, options);
  if (samples.closed) {
    corners.push_back(corners.front());
  } else {
    corners.insert(corners.begin(), {samples.points.front(), 0, 0});
    corners.push_back({samples.points.back(), samples.arc.back(), 0});
  }
  std::vector<Cubic> cubics;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k)
    std::ranges::move(fit_smooth(side_between(samples, corners[k], corners[k + 1]), options), std::back_inserter(cubics));
  return cubics;
}

Drawing fit_curves(const Chains& chains, const FitOptions& options, const InkDepth& depth, const std::vector<Curve>& before) {
  const Fitted known(before);
  const int count = static_cast<int>(chains.chains.size());
  std::vector<Curve> curves(chains.chains.size());
  for_each_largest_first(
      options.threads, count, [&](int c) { return chains.chains[at(c)].points.size(); },
      [&](int c) { curves[at(c)] = curve_of(chains.chains[at(c)], options, depth, known); });
  Drawing drawing;
  drawing.junctions = chains.junctions;
  std::set<std::uint64_t> ids;
  for (Curve& curve : curves) {
    while (!ids.insert(curve.id).second) ++curve.id;  // curves through the very same points
    if (!curve.segments.empty()) drawing.curves.push_back(std::move(curve));
  }
  return drawing;
}

}  // namespace inkgrid
