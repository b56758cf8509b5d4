#include "refine/corners.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/at.h"
#include "base/polyline.h"
#include "base/sample.h"
#include "ink/ink.h"
#include "refine/arrival.h"
#include "refine/tips.h"

namespace inkgrid {
namespace {

constexpr double kGoesOn = 0.4;    // cosine of the angle between a side and the tip: more is a branch
constexpr double kArms = 0.17;     // cosine of the widest angle between arms that share a blot, 80 degrees
constexpr double kApart = 0.5;     // strokes between the sides of a corner where each of them is confirmed
constexpr double kFacing = 1.5;    // strokes between ends that may go on into each other
constexpr double kInside = 0.4;    // strokes that the ink goes on behind a corner that is all but straight
constexpr double kIsolated = 0.5;  // strokes: confirmed parts shorter than this between others that are not are none
constexpr double kPassed = 0.4;    // pens
constexpr double kPaper = 1;       // px that rough rims may leave on the way to a tip

struct End {
  int chain;
  bool at_start;
};

class Corners {
 public:
  Corners(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const CornerInk& ink, const CornerOptions& options)
      : ridges_(std::move(ridges)), junctions_(std::move(junctions)), ink_(ink), options_(options), ends_(junctions_.size()) {}

  std::vector<RidgeChain> open() {
    drop_tips();
    join_pairs();
    join_free_ends(true);
    return finished();
  }

  ArmsJoined meet() {
    join_free_ends(false);
    auto joined = finished();
    return {std::move(joined), std::move(junctions_)};
  }

 private:
  std::vector<RidgeChain> finished() {
    std::erase_if(ridges_, [](const RidgeChain& r) { return r.chain.points.empty(); });
    for (auto& ridge : ridges_) sharpen(ridge);
    return std::move(ridges_);
  }

  RidgeChain& ridge(int c) { return ridges_[at(c)]; }
  const Chain& chain(int c) const { return ridges_[at(c)].chain; }
  Vec2 tip_of(End e) const { return e.at_start ? chain(e.chain).points.front() : chain(e.chain).points.back(); }

  void collect_ends() {
    for (auto& at : ends_) at.clear();
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c) {
      if (chain(c).start_junction >= 0) ends_[at(chain(c).start_junction)].push_back({c, true});
      if (chain(c).end_junction >= 0) ends_[at(chain(c).end_junction)].push_back({c, false});
    }
  }

  bool is_tip(const End& stub, const std::vector<End>& at) {
    const Chain& tip = chain(stub.chain);
    if (junction_at(ridge(stub.chain).chain, !stub.at_start) >= 0 || lengths_along(tip.points).back() > options_.longest)
      return false;
    std::vector<Arrival> sides;
    for (const End& e : at)
      if (e.chain != stub.chain) sides.push_back(arrival_at(ridge(e.chain), e.at_start));
    if (sides.size() != 2) return false;
    const Vec2 outermost = tip_of({stub.chain, !stub.at_start}), outward = unit(outermost - tip_of(stub));
    const auto goes_on = [&](const Arrival& side) { return dot(side.direction, outward) > kGoesOn; };
    if (!goes_on(sides[0]) || !goes_on(sides[1]) || faces_end(stub.chain, outermost)) return false;
    const double miss = miss_of(sides[0], sides[1], tip.width, options_);
    const auto meetings = meetings_of_sides(sides[0], sides[1], 0, options_);
    return std::any_of(meetings.begin(), meetings.end(), [&](Vec2 meeting) { return norm(meeting - outermost) < miss; });
  }

  // Whether another chain ends near there, with which this one may go on.
  bool faces_end(int c, Vec2 end) {
    for (int other = 0; other < static_cast<int>(ridges_.size()); ++other)
      for (const bool at_start : {true, false}) {
        if (other == c || !is_free({other, at_start})) continue;
        if (norm(tip_of({other, at_start}) - end) < kFacing * std::max(chain(c).width, chain(other).width)) return true;
      }
    return false;
  }

  void drop_tips() {
    collect_ends();
    std::vector<int> dropped;
    for (const auto& at : ends_) {
      if (at.size() != 3) continue;
      for (const End& stub : at)
        if (is_tip(stub, at)) dropped.push_back(stub.chain);
    }
    for (const int c : dropped) clear(ridge(c));
  }

  static void clear(RidgeChain& gone) { gone = {}; }

  // Both ends become one; what lies between them is not confirmed.
  void join(End a, End b) {
    RidgeChain &first = ridge(a.chain), &second = ridge(b.chain);
    junction_at(first.chain, a.at_start) = junction_at(second.chain, b.at_start) = -1;
    if (a.chain == b.chain) {
      first.chain.closed = true;
      if (!(first.chain.points.back() == first.chain.points.front())) {
        first.chain.points.push_back(first.chain.points.front());
        first.sections.push_back({});
      }
      return;
    }
    if (a.at_start) reverse(first);
    if (!b.at_start) reverse(second);
    first.sections.back() = second.sections.front() = {};
    first.chain.points.insert(first.chain.points.end(), second.chain.points.begin(), second.chain.points.end());
    first.sections.insert(first.sections.end(), second.sections.begin(), second.sections.end());
    first.chain.end_junction = second.chain.end_junction;
    first.chain.confirmed += second.chain.confirmed;
    clear(second);
  }

  static void reverse(RidgeChain& ridge) {
    ridge.chain = reversed(std::move(ridge.chain));
    std::reverse(ridge.sections.begin(), ridge.sections.end());
  }

  void join_pairs() {
    for (std::size_t j = 0; j < ends_.size(); ++j) {
      collect_ends();
      if (ends_[j].size() == 2) join(ends_[j][0], ends_[j][1]);
    }
  }

  std::vector<End> free_ends() {
    std::vector<End> free;
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c)
      for (const bool at_start : {true, false})
        if (is_free({c, at_start}) && chain(c).confirmed > chain(c).width) free.push_back({c, at_start});
    return free;
  }

  bool is_free(End e) {
    return !chain(e.chain).points.empty() && !chain(e.chain).closed && junction_at(ridge(e.chain).chain, e.at_start) < 0;
  }

  struct Pair {
    Vec2 tip_a, tip_b;
    double distance;
  };

  void join_free_ends(bool at_ends_of_ink) {
    std::vector<Arm> free;
    for (const End& end : free_ends()) free.push_back(arm_at(end));
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < free.size(); ++i)
      for (std::size_t j = i + 1; j < free.size(); ++j) {
        const Vec2 a = tip_of(free[i].end), b = tip_of(free[j].end);
        if (norm(b - a) < options_.longest + options_.hidden && shared_tip(free[i], free[j], at_ends_of_ink))
          pairs.push_back({a, b, norm(b - a)});
      }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& s, const Pair& t) { return s.distance < t.distance; });
    for (const Pair& pair : pairs) {
      const auto a = free_end_at(pair.tip_a), b = free_end_at(pair.tip_b);
      if (a && b && !(a->chain == b->chain && a->at_start == b->at_start)) join_at_tip(*a, *b, at_ends_of_ink);
    }
  }

  // Chains that were joined have other numbers; their free ends are where they were.
  std::optional<End> free_end_at(Vec2 tip) {
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c)
      for (const bool at_start : {true, false})
        if (is_free({c, at_start}) && tip_of({c, at_start}) == tip) return End{c, at_start};
    return std::nullopt;
  }

  double width_of(const End& a, const End& b) const { return std::max(chain(a.chain).width, chain(b.chain).width); }

  // A free end, and the lines along which its chain arrives there, and where it led into the blot of an acute corner.
  struct Arm {
    End end;
    Arrival line, behind_stem;
  };

  Arm arm_at(End end) {
    return {end, arrival_at(ridge(end.chain), end.at_start), options_.hidden > 0 ? arm_behind_stem(end) : Arrival{}};
  }

  struct SharedTip {
    Vec2 point;
    Arrival a, b;
    bool at_end_of_ink;
  };

  std::optional<SharedTip> shared_tip(const Arm& a, const Arm& b, bool at_end_of_ink) {
    if (a.end.chain == b.end.chain && lengths_along(chain(a.end.chain).points).back() < 2 * options_.longest) return std::nullopt;
    const double width = width_of(a.end, b.end);
    const bool share_blot = dot(a.line.direction, b.line.direction) > kArms;  // which slimming hollows out
    const auto& ink = share_blot ? ink_.drawn : ink_.slim;
    if (const auto tip = corner_of(a.line, b.line, width, ink, options_, options_.longest)) {
      const SharedTip shared = settled(*tip, a.line, b.line, width);
      const bool fits = at_end_of_ink ? shared.at_end_of_ink && ends_behind(*tip, a.line, b.line, width, ink_.slim, options_)
                                      : share_blot && !passed_by(*tip, width);
      if (fits && are_apart(shared, width) && leave_each_other(a, b, shared)) return shared;
    }
    return acute_tip(a, b, width, at_end_of_ink);
  }

  SharedTip settled(Vec2 tip, const Arrival& a, const Arrival& b, double width) const {
    const Vec2 point = settled_tip(tip, a, b, width, ink_, options_);
    return {point, a, b, ends_behind(point, a, b, width, ink_.slim, options_)};
  }

  // What the ink confirms nearer to the tip of an acute corner than its sides are apart is no side of it.
  bool are_apart(const SharedTip& shared, double width) const {
    if (options_.hidden == 0 || !is_acute(shared.a, shared.b)) return true;
    const double nearest = std::min(norm(shared.point - shared.a.point), norm(shared.point - shared.b.point));
    return 2 * nearest * half_sine(shared.a, shared.b) > kApart * width;
  }

  // Whether there is something left of a chain between its two arms.
  bool leave_each_other(const Arm& a, const Arm& b, const SharedTip& shared) const {
    return a.end.chain != b.end.chain || shared.a.last + shared.b.last + 1 < static_cast<int>(chain(a.end.chain).points.size());
  }

  // The same where a chain may lead into the blot, which hides more than its arms do.
  std::optional<SharedTip> acute_tip(const Arm& a, const Arm& b, double width, bool at_end_of_ink) {
    for (const auto& [one, other] :
         {std::pair{a.behind_stem, b.line}, std::pair{a.line, b.behind_stem}, std::pair{a.behind_stem, b.behind_stem}}) {
      if (!one.known || !other.known || !is_acute(one, other)) continue;
      const auto tip = corner_of(one, other, width, ink_.drawn, options_, options_.longest + options_.hidden);
      if (!tip || !ends_behind(*tip, one, other, width, ink_.slim, options_)) continue;
      const SharedTip shared = settled(*tip, one, other, width);
      const bool fits = shared.at_end_of_ink || !at_end_of_ink;
      if (fits && are_apart(shared, width) && leave_each_other(a, b, shared)) return shared;
    }
    return std::nullopt;
  }

  // Of a chain that goes on through the blot of an acute corner to its tip: the line of the side that it came from.
  Arrival arm_behind_stem(End e) {
    const RidgeChain& arm = ridge(e.chain);
    const int size = static_cast<int>(arm.chain.points.size());
    const auto place = [&](int k) { return e.at_start ? k : size - 1 - k; };
    const auto point = [&](int k) { return arm.chain.points[at(place(k))]; };
    int stem = 0;
    double length = 0;
    for (int k = 0; length < options_.longest + options_.hidden; ++k) {
      if (k + 1 == size) return {};
      if (arm.sections[at(place(k))].weight < 1) stem = k + 1;
      length += norm(point(k + 1) - point(k));
    }
    Arrival arrival = arrival_from(arm, place(stem), e.at_start);
    arrival.last += stem;
    return arrival;
  }

  // Without what the ink does not confirm, and straight on to the tip.
  void lead_to(End e, const Arrival& arrival, Vec2 tip) {
    RidgeChain& arm = ridge(e.chain);
    if (e.at_start) reverse(arm);
    const auto kept = arm.chain.points.size() - static_cast<std::size_t>(arrival.last);
    arm.chain.points.resize(kept);
    arm.chain.points.back() = arrival.point;
    const auto way = resampled({arrival.point, tip}, 1);
    arm.chain.points.insert(arm.chain.points.end(), way.begin() + 1, way.end());
    arm.sections.resize(kept);
    arm.sections.resize(arm.chain.points.size());
    if (e.at_start) reverse(arm);
  }

  void join_at_tip(End a, End b, bool at_end_of_ink) {
    const auto shared = shared_tip(arm_at(a), arm_at(b), at_end_of_ink);
    if (!shared) return;
    const double width = width_of(a, b);
    const bool corner = shared->at_end_of_ink;
    const int fork = corner ? -1 : junction_at_tip(shared->point, width);
    const Vec2 tip = fork < 0 ? shared->point : junctions_[at(fork)];
    lead_to(a, shared->a, tip);
    lead_to(b, shared->b, tip);
    if (corner || fork >= 0) drop_between(a, b, *shared, width, fork);
    if (fork >= 0) return end_at(fork, {a, b});
    const auto stem = corner ? std::nullopt : stem_at(a, b, tip, width);
    if (!stem) return join(a, b);
    junctions_.push_back(tip);
    end_at(static_cast<int>(junctions_.size()) - 1, {a, b, *stem});
  }

  void end_at(int junction, std::initializer_list<End> ends) {
    for (const End& e : ends) junction_at(ridge(e.chain).chain, e.at_start) = junction;
  }

  // The junction of other chains that a fork has already, or -1.
  int junction_at_tip(Vec2 tip, double width) const {
    int found = -1;
    for (const auto& ridge : ridges_)
      for (const int junction : {ridge.chain.start_junction, ridge.chain.end_junction})
        if (junction >= 0 && norm(junctions_[at(junction)] - tip) < (found < 0 ? width : norm(junctions_[at(found)] - tip)))
          found = junction;
    return found;
  }

  // Chains in the blot of a corner, or of a fork with this junction, that lead nowhere else.
  void drop_between(End a, End b, const SharedTip& shared, double width, int fork) {
    std::vector<int> inside;
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c)
      if (c != a.chain && c != b.chain && lies_between(chain(c).points, shared, width)) inside.push_back(c);
    for (bool changed = true; changed;) {
      const std::size_t before = inside.size();
      std::erase_if(inside, [&](int c) { return leads_out(c, inside, fork); });
      changed = inside.size() < before;
    }
    for (const int c : inside) clear(ridge(c));
  }

  bool lies_between(const std::vector<Vec2>& points, const SharedTip& shared, double width) const {
    if (points.empty() || lengths_along(points).back() >= options_.longest + options_.hidden) return false;
    return std::all_of(points.begin(), points.end(), [&](Vec2 p) {
      const double beside =
          std::min(distance_to_segment(p, shared.point, shared.a.point), distance_to_segment(p, shared.point, shared.b.point));
      return beside < width + kPaper && over_ink(ink_.slim, p, shared.point, width + kPaper);
    });
  }

  // Whether another chain than these begins where this one ends, but for the fork.
  bool leads_out(int c, const std::vector<int>& inside, int fork) const {
    for (const int junction : {chain(c).start_junction, chain(c).end_junction}) {
      if (junction < 0 || junction == fork) continue;
      for (int other = 0; other < static_cast<int>(ridges_.size()); ++other) {
        const bool begins = chain(other).start_junction == junction || chain(other).end_junction == junction;
        if (begins && !std::binary_search(inside.begin(), inside.end(), other)) return true;
      }
    }
    return false;
  }

  // The stem of a fork ends at its tip, which it may have passed.
  std::optional<End> stem_at(End a, End b, Vec2 tip, double width) {
    for (int c = 0; c < static_cast<int>(ridges_.size()); ++c)
      for (const bool at_start : {true, false}) {
        if (c == a.chain || c == b.chain || !is_free({c, at_start})) continue;
        RidgeChain& stem = ridge(c);
        if (at_start) reverse(stem);
        const auto& points = stem.chain.points;
        const auto near =
            std::min_element(points.begin(), points.end(), [&](Vec2 p, Vec2 q) { return norm2(p - tip) < norm2(q - tip); });
        const auto kept = static_cast<std::size_t>(near - points.begin());
        const auto lengths = lengths_along(points);
        const bool found =
            norm(*near - tip) < width && kept > 0 && lengths[kept] > width && lengths.back() - lengths[kept] < options_.longest;
        if (found) {
          stem.chain.points.resize(kept);
          stem.chain.points.push_back(tip);
          stem.sections.resize(kept);
          stem.sections.push_back({});
        }
        if (at_start) reverse(stem);
        if (found) return End{c, at_start};
      }
    return std::nullopt;
  }

  // Whether a chain leads through the place, rather than ends there.
  bool passed_by(Vec2 place, double width) const {
    for (const auto& ridge : ridges_) {
      const auto lengths = lengths_along(ridge.chain.points);
      for (std::size_t k = 0; k < lengths.size(); ++k) {
        const bool inside = ridge.chain.closed || std::min(lengths[k], lengths.back() - lengths[k]) > options_.longest;
        if (inside && norm(ridge.chain.points[k] - place) < width) return true;
      }
    }
    return false;
  }

  // A seam on confirmed ink splits no corner.
  static void move_seam(RidgeChain& ridge) {
    const auto known =
        std::find_if(ridge.sections.begin(), ridge.sections.end(), [](const CrossSection& s) { return s.weight > 0; });
    if (known == ridge.sections.end()) return;
    const auto turn = known - ridge.sections.begin();
    auto& points = ridge.chain.points;
    points.pop_back();
    ridge.sections.pop_back();
    if (turn < static_cast<std::ptrdiff_t>(points.size())) {
      std::rotate(points.begin(), points.begin() + turn, points.end());
      std::rotate(ridge.sections.begin(), ridge.sections.begin() + turn, ridge.sections.end());
    }
    points.push_back(points.front());
    ridge.sections.push_back(ridge.sections.front());
  }

  void sharpen(RidgeChain& ridge) const {
    if (ridge.chain.closed) move_seam(ridge);
    const auto unknown = [&](int k) { return ridge.sections[at(k)].weight <= 0; };
    const auto point = [&](int k) { return ridge.chain.points[at(k)]; };
    for (int k = 1; k < static_cast<int>(ridge.chain.points.size()); ++k) {
      if (!unknown(k) || unknown(k - 1)) continue;
      const int size = static_cast<int>(ridge.chain.points.size());
      int end = k;
      for (int j = k; j < size && norm(point(j) - point(end)) < kIsolated * ridge.chain.width; ++j)
        if (unknown(j)) end = j + 1;
      if (end >= size) return;
      k = sharpen_between(ridge, k, end);
    }
  }

  // Whether a pen that turned here would have left this ink, even if it bevelled the corner: an arc's sides meet at its rim.
  bool inside_ink(Vec2 tip, const Arrival& a, const Arrival& b, double width) const {
    return nearest(ink_.slim, tip + kInside * width * half_sine(a, b) * unit(a.direction + b.direction), std::uint8_t{0}) != 0;
  }

  // Whether the chain goes further than to the tip, as to the end of a turn whose sides are bent.
  bool is_passed(Vec2 tip, const RidgeChain& ridge, int from, int to, Vec2 outward) const {
    const auto& points = ridge.chain.points;
    return options_.pen > 0 && std::any_of(points.begin() + from, points.begin() + to,
                                           [&](Vec2 p) { return dot(p - tip, outward) > kPassed * options_.pen; });
  }

  // The number of the last point that was looked at.
  int sharpen_between(RidgeChain& ridge, int from, int to) const {
    const Arrival a = arrival_from(ridge, from - 1, false), b = arrival_from(ridge, to, true);
    const auto tip = corner_of(a, b, ridge.chain.width, ink_.slim, options_, options_.longest);
    if (!tip || !inside_ink(*tip, a, b, ridge.chain.width)) return to;
    const Vec2 turn = settled_tip(*tip, a, b, ridge.chain.width, ink_, options_);
    if (is_passed(turn, ridge, from, to, unit(a.direction + b.direction))) return to;
    auto& points = ridge.chain.points;
    const int first = from - a.last, last = to + b.last;
    if (first > 1) points[at(first - 1)] = a.point;
    if (last + 1 < static_cast<int>(points.size())) points[at(last)] = b.point;
    std::vector<Vec2> way = resampled({points[at(first - 1)], turn}, 1);
    const std::vector<Vec2> back = resampled({turn, points[at(last)]}, 1);
    way.insert(way.end(), back.begin() + 1, back.end());
    const auto replace = [&](auto& values, auto begin, auto end) {
      values.erase(values.begin() + first, values.begin() + last);
      values.insert(values.begin() + first, begin, end);
    };
    replace(points, way.begin() + 1, way.end() - 1);
    const std::vector<CrossSection> unsaid(way.size() - 2);
    replace(ridge.sections, unsaid.begin(), unsaid.end());
    return first + static_cast<int>(way.size()) - 2;
  }

  std::vector<RidgeChain> ridges_;
  std::vector<Vec2> junctions_;
  const CornerInk& ink_;
  const CornerOptions& options_;
  std::vector<std::vector<End>> ends_;
};

}  // namespace

ArmsJoined join_arms(std::vector<RidgeChain> ridges, std::vector<Vec2> junctions, const CornerInk& ink,
                     const CornerOptions& options) {
  return Corners(std::move(ridges), std::move(junctions), ink, options).meet();
}

std::vector<RidgeChain> open_corners(std::vector<RidgeChain> ridges, const std::vector<Vec2>& junctions, const CornerInk& ink,
                                     const CornerOptions& options) {
  return Corners(std::move(ridges), junctions, ink, options).open();
}

}  // namespace inkgrid
