// Chains traced by hand over painted drawings, and what must hold of any network of chains.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/polyline.h"
#include "drawings.h"
#include "graph/chains.h"

namespace inkgrid::testing {

inline Ink ink_of(const Image& image) {
  return measure_ink(binarise(image, 128));
}

// A chain with a point each pixel.
inline Chain chain_along(const std::vector<Vec2>& line, double width, int start_junction = -1, int end_junction = -1) {
  Chain chain;
  chain.points = resampled(line, 1);
  chain.start_junction = start_junction;
  chain.end_junction = end_junction;
  chain.width = width;
  return chain;
}

inline double length_of(const Chain& chain) {
  return lengths_along(chain.points).back();
}

inline double distance_to_line(Vec2 p, const std::vector<Vec2>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) least = std::min(least, distance_to_segment(p, line[i], line[i + 1]));
  return least;
}

inline double farthest_from(const std::vector<Vec2>& points, const std::vector<Vec2>& line) {
  double farthest = 0;
  for (const Vec2 p : points) farthest = std::max(farthest, distance_to_line(p, line));
  return farthest;
}

// Every junction joins at least three ends, each of which has its exact point; closed chains close.
inline void expect_consistent(const Chains& chains) {
  std::vector<int> degree(chains.junctions.size(), 0);
  const auto check_end = [&](int junction, Vec2 end) {
    if (junction < 0) return;
    ASSERT_LT(junction, static_cast<int>(chains.junctions.size()));
    ++degree[static_cast<std::size_t>(junction)];
    EXPECT_TRUE(chains.junctions[static_cast<std::size_t>(junction)] == end) << "junction " << junction;
  };
  for (const auto& chain : chains.chains) {
    ASSERT_GE(chain.points.size(), 2u);
    check_end(chain.start_junction, chain.points.front());
    check_end(chain.end_junction, chain.points.back());
    EXPECT_TRUE(!chain.closed || chain.points.front() == chain.points.back());
  }
  for (const int ends : degree) EXPECT_GE(ends, 3);
}

}  // namespace inkgrid::testing
