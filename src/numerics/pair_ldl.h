// What:   symmetric positive definite systems with two unknowns a node, as 2 x 2 blocks.
// Source: sections 6.1 and 6.2, the linear systems of the field and of the map.
// Differs: factorised row by row along the elimination tree (Davis 2006, chapter 4); the paper leaves the solver open.
// Cost:   one factorisation; a solve costs a pass down and a pass up the factor.
#pragma once

#include <array>
#include <complex>
#include <utility>
#include <vector>

#include "base/at.h"

namespace inkgrid {

// [a, b; c, d]
struct Block {
  double a = 0, b = 0, c = 0, d = 0;

  Block& operator+=(const Block& o) {
    a += o.a, b += o.b, c += o.c, d += o.d;
    return *this;
  }
  friend Block operator*(double k, const Block& x) { return {k * x.a, k * x.b, k * x.c, k * x.d}; }
};

inline Block transposed(const Block& x) {
  return {x.a, x.c, x.b, x.d};
}

// The two unknowns of a node.
template <class Scalar>
struct Pair {
  Scalar p{}, q{};

  Pair& operator+=(const Pair& o) {
    p += o.p, q += o.q;
    return *this;
  }
  Pair& operator-=(const Pair& o) {
    p -= o.p, q -= o.q;
    return *this;
  }
};
using RealPair = Pair<double>;
using ComplexPair = Pair<std::complex<double>>;

// A term of a sparse vector; over pairs, index 2 node is p and 2 node + 1 is q.
struct SparseTerm {
  int index;
  double value;
};
using SparseVector = std::vector<SparseTerm>;

// Symmetric; the diagonal blocks are symmetric themselves.
class PairMatrix {
 public:
  // `edges`: the pairs of different nodes that may have a block, in any order, repeated or not.
  PairMatrix(int size, const std::vector<std::array<int, 2>>& edges);
  // With blocks where another matrix has them.
  PairMatrix(std::vector<int> starts, std::vector<int> rows);

  // Adds a block at row i and column j, which implies its transpose at (j, i); where i == j it must be symmetric.
  void add(int i, int j, const Block& block);

  std::vector<ComplexPair> times(const std::vector<ComplexPair>& x) const;

  int size() const { return static_cast<int>(diagonal_.size()); }
  const std::vector<int>& starts() const { return starts_; }
  const std::vector<int>& rows() const { return rows_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<Block>& diagonal() const { return diagonal_; }

 private:
  std::vector<int> starts_;  // strictly lower triangle, by columns
  std::vector<int> rows_;    // ascending in each column
  std::vector<Block> blocks_;
  std::vector<Block> diagonal_;
};

inline void PairMatrix::add(int i, int j, const Block& block) {
  if (i == j) {
    diagonal_[at(i)] += block;
    return;
  }
  int k = starts_[at(i < j ? i : j)];
  while (rows_[at(k)] != (i < j ? j : i)) ++k;
  blocks_[at(k)] += i > j ? block : transposed(block);
}

// What a factorisation does, whatever the values: the same for all matrices with blocks at the same places.
struct EliminationPlan {
  std::vector<int> matrix_starts, matrix_rows;  // the strictly lower triangle of A by columns
  std::vector<int> places;                      // of each node in the order of elimination
  std::vector<int> parents;  // per place: that of the first row below the diagonal of its column of L, -1 where it has none
  std::vector<int> starts;   // L by columns, its unit diagonal left out
  // The strictly lower triangle of P A P' by rows: its columns, and its blocks as their places among those of A, or ~place where
  // they are transposed.
  std::vector<int> row_starts, columns, sources;
};

// Reads no values, so that they may be written at the same time.
EliminationPlan plan_elimination(const PairMatrix& matrix);

// Places that may be eliminated at the same time: subtrees of the tree of elimination, and the rest above them.
struct EliminationTasks {
  std::vector<std::vector<int>> subtrees;  // each ascending, and with all below its places
  std::vector<int> rest;                   // ascending
};

// Subtrees of at most a share of the work.
EliminationTasks elimination_tasks(const EliminationPlan& plan, double share);

// A = P' L D L' P.
class PairLdl {
 public:
  // Throws Error{numerics} where the matrix is not positive definite.  An empty plan is made first.  The result is the same for
  // any number of threads.
  explicit PairLdl(const PairMatrix& matrix, EliminationPlan plan = {}, int threads = 1);

  const EliminationPlan& plan() const& { return plan_; }
  EliminationPlan plan() && { return std::move(plan_); }

  // For real and for complex pairs.
  template <class Scalar>
  std::vector<Pair<Scalar>> solve(const std::vector<Pair<Scalar>>& right) const;

 private:
  friend class HalfSolver;

  EliminationPlan plan_;
  std::vector<int> rows_;      // ascending in each column
  std::vector<Block> blocks_;  // of L, transposed
  std::vector<Block> inverse_pivots_;
};

// Solves with sparse right hand sides; one for each thread.
class HalfSolver {
 public:
  explicit HalfSolver(const PairLdl& factor);

  // D^(-1/2) L^(-1) P a without its terms below `floor` (in size), so that dot products of such vectors are a' A^(-1) b.
  SparseVector solve(const SparseVector& a, double floor);

 private:
  void find_reach(const SparseVector& a);

  const PairLdl& factor_;
  std::vector<RealPair> work_;  // zero between calls
  std::vector<char> marked_;    // zero between calls
  std::vector<int> reach_, path_;
};

}  // namespace inkgrid
