#include "scribbles/touched.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace inkgrid {
namespace {

constexpr double kSlack = 2.5;  // px: triangles on the rim of the band read the gap beyond it

struct Step {
  int dx, dy;
  float length;
};
constexpr std::array<Step, 8> kSteps{{{1, 0, 1},
                                      {-1, 0, 1},
                                      {0, 1, 1},
                                      {0, -1, 1},
                                      {1, 1, 1.4142135f},
                                      {1, -1, 1.4142135f},
                                      {-1, 1, 1.4142135f},
                                      {-1, -1, 1.4142135f}}};

// Shortest ways over the pixels of the band from the scribbles.
class BandDistance {
 public:
  BandDistance(const ScaleMask& mask, const ScaleMask& bundles, const Ink& ink, double reach, double farthest)
      : mask_(mask),
        bundles_(bundles),
        ink_(ink),
        reach_(1.25 * reach * ink.stroke_width),
        farthest_(static_cast<float>(farthest)) {}

  Raster<float> measure() const {
    Raster<float> distance(ink_.width(), ink_.height(), kUnreached);
    using Entry = std::pair<float, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t i = 0; i < mask_.factor.size(); ++i) {
      if (mask_.factor[i] == 1 || !on_band(i)) continue;
      distance.data[i] = 0;
      queue.emplace(0, i);
    }
    while (!queue.empty()) {
      const auto [d, i] = queue.top();
      queue.pop();
      if (d > distance.data[i]) continue;
      const int x = static_cast<int>(i % static_cast<std::size_t>(ink_.width())),
                y = static_cast<int>(i / static_cast<std::size_t>(ink_.width()));
      for (const Step& step : kSteps) {
        const int nx = x + step.dx, ny = y + step.dy;
        const float further = d + step.length;
        if (!distance.contains(nx, ny) || further > farthest_ || further >= distance(nx, ny)) continue;
        const std::size_t n = distance.index(nx, ny);
        if (!on_band(n)) continue;
        distance.data[n] = further;
        queue.emplace(further, n);
      }
    }
    return distance;
  }

 private:
  bool on_band(std::size_t i) const {
    const float factor = std::max(1.0f, mask_.factor[i]) * (bundles_.factor.empty() ? 1.0f : bundles_.factor[i]);
    return static_cast<double>(ink_.gap.data[i]) <= reach_ * static_cast<double>(factor) + kSlack;
  }

  const ScaleMask& mask_;
  const ScaleMask& bundles_;
  const Ink& ink_;
  double reach_;
  float farthest_;
};

// Moves the connected set of reached pixels around (x, y) from `distance` into a part.
TouchedPart take_part(Raster<float>& distance, int x, int y) {
  struct Found {
    int x, y;
    float distance;
  };
  std::vector<Found> found{{x, y, distance(x, y)}};
  distance(x, y) = kUnreached;
  TouchedPart part{{x, y, x + 1, y + 1}, {}, distance.width, distance.height};
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Found at = found[k];
    part.box = {std::min(part.box.x0, at.x), std::min(part.box.y0, at.y), std::max(part.box.x1, at.x + 1),
                std::max(part.box.y1, at.y + 1)};
    for (const Step& step : kSteps) {
      const int nx = at.x + step.dx, ny = at.y + step.dy;
      if (!distance.contains(nx, ny) || distance(nx, ny) >= kUnreached) continue;
      found.push_back({nx, ny, distance(nx, ny)});
      distance(nx, ny) = kUnreached;
    }
  }
  part.distance = Raster<float>(part.box.width(), part.box.height(), kUnreached);
  for (const Found& f : found) part.distance(f.x - part.box.x0, f.y - part.box.y0) = f.distance;
  return part;
}

bool holds_ink(const TouchedPart& part, const Ink& ink) {
  for (int y = 0; y < part.box.height(); ++y)
    for (int x = 0; x < part.box.width(); ++x)
      if (part.distance(x, y) < kUnreached && ink.mask(part.box.x0 + x, part.box.y0 + y)) return true;
  return false;
}

}  // namespace

std::vector<TouchedPart> touched_parts(const ScaleMask& mask, const ScaleMask& bundles, const Ink& ink, double reach,
                                       double farthest) {
  Raster<float> distance = BandDistance(mask, bundles, ink, reach, farthest).measure();
  std::vector<TouchedPart> parts;
  for (int y = 0; y < distance.height; ++y)
    for (int x = 0; x < distance.width; ++x) {
      if (distance(x, y) >= kUnreached) continue;
      TouchedPart part = take_part(distance, x, y);
      if (holds_ink(part, ink)) parts.push_back(std::move(part));
    }
  return parts;
}

float distance_at(const TouchedPart& part, Vec2 p) {
  const auto pixel = [](double v, int count) { return static_cast<int>(std::clamp(std::floor(v), 0.0, count - 1.0)); };
  const int x = pixel(p.x, part.width) - part.box.x0, y = pixel(p.y, part.height) - part.box.y0;
  return part.distance.contains(x, y) ? part.distance(x, y) : kUnreached;
}

}  // namespace inkgrid
