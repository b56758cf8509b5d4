// The result: a network of cubic Bezier curves, in pixels of the input.
#pragma once

#include <cstdint>
#include <vector>

#include "inkgrid/vec2.h"

namespace inkgrid {

// One cubic Bezier segment.
struct Cubic {
  Vec2 p0, p1, p2, p3;
};

// A chain of segments: segments[i].p3 == segments[i+1].p0, and on a closed curve the last p3 == the first p0, to the last digit.
struct Curve {
  std::vector<Cubic> segments;  // at least one
  bool closed = false;
  double width = 0;         // measured stroke width, px
  double coverage = 0;      // part of its length that lies on ink, 0..1
  int start_junction = -1;  // index into Drawing::junctions, or -1 where the curve ends freely or is closed
  int end_junction = -1;
  std::uint64_t id = 0;  // tells the curves of a drawing apart, and is the same in another run where the curve runs the same
};

// A filled area: closed curves, without width or junctions; inside is what an odd number of them encloses.
struct Fill {
  std::vector<Curve> outlines;  // the outermost first
};

struct Drawing {
  int width = 0;  // px, those of the input
  int height = 0;
  double pixels_per_mm = 0;     // 0: unknown
  std::vector<Vec2> junctions;  // points that curves share, to the last digit
  std::vector<Curve> curves;
  std::vector<Fill> fills;
};

}  // namespace inkgrid
