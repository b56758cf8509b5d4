#include "refine/zigzags.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/at.h"
#include "base/polyline.h"
#include "inkgrid/vec2.h"

namespace inkgrid {
namespace {

constexpr double kLongest = 6;    // widths, of what is left out
constexpr double kArrival = 1.5;  // widths, over which the direction of the chain is told
constexpr double kInside = 0.5;   // widths, the same at the ends of a chain
constexpr double kShort = 0.25;   // widths: a line without a direction of its own
constexpr double kBack = -0.2;    // cosine: what turns back
constexpr double kOn = 0.5;       // cosine: what goes on
constexpr double kSaved = 0.75;   // widths: the line has to be shorter by that, and
constexpr double kFolded = 2;     // times

// A chain with the lengths up to its points, and a width as the unit.
struct Path {
  const std::vector<Vec2>& points;
  std::vector<double> lengths;
  double width;

  // Into point i and out of it; at the ends of the chain within the part that begins or ends there.
  Vec2 before(std::size_t i) const {
    const bool start = lengths[i] < kInside * width;
    return start ? point_at(points, lengths, lengths[i] + kInside * width) - points[i]
                 : points[i] - point_at(points, lengths, lengths[i] - kArrival * width);
  }
  Vec2 after(std::size_t j) const {
    const bool end = lengths.back() - lengths[j] < kInside * width;
    return end ? points[j] - point_at(points, lengths, lengths[j] - kInside * width)
               : point_at(points, lengths, lengths[j] + kArrival * width) - points[j];
  }
};

// A part of a path between two of its points.
struct Part {
  std::size_t first, last;
};

// How straight the line from first to last goes on from what comes before and into what follows, and these into each other: the
// least cosine.  A line that is short has no direction of its own.
double straightness(const Path& path, Part part) {
  const Vec2 chord = path.points[part.last] - path.points[part.first], in = path.before(part.first), out = path.after(part.last);
  const Vec2 through = norm(chord) < kShort * path.width ? in + out : chord;
  return std::min({dot(unit(in), unit(through)), dot(unit(through), unit(out)), dot(unit(in), unit(out))});
}

bool turns_back(const Path& path, Part part, double span) {
  const Vec2 chord = path.points[part.last] - path.points[part.first];
  const Vec2 on = norm(chord) < kShort * path.width ? path.before(part.first) : chord;
  for (std::size_t k = part.first; k < part.last; ++k) {
    const double to = std::min(path.lengths[k] + span, path.lengths[part.last]);
    if (dot(unit(point_at(path.points, path.lengths, to) - path.points[k]), unit(on)) < kBack) return true;
  }
  return false;
}

bool lies_along(const Path& path, Part part) {
  const Vec2 a = path.points[part.first], b = path.points[part.last];
  return std::all_of(path.points.begin() + static_cast<std::ptrdiff_t>(part.first),
                     path.points.begin() + static_cast<std::ptrdiff_t>(part.last),
                     [&](Vec2 p) { return distance_to_segment(p, a, b) < path.width; });
}

// The part that a line replaces best, if any.
std::optional<Part> zigzag(const Path& path) {
  std::optional<Part> best;
  double straightest = kOn;
  for (std::size_t i = 0; i < path.points.size(); ++i)
    for (std::size_t j = i + 2; j < path.points.size(); ++j) {
      const double along = path.lengths[j] - path.lengths[i];
      if (along > kLongest * path.width) break;
      const double chord = norm(path.points[j] - path.points[i]);
      if (along < kFolded * chord || along - chord < kSaved * path.width) continue;
      const Part part{i, j};
      const double straight = straightness(path, part);
      if (straight > straightest && lies_along(path, part) && turns_back(path, part, 0.25 * path.width))
        best = part, straightest = straight;
    }
  return best;
}

}  // namespace

Chains drop_zigzags(Chains chains, double width) {
  for (Chain& chain : chains.chains) {
    if (is_loop(chain)) continue;
    while (true) {
      const auto part = zigzag({chain.points, lengths_along(chain.points), width});
      if (!part) break;
      chain.points.erase(chain.points.begin() + static_cast<std::ptrdiff_t>(part->first) + 1,
                         chain.points.begin() + static_cast<std::ptrdiff_t>(part->last));
    }
  }
  return chains;
}

}  // namespace inkgrid
