#include "refine/flanks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/at.h"
#include "base/index_raster.h"
#include "base/parallel.h"
#include "base/polyline.h"
#include "base/raster.h"
#include "base/sample.h"

namespace inkgrid {
namespace {

constexpr double kStep = 1;                                // px along a chain
constexpr double kRayStep = 0.5;                           // px across it
constexpr int kTangentReach = 3;                           // steps to both sides
constexpr double kParallel = 35 * std::numbers::pi / 180;  // and less
constexpr double kOwnStretch = 2;                          // farthest gaps: as near along the chain it is no neighbour of itself
constexpr double kJump = 0.4;                              // of the gap; and at least a stroke width
constexpr int kTogether = 256;                             // samples that a thread takes at once
constexpr double kNearEnd = 1.5;                           // strokes

struct Sample {
  Vec2 at;
  Vec2 tangent;
  int chain;
  int step;  // along it
};

// Samples of all chains, those of chain c from first[c] to first[c + 1].
struct Samples {
  std::vector<Sample> all;
  std::vector<int> first{0};
  std::vector<bool> closed;  // of each chain

  int from(int chain) const { return first[at(chain)]; }
  int to(int chain) const { return first[at(chain) + 1]; }
  const Sample& operator[](int i) const { return all[at(i)]; }

  // Of one chain, the shorter way round.
  int steps_between(int i, int j) const {
    const int chain = (*this)[i].chain, way = std::abs(i - j);
    return closed[at(chain)] ? std::min(way, to(chain) - from(chain) - way) : way;
  }
};

Samples sample(const std::vector<Chain>& chains) {
  Samples samples;
  for (int c = 0; c < static_cast<int>(chains.size()); ++c) {
    const auto points = resampled(chains[at(c)].points, kStep);
    const int count = static_cast<int>(points.size());
    for (int i = 0; i < count; ++i) {
      const Vec2 along = points[at(std::min(i + kTangentReach, count - 1))] - points[at(std::max(i - kTangentReach, 0))];
      const double length = norm(along);
      samples.all.push_back({points[at(i)], length > 0 ? (1 / length) * along : Vec2{1, 0}, c, i});
    }
    samples.first.push_back(static_cast<int>(samples.all.size()));
    samples.closed.push_back(chains[at(c)].closed);
  }
  return samples;
}

// Per pixel a sample that lies in it or just left of or above it, or -1: no ray passes between two samples of a chain.
IndexRaster paint(const Samples& samples, int width, int height) {
  IndexRaster nearest(width, height);
  for (int i = 0; i < static_cast<int>(samples.all.size()); ++i) {
    const int x = static_cast<int>(std::floor(samples[i].at.x)), y = static_cast<int>(std::floor(samples[i].at.y));
    for (const auto [px, py] : {std::array{x + 1, y}, {x, y + 1}, {x, y}})
      if (nearest.contains(px, py)) nearest.set(px, py, i);
  }
  return nearest;
}

struct Neighbour {
  int sample = -1;  // -1: none, or none that is parallel
  double gap = 0;   // px
};

// The first other chain that a ray along the normal meets.
Neighbour look(const Samples& samples, const IndexRaster& painted, int i, Vec2 normal, double farthest) {
  const Sample& s = samples[i];
  for (double t = kStep; t < farthest; t += kRayStep) {
    const Vec2 p = s.at + t * normal;
    const int x = floor_of(p.x), y = floor_of(p.y);
    if (!painted.contains(x, y)) return {};
    const int found = painted(x, y);
    if (found < 0) continue;
    const Sample& o = samples[found];
    if (o.chain == s.chain && samples.steps_between(i, found) * kStep < kOwnStretch * farthest) continue;
    if (std::abs(dot(o.tangent, s.tangent)) < std::cos(kParallel)) return {};
    return {found, std::max(kStep, dot(o.at - s.at, normal))};
  }
  return {};
}

class FlankFinder {
 public:
  FlankFinder(const std::vector<Chain>& chains, int width, int height, const FlankOptions& options)
      : chains_(chains), options_(options), samples_(sample(chains)), near_(samples_.all.size()) {
    const IndexRaster painted = paint(samples_, width, height);
    for_ranges(options.threads, static_cast<int>(samples_.all.size()), kTogether, [&](int first, int end) {
      for (int i = first; i < end; ++i) {
        const Vec2 left{-samples_[i].tangent.y, samples_[i].tangent.x};
        near_[at(i)] = {look(samples_, painted, i, left, options.farthest), look(samples_, painted, i, -left, options.farthest)};
      }
    });
  }

  void append(int chain, std::size_t side, std::vector<Flank>& flanks) const {
    for (int from = samples_.from(chain), to; from < samples_.to(chain); from = to) {
      to = from + 1;
      if (near(from, side).sample < 0) continue;
      while (to < samples_.to(chain) && goes_on(to, side)) ++to;
      flanks.push_back(flank(chain, side, from, to - 1));
    }
  }

 private:
  const Neighbour& near(int i, std::size_t side) const { return near_[at(i)][side]; }

  // From the sample before.
  bool goes_on(int i, std::size_t side) const {
    const double gap = near(i - 1, side).gap;
    return near(i, side).sample >= 0 && std::abs(near(i, side).gap - gap) < std::max(options_.stroke_width, kJump * gap);
  }

  Flank flank(int chain, std::size_t side, int from, int to) const {
    Flank f;
    f.chain = chain;
    f.other = samples_[near(to, side).sample].chain;
    std::vector<double> behind;
    for (int i = from; i <= to; ++i) {
      const Neighbour &n = near(i, side), &b = near(i, 1 - side);
      f.here.push_back(samples_[i].at);
      f.opposite.push_back(samples_[n.sample].at);
      f.gap += n.gap / (to - from + 1);
      behind.push_back(b.sample < 0 ? std::numeric_limits<double>::infinity() : b.gap);
    }
    f.length = (to - from + 1) * kStep;
    std::nth_element(behind.begin(), behind.begin() + (to - from) / 2, behind.end());
    f.clearance = behind[at((to - from) / 2)];
    for (const int i : {from, to}) {
      const bool own = (i == from ? i == samples_.from(chain) : i == samples_.to(chain) - 1) && near_free_end(i);
      const bool other = near_free_end(near(i, side).sample);
      f.own_ends += own && !other;
      f.other_ends += other && !own;
      f.meetings += meet(i, near(i, side).sample);
    }
    return f;
  }

  bool near_free_end(int i) const {
    const Sample& s = samples_[i];
    const Chain& chain = chains_[at(s.chain)];
    const double near = kNearEnd * options_.stroke_width, rest = (samples_.to(s.chain) - 1 - i) * kStep;
    return !chain.closed && ((chain.start_junction < 0 && s.step * kStep <= near) || (chain.end_junction < 0 && rest <= near));
  }

  // In the junction at the nearer end of the chain of sample i.
  bool meet(int i, int opposite) const {
    const Sample& s = samples_[i];
    const Chain& chain = chains_[at(s.chain)];
    const Chain& other = chains_[at(samples_[opposite].chain)];
    const int junction = s.step < samples_.to(s.chain) - 1 - i ? chain.start_junction : chain.end_junction;
    return junction >= 0 && (junction == other.start_junction || junction == other.end_junction);
  }

  const std::vector<Chain>& chains_;
  const FlankOptions options_;
  const Samples samples_;
  std::vector<std::array<Neighbour, 2>> near_;  // of each sample, left and right
};

}  // namespace

std::vector<Flank> find_flanks(const std::vector<Chain>& chains, int width, int height, const FlankOptions& options) {
  const FlankFinder finder(chains, width, height, options);
  std::vector<Flank> flanks;
  for (int c = 0; c < static_cast<int>(chains.size()); ++c)
    for (const std::size_t side : {0u, 1u}) finder.append(c, side, flanks);
  return flanks;
}

}  // namespace inkgrid
