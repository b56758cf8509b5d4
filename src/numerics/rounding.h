// What:   integers that make a quadratic small, by greedy rounding and a local search.
// Source: section 6.2, "Final optimization" (greedy rounding).
// Differs: many integers are fixed in batches; a local search follows (docs/METHOD.md, "Integers").
// Cost:   one by one, a solution by a factor for each integer; in batches, some ten products with S for each.
#pragma once

#include <stop_token>
#include <vector>

#include "numerics/pair_ldl.h"

namespace inkgrid {

// x' S x / 2 - h' x + constant, S symmetric positive definite.
struct Quadratic {
  std::vector<SparseVector> rows;  // of S, without its diagonal
  std::vector<double> diagonal;
  std::vector<double> h;
  double constant = 0;

  int size() const { return static_cast<int>(diagonal.size()); }
  double gradient(const std::vector<double>& x, int i) const;  // row i of S x - h
  double energy(const std::vector<double>& x) const;
};

struct Rounding {
  std::vector<double> relaxed;  // the minimum over the reals
  std::vector<double> rounded;  // exactly integral
};

// The unknown nearest to an integer is fixed, the others answer, and so on.  Ties: the smaller index; halves go up.  Pivots must
// clearly exceed the rounding errors of numbers as large as `scale`.  Throws Error{numerics} where they do not, Error{cancelled}
// where it is asked to stop.
Rounding round_one_by_one(const Quadratic& energy, const std::vector<double>& scale, const std::stop_token& stop);

// The same, but the nearest 32nd part of those that are left is fixed at once, and the others answer up to a hundredth.
Rounding round_in_batches(const Quadratic& energy, const std::stop_token& stop);

// Moves single integers and pairs of coupled ones by one as long as the energy falls, the steepest move first.
std::vector<double> descend(const Quadratic& energy, std::vector<double> x, const std::stop_token& stop);

}  // namespace inkgrid
