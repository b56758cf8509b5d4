#include "refine/ridge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/at.h"
#include "base/median.h"
#include "base/parallel.h"
#include "base/polyline.h"
#include "base/sample.h"
#include "refine/strokes.h"

namespace inkgrid {
namespace {

constexpr double kWalkStep = 0.5;        // px, across the stroke
constexpr double kRim = 1;               // px, of the antialiased rim outside the mask
constexpr double kOneSidedWeight = 0.3;  // of a point with paper on one side only
constexpr double kWidest = 1.3;          // times the usual width: more is a junction or a corner
constexpr double kStiffest = 4;          // times the usual stroke
constexpr double kFade = 1.5;
constexpr double kOfLoop = 0.4;       // of its radius: bends longer than that keep a small loop from shrinking
constexpr double kStubby = 1.2;       // widths of the drawn ink: shorter chains may be threads all along
constexpr double kThread = 0.35;      // of what slimming leaves of a stroke
constexpr double kTaken = 1.5;        // times what slimming usually takes
constexpr double kRimNoise = 1;       // px
constexpr double kTurn = 2;           // strokes along the chain before its other side can begin
constexpr double kOtherSide = -0.82;  // cosine of 145 degrees between the directions of the sides of a sharp corner
constexpr double kAnchor = 0.05;      // of the isoline itself, which is all that is known where sections tell nothing

// One side of a cross-section: how far the ink goes, and whether paper ends it.
struct Side {
  double extent = 0;
  bool paper = false;
  double mass = 0;    // integral of darkness
  double moment = 0;  // integral of darkness times distance
};

// The points of a chain and the normals there.
struct Track {
  const std::vector<Vec2>& points;
  const std::vector<Vec2>& normals;
  int first;  // its first sample in the ownership
};

class SectionReader {
 public:
  SectionReader(const Ownership& ownership, const Ink& ink, const RidgeOptions& options)
      : ownership_(ownership), ink_(ink), options_(options), farthest_(3 * ink.stroke_width + 2 * options.bridge) {}

  CrossSection read(const Track& track, int k) const {
    const Vec2 p = track.points[at(k)], normal = track.normals[at(k)];
    const Side left = walk(track, k, p, normal), right = walk(track, k, p, -normal);
    CrossSection section;
    if (left.extent + right.extent <= 0 || left.mass + right.mass <= 0) return section;
    if (left.paper && right.paper) {
      section.width = left.extent + right.extent;
      section.offset = (left.moment - right.moment) / (left.mass + right.mass);
      section.weight = 1;
    } else if (left.paper || right.paper) {
      // Completed by the usual width once that is known: offset holds the rim on the paper's side.
      section.offset = left.paper ? left.extent : -right.extent;
      section.weight = kOneSidedWeight;
    }
    return section;
  }

 private:
  Side walk(const Track& track, int k, Vec2 p, Vec2 direction) const {
    Side side;
    double last = 0;
    for (double t = 0.5 * kWalkStep; t < farthest_; t += kWalkStep) {
      const Vec2 q = p + t * direction;
      const int x = floor_of(q.x), y = floor_of(q.y);
      if (!ink_.mask.contains(x, y)) {
        side.paper = t - last > 1;  // what lies on the border goes on beyond it
        return side;
      }
      const int owner = ownership_.owner(x, y);
      if (owner >= 0 && !belongs(owner, track, k)) return side;
      if (ink_.mask(x, y)) {
        last = t + 0.5 * kWalkStep;
        const double dark = bilinear(ink_.darkness, q);
        side.mass += dark;
        side.moment += dark * t;
        side.extent = last;
        continue;
      }
      if (t - last > std::max(options_.bridge, options_.slit) || owner < 0) {
        side.paper = true;
        return side;
      }
      // The rim's pixels that are more paper than ink still say where it is.
      if (t - last <= kRim) {
        const double dark = bilinear(ink_.darkness, q);
        side.mass += dark;
        side.moment += dark * t;
      }
    }
    return side;
  }

  // The owner is a stretch of the same chain around the point, and where corners count not the other side of one.
  bool belongs(int owner, const Track& track, int k) const {
    const auto a = ownership_.samples[at(owner)], b = ownership_.samples[at(track.first + k)];
    const double away = std::abs(a.point - b.point) * options_.step;
    return a.chain == b.chain && away < 2.5 * farthest_ &&
           !(options_.corners && away > kTurn * ink_.stroke_width &&
             dot(track.normals[at(a.point)], track.normals[at(k)]) < kOtherSide);
  }

  const Ownership& ownership_;
  const Ink& ink_;
  const RidgeOptions& options_;
  double farthest_;
};

// Points to both sides over which a width is usual.
int width_span(double stroke_width, double step) {
  return std::max(4, static_cast<int>(5 * stroke_width / step));
}

// The usual width around each point: the median of what is known within `span` points, else of the whole chain, else `fallback`.
std::vector<double> usual_widths(const std::vector<CrossSection>& sections, int span, double fallback) {
  std::vector<double> all;
  for (const auto& s : sections)
    if (s.width > 0) all.push_back(s.width);
  const double overall = all.empty() ? fallback : median(all);
  const int n = static_cast<int>(sections.size());
  std::vector<double> usual(sections.size(), overall);
  const int stride = std::max(1, span / 4);
  std::vector<double> near;  // in order
  int first = 0, end = 0;    // of the points that it is of
  for (int block = 0; block < n; block += stride) {
    for (; end < std::min(n, block + span); ++end)
      if (const double width = sections[at(end)].width; width > 0)
        near.insert(std::upper_bound(near.begin(), near.end(), width), width);
    for (; first < block - span; ++first)
      if (const double width = sections[at(first)].width; width > 0)
        near.erase(std::lower_bound(near.begin(), near.end(), width));
    if (near.size() < 5) continue;
    const double local = near[near.size() / 2];
    for (int i = block; i < std::min(n, block + stride); ++i) usual[at(i)] = std::min(local, 1.5 * overall);
  }
  return usual;
}

// Completes one-sided sections and drops those of junctions and corners.
void judge(std::vector<CrossSection>& sections, const std::vector<double>& usual) {
  for (std::size_t k = 0; k < sections.size(); ++k) {
    auto& s = sections[k];
    if (s.weight == kOneSidedWeight) s.offset -= std::copysign(0.5 * usual[k], s.offset);
    if (s.width > kWidest * usual[k]) s = {0, s.width, 0};
  }
}

double extent_of(const Raster<std::uint8_t>& ink, Vec2 p, Vec2 direction) {
  return ink_ahead(ink, p, direction, kWalkStep, std::numeric_limits<double>::infinity());
}

// Where slimming left but a thread between two rims, or moved the one rim by more than it usually does, the rims are none that
// were drawn: strokes share their ink.  Sections as they were read; chains shorter than their ink is wide may be such all along.
void doubt_rims(RidgeChain& ridge, const std::vector<Vec2>& normals, double stroke_width, const RidgeOptions& options) {
  const Raster<std::uint8_t>& drawn = *options.drawn;
  const auto& points = ridge.chain.points;
  std::vector<double> across(points.size(), 0), taken{options.taken}, left{stroke_width};
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (ridge.sections[k].weight != 1) continue;
    across[k] = extent_of(drawn, points[k], normals[k]) + extent_of(drawn, points[k], -normals[k]);
    taken.push_back(across[k] - ridge.sections[k].width);
    left.push_back(ridge.sections[k].width);
  }
  const double length = lengths_along(points).back();
  const bool stubby = !ridge.chain.closed && length < kStubby * (median(taken) + median(left));
  const double usual = stubby ? options.taken : median(taken), usual_left = stubby ? stroke_width : median(left);
  const double share = usual_left / (usual_left + usual);
  for (std::size_t k = 0; k < points.size(); ++k) {
    CrossSection& s = ridge.sections[k];
    const bool thread = s.weight == 1 && s.width < kThread * share * across[k];
    const bool lost = s.weight == kOneSidedWeight && extent_of(drawn, points[k], s.offset > 0 ? normals[k] : -normals[k]) >
                                                         std::abs(s.offset) + kRimNoise + 0.5 * kTaken * usual;
    if (thread || lost) s = {};
  }
}

// A symmetric positive definite system of five diagonals: the places (k, k), (k, k - 1) and (k, k - 2) of each row.
struct FiveDiagonals {
  std::vector<double> diagonal, first, second;

  explicit FiveDiagonals(std::size_t n) : diagonal(n), first(n, 0.0), second(n, 0.0) {}
};

// By L D L^T in place.
std::vector<double> solve(FiveDiagonals system, std::vector<double> x) {
  std::vector<double>&diagonal = system.diagonal, &first = system.first, &second = system.second;
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) {
    double l2 = 0, l1 = 0;
    if (k >= 2) l2 = second[k] / diagonal[k - 2];
    if (k >= 1) l1 = (first[k] - (k >= 2 ? l2 * diagonal[k - 2] * first[k - 1] : 0)) / diagonal[k - 1];
    if (k >= 2) diagonal[k] -= l2 * l2 * diagonal[k - 2];
    if (k >= 1) diagonal[k] -= l1 * l1 * diagonal[k - 1];
    second[k] = l2;
    first[k] = l1;
    if (k >= 1) x[k] -= l1 * x[k - 1];
    if (k >= 2) x[k] -= l2 * x[k - 2];
  }
  for (std::size_t k = n; k-- > 0;) {
    x[k] /= diagonal[k];
    if (k + 1 < n) x[k] -= first[k + 1] * x[k + 1];
    if (k + 2 < n) x[k] -= second[k + 2] * x[k + 2];
  }
  return x;
}

// Minimises  sum w (d - offset)^2 + bend |second difference of (p + d n)|^2  over the displacements d, with a stiffness `bend` a
// point.
std::vector<double> smoothed_displacements(const std::vector<Vec2>& points, const std::vector<Vec2>& normals,
                                           const std::vector<CrossSection>& sections, const std::vector<double>& bend) {
  const std::size_t n = points.size();
  FiveDiagonals system(n);
  std::vector<double> right(n);
  for (std::size_t k = 0; k < n; ++k) {
    system.diagonal[k] = sections[k].weight + kAnchor;
    right[k] = sections[k].weight * sections[k].offset;
  }
  constexpr double kStencil[3] = {1, -2, 1};
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Vec2 rest = points[k - 1] - 2.0 * points[k] + points[k + 1];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = k - 1 + i;
      right[a] -= bend[k] * kStencil[i] * dot(normals[a], rest);
      for (std::size_t j = 0; j <= i; ++j) {
        const double value = bend[k] * kStencil[i] * kStencil[j] * dot(normals[a], normals[k - 1 + j]);
        (i == j ? system.diagonal : i == j + 1 ? system.first : system.second)[a] += value;
      }
    }
  }
  return solve(std::move(system), std::move(right));
}

// Repeats both ends of a closed sequence, so that what is done to an open one holds at the seam too.
template <class T>
std::vector<T> wrapped(const std::vector<T>& values, std::size_t margin) {
  const std::size_t period = values.size() - 1;
  std::vector<T> out;
  for (std::size_t k = 0; k < period + 2 * margin + 1; ++k)
    out.push_back(values[(k + period * (margin / period + 1) - margin) % period]);
  return out;
}

void move_points(RidgeChain& ridge, const std::vector<Vec2>& normals, const std::vector<double>& bend) {
  auto& points = ridge.chain.points;
  if (!ridge.chain.closed) {
    const auto d = smoothed_displacements(points, normals, ridge.sections, bend);
    for (std::size_t k = 0; k < points.size(); ++k) points[k] += d[k] * normals[k];
    return;
  }
  const std::size_t margin = std::min<std::size_t>(points.size() - 1, 200);
  const auto d = smoothed_displacements(wrapped(points, margin), wrapped(normals, margin), wrapped(ridge.sections, margin),
                                        wrapped(bend, margin));
  for (std::size_t k = 0; k < points.size(); ++k) points[k] += d[k + margin] * normals[k];
  points.back() = points.front();
}

// What counts as noise grows with the stroke: where strokes of a bundle begin and end, its middle jumps by as much as they are
// wide.  So it does beside a wide part: it fades by one usual stroke over each kFade of them.
std::vector<double> stiffness(const Chain& chain, const std::vector<double>& usual, double stroke_width,
                              const RidgeOptions& options) {
  std::vector<double> ratio;
  ratio.reserve(usual.size());
  for (const double width : usual) ratio.push_back(std::clamp(width / stroke_width, 1.0, kStiffest));
  const double fade = options.step / (kFade * stroke_width);
  for (std::size_t k = 1; k < ratio.size(); ++k) ratio[k] = std::max(ratio[k], ratio[k - 1] - fade);
  for (std::size_t k = ratio.size() - 1; k-- > 0;) ratio[k] = std::max(ratio[k], ratio[k + 1] - fade);
  const double most = is_loop(chain) ? kOfLoop * lengths_along(chain.points).back() / (2 * std::numbers::pi) : 1e9;
  for (double& r : ratio) r = std::pow(std::min(r * options.smooth, most) / options.step, 4);
  return ratio;
}

void follow_once(std::vector<RidgeChain>& ridges, const Ink& ink, const InkBand& band, const RidgeOptions& options) {
  std::vector<Chain> chains;
  chains.reserve(ridges.size());
  for (const auto& r : ridges) chains.push_back(r.chain);
  const Ownership ownership = assign_ink(chains, band);
  const SectionReader reader(ownership, ink, options);
  const int tangent_span = std::max(1, static_cast<int>(std::lround(options.smooth / options.step)));
  const auto follow = [&](RidgeChain& ridge, int first_sample) {
    const int n = static_cast<int>(ridge.chain.points.size());
    std::vector<Vec2> normals;
    ridge.sections.clear();
    for (int k = 0; k < n; ++k)
      normals.push_back(quarter_turn(tangent_at(ridge.chain.points, k, tangent_span, ridge.chain.closed)));
    for (int k = 0; k < n; ++k) ridge.sections.push_back(reader.read({ridge.chain.points, normals, first_sample}, k));
    if (options.drawn) doubt_rims(ridge, normals, ink.stroke_width, options);
    const auto usual = usual_widths(ridge.sections, width_span(ink.stroke_width, options.step), ink.stroke_width);
    judge(ridge.sections, usual);
    move_points(ridge, normals, stiffness(ridge.chain, usual, ink.stroke_width, options));
  };
  for_each_largest_first(
      options.threads, static_cast<int>(ridges.size()), [&](int c) { return ridges[at(c)].chain.points.size(); },
      [&](int c) { follow(ridges[at(c)], ownership.first[at(c)]); });
}

std::vector<Vec2> spaced_points(const Chain& chain, double step) {
  auto points = resampled(chain.points, step);
  // Short closed chains keep enough points to stay round.
  if (chain.closed && points.size() < 9) return resampled(chain.points, lengths_along(chain.points).back() / 8);
  return points;
}

// The points of its parts, one after the other; what they share at junctions once.
Chain joined(const std::vector<StrokePart>& stroke, const std::vector<RidgeChain>& parts) {
  Chain whole = parts[at(stroke.front().chain)].chain;
  whole.points.clear();
  for (const StrokePart& part : stroke) {
    auto points = parts[at(part.chain)].chain.points;
    if (part.reversed) std::reverse(points.begin(), points.end());
    whole.points.insert(whole.points.end(), points.begin() + (whole.points.empty() ? 0 : 1), points.end());
  }
  return whole;
}

// Gives the parts what was found for the stroke.
void split(const RidgeChain& whole, const std::vector<StrokePart>& stroke, std::vector<RidgeChain>& parts) {
  std::ptrdiff_t from = 0;
  for (const StrokePart& part : stroke) {
    RidgeChain& ridge = parts[at(part.chain)];
    const auto count = static_cast<std::ptrdiff_t>(ridge.chain.points.size());
    const auto copy = [&](const auto& values, auto& into) {
      into.assign(values.begin() + from, values.begin() + from + count);
      if (part.reversed) std::reverse(into.begin(), into.end());
    };
    copy(whole.chain.points, ridge.chain.points);
    copy(whole.sections, ridge.sections);
    if (part.reversed)
      for (CrossSection& section : ridge.sections) section.offset = -section.offset;
    from += count - 1;
  }
}

template <class Work>
void for_each_chain(std::vector<RidgeChain>& ridges, int threads, const Work& work) {
  const auto size = [&](int c) { return ridges[at(c)].chain.points.size(); };
  for_each_largest_first(threads, static_cast<int>(ridges.size()), size, [&](int c) { work(ridges[at(c)]); });
}

void measure(RidgeChain& ridge, double stroke_width, double step) {
  ridge.chain.width = median(usual_widths(ridge.sections, width_span(stroke_width, step), stroke_width));
  ridge.chain.confirmed = step * static_cast<double>(std::count_if(ridge.sections.begin(), ridge.sections.end(),
                                                                   [](const CrossSection& x) { return x.weight == 1; }));
}

}  // namespace

double ink_ahead(const Raster<std::uint8_t>& ink, Vec2 from, Vec2 direction, double step, double farthest) {
  double t = 0;
  while (t < farthest && nearest(ink, from + t * direction, std::uint8_t{0})) t += step;
  return t;
}

std::vector<RidgeChain> follow_ridges(const std::vector<Chain>& chains, const InkBands& bands, const RidgeOptions& options) {
  std::vector<RidgeChain> ridges, wholes;
  for (const auto& chain : chains) ridges.push_back({chain, {}, options.taken});
  for_each_chain(ridges, options.threads,
                 [&](RidgeChain& ridge) { ridge.chain.points = spaced_points(ridge.chain, options.step); });
  const auto strokes = strokes_of(chains, options.stroke_span);
  for (const auto& stroke : strokes) wholes.push_back({joined(stroke, ridges), {}});
  const Ink& ink = bands.ink();
  const InkBand& band = bands.of(options.bridge);
  for (int round = 0; round < 2; ++round) follow_once(wholes, ink, band, options);
  for (std::size_t s = 0; s < strokes.size(); ++s) split(wholes[s], strokes[s], ridges);
  for_each_chain(ridges, options.threads, [&](RidgeChain& ridge) { measure(ridge, ink.stroke_width, options.step); });
  return ridges;
}

}  // namespace inkgrid
