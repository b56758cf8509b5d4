#include "ink/preset.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace inkgrid {
namespace {

constexpr double kSpreadOpacity = 0.065;  // where much is pale
constexpr double kSpreadCentres = 0.08;   // where enough of the ink is no rim
constexpr float kFullyDark = 0.97F;
constexpr double kMuchPale = 0.25;
constexpr double kSomeInside = 0.15;
constexpr double kEnoughInside = 0.3;
constexpr double kManySlits = 0.03;
constexpr double kSpreadSeams = 0.038;  // where strokes over each other leave grey seams; of pens of two widths it is less
constexpr double kSlitsWithSeams = 0.005;
constexpr double kUnevenWidth = 0.48;
constexpr int kStepsOfPixels = 1;     // of the depth, between one and the next place of a stroke on the pixels
constexpr double kSeveralPens = 1.8;  // uneven widths beyond this are pens, not strokes over strokes
constexpr double kSlit = 0.75;        // pens
constexpr double kFinePen = 4;        // px: a slimmer pen has no details below its width that pixels show
constexpr double kFinest = 0.5;
constexpr double kWidestGap = 6;  // px: pictures break strokes by so much

class Spread {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
    ++count_;
  }

  double count() const { return static_cast<double>(count_); }

  double deviation() const {
    const double mean = sum_ / std::max(1.0, count());
    return std::sqrt(std::max(0.0, squares_ / std::max(1.0, count()) - mean * mean));
  }

 private:
  double sum_ = 0, squares_ = 0;
  long count_ = 0;
};

// The rim of a stroke is grey for other reasons.
void measure_opacity(const Ink& ink, Sketchiness& sketchiness) {
  Spread inside, centres;
  long pale = 0;
  for (std::size_t i = 0; i < ink.mask.data.size(); ++i) {
    if (ink.depth.data[i] < 2) continue;
    const float dark = ink.darkness.data[i];
    inside.add(static_cast<double>(dark));
    if (ink.rise.data[i] < 1) continue;
    centres.add(static_cast<double>(dark));
    pale += dark < kFullyDark;
  }
  sketchiness.inside = inside.count() / static_cast<double>(ink.pixels);
  sketchiness.opacity_spread = inside.deviation();
  sketchiness.centre_spread = centres.deviation();
  sketchiness.pale = static_cast<double>(pale) / std::max(1.0, centres.count());
}

double width_spread(const Ink& ink) {
  std::vector<int> depths;
  for (int y = 0; y < ink.height(); ++y)
    for (int x = 0; x < ink.width(); ++x)
      if (ink.mask(x, y) && ink.centre_distance(x, y) == 0) depths.push_back(ink.depth(x, y));
  if (depths.empty()) return 0;
  std::sort(depths.begin(), depths.end());
  const int steps = depths[depths.size() * 9 / 10] - depths[depths.size() / 10];
  return steps > kStepsOfPixels ? 2.0 * steps / ink.stroke_width : 0;
}

}  // namespace

Sketchiness measure_sketchiness(const Ink& ink, double pen_width) {
  Sketchiness sketchiness;
  if (ink.pixels == 0) return sketchiness;
  measure_opacity(ink, sketchiness);
  sketchiness.slits = slit_share(ink, kSlit * pen_width);
  sketchiness.uneven_width = width_spread(ink);
  return sketchiness;
}

Preset choose_preset(const Ink& ink, double pen_width) {
  const Sketchiness s = measure_sketchiness(ink, pen_width);
  const bool pale = s.inside > kSomeInside && s.opacity_spread > kSpreadOpacity && s.pale > kMuchPale;
  const bool unequal = s.inside > kEnoughInside && s.centre_spread > kSpreadCentres;
  const bool seams = s.centre_spread > kSpreadSeams;
  const bool uneven = s.uneven_width > kUnevenWidth && s.uneven_width < kSeveralPens;
  const bool overdrawn = uneven && s.slits > (seams ? kSlitsWithSeams : kManySlits);
  return pale || unequal || overdrawn ? Preset::rough : Preset::clean;
}

PresetValues preset_values(Preset preset, double stroke_width, int enlargement) {
  const double gap = std::min(1.0, kWidestGap * enlargement / stroke_width);
  if (preset == Preset::rough) return {0.45, 1.5, gap};
  const double fineness = std::clamp(kFinePen / stroke_width, kFinest, 1.0);
  return {0.3 * std::min(fineness, std::max(kFinest, stroke_width / kFinePen)), 0.7 * fineness, gap};
}

}  // namespace inkgrid
