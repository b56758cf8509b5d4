// What:   minimise a quadratic over reals and integers; knows nothing of geometry.
// Source: section 6.2, "Final optimization" (greedy rounding).
// Differs: integers are ordered last, so that rounding happens on the Schur complement; a local search follows
//          (docs/METHOD.md, "Integers").
// Cost:   one sparse factorisation and solve; then a sparse system of the integers only, updated once an integer.
#pragma once

#include <stop_token>
#include <vector>

#include "numerics/pair_ldl.h"
#include "numerics/spd_solver.h"

namespace inkgrid {

// minimise  x' A x / 2 - b' x  where x are pairs of reals and, after them, integers; A is symmetric positive definite.
struct MixedIntegerProblem {
  PairMatrix reals{0, {}};              // A between the reals
  std::vector<RealPair> real_b;         // per pair
  std::vector<SparseVector> coupling;   // per integer: its row of A over the reals; terms at the same place add up
  std::vector<Entry<double>> integral;  // lower triangle of A between the integers; entries at the same place add up
  std::vector<double> integral_b;       // per integer
};

struct MixedIntegerSolution {
  std::vector<RealPair> reals;
  std::vector<double> integers;  // exactly integral
  double energy = 0;             // x' A x / 2 - b' x
  double greedy_energy = 0;      // before the local search
  double relaxed_energy = 0;     // its minimum over the reals
  EliminationPlan plan;          // of the reals
};

struct MixedIntegerLimits {
  int threads = 1;
  std::stop_token stop = {};
  int one_by_one = 3000;  // more integers are fixed in batches, and what hardly couples them is left out
};

// Greedy: the integer unknown nearest to an integer is fixed, the others answer, and so on.  Ties: the smaller index.  Where they
// are many, the nearest 32nd part of those that are left is fixed at once.
// Then single integers and pairs of coupled ones move by one as long as the energy falls, the steepest move first.
// `plan`: that of an earlier problem whose reals had blocks at the same places, or none.
// The result is the same for any number of threads.  Throws Error{numerics} when A is not positive definite or holds a value that
// is not finite, Error{cancelled} where it is asked to stop while integers are rounded.
MixedIntegerSolution solve_mixed_integer(const MixedIntegerProblem& problem, EliminationPlan plan = {},
                                         const MixedIntegerLimits& limits = {});

}  // namespace inkgrid
