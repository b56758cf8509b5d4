#include "refine/confirmed.h"

#include <algorithm>

#include "base/at.h"
#include "base/polyline.h"

namespace inkgrid {
namespace {

constexpr double kStubby = 1.2;     // widths: what is shorter is no stroke of its own
constexpr double kTip = 0.25;       // widths at a free end that are not believed
constexpr double kSlender = 1.2;    // pens: wider ink is more than one stroke
constexpr double kRim = 0.5;        // px
constexpr double kShortest = 0.5;   // pens: shorter slender parts are none
constexpr double kShortStub = 1.5;  // pens: the same at a free end, beside a blot
constexpr double kWalkStep = 0.25;  // px
constexpr int kTangent = 2;         // points

// Calls visit(first, end) for each part of points that are set.
template <class Visit>
void for_each_part(const std::vector<std::uint8_t>& set, const Visit& visit) {
  for (std::size_t k = 0; k < set.size();) {
    std::size_t end = k;
    while (end < set.size() && set[end]) ++end;
    if (end > k) visit(k, end);
    k = std::max(end, k + 1);
  }
}

void fill(std::vector<std::uint8_t>& values, std::size_t first, std::size_t end, std::uint8_t value) {
  std::fill(values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + static_cast<std::ptrdiff_t>(end), value);
}

void forget_free_ends(const RidgeChain& ridge, const std::vector<double>& lengths, std::vector<std::uint8_t>& confirmed) {
  if (ridge.chain.closed) return;
  for (std::size_t k = 0; k < lengths.size(); ++k)
    if ((ridge.chain.start_junction < 0 && lengths[k] <= kTip * ridge.chain.width) ||
        (ridge.chain.end_junction < 0 && lengths.back() - lengths[k] <= kTip * ridge.chain.width))
      confirmed[k] = 0;
}

void forget_short_parts(const RidgeChain& ridge, const std::vector<double>& lengths, double pen,
                        std::vector<std::uint8_t>& slender) {
  if (ridge.chain.closed) return;
  const auto whole = slender;
  for_each_part(whole, [&](std::size_t first, std::size_t end) {
    const bool at_free_end =
        (first == 0 && ridge.chain.start_junction < 0) || (end == whole.size() && ridge.chain.end_junction < 0);
    if (lengths[end - 1] - lengths[first] < (at_free_end ? kShortStub : kShortest) * pen) fill(slender, first, end, 0);
  });
}

}  // namespace

std::vector<std::uint8_t> confirmed_points(const RidgeChain& ridge, double isolated) {
  const auto lengths = lengths_along(ridge.chain.points);
  std::vector<std::uint8_t> confirmed(lengths.size(), 0);
  if (lengths.back() < kStubby * ridge.chain.width && !ridge.chain.closed) return confirmed;
  const double shortest = std::min(isolated, 0.9 * lengths.back());
  std::vector<std::uint8_t> known;
  for (const CrossSection& section : ridge.sections) known.push_back(section.weight == 1);
  for_each_part(known, [&](std::size_t first, std::size_t end) {
    if (lengths[end - 1] - lengths[first] >= shortest) fill(confirmed, first, end, 1);
  });
  forget_free_ends(ridge, lengths, confirmed);
  return confirmed;
}

std::vector<std::uint8_t> slender_points(const RidgeChain& ridge, const Raster<std::uint8_t>& drawn, double pen) {
  const auto& points = ridge.chain.points;
  std::vector<std::uint8_t> slender;
  for (int k = 0; k < static_cast<int>(points.size()); ++k) {
    const Vec2 p = points[at(k)], normal = quarter_turn(tangent_at(points, k, kTangent, ridge.chain.closed));
    const double across = ink_ahead(drawn, p, normal, kWalkStep, pen) + ink_ahead(drawn, p, -normal, kWalkStep, pen);
    slender.push_back(ridge.sections[at(k)].weight > 0 && across < kSlender * pen + kRim);
  }
  const auto lengths = lengths_along(points);
  forget_short_parts(ridge, lengths, pen, slender);
  forget_free_ends(ridge, lengths, slender);
  return slender;
}

}  // namespace inkgrid
