// What:   sparse symmetric positive definite systems whose unknowns are held at zero one after the other.
// Source: section 6.2, "Final optimization"; rank-one changes of a factor after Gill, Golub, Murray and Saunders (1974).
// Cost:   one factorisation; a removal costs the columns of the factor between the unknown and the root.
#pragma once

#include <vector>

namespace inkgrid {

// An entry of a sparse matrix; entries at the same place add up.
template <class Scalar>
struct Entry {
  int row;
  int column;
  Scalar value;
};

// A = P' L D L' P, with P chosen for little fill-in.
class SparseLdl {
 public:
  // `lower`: the lower triangle of A.  Throws Error{numerics} unless each pivot clearly exceeds the rounding errors of numbers
  // as large as `scale` (one an unknown; the diagonal of A where A was not itself computed by cancellation).
  SparseLdl(int size, const std::vector<Entry<double>>& lower, const std::vector<double>& scale);

  std::vector<double> solve(const std::vector<double>& b) const;

  // From now on unknown i is held at zero: the others form the system without its row and column.
  void remove(int i);

 private:
  int parent(int column) const;  // of the elimination tree, or -1

  int size_;
  std::vector<int> place_;  // of each unknown in the order of elimination
  std::vector<int> start_;  // L by columns, its unit diagonal left out
  std::vector<int> row_;    // ascending in each column
  std::vector<double> value_;
  std::vector<double> pivot_;  // D
  std::vector<char> removed_;  // by place
  std::vector<double> work_;   // zero between calls
};

}  // namespace inkgrid
