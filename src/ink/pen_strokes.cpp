#include "ink/pen_strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/at.h"
#include "base/index_raster.h"
#include "base/median.h"
#include "ink/ink.h"

namespace inkgrid {
namespace {

constexpr float kSteepest = 0.6F;    // a centre pixel has no neighbour deeper by more than this for each px of distance
constexpr float kClassStep = 1.15F;  // from one class of depths to the next
constexpr int kLink = 2;             // px: centre pixels no further apart go on into each other

// What counts as a stroke: a middle whose depth varies by this factor at most (and half a pixel) over `length` depths.
struct Uniformity {
  float variation;
  float length;
};
// Bundles of overdrawn strokes vary much.  Ink far wider than the pen is a stroke only where it has the look of a wide pen's.
constexpr Uniformity kNarrow{1.3F, 6};
constexpr Uniformity kWide{1.15F, 8};
// Where nothing is that long: several ticks of one width, and little else.
constexpr Uniformity kTick{1.15F, 1.7F};
constexpr std::size_t kSeveral = 3;

bool is_centre(const Raster<float>& depth, int x, int y) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const float distance = dx && dy ? std::sqrt(2.0F) : 1.0F;
      if (depth.contains(x + dx, y + dy) && depth(x + dx, y + dy) - depth(x, y) > kSteepest * distance) return false;
    }
  return true;
}

// Finds the runs of centre pixels whose depths belong together.
class RunFinder {
 public:
  RunFinder(PenStrokes& strokes) : centres_(strokes.centres), index_(strokes.depth.width, strokes.depth.height) {
    for (std::size_t i = 0; i < centres_.size(); ++i) index_.set(centres_[i].x, centres_[i].y, static_cast<int>(i));
    seen_.assign(centres_.size(), -1);
  }

  // Marks the centres deeper than `least` that belong to strokes, and unmarks the others.
  void mark(float least, float most, Uniformity uniformity) {
    for (auto& c : centres_)
      if (c.depth > least) c.of_stroke = false;
    for (float depth = std::max(1.0F, least); depth < kClassStep * most; depth *= kClassStep)
      for (const auto& run : runs_of(depth, uniformity)) mark_run(run, depth, least);
  }

  // Marks runs of one depth, if they are several and most of the centres are theirs.
  void mark_ticks(float most) {
    for (float depth = 1; depth < kClassStep * most; depth *= kClassStep) {
      const auto ticks = runs_of(depth, kTick);
      std::size_t covered = 0;
      for (const auto& tick : ticks) covered += tick.size();
      if (ticks.size() < kSeveral || 2 * covered < centres_.size()) continue;
      for (const auto& tick : ticks) mark_run(tick, depth, 0);
    }
  }

 private:
  // Pixels blur small depths.
  static bool near(float depth, float of, float factor, float blur) {
    return depth >= of / factor - blur && depth <= of * factor + blur;
  }

  bool begins_run(int i, float depth, float variation) const {
    return seen_[at(i)] != round_ && near(centres_[at(i)].depth, depth, variation, 0.6F);
  }

  std::vector<std::vector<int>> runs_of(float depth, Uniformity uniformity) {
    ++round_;
    std::vector<std::vector<int>> runs;
    for (int i = 0; i < static_cast<int>(centres_.size()); ++i) {
      if (!begins_run(i, depth, uniformity.variation)) continue;
      std::vector<int> run = collect(i, depth, uniformity.variation);
      if (length_of(run) >= uniformity.length * depth) runs.push_back(std::move(run));
    }
    return runs;
  }

  void mark_run(const std::vector<int>& run, float depth, float least) {
    const float kernel = std::sqrt(kClassStep) * 1.02F;
    for (const int i : run)
      if (centres_[at(i)].depth > least && near(centres_[at(i)].depth, depth, kernel, 0.3F)) centres_[at(i)].of_stroke = true;
  }

  std::vector<int> collect(int first, float depth, float variation) {
    std::vector<int> run{first};
    seen_[at(first)] = round_;
    for (std::size_t k = 0; k < run.size(); ++k) {
      const CentrePixel here = centres_[at(run[k])];
      for (int dy = -kLink; dy <= kLink; ++dy)
        for (int dx = -kLink; dx <= kLink; ++dx) {
          if (!index_.contains(here.x + dx, here.y + dy)) continue;
          const int next = index_(here.x + dx, here.y + dy);
          if (next < 0 || !begins_run(next, depth, variation)) continue;
          seen_[at(next)] = round_;
          run.push_back(next);
        }
    }
    return run;
  }

  // The middle of a stroke is one or two pixels wide.
  float length_of(const std::vector<int>& run) const {
    int x0 = index_.width(), y0 = index_.height(), x1 = 0, y1 = 0;
    for (const int i : run) {
      const CentrePixel& c = centres_[at(i)];
      x0 = std::min(x0, c.x);
      x1 = std::max(x1, c.x);
      y0 = std::min(y0, c.y);
      y1 = std::max(y1, c.y);
    }
    return std::max(std::hypot(static_cast<float>(x1 - x0), static_cast<float>(y1 - y0)), static_cast<float>(run.size()) / 2);
  }

  std::vector<CentrePixel>& centres_;
  IndexRaster index_;      // per pixel: its centre
  std::vector<int> seen_;  // per centre: the last round that saw it
  int round_ = -1;
};

// Of the stroke through the pixel, px: the shortest run of darkness through it in four directions, which is at most 8 % too long.
double width_at(const CentrePixel& c, const PenStrokes& strokes, const Raster<float>& darkness) {
  constexpr std::array<std::array<int, 2>, 4> kDirections{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  const float full = std::max(darkness(c.x, c.y), 1e-3F);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [dx, dy] : kDirections) {
    double run = 1;
    for (const int sign : {-1, 1})
      for (int k = 1;; ++k) {
        const int x = c.x + sign * k * dx, y = c.y + sign * k * dy;
        if (!darkness.contains(x, y)) break;
        run += static_cast<double>(std::min(1.0F, darkness(x, y) / full));
        if (strokes.depth(x, y) <= 0) break;  // the rim is the last
      }
    least = std::min(least, run * std::hypot(dx, dy));
  }
  return least;
}

double median_width(const PenStrokes& strokes, const Raster<float>& darkness) {
  std::vector<double> widths;
  for (const CentrePixel& c : strokes.centres)
    if (c.of_stroke) widths.push_back(width_at(c, strokes, darkness));
  return widths.empty() ? 0 : median(std::move(widths));
}

}  // namespace

Raster<float> depth_of(const Raster<std::uint8_t>& ink) {
  Raster<std::uint8_t> paper(ink.width, ink.height);
  std::transform(ink.data.begin(), ink.data.end(), paper.data.begin(), [](auto i) { return static_cast<std::uint8_t>(!i); });
  return distance_to(paper);
}

PenStrokes find_pen_strokes(const Raster<std::uint8_t>& ink, const Raster<float>& darkness, float far_wider) {
  PenStrokes strokes;
  strokes.depth = depth_of(ink);
  float most = 1;
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x) {
      if (!ink(x, y) || !is_centre(strokes.depth, x, y)) continue;
      strokes.centres.push_back({x, y, strokes.depth(x, y), false});
      most = std::max(most, strokes.depth(x, y));
    }
  // Where there is no paper at all, nothing is a stroke.
  most = std::min(most, static_cast<float>(ink.width + ink.height));
  RunFinder finder(strokes);
  finder.mark(0, most, kNarrow);
  strokes.width = median_width(strokes, darkness);
  if (strokes.width == 0) {
    finder.mark_ticks(most);
    strokes.width = median_width(strokes, darkness);
  }
  if (strokes.width > 0) finder.mark(far_wider * static_cast<float>(strokes.width / 2), most, kWide);
  return strokes;
}

}  // namespace inkgrid
