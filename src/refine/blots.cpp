#include "refine/blots.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "base/at.h"
#include "base/polyline.h"
#include "base/union_find.h"
#include "refine/arrival.h"
#include "refine/confirmed.h"
#include "refine/turns.h"

namespace inkgrid {
namespace {

constexpr double kIsolated = 0.5;     // strokes: confirmed parts shorter than this between others that are not are none
constexpr double kMiss = 0.25;        // strokes by which a line may miss the point where the others meet
constexpr double kSlant = 0.08;       // the same for each px of the way there
constexpr double kPassed = 0.5;       // strokes by which an arm may have passed it
constexpr double kWider = 0.15;       // half of what ink may be wider than a pen without a doubt, pens
constexpr double kBeside = 1;         // pens, or widths of the broadest arm, between a chain in a blot and what replaces it
constexpr double kPaper = 1;          // px of paper that rough rims may leave on the way
constexpr double kInLine = 0.98;      // cosine of the angle between the two arms of a stroke that goes on beyond a waist
constexpr double kOffLine = 0.3;      // strokes by which one of them may miss the other
constexpr double kBend = 0.015;       // the same for each px between them
constexpr int kFarthest = 3;          // pens from a blot where its arms are looked at
constexpr double kParallel = 0.01;    // determinant of the squared normals, an arm: less are all but parallel
constexpr double kBlunt = 0.57;       // cosine of 55 degrees: a chain around a wider corner needs no turn
constexpr double kBesideTurn = 0.75;  // pens between a chain in a blot and the turn that replaces it

// Points [from, to) of a chain that the ink does not confirm; of none, -1, where it was united with the one before.
struct Run {
  int chain, from, to;
  int blot = -1;
};

// Where a stroke runs into a blot.
struct Arm {
  int run;
  bool before;  // whether the stroke lies before the run, along the chain
  Arrival arrival;
};

using Confirm = std::function<std::vector<std::uint8_t>(const RidgeChain&)>;

class Blotter {
 public:
  // Blots of the junctions from number `settled` on stay.
  Blotter(Blots blots, std::size_t settled, const Confirm& confirm, const InkBand& band, const Raster<std::uint8_t>& drawn,
          const BlotOptions& options)
      : ridges_(std::move(blots.ridges)),
        junctions_(std::move(blots.junctions)),
        settled_(settled),
        band_(band),
        drawn_(drawn),
        options_(options) {
    find_runs(confirm);
    unite_runs();
    find_arms();
  }

  Blots turn() {
    std::vector<int> target(blots_.size(), -1);
    for (std::size_t b = 0; b < blots_.size(); ++b)
      if (const auto tip = turn_in(blots_[b])) {
        target[b] = static_cast<int>(junctions_.size());
        junctions_.push_back(*tip);
      }
    return ended_in(target);
  }

  Blots meet() {
    unite_over_waists();
    std::vector<int> target(blots_.size(), -1);
    for (std::size_t b = 0; b < blots_.size(); ++b)
      if (const auto point = blots_[b].size() >= 3 && !stays_[b] ? meeting_point(blots_[b]) : std::nullopt) {
        target[b] = static_cast<int>(junctions_.size());
        junctions_.push_back(*point);
      }
    const std::vector<int> settled = settled_by_x();
    for (std::size_t b = 0; b < blots_.size(); ++b)
      if (target[b] < 0 && !stays_[b]) target[b] = junction_beside(blots_[b], settled);
    return ended_in(target);
  }

 private:
  Blots ended_in(const std::vector<int>& target) {
    std::vector<RidgeChain> result;
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c) split(c, target, result);
    return {std::move(result), std::move(junctions_)};
  }

  const RidgeChain& ridge(int c) const { return ridges_[at(c)]; }
  Run& run(int r) { return runs_[at(r)]; }
  const Run& run(int r) const { return runs_[at(r)]; }
  int size(int c) const { return static_cast<int>(ridge(c).chain.points.size()); }

  void find_runs(const Confirm& confirm) {
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c) {
      const auto confirmed = confirm(ridge(c));
      first_run_.push_back(static_cast<int>(runs_.size()));
      run_of_.emplace_back(confirmed.size(), -1);
      for (int k = 0; k < size(c);) {
        int end = k;
        while (end < size(c) && !confirmed[at(end)]) run_of_.back()[at(end++)] = static_cast<int>(runs_.size());
        if (end > k) runs_.push_back({c, k, end});
        k = std::max(end, k + 1);
      }
    }
    first_run_.push_back(static_cast<int>(runs_.size()));
  }

  // Runs that share a junction, or own ink that touches, lie in one blot.
  void unite_runs() {
    const int count = static_cast<int>(runs_.size());
    UnionFind groups(count + static_cast<int>(junctions_.size()));
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c)
      for (const bool at_start : {true, false}) {
        const int r = at_start ? run_of_[at(c)].front() : run_of_[at(c)].back();
        const int j = junction_at(ridge(c).chain, at_start);
        if (r >= 0 && j >= 0) groups.unite(r, count + j);
        if (r >= 0 && ridge(c).chain.closed && at_start && run_of_[at(c)].back() >= 0) groups.unite(r, run_of_[at(c)].back());
      }
    std::vector<Chain> chains;
    for (const auto& ridge : ridges_) chains.push_back(ridge.chain);
    const Ownership ownership = assign_ink(chains, band_);
    const auto run_at = [&](int x, int y) {
      if (!drawn_.contains(x, y) || !drawn_(x, y)) return -1;
      const int owner = ownership.owner(x, y);
      if (owner < 0) return -1;
      const auto s = ownership.samples[at(owner)];
      return run_of_[at(s.chain)][at(s.point)];
    };
    for (const auto [x, y] : band_.pixels()) {
      const int r = run_at(x, y);
      if (r < 0) continue;
      for (const int other : {run_at(x + 1, y), run_at(x, y + 1)})
        if (other >= 0) groups.unite(r, other);
    }
    number_blots(groups);
  }

  void number_blots(UnionFind& groups) {
    std::vector<int> number(runs_.size() + junctions_.size(), -1);
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
      int& n = number[at(groups.find(r))];
      if (n < 0) {
        n = static_cast<int>(blots_.size());
        blots_.emplace_back();
        runs_in_.emplace_back();
      }
      run(r).blot = n;
      runs_in_[at(n)].push_back(r);
    }
    stays_.assign(blots_.size(), 0);
    for (std::size_t j = settled_; j < junctions_.size(); ++j) {
      const int n = number[at(groups.find(static_cast<int>(runs_.size() + j)))];
      if (n >= 0) stays_[at(n)] = 1;
    }
  }

  void find_arms() {
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
      const Run& here = run(r);
      auto& arms = blots_[at(here.blot)];
      if (here.from > 0) arms.push_back({r, true, arrival_from(ridge(here.chain), here.from - 1, false)});
      if (here.to < size(here.chain)) arms.push_back({r, false, arrival_from(ridge(here.chain), here.to, true)});
    }
  }

  // Where two strokes cross at a small angle there is a blot before and one behind the waist where they lie on each other, and
  // which seems a stroke.
  void unite_over_waists() {
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r)
      if (const int next = next_blot(r); next >= 0)
        if (const auto arms = crossing_over(r, next); !arms.empty()) unite(r, next, arms);
  }

  // The run after r on its chain that lies in another blot where strokes meet, or -1.
  int next_blot(int r) const {
    const auto arms = [&](int k) { return run(k).blot < 0 ? 0 : blots_[at(run(k).blot)].size(); };
    int next = r + 1;
    const auto on_chain = [&] { return next < static_cast<int>(runs_.size()) && run(next).chain == run(r).chain; };
    while (on_chain() && arms(next) <= 2) ++next;
    const bool found = arms(r) == 3 && on_chain() && arms(next) == 3 && run(next).blot != run(r).blot &&
                       !stays_[at(run(r).blot)] && !stays_[at(run(next).blot)];
    return found ? next : -1;
  }

  // The four arms of two strokes that cross between two runs, or none.  Beside such a blot the ridge may be bent by it: where
  // arms do not go on in line there, they are looked at further away.
  std::vector<Arm> crossing_over(int r, int next) const {
    const auto points = ridge(run(r).chain).chain.points.begin();
    const auto before = arms_but(run(r).blot, r, false), behind = arms_but(run(next).blot, next, true);
    if (before.size() != 2 || behind.size() != 2 || norm(points[run(next).from] - points[run(r).to - 1]) > 2 * options_.longest)
      return {};
    for (int pens = 0; pens <= kFarthest; ++pens) {
      const int away = static_cast<int>(pens * options_.pen);
      std::vector<Arm> arms{moved(before[0], away), moved(before[1], away), moved(behind[0], away), moved(behind[1], away)};
      const bool straight = go_on(arms[0], arms[2]) && go_on(arms[1], arms[3]);
      const bool crossed = go_on(arms[0], arms[3]) && go_on(arms[1], arms[2]);
      if ((straight || crossed) && meeting_point(arms)) return arms;
    }
    return {};
  }

  // The same arm, so many points further away from the blot.
  Arm moved(Arm arm, int away) const {
    if (away == 0) return arm;
    const RidgeChain& whole = ridge(run(arm.run).chain);
    const int first = arm.before ? run(arm.run).from - 1 - away : run(arm.run).to + away;
    arm.arrival = first < 0 || first >= size(run(arm.run).chain) ? Arrival{} : arrival_from(whole, first, !arm.before);
    arm.arrival.last += away;
    return arm;
  }

  std::vector<Arm> arms_but(int blot, int r, bool before) const {
    std::vector<Arm> arms = blots_[at(blot)];
    std::erase_if(arms, [&](const Arm& arm) { return arm.run == r && arm.before == before; });
    return arms;
  }

  // Whether two arms are of one straight stroke.
  bool go_on(const Arm& a, const Arm& b) const {
    if (!a.arrival.known || !b.arrival.known || dot(a.arrival.direction, b.arrival.direction) > -kInLine) return false;
    const Vec2 way = b.arrival.point - a.arrival.point;
    const double miss = std::max(std::abs(cross(a.arrival.direction, way)), std::abs(cross(b.arrival.direction, way)));
    return miss < kOffLine * std::max(width_of(a), width_of(b)) + kBend * norm(way);
  }

  // The runs from r to `last` become one, with all that lies between them.
  void unite(int r, int last, std::vector<Arm> arms) {
    const int kept = run(r).blot, gone = run(last).blot;
    for (Arm& arm : arms)
      if (arm.run == last) arm.run = r;
    for (int k = r + 1; k <= last; ++k) blots_[at(run(k).blot)].clear();
    blots_[at(kept)] = std::move(arms);
    for (const int other : runs_in_[at(gone)]) {
      if (run(other).blot != gone) continue;
      run(other).blot = kept;
      runs_in_[at(kept)].push_back(other);
    }
    run(r).to = run(last).to;
    for (int k = r + 1; k <= last; ++k) run(k) = {-1, 0, 0};
  }

  double width_of(const Arm& arm) const { return ridge(run(arm.run).chain).chain.width; }

  // Where the lines of all arms meet, in the least squares.
  std::optional<Vec2> meeting_point(const std::vector<Arm>& arms) const {
    double a = 0, b = 0, c = 0;
    Vec2 right;
    for (const Arm& arm : arms) {
      if (!arm.arrival.known) return std::nullopt;
      const Vec2 normal = quarter_turn(arm.arrival.direction);
      a += normal.x * normal.x;
      b += normal.x * normal.y;
      c += normal.y * normal.y;
      right += dot(normal, arm.arrival.point) * normal;
    }
    const double determinant = a * c - b * b;
    if (determinant < kParallel * static_cast<double>(arms.size())) return std::nullopt;
    const Vec2 found{(c * right.x - b * right.y) / determinant, (a * right.y - b * right.x) / determinant};
    const bool all =
        std::all_of(arms.begin(), arms.end(), [&](const Arm& arm) { return leads_to(arm, found, passing(arms, arm)); });
    return all && stands_for_blot(arms, found, beside(arms)) ? std::optional(found) : std::nullopt;
  }

  std::optional<Vec2> turn_in(const std::vector<Arm>& arms) const {
    if (arms.size() != 2) return std::nullopt;
    const Arrival &a = arms[0].arrival, &b = arms[1].arrival;
    const bool passed = runs_in_[at(run(arms[0].run).blot)].size() == 1;
    if (passed && dot(a.direction, b.direction) < kBlunt) return std::nullopt;
    const auto tip = turn_of(a, b, drawn_, options_.pen, options_.longest);
    return tip && stands_for_blot(arms, *tip, kBesideTurn * options_.pen) ? tip : std::nullopt;
  }

  double beside(const std::vector<Arm>& arms) const {
    double widest = options_.pen;
    for (const Arm& arm : arms) widest = std::max(widest, width_of(arm));
    return kBeside * widest;
  }

  // Whether no chain of the blot is far from the ways that replace it.
  bool stands_for_blot(const std::vector<Arm>& arms, Vec2 meeting, double farthest) const {
    const auto is_near = [&](Vec2 p) {
      return std::any_of(arms.begin(), arms.end(),
                         [&](const Arm& arm) { return distance_to_segment(p, arm.arrival.point, meeting) < farthest; });
    };
    const int blot = run(arms.front().run).blot;
    return std::all_of(runs_in_[at(blot)].begin(), runs_in_[at(blot)].end(), [&](int r) {
      const Run& here = run(r);
      if (here.blot != blot) return true;
      const auto points = ridge(here.chain).chain.points.begin();
      return std::all_of(points + here.from, points + here.to, is_near);
    });
  }

  // The junctions that are settled already, from left to right.
  std::vector<int> settled_by_x() const {
    std::vector<int> numbers(junctions_.size() - settled_);
    std::iota(numbers.begin(), numbers.end(), static_cast<int>(settled_));
    std::sort(numbers.begin(), numbers.end(), [&](int a, int b) { return x_of(a) < x_of(b); });
    return numbers;
  }

  // The first one of those that all arms lead to, as those of a star of which the grid joined only some; or -1.
  int junction_beside(const std::vector<Arm>& arms, const std::vector<int>& settled) const {
    if (arms.empty() || !arms.front().arrival.known) return -1;
    const double x = arms.front().arrival.point.x, reach = reach_beside(arms.front());
    auto j = std::lower_bound(settled.begin(), settled.end(), x - reach, [&](int a, double least) { return x_of(a) < least; });
    int found = -1;
    for (; j != settled.end() && x_of(*j) <= x + reach; ++j)
      if ((found < 0 || *j < found) && all_lead_to(arms, junctions_[at(*j)])) found = *j;
    return found;
  }

  double x_of(int junction) const { return junctions_[at(junction)].x; }
  double reach_beside(const Arm& arm) const { return kBeside * options_.pen + width_of(arm); }

  bool all_lead_to(const std::vector<Arm>& arms, Vec2 place) const {
    const bool all = std::all_of(arms.begin(), arms.end(), [&](const Arm& arm) {
      return arm.arrival.known && norm(arm.arrival.point - place) < reach_beside(arm) && leads_to(arm, place, 0);
    });
    return all && stands_for_blot(arms, place, beside(arms));
  }

  // How far an arm may seem to go on past the others, px: the sharper two of them meet, the later their ink is wider than a
  // stroke.
  double passing(const std::vector<Arm>& arms, const Arm& arm) const {
    double sharpest = 0;  // cosine of half the angle between two others
    for (const Arm& a : arms)
      for (const Arm& b : arms)
        if (&a != &b && &a != &arm && &b != &arm)
          sharpest = std::max(sharpest, std::sqrt(std::max(0.0, 0.5 + 0.5 * dot(a.arrival.direction, b.arrival.direction))));
    return kWider * options_.pen * sharpest / std::sqrt(std::max(1e-3, 1 - sharpest * sharpest));
  }

  bool leads_to(const Arm& arm, Vec2 point, double passing) const {
    const Vec2 way = point - arm.arrival.point;
    const double ahead = dot(arm.arrival.direction, way), width = width_of(arm);
    return ahead > -kPassed * width - passing && ahead < options_.longest &&
           std::abs(cross(arm.arrival.direction, way)) < kMiss * width + kSlant * std::max(0.0, ahead) &&
           over_ink(drawn_, arm.arrival.point, point, kPaper);
  }

  // The parts of a chain between the blots where strokes meet.
  void split(int c, const std::vector<int>& target, std::vector<RidgeChain>& result) const {
    const RidgeChain& whole = ridge(c);
    int from = 0, start = whole.chain.start_junction;
    const Arm* after = nullptr;
    bool cut = false;
    const auto emit = [&](int to, int end, const Arm* before) {
      if (to - from < 2) return;
      result.push_back(part(whole, from, to, after, before));
      result.back().chain.start_junction = start;
      result.back().chain.end_junction = end;
      result.back().chain.closed = whole.chain.closed && !cut;
      if (after) lead_to_junction(result.back(), true, after->arrival.direction);
      if (before) lead_to_junction(result.back(), false, before->arrival.direction);
    };
    for (int r = first_run_[at(c)]; r < first_run_[at(c) + 1]; ++r) {
      const Run& here = run(r);
      if (here.chain != c || target[at(here.blot)] < 0) continue;
      cut = true;
      const int junction = target[at(here.blot)];
      if (here.from > 0) emit(here.from, junction, arm_of(r, true));
      from = here.to;
      start = junction;
      after = arm_of(r, false);
    }
    if (from < size(c)) emit(size(c), whole.chain.end_junction, nullptr);
  }

  const Arm* arm_of(int r, bool before) const {
    for (const Arm& arm : blots_[at(run(r).blot)])
      if (arm.run == r && arm.before == before) return &arm;
    return nullptr;
  }

  // Without the points beside a blot, which are bent by it.
  static RidgeChain part(const RidgeChain& whole, int from, int to, const Arm* after, const Arm* before) {
    int first = from + (after ? after->arrival.last : 0), last = to - (before ? before->arrival.last : 0);
    const bool short_of_points = last - first < 2;
    if (short_of_points) first = from, last = to;
    RidgeChain piece = whole;
    const auto range = [&](auto& values) {
      values.erase(values.begin() + last, values.end());
      values.erase(values.begin(), values.begin() + first);
    };
    range(piece.chain.points);
    range(piece.sections);
    if (after && !short_of_points) piece.chain.points.front() = after->arrival.point;
    if (before && !short_of_points) piece.chain.points.back() = before->arrival.point;
    return piece;
  }

  // From where it has not passed it.
  void lead_to_junction(RidgeChain& piece, bool at_start, Vec2 direction) const {
    const int junction = junction_at(piece.chain, at_start);
    auto& points = piece.chain.points;
    if (at_start) std::reverse(points.begin(), points.end()), std::reverse(piece.sections.begin(), piece.sections.end());
    const Vec2 target = junctions_[at(junction)];
    while (points.size() > 2 && dot(direction, target - points.back()) < 0) points.pop_back();
    piece.sections.resize(points.size());
    const auto way = resampled({points.back(), target}, 1);
    points.insert(points.end(), way.begin() + 1, way.end());
    piece.sections.resize(points.size());
    if (at_start) std::reverse(points.begin(), points.end()), std::reverse(piece.sections.begin(), piece.sections.end());
  }

  std::vector<RidgeChain> ridges_;
  std::vector<Vec2> junctions_;
  std::size_t settled_;
  const InkBand& band_;
  const Raster<std::uint8_t>& drawn_;
  BlotOptions options_;
  std::vector<std::vector<int>> run_of_;  // per chain and point: its run, or -1
  std::vector<Run> runs_;                 // chain by chain
  std::vector<int> first_run_;            // per chain, and one more
  std::vector<std::vector<Arm>> blots_;
  std::vector<std::vector<int>> runs_in_;  // per blot; some have left it since
  std::vector<std::uint8_t> stays_;        // per blot
};

const InkBand& band_of_blots(const InkBands& bands, const BlotOptions& options) {
  return bands.of(options.bridge + std::max(0.0, 0.5 * (options.pen - bands.ink().stroke_width)));
}

}  // namespace

Blots meet_in_blots(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const InkBands& bands,
                    const Raster<std::uint8_t>& drawn, const BlotOptions& options) {
  const std::size_t old = junctions.size();
  Blots blots{std::move(ridges), std::move(junctions)};
  const double width = bands.ink().stroke_width;
  const InkBand& band = band_of_blots(bands, options);
  // Short parts that seem confirmed may be strokes, or lie inside a blot: the first is tried first.
  for (const double isolated : {kIsolated * width, std::max(kIsolated * width, options.pen)}) {
    const auto confirm = [&](const RidgeChain& ridge) { return confirmed_points(ridge, isolated); };
    blots = Blotter(std::move(blots), old, confirm, band, drawn, options).meet();
  }
  return blots;
}

Blots turn_in_blots(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const InkBands& bands,
                    const Raster<std::uint8_t>& drawn, const BlotOptions& options) {
  const std::size_t old = junctions.size();
  const auto confirm = [&](const RidgeChain& ridge) { return slender_points(ridge, drawn, options.pen); };
  return Blotter({std::move(ridges), std::move(junctions)}, old, confirm, band_of_blots(bands, options), drawn, options).turn();
}

}  // namespace inkgrid
