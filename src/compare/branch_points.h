// What:   junctions and free ends of a set of curves, found by geometry alone, and how well two sets of points agree.
// Source: own.  A path that is cut into touching pieces is no junction; curves that cross without a common point are one.
// Cost:   crossings of all curves; the samples around each candidate.
#pragma once

#include <vector>

#include "compare/curve_samples.h"
#include "inkgrid/compare.h"

namespace inkgrid {

struct BranchPoints {
  std::vector<Vec2> junctions;  // three or more branches leave a circle of 1.5 touch + 1 px around the point
  std::vector<Vec2> ends;       // one does
};

// `touch`: how near an end comes to a curve that it touches, px.  Throws Error{file} where there are too many crossings.
BranchPoints find_branch_points(const CurveSamples& samples, double touch);

// Pairs of a point of either set at most `radius` apart, nearest first, each point once.
PointAgreement match_points(const std::vector<Vec2>& result, const std::vector<Vec2>& truth, double radius);

double harmonic_mean(double a, double b);

}  // namespace inkgrid
