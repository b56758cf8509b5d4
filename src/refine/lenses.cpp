#include "refine/lenses.h"

#include <algorithm>
#include <map>

#include "base/at.h"
#include "base/median.h"
#include "base/polyline.h"
#include "graph/dissolve.h"

namespace inkgrid {
namespace {

constexpr double kStep = 1;           // px
constexpr double kWidest = 2;         // strokes: median distance of the two
constexpr double kSpan = 1.5;         // strokes: over which directions are measured
constexpr double kLeastCosine = 0.3;  // cosine of the angle between the two at a junction

struct Lens {
  int first = 0;
  int second = 0;              // chains
  std::vector<Vec2> along;     // points of the first
  std::vector<Vec2> opposite;  // as many of the second, from the same junction
};

std::vector<Vec2> evenly(const std::vector<Vec2>& path, int count) {
  const std::vector<double> lengths = lengths_along(path);
  std::vector<Vec2> points;
  for (int k = 0; k <= count; ++k) points.push_back(point_at(path, lengths, lengths.back() * k / count));
  return points;
}

Lens lens_of(const Chains& chains, int first, int second) {
  const Chain &a = chains.chains[at(first)], &b = chains.chains[at(second)];
  std::vector<Vec2> other = b.points;
  if (a.start_junction != b.start_junction) std::reverse(other.begin(), other.end());
  const double longer = std::max(lengths_along(a.points).back(), lengths_along(other).back());
  const int count = std::max(4, static_cast<int>(longer / kStep));
  return {first, second, evenly(a.points, count), evenly(other, count)};
}

Vec2 direction(const std::vector<Vec2>& points, bool from_end, std::size_t span) {
  const std::size_t last = points.size() - 1, far = std::min(span, last / 2);
  return unit(from_end ? points[last - far] - points[last] : points[far] - points[0]);
}

bool is_one_line(const Lens& lens, double stroke_width) {
  std::vector<double> gaps;
  for (std::size_t k = 0; k < lens.along.size(); ++k) gaps.push_back(norm(lens.along[k] - lens.opposite[k]));
  const auto span = static_cast<std::size_t>(kSpan * stroke_width / kStep);
  const auto parts_gently = [&](bool end) {
    return dot(direction(lens.along, end, span), direction(lens.opposite, end, span)) >= kLeastCosine;
  };
  return median(std::move(gaps)) <= kWidest * stroke_width && parts_gently(false) && parts_gently(true);
}

// Of every two junctions with exactly two chains between them.
std::vector<Lens> find_lenses(const Chains& chains, double stroke_width) {
  std::map<std::pair<int, int>, std::vector<int>> between;
  for (std::size_t c = 0; c < chains.chains.size(); ++c) {
    const Chain& chain = chains.chains[c];
    const auto [low, high] = std::minmax(chain.start_junction, chain.end_junction);
    if (low >= 0 && low != high) between[{low, high}].push_back(static_cast<int>(c));
  }
  std::vector<Lens> lenses;
  for (const auto& [ends, pair] : between) {
    if (pair.size() != 2) continue;
    Lens lens = lens_of(chains, pair[0], pair[1]);
    if (is_one_line(lens, stroke_width)) lenses.push_back(std::move(lens));
  }
  return lenses;
}

// Chains at each junction, a lens counted as one.
std::vector<int> lines_at(const Chains& chains, const std::vector<Lens>& lenses) {
  std::vector<int> lines(chains.junctions.size());
  const auto count = [&](const Chain& chain, int by) {
    for (const int j : {chain.start_junction, chain.end_junction})
      if (j >= 0) lines[at(j)] += by;
  };
  for (const Chain& chain : chains.chains) count(chain, 1);
  for (const Lens& lens : lenses) count(chains.chains[at(lens.first)], -1);
  return lines;
}

// The line in the middle of both, nearer to the wider; its ends stay to the last digit.
Chain middle_of(const Lens& lens, const Chain& first, const Chain& second) {
  Chain line = first;
  const double widths = first.width + second.width, share = widths > 0 ? second.width / widths : 0.5;
  line.points = lens.along;
  for (std::size_t k = 1; k + 1 < line.points.size(); ++k) line.points[k] = lerp(lens.along[k], lens.opposite[k], share);
  line.points.front() = first.points.front();
  line.points.back() = first.points.back();
  line.width = std::max(first.width, second.width);
  return line;
}

}  // namespace

Chains join_lenses(Chains chains, double stroke_width) {
  const std::vector<Lens> lenses = find_lenses(chains, stroke_width);
  const std::vector<int> lines = lines_at(chains, lenses);
  std::vector<std::uint8_t> kept(chains.chains.size(), 1);
  for (const Lens& lens : lenses) {
    Chain& line = chains.chains[at(lens.first)];
    if (lines[at(line.start_junction)] != 2 || lines[at(line.end_junction)] != 2) continue;
    line = middle_of(lens, line, chains.chains[at(lens.second)]);
    kept[at(lens.second)] = 0;
  }
  keep_chains(chains, kept);
  return dissolve_junctions(std::move(chains));
}

}  // namespace inkgrid
