#include "refine/strokes.h"

#include <algorithm>
#include <tuple>

#include "base/at.h"
#include "base/polyline.h"

namespace inkgrid {
namespace {

constexpr double kStraightOn = 0.94;  // cosine of 20 degrees

// An end of a chain is numbered 2 * chain, and one more at its end.
int chain_of(int end) {
  return end / 2;
}
bool at_start(int end) {
  return end % 2 == 0;
}

// From the end into the chain; zero where that is shorter than the span, and points nowhere in particular.
Vec2 departure(const std::vector<Chain>& chains, int end, double span) {
  const auto& points = chains[at(chain_of(end))].points;
  const auto lengths = lengths_along(points);
  if (lengths.back() < span) return {};
  return unit(at_start(end) ? point_at(points, lengths, span) - points.front()
                            : point_at(points, lengths, lengths.back() - span) - points.back());
}

std::vector<std::vector<int>> ends_at_junctions(const std::vector<Chain>& chains) {
  std::vector<std::vector<int>> ends;
  for (int end = 0; end < 2 * static_cast<int>(chains.size()); ++end) {
    const Chain& chain = chains[at(chain_of(end))];
    const int junction = at_start(end) ? chain.start_junction : chain.end_junction;
    if (junction < 0) continue;
    if (static_cast<std::size_t>(junction) >= ends.size()) ends.resize(static_cast<std::size_t>(junction) + 1);
    ends[at(junction)].push_back(end);
  }
  return ends;
}

// Of each end the end that the stroke goes on with, or -1.
std::vector<int> continuations(const std::vector<Chain>& chains, double span) {
  std::vector<int> next(2 * chains.size(), -1);
  for (const auto& ends : ends_at_junctions(chains)) {
    std::vector<std::tuple<double, int, int>> pairs;
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const double bend = dot(departure(chains, ends[i], span), departure(chains, ends[k], span));
        if (chain_of(ends[i]) != chain_of(ends[k]) && bend < -kStraightOn) pairs.emplace_back(bend, ends[k], ends[i]);
      }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [bend, a, b] : pairs)
      if (next[at(a)] < 0 && next[at(b)] < 0) {
        next[at(a)] = b;
        next[at(b)] = a;
      }
  }
  return next;
}

}  // namespace

std::vector<std::vector<StrokePart>> strokes_of(const std::vector<Chain>& chains, double span) {
  const auto next = continuations(chains, span);
  std::vector<std::vector<StrokePart>> strokes;
  std::vector<bool> taken(chains.size(), false);
  const auto follow = [&](int end) {
    strokes.emplace_back();
    while (end >= 0 && !taken[at(chain_of(end))]) {
      taken[at(chain_of(end))] = true;
      strokes.back().push_back({chain_of(end), !at_start(end)});
      end = next[at(end ^ 1)];
    }
  };
  // Rounds of chains have no first one: what is left belongs to them.
  for (const bool of_rounds : {false, true})
    for (int end = 0; end < static_cast<int>(next.size()); ++end)
      if (!taken[at(chain_of(end))] && (of_rounds || next[at(end)] < 0)) follow(end);
  return strokes;
}

}  // namespace inkgrid
