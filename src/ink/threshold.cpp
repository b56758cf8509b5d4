// What:   see threshold.h.  `auto`: divide by the paper, then half of the darkest ink nearby, then drop what is no stroke.
// Source: ours; the half level is where an antialiased edge really is (section 5 asks for a manual threshold).
// Differs: docs/METHOD.md, "Threshold".
// Cost:   about ten passes over the pixels; apart from the results one float a pixel, and the runs of the mask.
#include "ink/threshold.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "base/at.h"
#include "base/filters.h"
#include "base/union_find.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr int kBlocks = 256;           // the paper is estimated on about this many blocks along the shorter side
constexpr int kWindow = 20;            // blocks: no stroke is wider than twice this
constexpr float kFade = 0.97f;         // a block: the light of the paper falls by no more, what is darker is a patch of ink
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

// The drawing as dark lines on light paper, whichever way it came.
struct View {
  const Image& image;
  std::uint8_t flip;  // 255 turns light into dark

  int width() const { return image.width; }
  int height() const { return image.height; }
  std::uint8_t operator()(int x, int y) const {
    const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    return image.grey[i] ^ flip;
  }
};

struct Histogram {
  std::vector<long> count;
  float low, scale;

  Histogram(int bins, float from, float to)
      : count(static_cast<std::size_t>(bins)), low(from), scale(static_cast<float>(bins) / (to - from)) {}
  void add(float value) {
    ++count[static_cast<std::size_t>(std::clamp((value - low) * scale, 0.0f, static_cast<float>(count.size() - 1)))];
  }
  // The value below which the given fraction of the samples in [from, to) lies; `from` when there are none.
  double quantile(double fraction, double from, double to) const {
    const auto bin = [&](double v) {
      return static_cast<std::size_t>(std::clamp((v - low) * scale, 0.0, static_cast<double>(count.size())));
    };
    const std::size_t first = bin(from), last = bin(to);
    long total = 0, seen = 0;
    for (std::size_t i = first; i < last; ++i) total += count[i];
    if (total == 0) return from;
    std::size_t i = first;
    for (; i + 1 < last && static_cast<double>(seen += count[i]) < fraction * static_cast<double>(total);) ++i;
    return low + (static_cast<double>(i) + 0.5) / scale;
  }
};

int block_size(const View& view) {
  return std::max(1, (std::min(view.width(), view.height()) + kBlocks - 1) / kBlocks);
}

// One value a block of size x size pixels: the extreme of the block under `before`.
template <class Before>
Raster<float> block_extreme(const View& view, int size, Before before) {
  Raster<float> blocks((view.width() + size - 1) / size, (view.height() + size - 1) / size, before(1.0f, 0.0f) ? -1.0f : 256.0f);
  for (int y = 0; y < view.height(); ++y)
    for (int i = 0; i < blocks.width; ++i) {
      std::uint8_t extreme = view(i * size, y);
      for (int x = i * size + 1; x < std::min(view.width(), (i + 1) * size); ++x)
        if (before(view(x, y), extreme)) extreme = view(x, y);
      float& block = blocks(i, y / size);
      if (before(static_cast<float>(extreme), block)) block = extreme;
    }
  return blocks;
}

// Pixels darker and lighter than the middle between two tones.
struct Share {
  long dark = 0, light = 0;

  // Pixels first..last of row y against half of `both_tones`.
  void count(const View& view, int first, int last, int y, int both_tones) {
    int below = 0, above = 0;
    for (int x = first; x <= last; ++x) {
      below += 2 * view(x, y) < both_tones;
      above += 2 * view(x, y) > both_tones;
    }
    dark += below;
    light += above;
  }
};

// Which of two tones is the paper: the more frequent one, near the strokes, in the whole and along the border.
bool light_on_dark(const View& view) {
  const int size = block_size(view), right = view.width() - 1, bottom = view.height() - 1;
  const Raster<float> lightest = window_extreme(block_extreme(view, size, std::greater<>()), kWindow, std::greater<>());
  const Raster<float> darkest = window_extreme(block_extreme(view, size, std::less<>()), kWindow, std::less<>());
  const float white = *std::max_element(lightest.data.begin(), lightest.data.end());
  const float black = *std::min_element(darkest.data.begin(), darkest.data.end());
  const int both = static_cast<int>(white + black);
  Share near, whole, border;
  for (int y = 0; y <= bottom; ++y) {
    whole.count(view, 0, right, y, both);
    border.count(view, 0, y == 0 || y == bottom ? right : 0, y, both);
    border.count(view, right, right, y, both);
    for (int i = 0; i < lightest.width; ++i) {
      const float high = lightest(i, y / size), low = darkest(i, y / size);
      if (high - low <= 0.3f * (white - black)) continue;
      near.count(view, i * size, std::min(right, (i + 1) * size - 1), y, static_cast<int>(high + low));
    }
  }
  return near.dark > near.light && whole.dark > whole.light && (border.dark > border.light || whole.dark > 3 * whole.light);
}

// Linear interpolation between the centres of blocks: for each pixel along one axis the block before it and the part of the next.
struct Axis {
  std::vector<int> first;
  std::vector<float> part;

  Axis(int pixels, int block, int blocks) {
    for (int p = 0; p < pixels; ++p) {
      const float at = (static_cast<float>(p) + 0.5f) / static_cast<float>(block) - 0.5f;
      const float inside = std::clamp(at, 0.0f, static_cast<float>(blocks - 1));
      first.push_back(std::min(static_cast<int>(inside), std::max(0, blocks - 2)));
      part.push_back(inside - static_cast<float>(first.back()));
    }
  }
};

// The light of the bare paper, smooth over the picture.
struct Paper {
  int block = 1;        // px
  Raster<float> level;  // grey level at the centre of each block
};

// The least light of paper that is near lighter paper: it fades by no more than kFade a block.
Raster<float> fading(Raster<float> level) {
  filter_lines(level, [](std::vector<float>& line) {
    for (std::size_t i = 1; i < line.size(); ++i) line[i] = std::max(line[i], kFade * line[i - 1]);
    for (std::size_t i = line.size() - 1; i > 0; --i) line[i - 1] = std::max(line[i - 1], kFade * line[i]);
  });
  return level;
}

// Fills in what is dark and narrower than the window.  The margin lets the window hang over the border, where a slope of
// the light would else be cut off.
Raster<float> close_gaps(const Raster<float>& level) {
  Raster<float> padded(level.width + 2 * kWindow, level.height + 2 * kWindow, 0.0f);
  for (int y = 0; y < level.height; ++y) std::copy_n(&level.data[level.index(0, y)], level.width, &padded(kWindow, y + kWindow));
  padded = window_extreme(window_extreme(std::move(padded), kWindow, std::greater<>()), kWindow, std::less<>());
  Raster<float> closed(level.width, level.height);
  for (int y = 0; y < level.height; ++y) std::copy_n(&padded(kWindow, y + kWindow), level.width, &closed(0, y));
  return closed;
}

// Upper envelope: what remains when all that is dark and narrower than the window is filled in.
Paper first_paper(const View& view) {
  const int size = block_size(view);
  Raster<float> level = close_gaps(block_extreme(view, size, std::greater<>()));
  const Raster<float> least = fading(level);
  const float white = *std::max_element(level.data.begin(), level.data.end());
  Raster<float> known(level.width, level.height, 1.0f);
  for (std::size_t i = 0; i < level.data.size(); ++i) {
    // Far darker than the paper around it: a patch filled with ink, wider than the window.
    if (level.data[i] < 0.7f * least.data[i] || level.data[i] < 0.2f * white) known.data[i] = level.data[i] = 0;
  }
  return {size, SmoothField(std::move(known), 1).through(level)};
}

// Calls visit(x, y, light) row by row; light = 1 on bare paper.
template <class Visit>
void over_light(const View& view, const Paper& paper, Visit visit) {
  const Raster<float>& level = paper.level;
  const Axis across(view.width(), paper.block, level.width), down(view.height(), paper.block, level.height);
  std::vector<float> row(static_cast<std::size_t>(level.width + 1));
  for (int y = 0; y < view.height(); ++y) {
    const int above = down.first[at(y)], below = std::min(above + 1, level.height - 1);
    const float v = down.part[at(y)];
    for (int i = 0; i <= level.width; ++i) {
      const int block = std::min(i, level.width - 1);
      row[at(i)] = level(block, above) + v * (level(block, below) - level(block, above));
    }
    for (int x = 0; x < view.width(); ++x) {
      const auto i = static_cast<std::size_t>(across.first[at(x)]);
      const float paper_here = row[i] + across.part[at(x)] * (row[i + 1] - row[i]);
      visit(x, y, static_cast<float>(view(x, y)) / std::max(1.0f, paper_here));
    }
  }
}

// The mean of the pixels that are paper by the upper envelope: without its bias on grainy paper.
Paper estimate_paper(const View& view) {
  const Paper first = first_paper(view);
  Histogram light(4096, 0, 2);
  over_light(view, first, [&](int, int, float l) { light.add(l); });
  const double middle = light.quantile(0.5, 0.5, 2);
  const double spread = 1.5 * (light.quantile(0.5, middle, 2) - middle);  // from the brighter half, which has no ink
  const float margin = static_cast<float>(std::max(0.05, 3 * spread)), centre = static_cast<float>(middle);

  Raster<float> sum(first.level.width, first.level.height), weight(first.level.width, first.level.height);
  over_light(view, first, [&](int x, int y, float l) {
    if (std::abs(l - centre) > margin) return;
    sum(x / first.block, y / first.block) += static_cast<float>(view(x, y));
    weight(x / first.block, y / first.block) += 1;
  });
  return {first.block, SmoothField(std::move(weight), static_cast<float>(first.block * first.block)).through(sum)};
}

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
  double grain = 0;  // standard deviation of the darkness of bare paper
  double weak = 0;   // darkness of the weakest ink
  double full = 1;   // darkness of full ink
};

Levels measure_levels(const Raster<float>& darkness) {
  Histogram histogram(6144, -0.5, 1.0);
  for (const float d : darkness.data) histogram.add(d);
  Levels levels;
  const double bin = 1.5 / 6144;
  levels.grain = std::max(0.0, -1.4826 * histogram.quantile(0.5, -0.5, bin));
  const double least = std::max(kFaintest, kNoiseFactor * levels.grain);
  levels.full = std::max(histogram.quantile(0.9, least, 1.0), 2 * least);
  levels.weak = std::max(least, kFaintOfFull * levels.full);
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

struct Run {
  int y, first, last;  // pixels first..last of row y
};

std::vector<Run> runs_of(const Raster<std::uint8_t>& mask, std::uint8_t value) {
  std::vector<Run> runs;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (mask(x, y) == value) {
        const int first = x;
        while (x + 1 < mask.width && mask(x + 1, y) == value) ++x;
        runs.push_back({y, first, x});
      }
  return runs;
}

// Runs that touch are one component; corners count when reach is 1, not when it is 0.
UnionFind join_runs(const std::vector<Run>& runs, int reach) {
  UnionFind sets(static_cast<int>(runs.size()));
  for (std::size_t i = 0, above = 0; i < runs.size(); ++i) {
    while (runs[above].y + 1 < runs[i].y || (runs[above].y < runs[i].y && runs[above].last + reach < runs[i].first)) ++above;
    for (std::size_t k = above; k < i && runs[k].y < runs[i].y && runs[k].first <= runs[i].last + reach; ++k)
      sets.unite(static_cast<int>(k), static_cast<int>(i));
  }
  return sets;
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
void turn_over(Raster<std::uint8_t>& mask, std::uint8_t value, int reach, const Raster<float>& darkness, Unwanted unwanted) {
  const std::vector<Run> runs = runs_of(mask, value);
  UnionFind sets = join_runs(runs, reach);
  std::vector<Amount> amounts(runs.size());
  const auto amount_of = [&](std::size_t run) -> Amount& { return amounts[at(sets.find(static_cast<int>(run)))]; };
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
void fill_pinholes(Raster<std::uint8_t>& ink, const Raster<float>& darkness, const Levels& levels) {
  turn_over(ink, 0, 0, darkness, [&](const Amount& a) { return a.pixels <= kPinhole && a.lightest > levels.weak; });
}

// Specks: no dark pixel in them, or too little ink altogether.
void drop_specks(Raster<std::uint8_t>& ink, const Raster<float>& darkness, const Levels& levels) {
  const double least = levels.full * (levels.grain > kAnyGrain ? kSpeckInGrain : kSpeck);
  turn_over(ink, 1, 1, darkness, [&](const Amount& a) { return a.darkest < kSeedFactor * levels.weak || a.darkness < least; });
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
  Binarisation result{Raster<std::uint8_t>(view.width(), view.height()), Raster<float>(view.width(), view.height()), threshold,
                      false};
  for (int y = 0; y < view.height(); ++y)
    for (int x = 0; x < view.width(); ++x) {
      result.ink(x, y) = view(x, y) < threshold;
      result.darkness(x, y) = static_cast<float>(255 - view(x, y)) / 255.0f;
    }
  return result;
}

Binarisation automatic(const View& view) {
  const Paper paper = estimate_paper(view);
  Raster<float> darkness(view.width(), view.height());
  over_light(view, paper, [&](int x, int y, float light) { darkness(x, y) = 1 - light; });
  Levels levels = measure_levels(darkness);
  Raster<float> smoothed;
  if (levels.grain > kGrainy) {
    smoothed = darkness;
    soften(smoothed);
    levels = measure_levels(smoothed);
  }
  const Raster<float>& clear = smoothed.data.empty() ? darkness : smoothed;
  LocalInk local = half_of_local_ink(clear, levels.weak);
  fill_pinholes(local.ink, clear, levels);
  drop_specks(local.ink, clear, levels);
  const auto full = static_cast<float>(levels.full);
  for (float& d : darkness.data) d = std::clamp(d / full, 0.0f, 1.0f);
  const double mean_paper =
      std::accumulate(paper.level.data.begin(), paper.level.data.end(), 0.0) / static_cast<double>(paper.level.data.size());
  return {std::move(local.ink), std::move(darkness), mean_paper * (1 - local.mean_threshold), false};
}

}  // namespace

Binarisation binarise(const Image& image, std::optional<double> threshold) {
  if (image.width <= 0 || image.height <= 0) throw Error(ErrorCode::usage, "the image is empty");
  if (threshold) return below({image, 0}, *threshold);
  const bool inverted = light_on_dark({image, 0});
  const View view{image, static_cast<std::uint8_t>(inverted ? 255 : 0)};
  Binarisation result;
  if (const auto tones = two_tones(image)) {
    result = below(view, 0.5 * ((tones->first ^ view.flip) + (tones->second ^ view.flip)));
    for (std::size_t i = 0; i < result.ink.data.size(); ++i) result.darkness.data[i] = result.ink.data[i];
  } else {
    result = automatic(view);
  }
  result.inverted = inverted;
  if (inverted) result.threshold = 255 - result.threshold;
  return result;
}

}  // namespace inkgrid
