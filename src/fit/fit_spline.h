// What:   a chain of cubic segments with common tangents, moved to lie best along points.
// Source: section 6.3, "Curve fitting": the least-squares energy.
// Differs: distances are to the nearest point of the curve, not to the point of equal arc length; joints are free and smooth.
// Cost:   a few passes over the points a step; the normal equations are banded.
#pragma once

#include <array>
#include <vector>

#include "base/cubic.h"
#include "fit/fit_samples.h"

namespace inkgrid {

// Segment k runs from joint k to the next one; on a closed spline the last segment returns to joint 0.
struct SmoothSpline {
  std::vector<Vec2> joints;
  std::vector<double> angles;                  // rad: the direction of travel at each joint
  std::vector<std::array<double, 2>> handles;  // px: how far the inner control points of each segment are from its joints
  bool closed = false;

  int segments() const { return static_cast<int>(handles.size()); }
  int joint_after(int segment) const { return closed ? (segment + 1) % segments() : segment + 1; }
  Cubic cubic(int segment) const;
};

// For each point, the place on the spline nearest to it: the number of the segment + the parameter in it.
using Feet = std::vector<double>;

// Without the care for overflow of unit().
inline Vec2 fast_unit(Vec2 a) {
  const double squared = norm2(a);
  return squared > 0 ? a / std::sqrt(squared) : a;
}

std::vector<Cubic> cubics_of(const SmoothSpline& spline);

struct RefineOptions {
  bool pin_start_angle = false;  // of an open spline, whose end points never move
  bool pin_end_angle = false;
  int most_steps = 24;
};

// Damped Gauss-Newton steps on joints, angles and handles towards least weighted squares.
void refine_spline(SmoothSpline& spline, Feet& feet, const Samples& samples, const std::vector<double>& weights,
                   const RefineOptions& options);

// For each segment, the largest distance between it and the polyline, measured both ways; infinite where it folds, kinks or
// wriggles.
std::vector<double> deviations(const SmoothSpline& spline, const Feet& feet, const Samples& samples);

// Distance of each point to its foot.
std::vector<double> distances(const SmoothSpline& spline, const Feet& feet, const Samples& samples);

// Makes one segment of those before and after an inner joint.
void join_segments(SmoothSpline& spline, Feet& feet, int joint);

// Moves the seam of a closed spline on by some joints.
void rotate_seam(SmoothSpline& spline, Feet& feet, int joints);

}  // namespace inkgrid
