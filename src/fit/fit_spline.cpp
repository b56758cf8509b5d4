#include "fit/fit_spline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/at.h"
#include "base/polyline.h"
#include "fit/fit_band_solver.h"

namespace inkgrid {
namespace {

constexpr std::size_t kPointsPerSegment = 64;  // more are thinned out
constexpr int kFootSteps = 5;                  // of Newton's method, at most: joints slide slowly when feet lag behind
constexpr double kFootSettled = 1e-4;
constexpr double kThirdsWeight = 2e-6;  // of the pull of handles towards a third of the length, which evens the speed
constexpr double kShortestHandle = 0.04, kLongestHandle = 0.8;  // of the segment's length
constexpr double kThereAndBack = 1.2;                           // rad
constexpr double kBend = 24;                                    // steps of the samples: three strokes
constexpr double kSharpestTurn = 55 * std::numbers::pi / 180;   // within 1/16 of a segment's parameter: else it is a kink

// The eight unknowns of one segment, in this order.
enum Unknown { start_x, start_y, start_angle, start_handle, end_handle, end_angle, end_x, end_y, unknowns };

struct LocalSystem {
  std::array<std::array<double, unknowns>, unknowns> matrix{};
  std::array<double, unknowns> gradient{};
};

double approximate_length(const Cubic& c) {
  const auto length = [](Vec2 a) { return std::sqrt(norm2(a)); };
  return 0.5 * (length(c.p3 - c.p0) + length(c.p1 - c.p0) + length(c.p2 - c.p1) + length(c.p3 - c.p2));
}

// Which global unknown each local one is; -1: pinned.
std::vector<std::array<int, unknowns>> number_unknowns(const SmoothSpline& spline, const RefineOptions& options, int& count) {
  const int n = spline.segments(), joints = static_cast<int>(spline.joints.size());
  std::vector<std::array<int, 3>> of_joint(at(joints), {-1, -1, -1});
  std::vector<std::array<int, unknowns>> of_segment(at(n));
  count = 0;
  for (int j = 0; j < joints; ++j) {
    const bool end = !spline.closed && (j == 0 || j == n);
    if (!end) of_joint[at(j)] = {count, count + 1, count + 2}, count += 3;
    if (end && !(j == 0 ? options.pin_start_angle : options.pin_end_angle)) of_joint[at(j)][2] = count++;
    if (j < n) of_segment[at(j)][start_handle] = count, of_segment[at(j)][end_handle] = count + 1, count += 2;
  }
  for (int k = 0; k < n; ++k) {
    const auto& a = of_joint[at(k)];
    const auto& b = of_joint[at(spline.joint_after(k))];
    auto& s = of_segment[at(k)];
    s[start_x] = a[0], s[start_y] = a[1], s[start_angle] = a[2];
    s[end_x] = b[0], s[end_y] = b[1], s[end_angle] = b[2];
  }
  return of_segment;
}

struct Place {
  int segment;
  double t;
};

// A step that went astray leaves feet that are no numbers.
Place place_of(const SmoothSpline& spline, double foot) {
  const int last = spline.segments() - 1, k = foot > 0 ? static_cast<int>(std::min(foot, static_cast<double>(last))) : 0;
  return {k, foot - k};
}

// One Newton step of a foot towards the nearest point, over a joint if need be.
double step_foot(const SmoothSpline& spline, const std::vector<Cubic>& cubics, double foot, Vec2 p) {
  const auto [k, t] = place_of(spline, foot);
  const Cubic& c = cubics[at(k)];
  const Vec2 gap = point_on(c, t) - p, velocity = velocity_on(c, t);
  const double slope = dot(gap, velocity), speed2 = norm2(velocity);
  if (speed2 == 0) return foot;
  const double curve = speed2 + dot(gap, acceleration_on(c, t));
  const double next = t - std::clamp(slope / std::max(curve, 0.3 * speed2), -0.3, 0.3);
  if (next >= 0 && next <= 1) return k + next;
  const int n = spline.segments(), other = next < 0 ? k - 1 : k + 1;
  if (!spline.closed && (other < 0 || other >= n)) return next < 0 ? 0 : n;
  const Cubic& neighbour = cubics[at((other + n) % n)];
  const double ratio = std::clamp(approximate_length(c) / std::max(approximate_length(neighbour), 1e-12), 0.0, 3.0);
  const double into = std::min(0.3, (next < 0 ? -next : next - 1) * ratio);
  return (other + n) % n + (next < 0 ? 1 - into : into);
}

void move_feet(const SmoothSpline& spline, const std::vector<Cubic>& cubics, const Samples& samples, std::size_t stride,
               Feet& feet) {
  for (std::size_t i = 0; i < feet.size(); i += stride)
    for (int step = 0; step < kFootSteps; ++step) {
      const double before = feet[i];
      feet[i] = step_foot(spline, cubics, before, samples.points[i]);
      if (std::abs(feet[i] - before) < kFootSettled) break;
    }
  if (!spline.closed) feet.front() = 0, feet.back() = spline.segments();
}

// The derivative of the distance along `normal` by the segment's unknowns.
std::array<double, unknowns> derivative(const Cubic& c, std::array<Vec2, 2> directions, double t, Vec2 normal) {
  const auto b = bernstein(t);
  return {(b[0] + b[1]) * normal.x,
          (b[0] + b[1]) * normal.y,
          b[1] * dot(quarter_turn(c.p1 - c.p0), normal),
          b[1] * dot(directions[0], normal),
          -b[2] * dot(directions[1], normal),
          -b[2] * dot(quarter_turn(c.p3 - c.p2), normal),
          (b[2] + b[3]) * normal.x,
          (b[2] + b[3]) * normal.y};
}

class Fitter {
 public:
  Fitter(SmoothSpline& spline, Feet& feet, const Samples& samples, const std::vector<double>& weights,
         const RefineOptions& options)
      : spline_(spline),
        feet_(feet),
        samples_(samples),
        weights_(weights),
        options_(options),
        stride_(std::max<std::size_t>(1, feet.size() / (kPointsPerSegment * spline.handles.size()))),
        of_segment_(number_unknowns(spline, options, count_)) {}

  void run() {
    cubics_ = cubics_of(spline_);
    for (const Cubic& cubic : cubics_) thirds_.push_back(approximate_length(cubic) / 3);
    move_feet(spline_, cubics_, samples_, stride_, feet_);
    double damping = 1e-3;
    int settled = 0;
    bool easy = true;
    for (int step = 0; step < options_.most_steps && settled < 2 && damping < 1e6; ++step) {
      assemble();
      const double before = energy(spline_, cubics_, feet_);
      SmoothSpline spline;
      Feet feet = feet_;
      if (!propose(damping, spline)) {
        damping *= 10;
        continue;
      }
      const std::vector<Cubic> cubics = cubics_of(spline);
      move_feet(spline, cubics, samples_, stride_, feet);
      const double after = energy(spline, cubics, feet);
      if (!(after < before)) {
        damping *= 4;
        easy = false;
        if (!(after > before * (1 + 1e-9))) ++settled;
        continue;
      }
      settled = before - after < 2e-4 * before ? settled + 1 : 0;
      spline_ = spline, feet_ = feet, cubics_ = cubics;
      if (easy) damping = std::max(1e-7, damping / 6);
      easy = true;
    }
    for (std::size_t i = 0; i < feet_.size(); ++i) feet_[i] = feet_[i - i % stride_];
    move_feet(spline_, cubics_, samples_, 1, feet_);
  }

 private:
  double energy(const SmoothSpline& spline, const std::vector<Cubic>& cubics, const Feet& feet) const {
    double sum = 0;
    for (std::size_t i = 0; i < feet.size(); i += stride_) {
      const auto [k, t] = place_of(spline, feet[i]);
      sum += weights_[i] * norm2(point_on(cubics[at(k)], t) - samples_.points[i]);
    }
    for (std::size_t k = 0; k < thirds_.size(); ++k)
      for (const double handle : spline.handles[k]) sum += pull_[k] * (handle - thirds_[k]) * (handle - thirds_[k]);
    return sum;
  }

  void assemble() {
    local_.assign(cubics_.size(), {});
    pull_.assign(cubics_.size(), 0);
    directions_.clear();
    for (const Cubic& cubic : cubics_) directions_.push_back({unit(cubic.p1 - cubic.p0), unit(cubic.p3 - cubic.p2)});
    for (std::size_t i = 0; i < feet_.size(); i += stride_) add_point(i);
    for (std::size_t k = 0; k < local_.size(); ++k)
      for (int side = 0; side < 2; ++side) {
        const auto unknown = at(start_handle + side);
        local_[k].matrix[unknown][unknown] += pull_[k];
        local_[k].gradient[unknown] += pull_[k] * (spline_.handles[k][at(side)] - thirds_[k]);
      }
  }

  void add_point(std::size_t i) {
    const auto [k, t] = place_of(spline_, feet_[i]);
    const Vec2 tangent = fast_unit(velocity_on(cubics_[at(k)], t));
    const Vec2 gap = point_on(cubics_[at(k)], t) - samples_.points[i];
    const auto row = derivative(cubics_[at(k)], directions_[at(k)], t, quarter_turn(tangent));
    const double distance = cross(tangent, gap);
    LocalSystem& local = local_[at(k)];
    for (std::size_t a = 0; a < unknowns; ++a) {
      const double scaled = weights_[i] * row[a];
      local.gradient[a] += scaled * distance;
      for (std::size_t b = 0; b <= a; ++b) local.matrix[a][b] += scaled * row[b];
    }
    pull_[at(k)] += kThirdsWeight * weights_[i];
  }

  // The lengths by which steps of different unknowns are compared.
  double scale2(std::size_t k, std::size_t unknown) const {
    return unknown == start_angle || unknown == end_angle ? thirds_[k] * thirds_[k] : 1;
  }

  bool propose(double damping, SmoothSpline& proposal) const {
    BandSystem system(count_, of_segment_);
    for (std::size_t k = 0; k < local_.size(); ++k) {
      const double level = 1e-3 * pull_[k] / kThirdsWeight;
      for (std::size_t a = 0; a < unknowns; ++a) {
        if (of_segment_[k][a] < 0) continue;
        system.gradient(of_segment_[k][a]) += local_[k].gradient[a];
        system.entry(of_segment_[k][a], of_segment_[k][a]) += damping * (local_[k].matrix[a][a] + level * scale2(k, a)) + 1e-12;
        for (std::size_t b = 0; b <= a; ++b)
          if (of_segment_[k][b] >= 0) system.entry(of_segment_[k][a], of_segment_[k][b]) += local_[k].matrix[a][b];
      }
    }
    std::vector<double> step;
    if (!system.solve(step)) return false;
    proposal = spline_;
    for (std::size_t k = 0; k < local_.size(); ++k) {
      apply(step, k, proposal);
      const auto end = at(spline_.joint_after(static_cast<int>(k)));
      const std::size_t next = end < thirds_.size() ? end : k;
      if (norm(proposal.joints[end] - spline_.joints[end]) > std::min(thirds_[k], thirds_[next])) return false;
    }
    return true;
  }

  void apply(const std::vector<double>& step, std::size_t k, SmoothSpline& proposal) const {
    const auto change = [&](int unknown) {
      const int global = of_segment_[k][at(unknown)];
      return global < 0 ? 0.0 : -step[at(global)];
    };
    const double length = approximate_length(cubics_[k]);
    for (int side = 0; side < 2; ++side) {
      double& handle = proposal.handles[k][at(side)];
      handle = std::clamp(handle + change(start_handle + side), kShortestHandle * length, kLongestHandle * length);
    }
    const auto end = at(spline_.joint_after(static_cast<int>(k)));
    if (k == 0 && !spline_.closed) proposal.angles[0] += std::clamp(change(start_angle), -0.5, 0.5);
    const double turn = std::clamp(change(end_angle), -0.5, 0.5);
    proposal.angles[end] += turn;
    // A joint that slides along the curve turns on the way, so it leaves in a direction between the old and the new one.
    proposal.joints[end] += Vec2{std::cos(turn / 2), std::sin(turn / 2)} * Vec2{change(end_x), change(end_y)};
  }

  SmoothSpline& spline_;
  Feet& feet_;
  const Samples& samples_;
  const std::vector<double>& weights_;
  const RefineOptions& options_;
  std::size_t stride_;  // of the points that are looked at
  int count_ = 0;
  std::vector<std::array<int, unknowns>> of_segment_;
  std::vector<Cubic> cubics_;
  std::vector<LocalSystem> local_;
  std::vector<std::array<Vec2, 2>> directions_;  // of travel at both ends of each segment
  std::vector<double> thirds_, pull_;  // per segment: a third of its length at first, the weight that draws handles to it
};

constexpr int kTurningSteps = 32;

// How the direction changes from each place to the next, rad.
std::array<double, kTurningSteps> turns_of(const Cubic& cubic) {
  std::array<double, kTurningSteps> turns{};
  for (int i = 0; i < kTurningSteps; ++i) {
    const Vec2 a = velocity_on(cubic, static_cast<double>(i) / kTurningSteps),
               b = velocity_on(cubic, static_cast<double>(i + 1) / kTurningSteps);
    turns[at(i)] = std::atan2(cross(a, b), dot(a, b));
  }
  return turns;
}

// Whether the curve turns one way and back again within `length` px.
bool wriggles(const Cubic& cubic, const std::array<double, kTurningSteps>& turns, double length) {
  std::array<double, kTurningSteps> arc{};
  for (int i = 0; i + 1 < kTurningSteps; ++i)
    arc[at(i + 1)] = arc[at(i)] + norm(velocity_on(cubic, (i + 0.5) / kTurningSteps)) / kTurningSteps;
  double total = 0, net = 0;
  for (int first = 0, i = 0; i < kTurningSteps; ++i) {
    total += std::abs(turns[at(i)]), net += turns[at(i)];
    for (; arc[at(i)] - arc[at(first)] > length; ++first) total -= std::abs(turns[at(first)]), net -= turns[at(first)];
    if (total - std::abs(net) > kThereAndBack) return true;
  }
  return false;
}

// `bend`, px: what is shorter is no bend that a pen draws.
bool is_fair(const Cubic& cubic, double bend) {
  const auto turns = turns_of(cubic);
  double total = 0;
  for (int i = 0; i < kTurningSteps; i += 2) {
    const double turn = std::abs(turns[at(i)] + turns[at(i + 1)]);
    if (turn > kSharpestTurn) return false;
    total += turn;
  }
  return total < 1.6 * std::numbers::pi && !wriggles(cubic, turns, bend);
}

// The piece of the spline between two consecutive feet against the edge between their points.
void measure_piece(const SmoothSpline& spline, const std::vector<Cubic>& cubics, double from, double to, Vec2 a, Vec2 b,
                   std::vector<double>& worst) {
  const int n = spline.segments();
  if (spline.closed && to < from - 0.5 * n) to += n;
  if (!(to > from)) return;  // or a foot is no number
  const int k = std::clamp(static_cast<int>(from), 0, n - 1);
  const double length = (to - from) * approximate_length(cubics[at(k)]), edge = norm(b - a);
  const int pieces =
      1 + static_cast<int>(std::fmax(1.0, std::fmin(20.0, length / std::max(edge, 1e-9))));  // of a length that is no number, too
  for (int i = 1; i < pieces; ++i) {
    const double foot = from + (to - from) * i / pieces;
    const auto [segment, t] = place_of(spline, foot >= n ? foot - n : foot);
    double& w = worst[at(segment)];
    w = std::max(w, distance_to_segment(point_on(cubics[at(segment)], t), a, b));
  }
}

}  // namespace

std::vector<Cubic> cubics_of(const SmoothSpline& spline) {
  std::vector<Cubic> cubics;
  cubics.reserve(at(spline.segments()));
  for (int k = 0; k < spline.segments(); ++k) cubics.push_back(spline.cubic(k));
  return cubics;
}

Cubic SmoothSpline::cubic(int segment) const {
  const auto from = at(segment), to = at(joint_after(segment));
  const Vec2 u{std::cos(angles[from]), std::sin(angles[from])}, v{std::cos(angles[to]), std::sin(angles[to])};
  return {joints[from], joints[from] + handles[from][0] * u, joints[to] - handles[from][1] * v, joints[to]};
}

void refine_spline(SmoothSpline& spline, Feet& feet, const Samples& samples, const std::vector<double>& weights,
                   const RefineOptions& options) {
  Fitter(spline, feet, samples, weights, options).run();
}

std::vector<double> distances(const SmoothSpline& spline, const Feet& feet, const Samples& samples) {
  const std::vector<Cubic> cubics = cubics_of(spline);
  std::vector<double> result;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const auto [k, t] = place_of(spline, feet[i]);
    result.push_back(norm(point_on(cubics[at(k)], t) - samples.points[i]));
  }
  return result;
}

std::vector<double> deviations(const SmoothSpline& spline, const Feet& feet, const Samples& samples) {
  const std::vector<Cubic> cubics = cubics_of(spline);
  std::vector<double> worst(cubics.size(), 0);
  const std::vector<double> gaps = distances(spline, feet, samples);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    double& w = worst[at(place_of(spline, feet[i]).segment)];
    w = std::max(w, gaps[i]);
    if (i > 0) measure_piece(spline, cubics, feet[i - 1], feet[i], samples.points[i - 1], samples.points[i], worst);
  }
  const double bend = kBend * samples.arc.back() / static_cast<double>(samples.points.size());
  for (std::size_t k = 0; k < cubics.size(); ++k)
    if (!is_fair(cubics[k], bend)) worst[k] = std::numeric_limits<double>::infinity();
  return worst;
}

void join_segments(SmoothSpline& spline, Feet& feet, int joint) {
  const auto j = static_cast<std::ptrdiff_t>(joint);
  const double before = approximate_length(spline.cubic(joint - 1)), after = approximate_length(spline.cubic(joint));
  const double part = before / (before + after);
  const double out = spline.handles[at(joint - 1)][0] / part, in = spline.handles[at(joint)][1] / (1 - part);
  const double most = 0.6 * (before + after);
  spline.handles[at(joint - 1)] = {std::min(out, most), std::min(in, most)};
  spline.handles.erase(spline.handles.begin() + j);
  spline.joints.erase(spline.joints.begin() + j);
  spline.angles.erase(spline.angles.begin() + j);
  for (double& foot : feet) {
    if (foot >= joint + 1)
      foot -= 1;
    else if (foot >= joint)
      foot = joint - 1 + part + (foot - joint) * (1 - part);
    else if (foot >= joint - 1)
      foot = joint - 1 + (foot - joint + 1) * part;
  }
}

void rotate_seam(SmoothSpline& spline, Feet& feet, int joints) {
  std::rotate(spline.joints.begin(), spline.joints.begin() + joints, spline.joints.end());
  std::rotate(spline.angles.begin(), spline.angles.begin() + joints, spline.angles.end());
  std::rotate(spline.handles.begin(), spline.handles.begin() + joints, spline.handles.end());
  for (double& foot : feet) foot += foot >= joints ? -joints : spline.segments() - joints;
}

}  // namespace inkgrid
