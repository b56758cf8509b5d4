#include "ink/slim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ink/pen_strokes.h"
#include "ink/preset.h"

namespace inkgrid {
namespace {

constexpr double kCellOfPen = 0.7;  // a grid cell is about so much of the pen's width at least
constexpr int kStepsOfShare = 3;    // to its double
constexpr double kFine = 0.785;     // strokes, half a step above a cell: up to here broader pens are slimmed
constexpr float kSideRise = 0.75F;  // of the depth from a pixel to the next, px: less than 1 on the middle of a stroke alone
constexpr float kDiagonalRise = 1.06F;
constexpr double kThin = 0.7;   // of the usual width: strokes above it count as usual
constexpr double kBroad = 1.5;  // of it, and half a pixel: strokes above that are of a broader pen
constexpr double kNearlyBroad = 1.3;
constexpr double kLeast = 1;     // px: half the width that is left of those at least
constexpr int kDepthLevels = 4;  // a pixel, when pixels are sorted by their depth

constexpr float kHalfPixel = 0.5F;  // from the middle of the outermost pixel to the rim

// Euclidean distance from the middle of each ink pixel to the rim, px.  What lies on the image's border goes on beyond it.
Raster<float> rim_distance(const Raster<std::uint8_t>& mask) {
  Raster<float> depth = depth_of(mask);
  for (float& d : depth.data)
    if (d > 0) d = std::max(0.0F, d - kHalfPixel);
  return depth;
}

// Whether the depth stops rising here as it does from a rim: the middle of a disc that no neighbour's holds, but for pixels.
bool is_middle(const Raster<float>& depth, int x, int y) {
  if (depth(x, y) <= 0) return false;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (depth.contains(x + dx, y + dy) && depth(x + dx, y + dy) > depth(x, y) + (dx && dy ? kDiagonalRise : kSideRise))
        return false;
  return true;
}

// A pixel wider than the disc, so that the pixels of the rim are in it too.
void raise_disc(Raster<float>& thickness, int cx, int cy, float radius) {
  const float reach = radius + 1;
  const int r = static_cast<int>(reach);
  for (int y = std::max(0, cy - r); y <= std::min(thickness.height - 1, cy + r); ++y) {
    const int half = static_cast<int>(std::sqrt(std::max(0.0F, reach * reach - static_cast<float>((y - cy) * (y - cy)))));
    for (int x = std::max(0, cx - half); x <= std::min(thickness.width - 1, cx + half); ++x)
      thickness(x, y) = std::max(thickness(x, y), radius);
  }
}

// The largest value of the ink within two pixels: pixels of a rough rim that no large disc happened to hold are not thin strokes.
Raster<float> widened(const Raster<float>& values) {
  Raster<float> out(values.width, values.height);
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x)
      for (int dy = -2; dy <= 2 && values(x, y) > 0; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
          if (values.contains(x + dx, y + dy)) out(x, y) = std::max(out(x, y), values(x + dx, y + dy));
  return out;
}

// The radius of the largest disc of ink that holds each pixel (the local thickness of Hildebrand and Rueegsegger, 1997), px.
Raster<float> thickness_of(const Raster<float>& depth) {
  Raster<float> thickness = depth;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x)
      if (is_middle(depth, x, y)) raise_disc(thickness, x, y, depth(x, y));
  return widened(thickness);
}

// Half the width of most strokes, px: the median over their length, which is their area over their width.
double usual_radius(const Raster<float>& depth, const Raster<float>& thickness) {
  std::vector<std::pair<float, double>> strokes;
  double length = 0;
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    if (depth.data[i] <= 0 || 2 * depth.data[i] < thickness.data[i]) continue;
    strokes.emplace_back(thickness.data[i], 1 / static_cast<double>(thickness.data[i]));
    length += strokes.back().second;
  }
  std::sort(strokes.begin(), strokes.end());
  std::size_t k = 0;
  for (double before = strokes[0].second; before < 0.5 * length && k + 1 < strokes.size(); before += strokes[k].second) ++k;
  return static_cast<double>(strokes[k].first);
}

// Per pixel on a stroke of a broader pen: half its width, px; elsewhere 0.  Where widths lie around the bound, it is broad all
// along.
Raster<float> broad_strokes(const Ink& ink, double usual) {
  const PenStrokes strokes = find_pen_strokes(ink.mask, ink.darkness, static_cast<float>(kBroad));
  Raster<float> broad(ink.width(), ink.height());
  for (const double bound : {kBroad, kNearlyBroad})
    for (const CentrePixel& c : strokes.centres) {
      const float radius = c.depth - kHalfPixel;
      const bool begun = bound == kBroad || broad(c.x, c.y) > 0;
      if (c.of_stroke && begun && static_cast<double>(radius) > bound * usual + 0.5) raise_disc(broad, c.x, c.y, radius);
    }
  return broad;
}

StrokeWidths widths_of(const Ink& ink) {
  StrokeWidths widths;
  widths.depth = rim_distance(ink.mask);
  widths.thickness = thickness_of(widths.depth);
  widths.usual = usual_radius(widths.depth, widths.thickness);
  widths.broad = broad_strokes(ink, widths.usual);
  return widths;
}

bool has_broad_strokes(const StrokeWidths& widths) {
  return std::any_of(widths.broad.data.begin(), widths.broad.data.end(), [](float radius) { return radius > 0; });
}

// How far the rim moves inwards where ink has this radius, px, and so has, or has not (0), a stroke of a broader pen.
double retreat(double radius, double broad, double usual, double share) {
  const double wide = radius > 2 * usual ? radius : broad;
  if (wide > 0) return std::max(0.0, wide - std::max(share * usual, kLeast));
  return (1 - share) * (radius < kThin * usual ? radius : usual);
}

// Whether the ink around a pixel hangs together without it and paper touches it: ink over corners, paper over sides.
bool is_simple(const Raster<std::uint8_t>& mask, int x, int y) {
  constexpr std::array<std::array<int, 2>, 9> kRing{
      {{1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}}};
  std::array<bool, 9> paper;
  for (std::size_t k = 0; k < kRing.size(); ++k)
    paper[k] = !mask(std::clamp(x + kRing[k][0], 0, mask.width - 1), std::clamp(y + kRing[k][1], 0, mask.height - 1));
  int connections = 0;
  for (std::size_t k = 0; k < 8; k += 2) connections += paper[k] && !(paper[k + 1] && paper[k + 2]);
  return connections == 1;
}

// Takes away from the rim inwards the pixels whose level is not above 0, as long as nothing breaks, vanishes or opens.
void peel(Raster<std::uint8_t>& mask, const Raster<float>& level, const Raster<float>& depth) {
  std::vector<std::vector<std::size_t>> by_depth;
  for (std::size_t i = 0; i < mask.data.size(); ++i) {
    if (!mask.data[i] || level.data[i] > 0) continue;
    const auto d = static_cast<std::size_t>(kDepthLevels * static_cast<double>(depth.data[i]));
    if (by_depth.size() <= d) by_depth.resize(d + 1);
    by_depth[d].push_back(i);
  }
  const auto width = static_cast<std::size_t>(mask.width);
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& layer : by_depth)
      std::erase_if(layer, [&](std::size_t i) {
        if (!is_simple(mask, static_cast<int>(i % width), static_cast<int>(i / width))) return false;
        mask.data[i] = 0;
        return changed = true;
      });
  }
}

// Slims the strokes of the mask; what is left of the ink above the new rim, px, and below it less than 0.
Raster<float> peeled(Raster<std::uint8_t>& mask, StrokeWidths widths, double share) {
  Raster<float> level = std::move(widths.thickness);
  const auto as_double = [](float value) { return static_cast<double>(value); };
  for (std::size_t i = 0; i < level.data.size(); ++i) {
    if (!mask.data[i]) continue;
    const double moved = retreat(as_double(level.data[i]), as_double(widths.broad.data[i]), widths.usual, share);
    level.data[i] = widths.depth.data[i] - static_cast<float>(moved);
  }
  peel(mask, level, widths.depth);
  return level;
}

bool has_rims(const Ink& ink) {
  return ink.pixels > 0 && ink.pixels < static_cast<long>(ink.mask.data.size());
}

bool may_be_slimmed(const Ink& ink, double spacing) {
  return spacing <= kFine && has_rims(ink);
}

}  // namespace

// In steps, so that most changes of the spacing leave the ink as it is; the usual spacing is the middle of one.
double slim_share(const Ink& ink, double spacing) {
  if (spacing >= kCellOfPen) return 1;
  const double usual = preset_values(Preset::clean, ink.stroke_width, ink.enlargement).spacing;
  const double steps = std::round(kStepsOfShare * std::log2(spacing / usual));
  return std::min(1.0, usual / kCellOfPen * std::exp2(steps / kStepsOfShare));
}

bool same_slimming(const Ink& ink, double spacing, double other) {
  return slim_share(ink, spacing) == slim_share(ink, other) && (spacing <= kFine) == (other <= kFine);
}

bool is_slimmed(const Ink& ink, double spacing) {
  if (!may_be_slimmed(ink, spacing)) return false;
  return slim_share(ink, spacing) < 1 || has_broad_strokes(widths_of(ink));
}

std::optional<Slimming> slimming_of(const Ink& ink, double spacing) {
  if (!may_be_slimmed(ink, spacing)) return std::nullopt;
  Slimming slimming{slim_share(ink, spacing), widths_of(ink)};
  if (slimming.share == 1 && !has_broad_strokes(slimming.widths)) return std::nullopt;
  return slimming;
}

Ink slim_ink(const Ink& ink, double share) {
  return has_rims(ink) ? slim_ink(ink, {share, widths_of(ink)}) : ink;
}

Ink slim_ink(const Ink& ink, Slimming slimming) {
  Binarisation slim{ink.mask, {}, ink.threshold, ink.inverted};
  slim.darkness = peeled(slim.ink, std::move(slimming.widths), slimming.share);
  for (std::size_t i = 0; i < slim.darkness.data.size(); ++i) {
    float& dark = slim.darkness.data[i];
    if (ink.mask.data[i])
      dark = slim.ink.data[i] ? std::clamp(dark + 0.5F, 0.5F, 1.0F) : std::clamp(dark + 0.5F, 0.0F, 0.5F);
    else if (dark != 0)
      dark = 0;
  }
  return measure_ink(std::move(slim), ink.enlargement);
}

}  // namespace inkgrid
