#include "ink/preset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
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
constexpr double kPlain = 0.016;      // spread of the opacity that a pen of even ink does not have
constexpr double kOnePen = 0.8;
constexpr int kStepsOfOnePen = 2;      // of the depth: a pen's places on the pixels
constexpr double kPartOfOnePen = 0.3;  // of the depth of a broad pen
constexpr int kSeam = 2;               // px from a seam to the ink beside it
constexpr float kPaler = 0.1F;
constexpr double kFinePen = 4;  // px: a slimmer pen has no details below its width that pixels show
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

// Whether the ink is darker on both sides: where the rims of two strokes touch.
bool is_seam(const Ink& ink, int x, int y) {
  const auto darkest = [&](int dx, int dy) {
    float dark = 0;
    for (int k = 1; k <= kSeam; ++k)
      if (ink.mask.contains(x + k * dx, y + k * dy)) dark = std::max(dark, ink.darkness(x + k * dx, y + k * dy));
    return dark;
  };
  const float paler = ink.darkness(x, y) + kPaler;
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}})
    if (darkest(dx, dy) > paler && darkest(-dx, -dy) > paler) return true;
  return false;
}

// The rim of a stroke is grey for other reasons.
void measure_opacity(const Ink& ink, Sketchiness& sketchiness) {
  Spread inside, centres, plain;
  long pale = 0;
  for (int y = 0; y < ink.height(); ++y)
    for (int x = 0; x < ink.width(); ++x) {
      if (ink.depth(x, y) < 2) continue;
      const float dark = ink.darkness(x, y);
      inside.add(static_cast<double>(dark));
      if (ink.rise(x, y) < 1) continue;
      centres.add(static_cast<double>(dark));
      pale += dark < kFullyDark;
      if (!is_seam(ink, x, y)) plain.add(static_cast<double>(dark));
    }
  sketchiness.inside = inside.count() / static_cast<double>(ink.pixels);
  sketchiness.opacity_spread = inside.deviation();
  sketchiness.centre_spread = centres.deviation();
  sketchiness.plain_spread = plain.deviation();
  sketchiness.pale = static_cast<double>(pale) / std::max(1.0, centres.count());
}

// Of the centre lines, in order.
std::vector<int> centre_depths(const Ink& ink) {
  std::vector<int> depths;
  for (int y = 0; y < ink.height(); ++y)
    for (int x = 0; x < ink.width(); ++x)
      if (ink.mask(x, y) && ink.centre_distance(x, y) == 0) depths.push_back(ink.depth(x, y));
  std::sort(depths.begin(), depths.end());
  return depths;
}

double width_spread(const std::vector<int>& depths, double stroke_width) {
  if (depths.empty()) return 0;
  const int steps = depths[depths.size() * 9 / 10] - depths[depths.size() / 10];
  return steps > kStepsOfPixels ? 2.0 * steps / stroke_width : 0;
}

// The largest share of depths that one pen can have.
double share_of_one_pen(const std::vector<int>& depths) {
  std::ptrdiff_t most = 0;
  for (auto first = depths.begin(); first != depths.end(); first = std::upper_bound(first, depths.end(), *first)) {
    const int steps = std::max(kStepsOfOnePen, static_cast<int>(kPartOfOnePen * *first));
    most = std::max(most, std::lower_bound(first, depths.end(), *first + steps) - first);
  }
  return static_cast<double>(most) / std::max<double>(1, static_cast<double>(depths.size()));
}

}  // namespace

Sketchiness measure_sketchiness(const Ink& ink, double pen_width) {
  Sketchiness sketchiness;
  if (ink.pixels == 0) return sketchiness;
  measure_opacity(ink, sketchiness);
  sketchiness.slits = slit_share(ink, kSlit * pen_width);
  const std::vector<int> depths = centre_depths(ink);
  sketchiness.uneven_width = width_spread(depths, ink.stroke_width);
  sketchiness.one_pen = share_of_one_pen(depths);
  return sketchiness;
}

Preset choose_preset(const Ink& ink, double pen_width) {
  const Sketchiness s = measure_sketchiness(ink, pen_width);
  const bool pale = s.inside > kSomeInside && s.opacity_spread > kSpreadOpacity && s.pale > kMuchPale;
  const bool unequal = s.inside > kEnoughInside && s.centre_spread > kSpreadCentres;
  const bool seams = s.centre_spread > kSpreadSeams;
  const bool uneven = s.uneven_width > kUnevenWidth && s.uneven_width < kSeveralPens;
  const bool overdrawn = uneven && s.slits > (seams ? kSlitsWithSeams : kManySlits);
  // Lines of even ink that meet at small angles, as hair and grass, have slits and seams too, but elsewhere are one pen wide.
  const bool one_pen = s.plain_spread < kPlain && s.one_pen > kOnePen;
  return !one_pen && (pale || unequal || overdrawn) ? Preset::rough : Preset::clean;
}

PresetValues preset_values(Preset preset, double stroke_width, int enlargement) {
  const double gap = std::min(1.0, kWidestGap * enlargement / stroke_width);
  if (preset == Preset::rough) return {0.45, 1.5, gap};
  const double fineness = std::clamp(kFinePen / stroke_width, kFinest, 1.0);
  return {0.3 * std::min(fineness, std::max(kFinest, stroke_width / kFinePen)), 0.7 * fineness, gap};
}

}  // namespace inkgrid
