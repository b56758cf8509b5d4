#include "scribbles/scribbles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace inkgrid {
namespace {

struct Span {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();

  void include(double x) {
    from = std::min(from, x);
    to = std::max(to, x);
  }
};

void include_disc(Span& span, Vec2 centre, double radius, double y) {
  const double squared = radius * radius - (y - centre.y) * (y - centre.y);
  if (squared < 0) return;
  span.include(centre.x - std::sqrt(squared));
  span.include(centre.x + std::sqrt(squared));
}

void include_edge(Span& span, Vec2 a, Vec2 b, double y) {
  if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y || a.y == b.y) return;
  span.include(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
}

// What the brush covers of a row between two points: the capsule around them is convex.
Span covered(Vec2 a, Vec2 b, double radius, double y) {
  Span span;
  include_disc(span, a, radius, y);
  include_disc(span, b, radius, y);
  const Vec2 side = radius * quarter_turn(unit(b - a));
  include_edge(span, a + side, b + side, y);
  include_edge(span, a - side, b - side, y);
  return span;
}

float factor_of(ScribbleKind kind) {
  return kind == ScribbleKind::less ? 0.5f : kind == ScribbleKind::more ? 2.0f : 1.0f;
}

// The first pixel of n whose centre is not before x, at most n.
int first_centre(double x, int n) {
  return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(n)));
}

void paint_capsule(ScaleMask& mask, Vec2 a, Vec2 b, double radius, float factor) {
  const int top = first_centre(std::min(a.y, b.y) - radius, mask.height);
  for (int row = top; row < mask.height && row + 0.5 <= std::max(a.y, b.y) + radius; ++row) {
    const Span span = covered(a, b, radius, row + 0.5);
    if (!(span.from <= span.to)) continue;
    const auto line = mask.factor.begin() + static_cast<std::ptrdiff_t>(row) * mask.width;
    const int from = first_centre(span.from, mask.width);
    const int to =
        static_cast<int>(std::clamp(std::floor(span.to + 0.5), static_cast<double>(from), static_cast<double>(mask.width)));
    std::fill(line + from, line + to, factor);
  }
}

}  // namespace

void paint_scribbles(ScaleMask& mask, std::span<const Scribble> scribbles) {
  for (const Scribble& scribble : scribbles)
    for (std::size_t i = 0; i < scribble.points.size(); ++i) {
      const Vec2 before = scribble.points[i > 0 ? i - 1 : 0];
      if (i == 0 && scribble.points.size() > 1) continue;
      paint_capsule(mask, before, scribble.points[i], scribble.radius, factor_of(scribble.kind));
    }
}

}  // namespace inkgrid
