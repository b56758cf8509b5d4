#include "base/contour.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/at.h"

namespace inkgrid {
namespace {

// The cells between four pixel centres, and their edges.  A ring of pixels around the raster mirrors its border at the level, so
// that lines end on the border itself.
class Contours {
 public:
  Contours(const Raster<float>& values, float level)
      : values_(values), level_(level), width_(values.width + 2), height_(values.height + 2) {
    next_.assign(2 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1);
    for (int y = 0; y + 1 < height_; ++y)
      for (int x = 0; x + 1 < width_; ++x) link(x, y);
  }

  std::vector<std::vector<Vec2>> lines() {
    std::vector<std::vector<Vec2>> lines;
    for (int first = 0; first < static_cast<int>(next_.size()); ++first)
      if (next_[at(first)] >= 0) lines.push_back(line_from(first));
    return lines;
  }

 private:
  // In coordinates of the ring.
  float value(int x, int y) const {
    const int i = std::clamp(x - 1, 0, values_.width - 1), j = std::clamp(y - 1, 0, values_.height - 1);
    const float inside = values_(i, j);
    return i == x - 1 && j == y - 1 ? inside : std::min(inside, 2 * level_ - inside);
  }

  // Of the edge from (x, y) to the right, or down.
  int edge(int x, int y, bool down) const { return 2 * (y * width_ + x) + down; }

  void link(int x, int y) {
    // The corners and edges in turn: top, right, bottom, left.
    const std::array<float, 4> corner{value(x, y), value(x + 1, y), value(x + 1, y + 1), value(x, y + 1)};
    const std::array<int, 4> edges{edge(x, y, false), edge(x + 1, y, true), edge(x, y + 1, false), edge(x, y, true)};
    const auto inside = [&](std::size_t k) { return corner[k % 4] > level_; };
    // Where two corners across are inside, the middle says whether they are joined.
    const bool joined = corner[0] + corner[1] + corner[2] + corner[3] > 4 * level_;
    const bool saddle = inside(0) == inside(2) && inside(1) == inside(3) && inside(0) != inside(1);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!inside(k) || inside(k + 1)) continue;
      std::size_t entry = k;
      do {
        entry = saddle && !joined ? entry + 3 : entry + 1;
      } while (inside(entry % 4) || !inside(entry % 4 + 1));
      next_[at(edges[k])] = edges[entry % 4];
    }
  }

  Vec2 crossing(int e) const {
    const int x = e / 2 % width_, y = e / 2 / width_;
    const bool down = e % 2 != 0;
    const float a = value(x, y), b = down ? value(x, y + 1) : value(x + 1, y);
    const double t = static_cast<double>((level_ - a) / (b - a));
    return Vec2{x - 0.5, y - 0.5} + t * (down ? Vec2{0, 1} : Vec2{1, 0});
  }

  std::vector<Vec2> line_from(int first) {
    std::vector<Vec2> line;
    for (int e = first; e >= 0;) {
      line.push_back(crossing(e));
      e = std::exchange(next_[at(e)], -1);
    }
    line.back() = line.front();
    return line;
  }

  const Raster<float>& values_;
  float level_;
  int width_, height_;
  std::vector<int> next_;  // per edge that a line leaves a cell by: the edge of the next crossing, or -1
};

}  // namespace

std::vector<std::vector<Vec2>> contours_at(const Raster<float>& values, float level) {
  return Contours(values, level).lines();
}

double enclosed_area(const std::vector<Vec2>& closed_line) {
  double twice = 0;
  for (std::size_t k = 0; k + 1 < closed_line.size(); ++k)
    twice += cross(closed_line[k] - closed_line.front(), closed_line[k + 1] - closed_line.front());
  return twice / 2;
}

}  // namespace inkgrid
