// What:   where to cut a smooth stretch of points so that few cubic segments follow it.
// Source: section 6.3, "Curve fitting": a compact result, few segments below an error.
// Differs: the paper adds one segment at a time to a uniform spline; here cuts fall where lines turn into arcs, by dynamic
//          programming that weighs segments against squared error.
// Cost:   some fifty fits of at most 24 points a segment.
#pragma once

#include <vector>

#include "fit/fit_samples.h"
#include "inkgrid/drawing.h"

namespace inkgrid {

// A cubic with free ends along a range of points.
struct SpanFit {
  Cubic cubic;
  double largest = 0;  // px: distance of a point from it
  double squares = 0;  // px^3: squared distance times length
};

SpanFit fit_span(const Samples& samples, int first, int last);

// Two turns of a closed stretch, so that a span may run over its seam.
Samples two_turns(const Samples& samples);

struct CutOptions {
  double limit = 1;     // px: largest distance of a point from its span's cubic
  double worth = 1;     // px^3: another span must save as much of the squared distances times length
  double shortest = 3;  // px: shorter spans are avoided, since their directions are noise
  int least = 4;        // spans of a closed stretch
};

// Indices of points, from the first to the last one, between which one cubic stays within the limit.  Those of a closed stretch
// are indices into two turns, the last one a whole turn after the first.
std::vector<int> cut_into_spans(const Samples& samples, const CutOptions& options);

}  // namespace inkgrid
