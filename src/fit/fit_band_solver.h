// What:   symmetric positive definite systems whose unknowns follow a curve.
// Source: section 6.3, "Curve fitting": the normal equations.
// Differs: the paper leaves the solver open; rows start at their first entry, so only the last rows of closed curves are long.
// Cost:   the sum of the squares of the row lengths.
#pragma once

#include <array>
#include <vector>

#include "base/at.h"

namespace inkgrid {

class BandSystem {
 public:
  // `groups`: the unknowns that share entries; -1 is none.
  BandSystem(int count, const std::vector<std::array<int, 8>>& groups);

  double& entry(int row, int column);  // of the symmetric matrix, either triangle
  double& gradient(int row) { return right_[at(row)]; }

  // matrix * solution = gradient, by Cholesky in place; false where the matrix is not positive definite.
  bool solve(std::vector<double>& solution);

 private:
  std::vector<std::size_t> first_, start_;  // of each row: its first column and where it is stored
  std::vector<double> values_, right_;
};

}  // namespace inkgrid
