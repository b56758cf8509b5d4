// What:   for each pixel of ink, the chain that it is nearest to, and where on it.
// Source: section 6.3, "we assign each stroke pixel to the nearest chain".
// Cost:   linear in the pixels of ink.
#pragma once

#include <vector>

#include "base/index_raster.h"
#include "graph/chains.h"

namespace inkgrid {

// Where a sample of a chain stands: chain index and index of its point.
struct ChainSample {
  int chain = -1;
  int point = -1;
};

struct Ownership {
  std::vector<ChainSample> samples;  // all points of all chains, in order
  std::vector<int> first;            // per chain: its first sample
  IndexRaster owner;                 // per pixel: the nearest sample; none off the band around the ink

  // The chain that owns the pixel at p, or -1.
  int chain_at(Vec2 p) const;
};

// Pixels nearer than `reach` px to the ink; distances go from pixel to pixel, so a chain does not own ink that it cannot be
// reached from.
Ownership assign_ink(const std::vector<Chain>& chains, const Ink& ink, double reach);

}  // namespace inkgrid
