#include "refine/bundles.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/polyline.h"

namespace inkgrid {
namespace {

constexpr double kFarthest = 8;  // strokes
constexpr double kLikely = 0.6;
constexpr double kWidest = 4;    // strokes: no coarser grid
constexpr double kWide = 1.2;    // strokes: what is slimmer keeps the grid of the pen
constexpr double kMargin = 0.5;  // strokes: of the coarser grid around the ink

// Weights of a logistic rule.  They were fitted to flanks of sketches whose strokes people had grouped by hand (docs/METHOD.md).
struct Weights {
  double constant, gap, log_gap, log_aspect, own_end, other_end, clearance, meeting, sketchiness;
};
constexpr Weights kAlone{-2.462, -0.559, -0.701, 0.557, 2.071, 1.53, 1.703, 0.661, 0};
constexpr Weights kInDrawing{-4.411, -0.649, -0.97, 0.25, 1.781, 1.286, 2.222, 0.632, 11.1};
constexpr double kClear = 10;  // strokes: more tells no more

double logistic(const Weights& w, const Flank& flank, double sketchiness, double stroke_width) {
  const double gap = flank.gap / stroke_width, clearance = std::min(flank.clearance / stroke_width / kClear, 1.0);
  const double sum = w.constant + w.gap * gap + w.log_gap * std::log(gap) + w.log_aspect * std::log(flank.length / flank.gap) +
                     w.own_end * flank.own_ends + w.other_end * flank.other_ends + w.clearance * clearance +
                     w.meeting * flank.meetings + w.sketchiness * sketchiness;
  return 1 / (1 + std::exp(-sum));
}

void fill_triangle(Raster<std::uint8_t>& raster, Vec2 a, Vec2 b, Vec2 c) {
  constexpr double kRim = -0.05;  // barycentric: neighbouring triangles leave no seam
  const double area = cross(b - a, c - a);
  if (std::abs(area) < 1e-9) return;
  const auto first = [](double least) { return std::max(0, static_cast<int>(std::floor(least))); };
  const auto last = [](double most, int size) { return std::min(size - 1, static_cast<int>(std::ceil(most))); };
  for (int y = first(std::min({a.y, b.y, c.y})); y <= last(std::max({a.y, b.y, c.y}), raster.height); ++y)
    for (int x = first(std::min({a.x, b.x, c.x})); x <= last(std::max({a.x, b.x, c.x}), raster.width); ++x) {
      const Vec2 p{x + 0.5, y + 0.5};
      const double least = std::min({cross(b - a, p - a) / area, cross(c - b, p - b) / area, cross(a - c, p - c) / area});
      if (least >= kRim) raster(x, y) = 1;
    }
}

void fill_between(Raster<std::uint8_t>& raster, const Flank& flank) {
  for (std::size_t i = 0; i + 1 < flank.here.size(); ++i) {
    fill_triangle(raster, flank.here[i], flank.here[i + 1], flank.opposite[i]);
    fill_triangle(raster, flank.here[i + 1], flank.opposite[i + 1], flank.opposite[i]);
  }
}

void raise_disc(ScaleMask& scale, int x, int y, double radius, float factor) {
  const int reach = static_cast<int>(radius);
  for (int v = std::max(0, y - reach); v <= std::min(scale.height - 1, y + reach); ++v) {
    const int half = static_cast<int>(std::sqrt(radius * radius - (v - y) * (v - y)));
    const auto row = scale.factor.begin() + static_cast<std::ptrdiff_t>(v) * scale.width;
    for (int u = std::max(0, x - half); u <= std::min(scale.width - 1, x + half); ++u) row[u] = std::max(row[u], factor);
  }
}

// How many pens wide the ink with joined slits is, around its centre lines.
ScaleMask widths_of(const Ink& joined, const Raster<std::uint8_t>& slits) {
  ScaleMask scale{joined.width(), joined.height(), std::vector<float>(joined.mask.data.size(), 1.0f)};
  const Raster<float> from_slit = distance_to(slits);
  for (int y = 0; y < joined.height(); ++y)
    for (int x = 0; x < joined.width(); ++x) {
      const double depth = joined.depth(x, y), wide = std::min(kWidest, 2 * depth / joined.stroke_width);
      const bool centre = joined.mask(x, y) && joined.centre_distance(x, y) == 0;
      if (!centre || wide < kWide || from_slit(x, y) > depth + 1) continue;
      raise_disc(scale, x, y, depth + kMargin * joined.stroke_width, static_cast<float>(wide));
    }
  return scale;
}

}  // namespace

double one_line(const Flank& flank, double sketchiness, double stroke_width) {
  return logistic(kInDrawing, flank, sketchiness, stroke_width);
}

double sketchiness(const std::vector<Flank>& flanks, const std::vector<Chain>& chains, double stroke_width) {
  std::vector<std::uint8_t> flanked(chains.size());
  double bundled = 0, length = 0;
  for (const Flank& flank : flanks) {
    bundled += logistic(kAlone, flank, 0, stroke_width) * flank.length;
    for (const int c : {flank.chain, flank.other}) flanked[at(c)] = 1;
  }
  for (std::size_t c = 0; c < chains.size(); ++c)
    if (flanked[c]) length += lengths_along(chains[c].points).back();
  return length > 0 ? bundled / length : 0;
}

bool are_one_line(const Flank& flank, double sketchiness, double stroke_width) {
  return one_line(flank, sketchiness, stroke_width) >= kLikely;
}

FlankOptions flank_options(double stroke_width, int threads) {
  return {kFarthest * stroke_width, stroke_width, threads};
}

Bundles find_bundles(const std::vector<Chain>& chains, const Ink& ink, int threads) {
  const double width = ink.stroke_width;
  const auto flanks = find_flanks(chains, ink.width(), ink.height(), flank_options(width, threads));
  Bundles bundles;
  bundles.sketchiness = sketchiness(flanks, chains, width);
  for (const Flank& flank : flanks) {
    if (!are_one_line(flank, bundles.sketchiness, width)) continue;
    if (bundles.count++ == 0) bundles.slits = Raster<std::uint8_t>(ink.width(), ink.height());
    fill_between(bundles.slits, flank);
  }
  return bundles;
}

JoinedInk join_bundles(const Ink& ink, const Bundles& bundles, const ScaleMask* mask) {
  Raster<std::uint8_t> slits = bundles.slits;
  if (mask)
    for (std::size_t i = 0; i < slits.data.size(); ++i) slits.data[i] = slits.data[i] && mask->factor[i] >= 1;
  Binarisation joined{ink.mask, ink.darkness, ink.threshold, ink.inverted};
  for (std::size_t i = 0; i < slits.data.size(); ++i) joined.ink.data[i] |= slits.data[i];
  JoinedInk result{measure_ink(std::move(joined), ink.enlargement), {}};
  result.ink.stroke_width = ink.stroke_width;
  result.scale = widths_of(result.ink, slits);
  return result;
}

}  // namespace inkgrid
