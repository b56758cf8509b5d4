// What:   minimise a quadratic over reals and integers; knows nothing of geometry.
// Source: section 6.2, "Final optimization" (greedy rounding).
// Differs: integers are ordered last, so that rounding happens on the Schur complement (docs/METHOD.md, "Integers").
// Cost:   one sparse factorisation and solve, then dense work on the integers only.
#pragma once

#include <vector>

#include "numerics/spd_solver.h"

namespace inkgrid {

// minimise  x' A x / 2 - b' x  with x[i] integer for each i in `integers`.
struct MixedIntegerProblem {
  int size = 0;
  std::vector<Entry<double>> lower;  // lower triangle of A, symmetric positive definite; duplicates add up
  std::vector<double> b;
  std::vector<int> integers;  // ascending
};

struct MixedIntegerSolution {
  std::vector<double> x;  // integer entries are exactly integral
  double energy = 0;      // x' A x / 2 - b' x
  double relaxed_energy = 0;  // its minimum over the reals
};

// Greedy: the integer unknown nearest to an integer is fixed, the others answer, and so on.  Ties: the smaller index.
// Throws Error{numerics} when A is not positive definite or holds a value that is not finite.
MixedIntegerSolution solve_mixed_integer(const MixedIntegerProblem& problem);

}  // namespace inkgrid
