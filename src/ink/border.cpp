#include "ink/border.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/median.h"

namespace inkgrid {
namespace {

constexpr double kWhole = 0.6;  // of the usual width: a stroke that is wider is seen whole
constexpr int kSlender = 4;     // times as long as wide: runs along the border instead of over it

// The image as seen from one side: how far along it, and how far inside.
class Side {
 public:
  Side(Raster<std::uint8_t>& mask, bool upright, bool far) : mask_(mask), upright_(upright), far_(far) {}

  int length() const { return upright_ ? mask_.height : mask_.width; }

  std::uint8_t& at(int along, int inside) const {
    const int across = far_ ? depth() - 1 - inside : inside;
    return upright_ ? mask_(across, along) : mask_(along, across);
  }

  // Ink that begins on the border, px.
  int width_at(int along) const {
    int inside = 0;
    while (inside < depth() && at(along, inside)) ++inside;
    return inside;
  }

 private:
  int depth() const { return upright_ ? mask_.width : mask_.height; }

  Raster<std::uint8_t>& mask_;
  bool upright_, far_;
};

struct AlongBorder {
  Side side;
  int first, length;
  int width;  // px that are seen
};

void find_along(const Side& side, std::vector<AlongBorder>& found) {
  std::vector<int> widths;
  for (int first = 0; first < side.length(); first += 1 + static_cast<int>(widths.size())) {
    widths.clear();
    for (int k = first; k < side.length() && side.at(k, 0); ++k) widths.push_back(side.width_at(k));
    if (widths.empty()) continue;
    const AlongBorder run{side, first, static_cast<int>(widths.size()), median(widths)};
    if (run.width > 1 && run.length >= kSlender * run.width) found.push_back(run);
  }
}

// The ink through a pixel in a direction.
struct Run {
  double length;  // px
  bool inside;    // ends before the border
};

Run run_through(const Raster<std::uint8_t>& mask, int x, int y, int dx, int dy) {
  Run run{1, true};
  for (const int way : {-1, 1}) {
    int k = 1;
    while (mask.contains(x + way * k * dx, y + way * k * dy) && mask(x + way * k * dx, y + way * k * dy)) ++k;
    run.length += k - 1;
    run.inside &= mask.contains(x + way * k * dx, y + way * k * dy);
  }
  run.length *= std::hypot(dx, dy);
  return run;
}

// The usual width of strokes that do not reach the border, px: the shortest run in four directions, the median over the pixels; 0
// where there are none.
double inner_width(const Raster<std::uint8_t>& mask) {
  const auto shorter = [](const Run& a, const Run& b) { return a.length < b.length; };
  std::vector<double> widths;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (!mask(x, y)) continue;
      const Run least = std::min({run_through(mask, x, y, 1, 0), run_through(mask, x, y, 0, 1), run_through(mask, x, y, 1, 1),
                                  run_through(mask, x, y, 1, -1)},
                                 shorter);
      if (least.inside) widths.push_back(least.length);
    }
  return widths.empty() ? 0 : median(std::move(widths));
}

}  // namespace

void end_strokes_at_border(Raster<std::uint8_t>& mask) {
  std::vector<AlongBorder> found;
  for (const bool upright : {false, true})
    for (const bool far : {false, true}) find_along({mask, upright, far}, found);
  if (found.empty()) return;
  const double usual = inner_width(mask);
  for (const AlongBorder& run : found)
    for (int k = run.first; k < run.first + run.length; ++k)
      if (run.width >= kWhole * usual && run.side.width_at(k) > 1) run.side.at(k, 0) = 0;
}

}  // namespace inkgrid
