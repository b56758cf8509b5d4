#include "ink/threshold.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/histogram.h"
#include "ink/paper_light.h"
#include "ink/ruling.h"
#include "ink/runs.h"
#include "ink/shade.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr int kLocal = 2;              // px: over this distance the ink of an edge falls to none
constexpr int kClimb = 3;              // px: and over this one more where the edge is soft
constexpr int kBeyond = 3;             // px: past the edge of a stroke
constexpr double kFaintest = 0.04;     // darkness (fraction of the paper's light) below which nothing is ink
constexpr double kFaintOfFull = 0.15;  // of full ink: lighter than this is soiled paper, not a stroke
constexpr double kNoiseFactor = 5;     // weak ink stands out from the grain by this many standard deviations
constexpr double kSeedFactor = 1.4;    // a stroke has a pixel this much darker than the weakest ink
constexpr double kGrainy = 0.012;      // standard deviation of the paper's darkness above which the picture is smoothed first
constexpr double kAnyGrain = 0.003;    // and below which there is none
constexpr double kSpeck = 2;           // px of full ink: less is no dot, on paper without grain
constexpr double kSpeckInGrain = 6;    // and with it
constexpr long kPinhole = 16;          // px
constexpr double kDrawn = 2;           // times the usual darkness of ruled lines: what is darker was drawn,
constexpr double kDrawnPart = 0.001;   // and is so much of the page at least
constexpr double kOverRuling = 1.2;    // times the darkness of nearly all of those lines: the weakest ink,
constexpr double kOfDrawn = 0.65;      // but no more than this part of what was drawn

// A light blur (1 2 1)/4 both ways, in place.
void soften(Raster<float>& raster) {
  const auto smooth_row = [&](float* row) {
    float before = row[0];
    for (int x = 0; x < raster.width; ++x) {
      const float here = row[x], after = x + 1 < raster.width ? row[x + 1] : here;
      row[x] = 0.25f * (before + 2 * here + after);
      before = here;
    }
  };
  for (int y = 0; y < raster.height; ++y) smooth_row(&raster(0, y));
  std::vector<float> before(raster.data.begin(), raster.data.begin() + raster.width);
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const float here = raster(x, y), after = y + 1 < raster.height ? raster(x, y + 1) : here;
      float& b = before[at(x)];
      raster(x, y) = 0.25f * (b + 2 * here + after);
      b = here;
    }
}

struct Levels {
  double grain = 0;    // standard deviation of the darkness of bare paper
  double weak = 0;     // darkness of the weakest ink
  double full = 1;     // darkness of full ink
  bool ruled = false;  // the paper is, and its lines are weaker
};

// `above`: darkness below which nothing is ink; `part`: the same as a part of full ink.
Levels measure_levels(const Raster<float>& darkness, double above, double part) {
  Histogram histogram(6144, -0.5, 1.0);
  for (const float d : darkness.data) histogram.add(d);
  Levels levels;
  const double bin = 1.5 / 6144;
  levels.grain = std::max(0.0, -1.4826 * histogram.quantile(0.5, -0.5, bin));
  const double least = std::max({kFaintest, kNoiseFactor * levels.grain, above});
  levels.full = std::max(histogram.quantile(0.9, least, 1.0), 2 * least);
  levels.weak = std::max(least, part * levels.full);
  return levels;
}

struct Pixel {
  int x, y;
};

// The darkest pixel within `radius` of p; the nearest of several, so p itself on a plateau.
Pixel darkest_near(const Raster<float>& darkness, Pixel p, int radius) {
  Pixel best = p;
  int nearest = 0;
  for (int y = std::max(0, p.y - radius); y <= std::min(darkness.height - 1, p.y + radius); ++y)
    for (int x = std::max(0, p.x - radius); x <= std::min(darkness.width - 1, p.x + radius); ++x) {
      const float gain = darkness(x, y) - darkness(best.x, best.y);
      const int distance = (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y);
      if (gain < 0 || (gain == 0 && distance >= nearest)) continue;
      best = {x, y};
      nearest = distance;
    }
  return best;
}

// The darkest ink that p may be the flank of: a short climb, then all that is near.
Pixel core_of(const Raster<float>& darkness, Pixel p) {
  Pixel top = p;
  for (int step = 0; step < kClimb; ++step) top = darkest_near(darkness, top, 1);
  const Pixel a = darkest_near(darkness, p, kLocal), b = darkest_near(darkness, top, kLocal);
  return darkness(b.x, b.y) > darkness(a.x, a.y) ? b : a;
}

// Beyond p, seen from the core, the picture is as dark as in p: a light stroke that leaves a strong one, not the edge of that.
bool goes_on_beyond(const Raster<float>& darkness, Pixel p, Pixel core, double weak) {
  const double dx = p.x - core.x, dy = p.y - core.y, length = std::hypot(dx, dy);
  const int x = p.x + static_cast<int>(std::lround(kBeyond * dx / length)),
            y = p.y + static_cast<int>(std::lround(kBeyond * dy / length));
  if (!darkness.contains(x, y) || darkness(x, y) <= weak) return false;
  const float ratio = darkness(x, y) / darkness(p.x, p.y);
  return ratio > 0.5f && ratio < 1.4f;
}

struct LocalInk {
  Raster<std::uint8_t> ink;
  double mean_threshold = 0;  // darkness; over the ink
};

// Ink is at least half as dark as the core of its stroke.
LocalInk half_of_local_ink(const Raster<float>& darkness, double weak) {
  LocalInk local{Raster<std::uint8_t>(darkness.width, darkness.height), 0};
  const float certain = 0.5f * *std::max_element(darkness.data.begin(), darkness.data.end());
  double sum = 0;
  long pixels = 0;
  for (int y = 0; y < darkness.height; ++y)
    for (int x = 0; x < darkness.width; ++x) {
      const float here = darkness(x, y);
      if (here <= weak) continue;
      const Pixel core = here > certain ? Pixel{x, y} : core_of(darkness, {x, y});
      const float half = 0.5f * darkness(core.x, core.y);
      if (here <= half && !goes_on_beyond(darkness, {x, y}, core, weak)) continue;
      local.ink(x, y) = 1;
      sum += std::max(weak, static_cast<double>(half));
      ++pixels;
    }
  local.mean_threshold = pixels > 0 ? sum / static_cast<double>(pixels) : weak;
  return local;
}

// A component of the mask, summed over its pixels.
struct Amount {
  long pixels = 0;
  double darkness = 0;
  float darkest = 0;
  float lightest = 1;
};

// Turns over the components of pixels equal to `value` of which unwanted(amount) is true.
template <class Unwanted>
void turn_over(Raster<std::uint8_t>& mask, std::uint8_t value, bool corners, const Raster<float>& darkness, Unwanted unwanted) {
  const std::vector<Run> runs = runs_of(mask, value);
  UnionFind pieces = pieces_of(runs, corners);
  std::vector<Amount> amounts(runs.size());
  const auto amount_of = [&](std::size_t run) -> Amount& { return amounts[at(pieces.find(static_cast<int>(run)))]; };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Amount& a = amount_of(i);
    for (int x = runs[i].first; x <= runs[i].last; ++x) {
      const float d = darkness(x, runs[i].y);
      ++a.pixels;
      a.darkness += d;
      a.darkest = std::max(a.darkest, d);
      a.lightest = std::min(a.lightest, d);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!unwanted(amount_of(i))) continue;
    for (int x = runs[i].first; x <= runs[i].last; ++x) mask(x, runs[i].y) ^= 1;
  }
}

// Gaps in a soft stroke: small holes through which no paper is seen.
void fill_pinholes(Raster<std::uint8_t>& ink, const Raster<float>& darkness, const Levels& levels, int pixel) {
  turn_over(ink, 0, false, darkness, [&](const Amount& a) { return a.pixels <= kPinhole * pixel && a.lightest > levels.weak; });
}

// Specks: no dark pixel in them, or too little ink altogether.
void drop_specks(Raster<std::uint8_t>& ink, const Raster<float>& darkness, const Levels& levels, int pixel) {
  const double least = pixel * levels.full * (levels.grain > kAnyGrain ? kSpeckInGrain : kSpeck);
  turn_over(ink, 1, true, darkness, [&](const Amount& a) { return a.darkest < kSeedFactor * levels.weak || a.darkness < least; });
}

// The two grey levels of a pure black-and-white picture, if it is one with a visible difference.
std::optional<std::pair<int, int>> two_tones(const Image& image) {
  const auto [low, high] = std::minmax_element(image.grey.begin(), image.grey.end());
  const std::pair<int, int> tones{*low, *high};
  if (tones.second - tones.first < 2 * kFaintest * 255) return std::nullopt;
  const bool pure =
      std::all_of(image.grey.begin(), image.grey.end(), [&](int g) { return g == tones.first || g == tones.second; });
  return pure ? std::optional(tones) : std::nullopt;
}

// Ink is exactly what is darker than the threshold.
Binarisation below(const View& view, double threshold) {
  Binarisation result{
      Raster<std::uint8_t>(view.width(), view.height()), Raster<float>(view.width(), view.height()), threshold, false, 0, false};
  for (int y = 0; y < view.height(); ++y)
    for (int x = 0; x < view.width(); ++x) {
      result.ink(x, y) = view(x, y) < threshold;
      result.darkness(x, y) = static_cast<float>(255 - view(x, y)) / 255.0f;
    }
  return result;
}

Raster<std::uint8_t> standing_out(const Raster<float>& darkness, double weak) {
  Raster<std::uint8_t> ink(darkness.width, darkness.height);
  std::transform(darkness.data.begin(), darkness.data.end(), ink.data.begin(), [&](float d) { return d > weak; });
  return ink;
}

// Full ink is that of what is dark enough, and dark enough is a part of full ink.
Levels levels_above(const Raster<float>& darkness, double faintest) {
  Levels levels = measure_levels(darkness, 0, faintest);
  for (int round = 0; round < 3; ++round) levels = measure_levels(darkness, faintest * levels.full, faintest);
  return levels;
}

// How dark what was drawn over ruled lines is where it is full; 0 where nothing was.
double drawn_over(const Raster<float>& darkness, double ruling) {
  Histogram histogram(1024, 0, 1);
  for (const float d : darkness.data) histogram.add(d);
  long drawn = 0;
  for (std::size_t i = at(static_cast<int>(1024 * std::min(1.0, kDrawn * ruling))); i < histogram.count.size(); ++i)
    drawn += histogram.count[i];
  const bool enough = static_cast<double>(drawn) > kDrawnPart * static_cast<double>(darkness.data.size());
  return enough ? histogram.quantile(0.9, kDrawn * ruling, 1) : 0;
}

// Above the lines of ruled paper, where something darker was drawn on it.
Levels levels_on_ruling(const Raster<float>& darkness, const Levels& levels) {
  const Ruling ruling = ruling_of(darkness, levels.weak);
  if (ruling.usual == 0) return levels;
  const double above = std::min(kOverRuling * ruling.most, kOfDrawn * drawn_over(darkness, ruling.usual));
  if (above < ruling.usual) return levels;
  Levels higher = measure_levels(darkness, above, kFaintOfFull);
  higher.ruled = true;
  return higher;
}

// Smoothed where there is grain.
struct Clear {
  Raster<float> smoothed;  // empty: nothing is
  Levels levels;

  const Raster<float>& of(const Raster<float>& darkness) const { return smoothed.data.empty() ? darkness : smoothed; }
};

Clear clear_of(const Raster<float>& darkness, std::optional<double> faintest) {
  Clear clear{{}, measure_levels(darkness, 0, kFaintOfFull)};
  if (clear.levels.grain > kGrainy) {
    clear.smoothed = darkness;
    soften(clear.smoothed);
    clear.levels = measure_levels(clear.smoothed, 0, kFaintOfFull);
  }
  const Raster<float>& seen = clear.of(darkness);
  clear.levels = faintest ? levels_above(seen, *faintest) : levels_on_ruling(seen, clear.levels);
  return clear;
}

// `pixel`: how many pixels of the view were one.
Binarisation automatic(const View& view, int pixel, std::optional<double> faintest) {
  auto [darkness, paper] = even_out(view);
  Clear found = clear_of(darkness, faintest);
  if (lighten_shades(view, paper, standing_out(found.of(darkness), found.levels.weak), darkness))
    found = clear_of(darkness, faintest);
  const Levels& levels = found.levels;
  const Raster<float>& clear = found.of(darkness);
  LocalInk local = half_of_local_ink(clear, levels.weak);
  fill_pinholes(local.ink, clear, levels, pixel);
  drop_specks(local.ink, clear, levels, pixel);
  const auto full = static_cast<float>(levels.full);
  for (float& d : darkness.data) d = std::clamp(d / full, 0.0f, 1.0f);
  return {std::move(local.ink),      std::move(darkness), paper.mean() * (1 - local.mean_threshold), false,
          levels.weak / levels.full, levels.ruled};
}

}  // namespace

Binarisation binarise(const Image& image, std::optional<double> threshold, int enlargement, std::optional<double> faintest) {
  if (image.width <= 0 || image.height <= 0) throw Error(ErrorCode::usage, "the image is empty");
  if (threshold) return below({image, 0}, *threshold);
  const bool inverted = light_on_dark({image, 0});
  const View view{image, static_cast<std::uint8_t>(inverted ? 255 : 0)};
  Binarisation result;
  if (const auto tones = two_tones(image)) {
    result = below(view, 0.5 * ((tones->first ^ view.flip) + (tones->second ^ view.flip)));
    for (std::size_t i = 0; i < result.ink.data.size(); ++i) result.darkness.data[i] = result.ink.data[i];
  } else {
    result = automatic(view, enlargement * enlargement, faintest);
  }
  result.inverted = inverted;
  if (inverted) result.threshold = 255 - result.threshold;
  return result;
}

}  // namespace inkgrid
