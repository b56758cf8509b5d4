#include "refine/flanking.h"

#include <algorithm>

#include "base/at.h"
#include "base/polyline.h"
#include "graph/dissolve.h"
#include "refine/bundles.h"
#include "refine/cuts.h"
#include "refine/lenses.h"

namespace inkgrid {
namespace {

constexpr double kStep = 1;        // px: that of the points of flanks
constexpr double kLeast = 0.5;     // gaps: what is shorter tells nothing
constexpr double kLeastEntry = 1;  // gaps: the same of what is to be cut off
constexpr double kRest = 2;        // gaps: what a chain has beside its flank where it bends into a junction
constexpr double kRamp = 2;        // gaps: over which a line moves to the middle and back
constexpr double kEntry = 3;       // gaps: over which a chain goes over into another
constexpr double kFacing = 2;      // strokes
constexpr int kSweeps = 3;
constexpr double kSketchy = 0.1;        // sketchiness: of drawings in which a line can part by chance
constexpr double kOverdrawn = 1.0 / 3;  // sketchiness
constexpr double kBundle = 2.5;         // strokes
constexpr double kTail = 2;             // widths of the bundle

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::size_t nearest_index(const std::vector<Vec2>& points, Vec2 p) {
  const auto nearer = [p](Vec2 a, Vec2 b) { return norm(a - p) < norm(b - p); };
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), nearer) - points.begin());
}

bool lies_on(Vec2 p, const Chain& chain) {
  return norm(chain.points[nearest_index(chain.points, p)] - p) < kStep;
}

// Flanks with a free end, those that are most likely one line first.
std::vector<Flank> flanks_of_one_line(const Chains& chains, const FlankingOptions& options) {
  std::vector<std::pair<double, Flank>> likely;
  const FlankOptions wanted = flank_options(options.stroke_width, options.threads);
  for (Flank& flank : find_flanks(chains.chains, options.width, options.height, wanted))
    if (flank.own_ends > 0 && flank.length >= kLeast * flank.gap &&
        are_one_line(flank, options.sketchiness, options.stroke_width))
      likely.emplace_back(one_line(flank, options.sketchiness, options.stroke_width), std::move(flank));
  std::stable_sort(likely.begin(), likely.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Flank> flanks;
  flanks.reserve(likely.size());
  for (auto& [likelihood, flank] : likely) flanks.push_back(std::move(flank));
  return flanks;
}

// A chain turned so that its free end is the last of its points, and its flank from `begin` to there.
struct Tail {
  Chain chain;
  std::size_t begin;
  std::vector<Vec2> here;
  std::vector<Vec2> opposite;
};

Tail tail_of(const Chain& chain, const Flank& flank) {
  Tail tail{chain, 0, flank.here, flank.opposite};
  const bool at_end = chain.end_junction < 0 && norm(flank.here.back() - chain.points.back()) < kStep;
  if (!at_end) {
    tail.chain = reversed(chain);
    std::reverse(tail.here.begin(), tail.here.end());
    std::reverse(tail.opposite.begin(), tail.opposite.end());
  }
  tail.begin = nearest_index(tail.chain.points, tail.here.front());
  return tail;
}

// From the one chain to the other along their flank: over a ramp to the middle, and over another away from it.
std::vector<Vec2> crossed_over(const Tail& tail, double middle, double ramp) {
  std::vector<Vec2> points;
  const std::size_t last = tail.here.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const double along = kStep * static_cast<double>(k), rest = kStep * static_cast<double>(last - k);
    const double share = middle * smooth(along / ramp) + (1 - middle) * (1 - smooth(rest / ramp));
    points.push_back(lerp(tail.here[k], tail.opposite[k], share));
  }
  return points;
}

// Means over `radius` values on both sides.
std::vector<Vec2> smoothed(const std::vector<Vec2>& values, std::size_t radius) {
  std::vector<Vec2> sums{{}}, means;
  for (const Vec2 v : values) sums.push_back(sums.back() + v);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t first = i - std::min(i, radius), last = std::min(i + radius + 1, values.size());
    means.push_back((sums[last] - sums[first]) / static_cast<double>(last - first));
  }
  return means;
}

// Moves a chain towards one that flanks it, by `share` of the gap.
void move_to_flank(Chain& chain, const Flank& flank, double share) {
  auto& points = chain.points;
  const std::size_t front = nearest_index(points, flank.opposite.front()), back = nearest_index(points, flank.opposite.back());
  const std::size_t from = std::min(front, back), to = std::max(front, back);
  if (to - from + 1 < flank.here.size() / 2 || to - from > 2 * flank.here.size()) return;  // the long way round
  std::vector<Vec2> shifts;
  for (std::size_t i = from; i <= to; ++i) {
    const std::size_t k = nearest_index(flank.opposite, points[i]);
    shifts.push_back(flank.here[k] - flank.opposite[k]);
  }
  shifts = smoothed(shifts, static_cast<std::size_t>(flank.gap / kStep));
  for (std::size_t i = from; i <= to; ++i) {
    const double along = kStep * static_cast<double>(std::min(i - from, to - i));
    points[i] += share * smooth(along / (kRamp * flank.gap)) * shifts[i - from];
  }
}

// One pass over the flanks, in which every chain is changed at most once.
class Sweep {
 public:
  Sweep(const Chains& chains, const FlankingOptions& options)
      : before_(chains), chains_(chains), options_(options), changed_(chains.chains.size()), gone_(chains.chains.size()) {
    for (Chain& chain : chains_.chains) chain.points = resampled(chain.points, kStep);
  }

  bool join() {
    bool any = false;
    for (const Flank& flank : flanks_of_one_line(chains_, options_)) {
      if (is_changed(flank.chain) || is_changed(flank.other)) continue;
      const bool joined = is_flanked_all_along(flank) ? drop(flank) : flank.other_ends > 0 ? join_ends(flank) : lead_in(flank);
      any = any || joined;
    }
    return any;
  }

  Chains joined() && {
    Chains kept{std::move(chains_.junctions), {}};
    for (std::size_t c = 0; c < chains_.chains.size(); ++c)
      if (!gone_[c]) kept.chains.push_back((changed_[c] ? chains_ : before_).chains[c]);
    return dissolve_junctions(std::move(kept));
  }

 private:
  Chain& chain(int c) { return chains_.chains[at(c)]; }
  bool is_changed(int c) const { return changed_[at(c)] != 0; }

  void change(int c, Chain chain) {
    chains_.chains[at(c)] = std::move(chain);
    changed_[at(c)] = 1;
  }

  void remove(int c) { changed_[at(c)] = gone_[at(c)] = 1; }

  bool is_flanked_all_along(const Flank& flank) {
    const Chain& c = chain(flank.chain);
    const int junctions = (c.start_junction >= 0) + (c.end_junction >= 0);
    const double rest = lengths_along(c.points).back() - flank.length;
    return flank.own_ends + junctions >= 2 && rest <= junctions * (kRest * flank.gap + options_.stroke_width) + 2 * kStep;
  }

  // How far the line of both is from the flanking chain, by how wide they are.
  double middle(const Flank& flank) {
    const double here = chain(flank.chain).width, opposite = chain(flank.other).width;
    return here + opposite > 0 ? opposite / (here + opposite) : 0.5;
  }

  bool drop(const Flank& flank) {
    Chain line = chain(flank.other);
    if (lies_on(flank.opposite.front(), line) && lies_on(flank.opposite.back(), line))
      move_to_flank(line, flank, 1 - middle(flank));
    change(flank.other, std::move(line));
    remove(flank.chain);
    return true;
  }

  // Both chains end beside each other: the one goes over into the other, by the middle where there is room.
  bool join_ends(const Flank& flank) {
    const Tail tail = tail_of(chain(flank.chain), flank);
    Chain next = chain(flank.other);
    const Vec2 start = tail.opposite.front();
    if (norm(next.points.back() - start) < norm(next.points.front() - start)) next = reversed(std::move(next));
    const bool facing = next.start_junction < 0 && norm(next.points.front() - start) <= kFacing * options_.stroke_width;
    if (next.closed || !facing || !lies_on(tail.opposite.back(), next)) return false;

    const double room = kEntry * flank.gap - flank.length;
    const auto spare = static_cast<std::size_t>(std::max(0.0, 0.5 * room / kStep));
    const double ramp = std::min(kRamp * flank.gap, 0.5 * flank.length);
    const auto over = room > 0 ? std::vector<Vec2>{} : crossed_over(tail, middle(flank), ramp);
    const std::size_t last = tail.begin - std::min(tail.begin, spare);
    const std::size_t first = std::min(nearest_index(next.points, tail.opposite.back()) + spare, next.points.size() - 1);
    return flank.chain == flank.other ? close(flank.chain, tail.chain, first, last, over)
                                      : join_at(flank, tail.chain, last, over, next, first);
  }

  bool join_at(const Flank& flank, Chain joined, std::size_t last, const std::vector<Vec2>& over, const Chain& next,
               std::size_t first) {
    joined.points.resize(last + 1);
    joined.points.insert(joined.points.end(), over.begin(), over.end());
    joined.points.insert(joined.points.end(), next.points.begin() + static_cast<std::ptrdiff_t>(first), next.points.end());
    joined.end_junction = next.end_junction;
    joined.width = std::max(joined.width, next.width);
    change(flank.chain, std::move(joined));
    remove(flank.other);
    return true;
  }

  // A chain that ends beside its own start.
  bool close(int c, const Chain& open, std::size_t first, std::size_t last, const std::vector<Vec2>& over) {
    if (open.start_junction >= 0 || first + 2 > last) return false;
    Chain closed = open;
    closed.points.assign(open.points.begin() + static_cast<std::ptrdiff_t>(first),
                         open.points.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    closed.points.insert(closed.points.end(), over.begin(), over.end());
    closed.points.push_back(closed.points.front());
    closed.closed = true;
    change(c, std::move(closed));
    return true;
  }

  // The chain's end is cut off, and what stays runs into the other.
  bool lead_in(const Flank& flank) {
    Tail tail = tail_of(chain(flank.chain), flank);
    const std::size_t entry = std::min(tail.here.size() - 1, static_cast<std::size_t>(kEntry * flank.gap / kStep));
    const Vec2 target = tail.opposite[entry];
    if (flank.length < kLeastEntry * flank.gap || flank.chain == flank.other || tail.begin == 0) return false;
    if (!lies_on(target, chain(flank.other))) return false;
    tail.chain.points.resize(tail.begin);
    for (std::size_t k = 0; k < entry; ++k)
      tail.chain.points.push_back(
          lerp(tail.here[k], tail.opposite[k], smooth(static_cast<double>(k) / static_cast<double>(entry))));
    tail.chain.end_junction = junction_on(flank.other, target);
    tail.chain.points.push_back(chains_.junctions[at(tail.chain.end_junction)]);
    change(flank.chain, std::move(tail.chain));
    return true;
  }

  // At a point of the chain: the junction that it ends in there, or a new one.
  int junction_on(int c, Vec2 p) {
    const Chain& line = chain(c);
    const std::size_t last = line.points.size() - 1;
    std::size_t at = nearest_index(line.points, p);
    if (line.closed)
      at = std::clamp<std::size_t>(at, 1, last - 1);  // the seam is no end
    else if (at < 2 || at + 2 > last)
      at = at < 2 ? 0 : last;
    if (at == 0 && line.start_junction >= 0) return line.start_junction;
    if (at == last && line.end_junction >= 0) return line.end_junction;
    const int junction = static_cast<int>(chains_.junctions.size());
    chains_.junctions.push_back(line.points[at]);
    std::vector<Chain> pieces = cut_chain(line, {{static_cast<int>(at), junction}});
    for (std::size_t k = 1; k < pieces.size(); ++k) {
      chains_.chains.push_back(std::move(pieces[k]));
      changed_.push_back(1);
      gone_.push_back(0);
    }
    change(c, std::move(pieces.front()));
    return junction;
  }

  const Chains& before_;
  Chains chains_;  // the same with points kStep apart
  const FlankingOptions& options_;
  std::vector<std::uint8_t> changed_;
  std::vector<std::uint8_t> gone_;
};

// What sticks out of a wide bundle, as strokes do that were drawn past each other.
Chains drop_tails(Chains chains, double stroke_width) {
  std::vector<int> degree(chains.junctions.size());
  std::vector<double> widest(chains.junctions.size());
  for (const Chain& chain : chains.chains)
    for (const int j : {chain.start_junction, chain.end_junction})
      if (j >= 0) {
        ++degree[at(j)];
        widest[at(j)] = std::max(widest[at(j)], chain.width);
      }
  std::erase_if(chains.chains, [&](const Chain& chain) {
    if (chain.closed || (chain.start_junction < 0) == (chain.end_junction < 0)) return false;
    const auto j = static_cast<std::size_t>(std::max(chain.start_junction, chain.end_junction));
    if (degree[j] < 3 || widest[j] < kBundle * stroke_width || lengths_along(chain.points).back() > kTail * widest[j])
      return false;
    --degree[j];
    return true;
  });
  return dissolve_junctions(std::move(chains));
}

}  // namespace

Chains join_flanking(Chains chains, const FlankingOptions& options) {
  for (int i = 0; i < kSweeps; ++i) {
    Sweep sweep(chains, options);
    if (!sweep.join()) break;
    chains = std::move(sweep).joined();
  }
  if (options.sketchiness >= kSketchy) chains = join_lenses(std::move(chains), options.stroke_width);
  return options.sketchiness >= kOverdrawn ? drop_tails(std::move(chains), options.stroke_width) : chains;
}

}  // namespace inkgrid
