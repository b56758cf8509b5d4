#include "ink/ink.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/at.h"
#include "base/parallel.h"
#include "base/sample.h"
#include "ink/border.h"

namespace inkgrid {
namespace {

constexpr std::uint16_t kFar = std::numeric_limits<std::uint16_t>::max();
constexpr int kStrip = 256;                                           // rows at a time
const float kNowhere = std::sqrt(std::numeric_limits<float>::max());  // px

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

// Rows of the exact Euclidean distance transform: the lower envelope of the parabolas f[q] + (p - q)^2, where f is the square of
// the distance in the column (Felzenszwalb and Huttenlocher 2012).
class Envelope {
 public:
  explicit Envelope(int width)
      : width_(width),
        columns_(static_cast<std::size_t>(width)),
        site_(static_cast<std::size_t>(width)),
        bound_(static_cast<std::size_t>(width) + 1) {}

  // From distances in the columns to those in the plane.  Between pixels of distance 0, nothing beyond them counts.
  void transform(float* row) {
    for (int first = 0; first < width_; ++first) {
      if (row[first] == 0) continue;
      const int end = static_cast<int>(std::find(row + first, row + width_, 0.0F) - row);
      const int from = std::max(0, first - 1), last = std::min(end, width_ - 1);
      std::copy(row + from, row + last + 1, columns_.begin() + from);
      transform(from, last, row);
      first = end;
    }
  }

 private:
  double square(int x) const { return static_cast<double>(columns_[at(x)] * columns_[at(x)]); }

  void transform(int first, int last, float* distances) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    int top = -1;
    for (int q = first; q <= last; ++q) {
      if (columns_[at(q)] == kFar) continue;
      const double f = square(q) + double(q) * q;
      double s = -kInfinite;
      while (top >= 0) {
        const int v = site_[at(top)];
        s = (f - (square(v) + double(v) * v)) / (2.0 * (q - v));
        if (s > bound_[at(top)]) break;
        s = -kInfinite;
        --top;
      }
      site_[at(++top)] = q;
      bound_[at(top)] = s;
      bound_[at(top + 1)] = kInfinite;
    }
    for (int p = first, k = 0; p <= last; ++p) {
      while (top >= 0 && bound_[at(k + 1)] < p) ++k;
      const double d = p - site_[at(k)];
      distances[p] = top < 0 ? kNowhere : std::sqrt(static_cast<float>(d * d + square(site_[at(k)])));
    }
  }

  int width_;
  std::vector<float> columns_;  // distances in the columns, px
  std::vector<int> site_;       // of each parabola of the envelope
  std::vector<double> bound_;   // where it begins
};

// Per pixel: the distance to the next pixel of the mask in its column, at most `most`.
template <class Distance>
Raster<Distance> column_distance(const Raster<std::uint8_t>& mask, Distance most) {
  constexpr int kBlock = 1024;  // px of a row: nothing is written where all of them are in the mask
  Raster<Distance> distance(mask.width, mask.height);
  const auto for_each_block = [&](int y, auto visit) {
    const std::uint8_t* const row = &mask(0, y);
    for (int x = 0; x < mask.width; x += kBlock) {
      const int end = std::min(mask.width, x + kBlock);
      if (std::find(row + x, row + end, 0) != row + end) visit(x, end);
    }
  };
  const auto nearer = [](Distance d, Distance neighbour) {
    return static_cast<Distance>(std::min<decltype(d + 1)>(d, neighbour + 1));
  };
  for (int y = 0; y < mask.height; ++y)
    for_each_block(y, [&](int first, int end) {
      for (int x = first; x < end; ++x) distance(x, y) = mask(x, y) ? Distance{0} : most;
      for (int x = first; x < end && y > 0; ++x) distance(x, y) = nearer(distance(x, y), distance(x, y - 1));
    });
  for (int y = mask.height - 2; y >= 0; --y)
    for_each_block(y, [&](int first, int end) {
      for (int x = first; x < end; ++x) distance(x, y) = nearer(distance(x, y), distance(x, y + 1));
    });
  return distance;
}

// Calls visit(first, end) for the blocks of a row of which any(value) holds somewhere, and skip(first, end) for the others.
template <class Value, class Any, class Visit, class Skip>
void for_each_block(const Value* row, int width, const Any& any, const Visit& visit, const Skip& skip) {
  constexpr int kBlock = 64;
  for (int first = 0; first < width; first += kBlock) {
    const int end = std::min(width, first + kBlock);
    int count = 0;
    for (int x = first; x < end; ++x) count += any(row[x]);
    count > 0 ? visit(first, end) : skip(first, end);
  }
}

// Calls visit(x) where a row of a mask is set; most of it is not.
template <class Visit>
void for_each_set(const std::uint8_t* row, int width, const Visit& visit) {
  for_each_block(
      row, width, [](std::uint8_t value) { return value != 0; },
      [&](int first, int end) {
        for (int x = first; x < end; ++x)
          if (row[x]) visit(x);
      },
      [](int, int) {});
}

// Calls visit(x, y) for the pixels within `radius` (Euclidean, between centres) of one of `value`, or for those that are not: in
// each row, the union of the chords of the discs.  A strip at a time, so that the distances of few rows are held at once; strips
// may be visited at the same time.
template <class Visit>
void for_each_within(const Raster<std::uint8_t>& mask, std::uint8_t value, double radius, bool within, int threads, Visit visit) {
  const auto r = static_cast<float>(radius);  // a radius that is whole but for rounding errors is whole
  const int w = mask.width, reach = static_cast<int>(std::floor(std::max(0.0F, r)));
  std::vector<int> half_chord;  // by the distance from the centre
  for (int d = 0; d <= reach; ++d) half_chord.push_back(static_cast<int>(std::sqrt(r * r - static_cast<float>(d * d))));
  const auto visit_strip = [&](int top, int bottom) {
    std::vector<int> change(static_cast<std::size_t>(w) + 1);  // of the number of chords over a pixel, from the one before
    const int first = std::max(0, top - reach);
    Raster<std::uint8_t> strip(w, std::min(mask.height, bottom + reach) - first);
    std::transform(&mask(0, first), &mask(0, first) + strip.data.size(), strip.data.begin(), [&](auto m) { return m == value; });
    const auto distance = column_distance(strip, static_cast<std::uint16_t>(reach + 1));
    for (int y = top; y < bottom; ++y) {
      std::fill(change.begin(), change.end(), 0);
      const std::uint16_t* const away = &distance(0, y - first);
      const auto add_chords = [&](int from, int end) {
        for (int x = from; x < end; ++x) {
          if (away[x] > reach) continue;
          const int half = half_chord[away[x]];
          ++change[at(std::max(0, x - half))];
          --change[at(std::min(w, x + half + 1))];
        }
      };
      for_each_block(
          away, w, [&](std::uint16_t d) { return d <= reach; }, add_chords, [](int, int) {});
      int chords = 0;
      const auto visit_changing = [&](int from, int end) {
        for (int x = from; x < end; ++x)
          if (((chords += change[at(x)]) > 0) == within) visit(x, y);
      };
      const auto visit_even = [&](int from, int end) {
        if ((chords > 0) != within) return;
        for (int x = from; x < end; ++x) visit(x, y);
      };
      for_each_block(
          change.data(), w, [](int c) { return c != 0; }, visit_changing, visit_even);
    }
  };
  for_ranges(threads, mask.height, std::max(kStrip, 4 * reach), visit_strip);
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

// By the depth of the centre line that each stroke pixel belongs to: climbing the depth to its summit.
// Pixels are visited by falling depth, so that the answer of the higher neighbour is known.
Raster<float> rise_of(const Raster<std::uint16_t>& depth) {
  std::vector<std::vector<std::size_t>> by_depth;
  for (std::size_t i = 0; i < depth.data.size(); ++i) {
    const std::size_t d = std::min<std::size_t>(depth.data[i], static_cast<std::size_t>(depth.width + depth.height));
    if (d == 0) continue;
    if (by_depth.size() <= d) by_depth.resize(d + 1);
    by_depth[d].push_back(i);
  }
  Raster<float> summit(depth.width, depth.height);
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
    if (depth.data[i]) summit.data[i] = std::min(1.0f, static_cast<float>(depth.data[i]) / summit.data[i]);
  return summit;
}

}  // namespace

Raster<float> distance_to(const Raster<std::uint8_t>& mask) {
  Raster<float> distance = column_distance(mask, static_cast<float>(kFar));
  Envelope envelope(mask.width);
  for (int y = 0; y < mask.height; ++y) envelope.transform(&distance(0, y));
  return distance;
}

Raster<std::uint8_t> closed_ink(const Ink& ink, double radius, int threads) {
  const int w = ink.width(), h = ink.height(), margin = static_cast<int>(std::ceil(radius)) + 1;
  // What lies on the border goes on beyond it, ink and paper alike.
  Raster<std::uint8_t> extended(w + 2 * margin, h + 2 * margin);
  for (int y = 0; y < extended.height; ++y) {
    const std::uint8_t* const row = &ink.mask(0, std::clamp(y - margin, 0, h - 1));
    std::uint8_t* const wider = &extended(0, y);
    for_each_set(row, w, [&](int x) { wider[x + margin] = 1; });
    if (row[0]) std::fill_n(wider, margin, std::uint8_t{1});
    if (row[w - 1]) std::fill_n(wider + margin + w, margin, std::uint8_t{1});
  }
  Raster<std::uint8_t> wide(extended.width, extended.height), closed(w, h);
  for_each_within(extended, 1, radius, true, threads, [&](int x, int y) { wide(x, y) = 1; });
  for_each_within(wide, 0, radius, false, threads, [&](int x, int y) {
    if (closed.contains(x - margin, y - margin)) closed(x - margin, y - margin) = 1;
  });
  for (int y = 0; y < h; ++y) for_each_set(&ink.mask(0, y), w, [&](int x) { closed(x, y) = 1; });
  return closed;
}

double depth_at(const Raster<std::uint8_t>& mask, Vec2 p, double most) {
  const double reach = most + 0.5;
  double nearest = reach * reach;
  const auto first = [&](double v) { return std::max(0, static_cast<int>(std::floor(v - reach))); };
  const auto last = [&](double v, int size) { return std::min(size - 1, static_cast<int>(std::ceil(v + reach))); };
  for (int y = first(p.y); y <= last(p.y, mask.height); ++y)
    for (int x = first(p.x); x <= last(p.x, mask.width); ++x)
      if (!mask(x, y)) nearest = std::min(nearest, norm2(Vec2{x + 0.5, y + 0.5} - p));
  return std::max(0.0, std::sqrt(nearest) - 0.5);
}

double slit_share(const Ink& ink, double width) {
  if (ink.pixels == 0) return 0;
  const double radius = width / 2;
  const auto closed = closed_ink(ink, radius);
  long slits = 0;
  // Of a square corner a disc leaves 0.41 radii.
  for_each_within(closed, 0, radius / 2 + 1, false, 1, [&](int x, int y) { slits += !ink.mask(x, y); });
  return static_cast<double>(slits) / static_cast<double>(ink.pixels);
}

Ink measure_ink(Binarisation binarisation, int enlargement) {
  Ink ink;
  ink.enlargement = enlargement;
  ink.threshold = binarisation.threshold;
  ink.inverted = binarisation.inverted;
  ink.faintest = binarisation.faintest;
  ink.ruled = binarisation.ruled;
  ink.mask = std::move(binarisation.ink);
  ink.darkness = std::move(binarisation.darkness);
  ink.pixels = static_cast<long>(std::count(ink.mask.data.begin(), ink.mask.data.end(), std::uint8_t{1}));
  if (ink.pixels == 0) return ink;
  end_strokes_at_border(ink.mask);
  ink.depth = l1_depth(ink.mask);
  ink.gap = distance_to(ink.mask);
  ink.rise = rise_of(ink.depth);
  ink.stroke_width = average_stroke_width(ink.depth);
  return ink;
}

bool over_ink(const Raster<std::uint8_t>& mask, Vec2 from, Vec2 to, double bridge) {
  const int steps = std::max(1, static_cast<int>(std::ceil(2 * norm(to - from))));
  double paper = 0;
  for (int k = 0; k <= steps; ++k) {
    const Vec2 p = lerp(from, to, static_cast<double>(k) / steps);
    paper = nearest(mask, p, std::uint8_t{0}) ? 0 : paper + 0.5;
    if (paper > bridge) return false;
  }
  return true;
}

}  // namespace inkgrid
