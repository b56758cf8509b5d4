// What:   chains moved onto the middle of their ink, across the stroke only.
// Source: ours; the paper fits curves to grid nodes (section 6.3).
// Differs: docs/METHOD.md, "Ridge".
// Cost:   linear in the length of the chains times the stroke width.
#pragma once

#include <vector>

#include "refine/ownership.h"

namespace inkgrid {

// What a cut across the stroke finds at one point of a chain.
struct CrossSection {
  double offset = 0;  // of the ink's middle from the point along the normal, px
  double width = 0;   // of the ink, px; 0 where a side is not bounded by paper
  double weight = 0;  // 0: tells nothing, 1: paper on both sides
};

// A chain with equally spaced points, and what is known of each.
struct RidgeChain {
  Chain chain;
  std::vector<CrossSection> sections;  // one a point
  double slimmed = 0;                  // what was taken from the width of the stroke, px
};

struct RidgeOptions {
  double step = 1;                              // distance of points, px
  double bridge = 1;                            // paper narrower than this inside a stroke is part of it, px
  double smooth = 3;                            // bends shorter than this are noise, px
  const Raster<std::uint8_t>* drawn = nullptr;  // the ink before it was slimmed, where it was
  double taken = 0;                             // what slimming took from the width of most strokes, px
  double stroke_span = 0;                       // over which chains go straight on into each other, px; 0: they move alone
  int threads = 0;                              // 0: as many as the machine has
  double slit = 0;                              // px: wider paper between ink of one chain that it may be the middle of; 0: none
  bool corners = false;                         // whether the two sides of a sharp corner of one chain have ink of their own
};

// How far ink goes on from a point, told in steps, px; no more than `farthest` is looked at.
double ink_ahead(const Raster<std::uint8_t>& ink, Vec2 from, Vec2 direction, double step, double farthest);

// Resamples every chain and moves its points to the weighted middle of the ink that it owns; where another chain's ink adjoins,
// the side that is paper decides.  Ends are not moved along the chain; junctions are left where they are (locate_junctions moves
// them).
std::vector<RidgeChain> follow_ridges(const std::vector<Chain>& chains, const InkBands& bands, const RidgeOptions& options);

}  // namespace inkgrid
