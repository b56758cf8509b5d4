// Disjoint sets of 0..n-1; the representative of a set is its smallest member, so results do not depend on the order of unions.
#pragma once

#include <numeric>
#include <vector>

#include "base/at.h"

namespace inkgrid {

class UnionFind {
 public:
  explicit UnionFind(int n) : parent_(static_cast<std::size_t>(n)) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int i) {
    while (parent_[at(i)] != i) {
      int& p = parent_[at(i)];
      p = parent_[at(p)];
      i = p;
    }
    return i;
  }

  void unite(int a, int b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[at(a > b ? a : b)] = a < b ? a : b;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace inkgrid
