// What:   minimise a quadratic over reals and integers; knows nothing of geometry.
// Source: section 6.2, "Final optimization" (greedy rounding).
// Differs: integers are ordered last, so that rounding happens on the Schur complement; a local search follows
//          (docs/METHOD.md, "Integers").
// Cost:   one sparse factorisation and solve; then a sparse system of the integers only, updated once an integer.
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
  std::vector<double> x;      // integer entries are exactly integral
  double energy = 0;          // x' A x / 2 - b' x
  double greedy_energy = 0;   // before the local search
  double relaxed_energy = 0;  // its minimum over the reals
};

// Greedy: the integer unknown nearest to an integer is fixed, the others answer, and so on.  Ties: the smaller index.
// Then single integers and pairs of coupled ones move by one as long as the energy falls, the steepest move first.
// Throws Error{numerics} when A is not positive definite or holds a value that is not finite.
MixedIntegerSolution solve_mixed_integer(const MixedIntegerProblem& problem);

}  // namespace inkgrid
