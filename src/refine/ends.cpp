#include "refine/ends.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/at.h"
#include "base/polyline.h"
#include "base/sample.h"
#include "graph/dissolve.h"
#include "refine/arrival.h"
#include "refine/cuts.h"
#include "refine/ridge.h"

namespace inkgrid {
namespace {

constexpr double kAligned = 0.97;     // cosine of 14 degrees
constexpr double kNarrower = 0.9;     // of the way to the end, and
constexpr double kSteps = 0.5;        // px: less are the steps of pixels
constexpr double kLongestInBlot = 5;  // strokes
constexpr double kDeep = 1.25;        // widths
constexpr double kBeside = 0.5;       // strokes between ends that passed each other in one stroke
constexpr double kWalkStep = 0.25;    // px, in which ink is looked at
constexpr double kFacing = -0.5;      // cosine of the angle between ends that may become one

constexpr double kFoldSpan = 3;     // strokes before the end that may be folded
constexpr double kFoldWide = 0.5;   // strokes: a bend that is wider was drawn
constexpr double kFoldBack = 0.25;  // strokes

// One end of a chain.
struct End {
  int chain = -1;
  bool at_start = true;
};

std::size_t end_index(const Chain& chain, bool at_start) {
  return at_start ? 0 : chain.points.size() - 1;
}

// Outward direction over about `span` px before the end.
Vec2 outward(const Chain& chain, bool at_start, double span) {
  const Vec2 tip = chain.points[end_index(chain, at_start)];
  const int n = static_cast<int>(chain.points.size());
  Vec2 base = tip;
  for (int k = 1; k < n; ++k) {
    base = chain.points[at(at_start ? k : n - 1 - k)];
    if (norm(tip - base) >= span) break;
  }
  return unit(tip - base);
}

bool on_ink(const Ink& ink, Vec2 p) {
  return nearest(ink.mask, p, std::uint8_t{0}) != 0;
}

bool is_free(const Chain& chain, bool at_start) {
  return !chain.closed && junction_at(chain, at_start) < 0;
}

// Distance along `direction` from the tip to where the ink ends; negative when the tip is on paper already.
double to_ink_end(const Ink& ink, Vec2 tip, Vec2 direction, const EndOptions& options, double farthest) {
  double last = 0, paper = 0;
  if (on_ink(ink, tip)) {
    for (double t = kWalkStep; t < farthest; t += kWalkStep) {
      const bool ink_here = on_ink(ink, tip + t * direction);
      paper = ink_here ? 0 : paper + kWalkStep;
      if (ink_here) last = t;
      if (paper > options.bridge) break;
    }
    return last;
  }
  for (double t = kWalkStep; t < farthest; t += kWalkStep)
    if (on_ink(ink, tip - t * direction)) return -t;
  return 0;
}

// Whether the end is free, and lies as deep in the ink as is asked for.
bool may_attach(const Chain& chain, bool at_start, const Ink& ink, const EndOptions& options) {
  if (!is_free(chain, at_start)) return false;
  if (options.deep == 0) return true;
  const double least = options.deep * chain.width;
  const Vec2 tip = chain.points[end_index(chain, at_start)];
  return to_ink_end(ink, tip, outward(chain, at_start, 1.5 * chain.width), options, least + 1) > least;
}

// What a free end runs into.
struct Meeting {
  End end;
  int chain = -1;
  int point = -1;
  double distance = 0;
};

std::optional<Meeting> meeting_of(const Chains& chains, const Ownership& ownership, const Ink& ink, End end,
                                  const EndOptions& options) {
  const auto& chain = chains.chains[at(end.chain)];
  const Vec2 tip = chain.points[end_index(chain, end.at_start)];
  const Vec2 direction = outward(chain, end.at_start, chain.width);
  const auto lengths = lengths_along(chain.points);
  double paper = 0, all_paper = 0;
  for (double t = 0; t < options.blot; t += 0.5) {
    const Vec2 q = tip + t * direction;
    paper = on_ink(ink, q) ? 0 : paper + 0.5;
    all_paper += on_ink(ink, q) ? 0 : 0.5;
    if (paper > options.bridge || (t >= options.reach && all_paper > 0)) return std::nullopt;
    const int owner = ownership.owner(floor_of(q.x), floor_of(q.y));
    if (owner < 0) continue;
    const auto sample = ownership.samples[at(owner)];
    const Vec2 target = chains.chains[at(sample.chain)].points[at(sample.point)];
    if (!over_ink(ink.mask, q, target, options.slit)) continue;
    if (sample.chain == end.chain) {
      // The chain's own far part counts as another chain.
      const double back = std::abs(lengths[at(sample.point)] - (end.at_start ? 0 : lengths.back()));
      if (back < 3 * options.reach) continue;
    }
    return Meeting{end, sample.chain, sample.point, norm(target - tip)};
  }
  return std::nullopt;
}

// Goes on straight to the point, with a point a pixel.
void append(Chain& chain, bool at_start, Vec2 point) {
  const Vec2 tip = chain.points[end_index(chain, at_start)];
  if (point == tip) return;
  auto way = resampled({tip, point}, 1);
  if (at_start) std::reverse(way.begin(), way.end());
  if (at_start)
    chain.points.insert(chain.points.begin(), way.begin(), way.end() - 1);
  else
    chain.points.insert(chain.points.end(), way.begin() + 1, way.end());
}

// A junction at, or near, a point of a chain: an existing one at its end, or a new cut.
int junction_on(Chains& chains, std::vector<std::vector<Cut>>& cuts, const Meeting& meeting, double near) {
  auto& chain = chains.chains[at(meeting.chain)];
  const Vec2 target = chain.points[at(meeting.point)];
  for (const bool at_start : {true, false}) {
    if (chain.closed || norm(chain.points[end_index(chain, at_start)] - target) > near) continue;
    int& junction = junction_at(chain, at_start);
    if (junction < 0) {
      junction = static_cast<int>(chains.junctions.size());
      chains.junctions.push_back(chain.points[end_index(chain, at_start)]);
    }
    return junction;
  }
  auto& here = cuts[at(meeting.chain)];
  for (const auto& cut : here)
    if (norm(chains.junctions[at(cut.junction)] - target) <= near) return cut.junction;
  here.push_back({meeting.point, static_cast<int>(chains.junctions.size())});
  chains.junctions.push_back(target);
  return here.back().junction;
}

// Two free ends that face each other over ink.
struct Facing {
  End a, b;
  double distance = 0;
};

struct Tip {
  End end;
  Vec2 point, direction;
};

bool lies_beside(Vec2 tip, const Chain& chain) {
  const double farthest = kBeside * chain.width;
  return std::any_of(chain.points.begin(), chain.points.end(), [&](Vec2 p) { return norm2(p - tip) < farthest * farthest; });
}

// Whether both chains run side by side before they end, as in one stroke.
bool passed(const Chains& chains, const Tip& a, const Tip& b) {
  const Vec2 way = b.point - a.point;
  return a.end.chain != b.end.chain && dot(a.direction, way) < 0 && dot(b.direction, way) > 0 &&
         lies_beside(a.point, chains.chains[at(b.end.chain)]) && lies_beside(b.point, chains.chains[at(a.end.chain)]);
}

// Those that may be attached, from left to right.
std::vector<Tip> free_tips(const Chains& chains, const Ink& ink, const EndOptions& options) {
  std::vector<Tip> tips;
  for (int c = 0; c < static_cast<int>(chains.chains.size()); ++c)
    for (const bool at_start : {true, false}) {
      const auto& chain = chains.chains[at(c)];
      if (may_attach(chain, at_start, ink, options))
        tips.push_back({{c, at_start}, chain.points[end_index(chain, at_start)], outward(chain, at_start, chain.width)});
    }
  std::stable_sort(tips.begin(), tips.end(), [](const Tip& s, const Tip& t) { return s.point.x < t.point.x; });
  return tips;
}

// Whether two ends face each other, near enough for how well they are in line, without too much paper between them.
bool may_be_joined(const Chains& chains, const Tip& a, const Tip& b, const Ink& ink, const EndOptions& options) {
  if (dot(a.direction, b.direction) > kFacing) return false;
  // Ends of one short chain face each other too.
  if (a.end.chain == b.end.chain && lengths_along(chains.chains[at(a.end.chain)].points).back() < 3 * options.reach) return false;
  const Vec2 way = b.point - a.point;
  const double distance = norm(way);
  const bool aligned = dot(a.direction, way) > kAligned * distance && dot(b.direction, way) < -kAligned * distance;
  const double most = passed(chains, a, b) ? options.blot : options.reach + (aligned ? options.gap : 0);
  return distance <= most &&
         over_ink(ink.mask, a.point, b.point, aligned ? std::max(options.gap, options.bridge) : options.bridge);
}

// The nearest first.
std::vector<Facing> facing_ends(const Chains& chains, const Ink& ink, const EndOptions& options) {
  const std::vector<Tip> tips = free_tips(chains, ink, options);
  std::vector<Facing> pairs;
  const double farthest = std::max(options.reach + options.gap, options.blot);
  for (std::size_t i = 0; i < tips.size(); ++i)
    for (std::size_t j = i + 1; j < tips.size() && tips[j].point.x - tips[i].point.x <= farthest; ++j) {
      const double distance = norm(tips[j].point - tips[i].point);
      if (distance <= farthest && may_be_joined(chains, tips[i], tips[j], ink, options))
        pairs.push_back({tips[i].end, tips[j].end, distance});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Facing& s, const Facing& t) { return s.distance < t.distance; });
  return pairs;
}

void cut_back(Chain& chain, bool at_start, double length) {
  if (at_start) std::reverse(chain.points.begin(), chain.points.end());
  const auto lengths = lengths_along(chain.points);
  // A chain keeps at least a tenth of itself.
  const double kept = std::max(lengths.back() - length, 0.1 * lengths.back());
  const Vec2 tip = point_at(chain.points, lengths, kept);
  while (chain.points.size() > 1 && lengths[chain.points.size() - 1] >= kept) chain.points.pop_back();
  chain.points.push_back(tip);
  if (at_start) std::reverse(chain.points.begin(), chain.points.end());
}

// Ends that passed each other go back to where they would meet.
void cut_overlap(Chain& a, bool a_at_start, Chain& b, bool b_at_start) {
  const Vec2 way = b.points[end_index(b, b_at_start)] - a.points[end_index(a, a_at_start)];
  const Vec2 direction = unit(outward(a, a_at_start, a.width) - outward(b, b_at_start, b.width));
  const double overlap = -dot(way, direction);
  if (overlap <= 0) return;
  cut_back(a, a_at_start, 0.5 * (overlap + a.width));
  cut_back(b, b_at_start, 0.5 * (overlap + b.width));
}

// The last point along the way that the chain came before it turned back within its own stroke; the very last one where it did
// not.
std::size_t furthest(const std::vector<Vec2>& points, double width) {
  const std::size_t last = points.size() - 1;
  const auto lengths = lengths_along(points);
  const double from = lengths.back() - kFoldSpan * width;
  if (from < width) return last;
  const Vec2 base = point_at(points, lengths, from), direction = unit(base - point_at(points, lengths, from - width));
  std::size_t tip = last;
  for (std::size_t k = last; k > 0 && lengths[k] > from; --k) {
    if (std::abs(cross(direction, points[k] - base)) > kFoldWide * width) return last;
    if (dot(direction, points[k] - points[tip]) > 0) tip = k;
  }
  return dot(direction, points[tip] - points[last]) > kFoldBack * width ? tip : last;
}

void unfold(Chain& chain, bool at_start, double width) {
  if (at_start) std::reverse(chain.points.begin(), chain.points.end());
  chain.points.resize(furthest(chain.points, width) + 1);
  if (at_start) std::reverse(chain.points.begin(), chain.points.end());
}

}  // namespace

EndOptions deep_ends(double stroke_width) {
  return {1.5 * stroke_width, kLongestInBlot * stroke_width, 0, 0, 0, kDeep};
}

Chains straightened_ends(const std::vector<RidgeChain>& ridges, std::vector<Vec2> junctions, double longest) {
  Chains chains{std::move(junctions), {}};
  for (const auto& ridge : ridges) {
    const bool loose = is_free(ridge.chain, true) && is_free(ridge.chain, false);
    if (loose && ridge.chain.confirmed == 0 && lengths_along(ridge.chain.points).back() < longest) continue;
    chains.chains.push_back(ridge.chain);
    Chain& chain = chains.chains.back();
    const auto lengths = lengths_along(chain.points);
    for (const bool at_start : {true, false}) {
      const Arrival arrival = arrival_at(ridge, at_start);
      if (!is_free(chain, at_start) || !arrival.known || arrival.last == 0) continue;
      const auto last = static_cast<std::size_t>(arrival.last);
      const double unsaid = at_start ? lengths[last] : lengths.back() - lengths[lengths.size() - 1 - last];
      if (unsaid > longest || unsaid + 3 * chain.width > lengths.back()) continue;
      cut_back(chain, at_start, unsaid + chain.width);
      append(chain, at_start, arrival.point);
    }
  }
  return chains;
}

Chains join_facing_ends(Chains chains, const Ink& ink, const EndOptions& options) {
  for (const auto& pair : facing_ends(chains, ink, options)) {
    auto& a = chains.chains[at(pair.a.chain)];
    auto& b = chains.chains[at(pair.b.chain)];
    if (!is_free(a, pair.a.at_start) || !is_free(b, pair.b.at_start)) continue;
    if (pair.a.chain != pair.b.chain) cut_overlap(a, pair.a.at_start, b, pair.b.at_start);
    Vec2& tip_a = a.points[end_index(a, pair.a.at_start)];
    Vec2& tip_b = b.points[end_index(b, pair.b.at_start)];
    tip_a = tip_b = lerp(tip_a, tip_b, 0.5);
    const int junction = static_cast<int>(chains.junctions.size());
    chains.junctions.push_back(tip_a);
    junction_at(a, pair.a.at_start) = junction;
    junction_at(b, pair.b.at_start) = junction;
  }
  return dissolve_junctions(std::move(chains));
}

Chains attach_ends(Chains chains, const InkBands& bands, const EndOptions& options) {
  const Ink& ink = bands.ink();
  chains = join_facing_ends(std::move(chains), ink, options);
  std::vector<End> ends;
  for (int c = 0; c < static_cast<int>(chains.chains.size()); ++c)
    for (const bool at_start : {true, false})
      if (may_attach(chains.chains[at(c)], at_start, ink, options)) ends.push_back({c, at_start});
  if (ends.empty()) return chains;
  const Ownership ownership = assign_ink(chains.chains, bands.of(options.bridge));
  std::vector<Meeting> meetings;
  for (const End end : ends)
    if (const auto meeting = meeting_of(chains, ownership, ink, end, options)) meetings.push_back(*meeting);
  std::stable_sort(meetings.begin(), meetings.end(), [](const Meeting& a, const Meeting& b) { return a.distance < b.distance; });
  std::vector<std::vector<Cut>> cuts(chains.chains.size());
  for (const auto& meeting : meetings) {
    if (!is_free(chains.chains[at(meeting.end.chain)], meeting.end.at_start)) continue;
    const int junction = junction_on(chains, cuts, meeting, 0.5 * options.reach);
    auto& chain = chains.chains[at(meeting.end.chain)];
    // A chain that would run into its own end there stays open.
    if (junction_at(chain, meeting.end.at_start) == junction) continue;
    junction_at(chain, meeting.end.at_start) = junction;
  }
  Chains result{chains.junctions, {}};
  for (std::size_t c = 0; c < chains.chains.size(); ++c)
    for (auto& piece : cut_chain(chains.chains[c], cuts[c])) {
      if (piece.start_junction >= 0) append(piece, true, result.junctions[at(piece.start_junction)]);
      if (piece.end_junction >= 0) append(piece, false, result.junctions[at(piece.end_junction)]);
      result.chains.push_back(std::move(piece));
    }
  return dissolve_junctions(std::move(result));
}

namespace {

// From a place in a stroke to its rim on both sides, on average; no more than `farthest` is looked at.
double half_chord(const Ink& ink, Vec2 p, Vec2 across, double farthest) {
  return 0.5 * (ink_ahead(ink.mask, p, across, kWalkStep, farthest) + ink_ahead(ink.mask, p, -across, kWalkStep, farthest));
}

// How far inside the end of its ink a stroke ends: where it is as far from there as from its sides, as the middle of a round
// cap is. Beside other ink, half the width of its chain.
double cap_radius(const Ink& ink, Vec2 end, Vec2 outward, double half_width) {
  const auto chord_at = [&](double inside) { return half_chord(ink, end - inside * outward, quarter_turn(outward), half_width); };
  double inside = half_width;
  while (inside > kWalkStep && chord_at(inside) < std::min(kNarrower * inside, inside - kSteps)) inside -= kWalkStep;
  return inside;
}

}  // namespace

Chains reach_ends(Chains chains, const Ink& ink, const EndOptions& options) {
  for (auto& chain : chains.chains)
    for (const bool at_start : {true, false}) {
      if (!is_free(chain, at_start)) continue;
      unfold(chain, at_start, ink.stroke_width);
      const Vec2 tip = chain.points[end_index(chain, at_start)], direction = outward(chain, at_start, 1.5 * chain.width);
      const double to_end = to_ink_end(ink, tip, direction, options, 4 * ink.stroke_width);
      const double further = to_end - cap_radius(ink, tip + to_end * direction, direction, 0.5 * chain.width);
      if (further > 0)
        append(chain, at_start, tip + further * direction);
      else
        cut_back(chain, at_start, -further);
    }
  return chains;
}

Chains reach_fills(Chains chains, const Fills& fills, double reach) {
  if (fills.count == 0) return chains;
  for (auto& chain : chains.chains)
    for (const bool at_start : {true, false}) {
      if (chain.mark || !is_free(chain, at_start)) continue;
      const Vec2 tip = chain.points[end_index(chain, at_start)], direction = outward(chain, at_start, 1.5 * chain.width);
      double way = 0;
      while (way < reach && nearest(fills.region, tip + way * direction, -1) < 0) way += kWalkStep;
      if (way < reach) append(chain, at_start, tip + way * direction);
    }
  return chains;
}

}  // namespace inkgrid
