// Whether the ink of two pictures is the same, but for its rim.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "ink/threshold.h"

namespace inkgrid::testing {

inline bool has_ink_near(const Binarisation& b, int x, int y) {
  for (int v = std::max(0, y - 1); v <= std::min(b.ink.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(b.ink.width - 1, x + 1); ++u)
      if (b.ink(u, v)) return true;
  return false;
}

// All ink of each lies on the other's or beside it, and nearly all on it.
inline void expect_same_ink(const Binarisation& a, const Binarisation& b, long most = 40) {
  long different = 0, stray = 0;
  for (int y = 0; y < b.ink.height; ++y)
    for (int x = 0; x < b.ink.width; ++x) {
      if (a.ink(x, y) == b.ink(x, y)) continue;
      ++different;
      stray += !has_ink_near(a.ink(x, y) ? b : a, x, y);
    }
  EXPECT_LE(different, most);
  EXPECT_LE(stray, most / 20);
}

inline long ink_in(const Binarisation& b, int x0, int y0, int x1, int y1) {
  long n = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) n += b.ink(x, y);
  return n;
}

}  // namespace inkgrid::testing
