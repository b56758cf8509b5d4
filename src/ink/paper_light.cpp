#include "ink/paper_light.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/filters.h"
#include "base/histogram.h"

namespace inkgrid {
namespace {

constexpr int kBlocks = 256;    // the paper is estimated on about this many blocks along the shorter side
constexpr int kWindow = 20;     // blocks: no stroke is wider than twice this
constexpr float kFade = 0.97f;  // a block: the light of the paper falls by no more, what is darker is a patch of ink

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
  Raster<float> level = close_gaps(lightest_of_blocks(view, size));
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

}  // namespace

double Paper::mean() const {
  return std::accumulate(level.data.begin(), level.data.end(), 0.0) / static_cast<double>(level.data.size());
}

Raster<float> lightest_of_blocks(const View& view, int size) {
  return block_extreme(view, size, std::greater<>());
}

bool light_on_dark(const View& view) {
  const int size = block_size(view), right = view.width() - 1, bottom = view.height() - 1;
  const Raster<float> lightest = window_extreme(lightest_of_blocks(view, size), kWindow, std::greater<>());
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

EvenLight even_out(const View& view) {
  EvenLight even{Raster<float>(view.width(), view.height()), estimate_paper(view)};
  over_light(view, even.paper, [&](int x, int y, float light) { even.darkness(x, y) = 1 - light; });
  return even;
}

}  // namespace inkgrid
