#include "compare/curve_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/polyline.h"
#include "compare/crossings.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr double kSamePoint = 1e-9;  // px
constexpr int kMostPieces = 20000;   // of a segment
constexpr double kMostSamples = 8e6;

// Never less than the segment's length.
double control_length(const PathSegment& segment) {
  double length = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(segment.degree); ++i)
    length += norm(segment.points[i + 1] - segment.points[i]);
  return length;
}

void refuse_too_long(const std::vector<SvgCurve>& curves, const std::string& name) {
  double length = 0;
  for (const SvgCurve& curve : curves)
    for (const PathSegment& segment : curve.segments) length += control_length(segment);
  if (!(length < kMostSamples * kSampleStep))
    throw Error(ErrorCode::file, "the curves of '" + name + "' are too long to be compared");
}

Vec2 point_on(const PathSegment& s, double t) {
  const double u = 1 - t;
  if (s.degree == 2) return u * u * s.points[0] + 2 * u * t * s.points[1] + t * t * s.points[2];
  return u * u * u * s.points[0] + 3 * u * u * t * s.points[1] + 3 * u * t * t * s.points[2] + t * t * t * s.points[3];
}

void append(std::vector<Vec2>& polyline, Vec2 point) {
  if (norm(point - polyline.back()) > kSamePoint) polyline.push_back(point);
}

// Lines stay whole, curves become pieces of about the sample step.
std::vector<Vec2> flattened(const SubPath& path) {
  std::vector<Vec2> polyline{path.front().front()};
  for (const PathSegment& segment : path) {
    if (segment.degree == 1) {
      append(polyline, segment.back());
      continue;
    }
    const double pieces = std::ceil(control_length(segment) / kSampleStep);
    const int n = static_cast<int>(std::clamp(pieces, 2.0, static_cast<double>(kMostPieces)));
    for (int i = 1; i <= n; ++i) append(polyline, point_on(segment, static_cast<double>(i) / n));
  }
  return polyline;
}

// Each sample is in the middle of the piece it stands for.
void append_samples(CurveSamples& samples, const std::vector<Vec2>& polyline, const std::vector<double>& lengths) {
  const double length = lengths.back();
  const int n = std::max(2, static_cast<int>(std::ceil(length / kSampleStep)));
  std::size_t piece = 0;
  for (int k = 0; k < n; ++k) {
    const double s = (k + 0.5) * (length / n);
    while (piece + 2 < polyline.size() && lengths[piece + 1] <= s) ++piece;
    const Vec2 step = polyline[piece + 1] - polyline[piece];
    const double angle = std::atan2(step.y, step.x);
    samples.points.push_back(polyline[piece] + (s - lengths[piece]) / (lengths[piece + 1] - lengths[piece]) * step);
    samples.angles.push_back(angle < 0 ? angle + std::numbers::pi : angle);
    samples.weights.push_back(length / n);
    samples.curves.push_back(static_cast<int>(samples.polylines.size()));
  }
}

}  // namespace

CurveSamples sample_curves(const std::vector<SvgCurve>& curves, const std::string& name) {
  refuse_too_long(curves, name);
  CurveSamples samples;
  for (const SvgCurve& curve : curves) {
    std::vector<Vec2> polyline = flattened(curve.segments);
    if (polyline.size() < 2) continue;
    const std::vector<double> lengths = lengths_along(polyline);
    samples.length += lengths.back();
    append_samples(samples, polyline, lengths);
    samples.closed.push_back(is_closed(polyline));
    samples.overdrawn.push_back(curve.overdrawn);
    samples.polylines.push_back(std::move(polyline));
  }
  samples.tree = PointTree(samples.points);
  return samples;
}

}  // namespace inkgrid
