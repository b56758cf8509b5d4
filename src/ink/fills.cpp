#include "ink/fills.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ink/fill_outlines.h"
#include "ink/ink.h"
#include "ink/pen_strokes.h"
#include "ink/specks.h"

namespace inkgrid {
namespace {

constexpr double kWider = 2.5;          // inscribed circle of a fill over the strokes' width
constexpr double kWiderUneven = 3.2;    // where the ink is of uneven darkness, as overdrawn strokes are
constexpr double kWiderThanDots = 3;    // where the piece is round and on its own
constexpr double kWiderThanStar = 1.3;  // over the circle in the middle of as many strokes that cross
constexpr double kUneven = 0.05;        // standard deviation of the darkness inside
constexpr double kRound = 1.3;          // area of a round piece over that of its inscribed circle, at most
constexpr double kBulge = 1.5;          // depth of a stroke that may be part of a fill, over that of the pen
constexpr double kSmallest = 3;         // px, radius of the inscribed circle
constexpr double kOpening = 2.2;        // radius of the disc that fits into a fill but not into its strokes, over theirs

struct Pixel {
  int x, y;
};

// Per pixel of ink: the depth of the widest stroke whose discs cover it, 0 where no stroke explains it.
Raster<float> stroke_cover(const PenStrokes& strokes) {
  Raster<float> cover(strokes.depth.width, strokes.depth.height, 0.0F);
  for (const CentrePixel& c : strokes.centres) {
    if (!c.of_stroke) continue;
    const float radius = c.depth + 1;
    const int r = static_cast<int>(radius);
    for (int dy = -r; dy <= r; ++dy)
      for (int dx = -r; dx <= r; ++dx) {
        const int x = c.x + dx, y = c.y + dy;
        if (!cover.contains(x, y) || strokes.depth(x, y) <= 0) continue;
        if (static_cast<float>(dx * dx + dy * dy) <= radius * radius) cover(x, y) = std::max(cover(x, y), c.depth);
      }
  }
  return cover;
}

// Visits the pixels that `inside` accepts and that are connected to the first, each once.
template <class Inside, class Visit>
void flood(Raster<std::uint8_t>& seen, Pixel first, Inside inside, Visit visit) {
  std::vector<Pixel> stack{first};
  seen(first.x, first.y) = 1;
  while (!stack.empty()) {
    const Pixel p = stack.back();
    stack.pop_back();
    visit(p);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Pixel q{p.x + dx, p.y + dy};
        if (!seen.contains(q.x, q.y) || seen(q.x, q.y) || !inside(q.x, q.y)) continue;
        seen(q.x, q.y) = 1;
        stack.push_back(q);
      }
  }
}

// The area of each connected piece of ink that no stroke explains, at each of its pixels, px^2.
Raster<int> unexplained_areas(const PenStrokes& strokes, const Raster<float>& cover) {
  Raster<int> areas(cover.width, cover.height);
  Raster<std::uint8_t> seen(cover.width, cover.height);
  for (int y = 0; y < cover.height; ++y)
    for (int x = 0; x < cover.width; ++x) {
      const auto unexplained = [&](int i, int j) { return strokes.depth(i, j) > 0 && cover(i, j) == 0; };
      if (seen(x, y) || !unexplained(x, y)) continue;
      std::vector<Pixel> piece;
      flood(seen, {x, y}, unexplained, [&](Pixel p) { piece.push_back(p); });
      for (const Pixel p : piece) areas(p.x, p.y) = static_cast<int>(piece.size());
    }
  return areas;
}

// What is wider than the pen and smaller than the unexplained ink that it adjoins is part of that, not a stroke: a lock of hair,
// one side of the ring around a highlight.
void uncover_bulges(const PenStrokes& strokes, Raster<float>& cover) {
  const float pen = static_cast<float>(kBulge * strokes.width / 2) + 0.5F;
  if (std::none_of(cover.data.begin(), cover.data.end(), [&](float depth) { return depth > pen; })) return;
  const Raster<int> areas = unexplained_areas(strokes, cover);
  Raster<std::uint8_t> seen(cover.width, cover.height);
  for (int y = 0; y < cover.height; ++y)
    for (int x = 0; x < cover.width; ++x) {
      const auto wide = [&](int i, int j) { return cover(i, j) > pen; };
      if (seen(x, y) || !wide(x, y)) continue;
      std::vector<Pixel> bulge;
      int adjoining = 0;
      flood(seen, {x, y}, wide, [&](Pixel p) {
        bulge.push_back(p);
        for (int j = std::max(0, p.y - 1); j <= std::min(cover.height - 1, p.y + 1); ++j)
          for (int i = std::max(0, p.x - 1); i <= std::min(cover.width - 1, p.x + 1); ++i)
            adjoining = std::max(adjoining, areas(i, j));
      });
      if (static_cast<int>(bulge.size()) < adjoining)
        for (const Pixel p : bulge) cover(p.x, p.y) = 0;
    }
}

// A connected piece of ink that no stroke explains.
struct Piece {
  std::vector<Pixel> pixels;
  Pixel deepest{0, 0};
  float depth = 0;         // there
  float stroke_depth = 0;  // of the widest stroke that leads into it
};

Piece collect_piece(const PenStrokes& strokes, const Raster<float>& cover, Raster<std::uint8_t>& seen, Pixel first) {
  Piece piece;
  const auto unexplained = [&](int x, int y) { return strokes.depth(x, y) > 0 && cover(x, y) == 0; };
  flood(seen, first, unexplained, [&](Pixel p) {
    piece.pixels.push_back(p);
    if (strokes.depth(p.x, p.y) > piece.depth) {
      piece.depth = strokes.depth(p.x, p.y);
      piece.deepest = p;
    }
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (cover.contains(p.x + dx, p.y + dy)) piece.stroke_depth = std::max(piece.stroke_depth, cover(p.x + dx, p.y + dy));
  });
  return piece;
}

// Into how many arms the ink falls that leaves the piece: runs of ink on a circle half as wide again as its own.
int arms_of(const Piece& piece, const Raster<float>& depth) {
  const double radius = 1.5 * static_cast<double>(piece.depth) + 1;
  const int steps = static_cast<int>(std::ceil(8 * radius));
  const auto ink_at = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / steps;
    const int x = piece.deepest.x + static_cast<int>(std::lround(radius * std::cos(angle)));
    const int y = piece.deepest.y + static_cast<int>(std::lround(radius * std::sin(angle)));
    return depth.contains(x, y) && depth(x, y) > 0;
  };
  int arms = 0;
  for (int k = 0; k < steps; ++k) arms += ink_at(k) && !ink_at(k + 1);
  return arms;
}

bool is_round(const Piece& piece) {
  return static_cast<double>(piece.pixels.size()) < kRound * std::numbers::pi * piece.depth * piece.depth;
}

// Not at the rim, which is grey for other reasons.
bool is_uneven(const Piece& piece, const PenStrokes& strokes, const Raster<float>& darkness) {
  double sum = 0, squares = 0, count = 0;
  for (const Pixel p : piece.pixels) {
    if (strokes.depth(p.x, p.y) < 2) continue;
    const double dark = static_cast<double>(darkness(p.x, p.y));
    sum += dark;
    squares += dark * dark;
    ++count;
  }
  return count > 0 && squares / count - (sum / count) * (sum / count) > kUneven * kUneven;
}

// n strokes of half-width r that cross at even angles hold a circle of radius r / sin(pi / n).
bool is_fill(const Piece& piece, const PenStrokes& strokes, const Raster<float>& darkness) {
  // In an image of a few rows, depth is the length of what is drawn.
  const auto side = static_cast<float>(std::min(darkness.width, darkness.height));
  const bool everywhere = piece.pixels.size() == darkness.data.size();
  if (piece.depth < kSmallest || (piece.depth > side && !everywhere)) return false;
  const int arms = everywhere ? 0 : arms_of(piece, strokes.depth);  // where all is ink, depth has no bound
  double wider = is_uneven(piece, strokes, darkness) ? kWiderUneven : kWider;
  if (arms > 4) wider = std::max(wider, kWiderThanStar / std::sin(std::numbers::pi / arms));
  if (piece.stroke_depth == 0 && is_round(piece)) wider = std::max(wider, kWiderThanDots);
  return piece.depth > wider * std::max(strokes.width / 2, static_cast<double>(piece.stroke_depth));
}

// The part of the drawing around a piece.
struct Window {
  int x0, y0, width, height;
};

Window window_around(const Piece& piece, int margin, const Raster<float>& depth) {
  int x0 = depth.width, y0 = depth.height, x1 = 0, y1 = 0;
  for (const Pixel p : piece.pixels) {
    x0 = std::min(x0, p.x);
    x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y);
    y1 = std::max(y1, p.y);
  }
  x0 = std::max(0, x0 - margin);
  y0 = std::max(0, y0 - margin);
  x1 = std::min(depth.width - 1, x1 + margin);
  y1 = std::min(depth.height - 1, y1 + margin);
  return {x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

// Where strokes enter a fill, their discs reach into it: given back is what a disc covers that fits into the ink there, but not
// into those strokes.
void add_fill(const Piece& piece, const PenStrokes& strokes, Raster<std::uint8_t>& filled) {
  for (const Pixel p : piece.pixels) filled(p.x, p.y) = 1;
  if (piece.stroke_depth == 0) return;
  const auto radius = static_cast<float>(kOpening) * piece.stroke_depth;
  const Window window = window_around(piece, static_cast<int>(std::ceil(3 * radius)), strokes.depth);
  Raster<std::uint8_t> middle(window.width, window.height);
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) middle(x, y) = strokes.depth(window.x0 + x, window.y0 + y) > radius;
  const Raster<float> distance = distance_to(middle);
  Raster<std::uint8_t> seen(window.width, window.height);
  const auto opened = [&](int x, int y) { return distance(x, y) < radius; };
  for (const Pixel p : piece.pixels) {
    const Pixel q{p.x - window.x0, p.y - window.y0};
    if (seen(q.x, q.y) || !opened(q.x, q.y)) continue;
    flood(seen, q, opened, [&](Pixel o) { filled(window.x0 + o.x, window.y0 + o.y) = 1; });
  }
}

Fills number_fills(const Raster<std::uint8_t>& filled) {
  Fills fills;
  Raster<std::uint8_t> seen(filled.width, filled.height);
  for (int y = 0; y < filled.height; ++y)
    for (int x = 0; x < filled.width; ++x) {
      if (!filled(x, y) || seen(x, y)) continue;
      if (fills.count == 0) fills.region = Raster<int>(filled.width, filled.height, -1);
      flood(
          seen, {x, y}, [&](int i, int j) { return filled(i, j) != 0; }, [&](Pixel p) { fills.region(p.x, p.y) = fills.count; });
      ++fills.count;
    }
  return fills;
}

}  // namespace

Fills find_fills(const Binarisation& ink) {
  const PenStrokes strokes = find_pen_strokes(close_specks(ink.ink), ink.darkness);
  Raster<float> cover = stroke_cover(strokes);
  uncover_bulges(strokes, cover);
  Raster<std::uint8_t> seen(ink.ink.width, ink.ink.height), filled(ink.ink.width, ink.ink.height);
  for (int y = 0; y < filled.height; ++y)
    for (int x = 0; x < filled.width; ++x) {
      if (strokes.depth(x, y) <= 0 || seen(x, y) || cover(x, y) > 0) continue;
      const Piece piece = collect_piece(strokes, cover, seen, {x, y});
      if (is_fill(piece, strokes, ink.darkness)) add_fill(piece, strokes, filled);
    }
  Fills fills = number_fills(filled);
  fills.stroke_width = strokes.width;
  trace_outlines(fills, ink);
  return fills;
}

Binarisation without_fills(Binarisation ink, const Fills& fills) {
  constexpr int kRim = 2;  // px
  if (fills.count == 0) return ink;
  for (int y = 0; y < ink.ink.height; ++y)
    for (int x = 0; x < ink.ink.width; ++x) {
      if (fills.region(x, y) < 0) continue;
      ink.ink(x, y) = 0;
      for (int dy = -kRim; dy <= kRim; ++dy)
        for (int dx = -kRim; dx <= kRim; ++dx)
          if (ink.ink.contains(x + dx, y + dy) && !ink.ink(x + dx, y + dy)) ink.darkness(x + dx, y + dy) = 0;
    }
  return ink;
}

}  // namespace inkgrid
