#include "ink.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace inkgrid {
namespace {

constexpr std::uint16_t kFar = std::numeric_limits<std::uint16_t>::max();

std::uint16_t one_more(std::uint16_t d) {
  return d == kFar ? kFar : static_cast<std::uint16_t>(d + 1);
}

Raster<std::uint16_t> l1_depth(const Raster<std::uint8_t>& mask) {
  const int w = mask.width, h = mask.height;
  Raster<std::uint16_t> depth(w, h, 0);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      if (!mask(x, y)) continue;
      const std::uint16_t left = x > 0 ? one_more(depth(x - 1, y)) : kFar;
      const std::uint16_t up = y > 0 ? one_more(depth(x, y - 1)) : kFar;
      depth(x, y) = std::min(left, up);
    }
  for (int y = h - 1; y >= 0; --y)
    for (int x = w - 1; x >= 0; --x) {
      if (!mask(x, y)) continue;
      if (x + 1 < w) depth(x, y) = std::min(depth(x, y), one_more(depth(x + 1, y)));
      if (y + 1 < h) depth(x, y) = std::min(depth(x, y), one_more(depth(x, y + 1)));
    }
  return depth;
}

// One row or column of the exact Euclidean distance transform: the lower envelope of the parabolas f[q] + (p - q)^2
// (Felzenszwalb and Huttenlocher 2012).
struct Envelope {
  std::vector<int> site;
  std::vector<double> bound;
  std::vector<float> value;

  explicit Envelope(int n)
      : site(static_cast<std::size_t>(n)), bound(static_cast<std::size_t>(n) + 1), value(static_cast<std::size_t>(n)) {}

  void transform(int n) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    std::size_t k = 0;
    bool any = false;
    for (int q = 0; q < n; ++q) {
      const double f = value[static_cast<std::size_t>(q)];
      if (!(f < std::numeric_limits<float>::max())) continue;
      double s = -kInfinite;
      while (any) {
        const int v = site[k];
        s = ((f + double(q) * q) - (double(value[static_cast<std::size_t>(v)]) + double(v) * v)) / (2.0 * (q - v));
        if (s > bound[k]) break;
        if (k == 0) {
          any = false;
          s = -kInfinite;
        } else {
          --k;
        }
      }
      k = any ? k + 1 : 0;
      any = true;
      site[k] = q;
      bound[k] = s;
      bound[k + 1] = kInfinite;
    }
    if (!any) return;
    const std::vector<float> f = value;
    std::size_t j = 0;
    for (int p = 0; p < n; ++p) {
      while (bound[j + 1] < p) ++j;
      const double d = p - site[j];
      value[static_cast<std::size_t>(p)] = static_cast<float>(d * d + double(f[static_cast<std::size_t>(site[j])]));
    }
  }
};

// Per pixel: the distance to the next pixel of the mask in its column, at most `most`.
Raster<std::uint16_t> column_distance(const Raster<std::uint8_t>& mask, std::uint16_t most) {
  Raster<std::uint16_t> distance(mask.width, mask.height);
  const auto next = [&](std::uint16_t d) { return std::min<std::uint16_t>(most, one_more(d)); };
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) distance(x, y) = mask(x, y) ? 0 : y == 0 ? most : next(distance(x, y - 1));
  for (int y = mask.height - 2; y >= 0; --y)
    for (int x = 0; x < mask.width; ++x) distance(x, y) = std::min(distance(x, y), next(distance(x, y + 1)));
  return distance;
}

// Pixels within `radius` (Euclidean, between centres) of one of the mask: in each row, the union of the chords of the discs.
Raster<std::uint8_t> dilated(const Raster<std::uint8_t>& mask, double radius) {
  const auto r = static_cast<float>(radius);  // a radius that is whole but for rounding errors is whole
  const int w = mask.width, reach = static_cast<int>(std::floor(std::max(0.0F, r)));
  std::vector<int> half_chord;  // by the distance from the centre
  for (int d = 0; d <= reach; ++d) half_chord.push_back(static_cast<int>(std::sqrt(r * r - static_cast<float>(d * d))));
  const auto distance = column_distance(mask, static_cast<std::uint16_t>(reach + 1));
  Raster<std::uint8_t> result(w, mask.height);
  std::vector<int> change(static_cast<std::size_t>(w) + 1);  // of the number of chords over a pixel, from the one before
  for (int y = 0; y < mask.height; ++y) {
    std::fill(change.begin(), change.end(), 0);
    for (int x = 0; x < w; ++x) {
      if (distance(x, y) > reach) continue;
      const int half = half_chord[distance(x, y)];
      ++change[static_cast<std::size_t>(std::max(0, x - half))];
      --change[static_cast<std::size_t>(std::min(w, x + half + 1))];
    }
    int chords = 0;
    for (int x = 0; x < w; ++x) result(x, y) = (chords += change[static_cast<std::size_t>(x)]) > 0;
  }
  return result;
}

Raster<std::uint8_t> inverted(Raster<std::uint8_t> mask) {
  for (auto& pixel : mask.data) pixel = !pixel;
  return mask;
}

bool is_centre(const Raster<std::uint16_t>& depth, int x, int y) {
  const auto d = depth(x, y);
  if (d == 0) return false;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (depth.contains(x + dx, y + dy) && depth(x + dx, y + dy) > d) return false;
  return true;
}

// Section 5: the L1 depth of the centre lines, averaged, and twice that.
double average_stroke_width(const Raster<std::uint16_t>& depth) {
  double sum = 0;
  long count = 0;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x)
      if (is_centre(depth, x, y) && depth(x, y) != kFar) {
        sum += 2.0 * depth(x, y);
        ++count;
      }
  return count ? sum / static_cast<double>(count) : std::min(depth.width, depth.height);
}

// The depth of the centre line that each stroke pixel belongs to: climbing the depth to its summit.
// Pixels are visited by falling depth, so that the answer of the higher neighbour is known.
Raster<float> normalized_centre_distance(const Raster<std::uint16_t>& depth) {
  std::vector<std::vector<std::size_t>> by_depth;
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    const std::size_t d = std::min<std::size_t>(depth.data[i], static_cast<std::size_t>(depth.width + depth.height));
    if (d == 0) continue;
    if (by_depth.size() <= d) by_depth.resize(d + 1);
    by_depth[d].push_back(i);
  }
  Raster<float> summit(depth.width, depth.height, 1.0f);
  const auto w = static_cast<std::size_t>(depth.width);
  for (std::size_t d = by_depth.size(); d-- > 0;) {
    for (const std::size_t i : by_depth[d]) {
      const int x = static_cast<int>(i % w), y = static_cast<int>(i / w);
      float top = static_cast<float>(d);
      std::uint16_t best = depth.data[i];
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (depth.contains(x + dx, y + dy) && depth(x + dx, y + dy) > best) {
            best = depth(x + dx, y + dy);
            top = summit(x + dx, y + dy);
          }
      summit.data[i] = top;
    }
  }
  for (std::size_t i = 0; i < depth.data.size(); ++i)
    summit.data[i] = depth.data[i] ? std::max(0.0f, 1.0f - static_cast<float>(depth.data[i]) / summit.data[i]) : 1.0f;
  return summit;
}

}  // namespace

Raster<float> distance_to(const Raster<std::uint8_t>& mask) {
  const int w = mask.width, h = mask.height;
  Raster<float> gap(w, h);
  Envelope column(h);
  for (int x = 0; x < w; ++x) {
    for (int y = 0; y < h; ++y) column.value[static_cast<std::size_t>(y)] = mask(x, y) ? 0.0f : std::numeric_limits<float>::max();
    column.transform(h);
    for (int y = 0; y < h; ++y) gap(x, y) = column.value[static_cast<std::size_t>(y)];
  }
  Envelope row(w);
  for (int y = 0; y < h; ++y) {
    float* const begin = &gap.data[gap.index(0, y)];
    std::copy(begin, begin + w, row.value.begin());
    row.transform(w);
    std::transform(row.value.begin(), row.value.end(), begin, [](float d2) { return std::sqrt(d2); });
  }
  return gap;
}

Raster<std::uint8_t> closed_ink(const Ink& ink, double radius) {
  const int w = ink.width(), h = ink.height(), margin = static_cast<int>(std::ceil(radius)) + 1;
  // What lies on the border goes on beyond it, ink and paper alike.
  Raster<std::uint8_t> extended(w + 2 * margin, h + 2 * margin);
  for (int y = 0; y < extended.height; ++y)
    for (int x = 0; x < extended.width; ++x)
      extended(x, y) = ink.mask(std::clamp(x - margin, 0, w - 1), std::clamp(y - margin, 0, h - 1));
  const Raster<std::uint8_t> closing = inverted(dilated(inverted(dilated(extended, radius)), radius));
  Raster<std::uint8_t> closed(w, h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) closed(x, y) = ink.mask(x, y) || closing(x + margin, y + margin);
  return closed;
}

Ink measure_ink(Binarisation binarisation) {
  Ink ink;
  ink.threshold = binarisation.threshold;
  ink.inverted = binarisation.inverted;
  ink.mask = std::move(binarisation.ink);
  ink.darkness = std::move(binarisation.darkness);
  ink.pixels = static_cast<long>(std::count(ink.mask.data.begin(), ink.mask.data.end(), std::uint8_t{1}));
  if (ink.pixels == 0) return ink;
  ink.depth = l1_depth(ink.mask);
  ink.gap = distance_to(ink.mask);
  ink.centre_distance = normalized_centre_distance(ink.depth);
  ink.stroke_width = average_stroke_width(ink.depth);
  return ink;
}

}  // namespace inkgrid
