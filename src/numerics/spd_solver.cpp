#include "numerics/spd_solver.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {

namespace {

constexpr double kPivotTolerance = 1e-14;

Eigen::SparseMatrix<double> sparse_matrix(int size, const std::vector<Entry<double>>& lower) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(lower.size());
  for (const auto& e : lower) triplets.emplace_back(e.row, e.column, e.value);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace

SparseLdl::SparseLdl(int size, const std::vector<Entry<double>>& lower, const std::vector<double>& scale)
    : size_(size), start_(at(size) + 1, 0), removed_(at(size), 0), work_(at(size), 0.0) {
  if (size == 0) return;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt(sparse_matrix(size, lower));
  if (ldlt.info() != Eigen::Success) throw Error(ErrorCode::numerics, "The matrix of a linear system is singular.");
  const auto& order = ldlt.permutationP().indices();
  place_.assign(order.data(), order.data() + size);
  const auto d = ldlt.vectorD();
  pivot_.assign(d.data(), d.data() + size);
  for (int i = 0; i < size; ++i)
    if (!(pivot_[at(place_[at(i)])] > kPivotTolerance * scale[at(i)]))
      throw Error(ErrorCode::numerics, "The matrix of a linear system is not positive definite.");
  const Eigen::SparseMatrix<double>& l = ldlt.matrixL().nestedExpression();
  row_.reserve(static_cast<std::size_t>(l.nonZeros()));
  value_.reserve(static_cast<std::size_t>(l.nonZeros()));
  for (int k = 0; k < size; ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(l, k); it; ++it) {
      row_.push_back(static_cast<int>(it.row()));
      value_.push_back(it.value());
    }
    start_[at(k) + 1] = static_cast<int>(row_.size());
  }
}

int SparseLdl::parent(int column) const {
  return start_[at(column)] < start_[at(column) + 1] ? row_[at(start_[at(column)])] : -1;
}

std::vector<double> SparseLdl::solve(const std::vector<double>& b) const {
  std::vector<double> y(at(size_));
  for (int i = 0; i < size_; ++i) y[at(place_[at(i)])] = b[at(i)];
  for (int k = 0; k < size_; ++k) {
    if (removed_[at(k)]) y[at(k)] = 0;
    const double yk = y[at(k)];
    if (yk == 0) continue;
    for (int p = start_[at(k)]; p < start_[at(k) + 1]; ++p) y[at(row_[at(p)])] -= value_[at(p)] * yk;
  }
  for (int k = size_ - 1; k >= 0; --k) {
    if (removed_[at(k)]) continue;
    double sum = y[at(k)] / pivot_[at(k)];
    for (int p = start_[at(k)]; p < start_[at(k) + 1]; ++p) sum -= value_[at(p)] * y[at(row_[at(p)])];
    y[at(k)] = sum;
  }
  std::vector<double> x(at(size_));
  for (int i = 0; i < size_; ++i) x[at(i)] = y[at(place_[at(i)])];
  return x;
}

void SparseLdl::remove(int i) {
  const int removed = place_[at(i)];
  removed_[at(removed)] = 1;
  for (int p = start_[at(removed)]; p < start_[at(removed) + 1]; ++p) work_[at(row_[at(p)])] = value_[at(p)];
  double weight = pivot_[at(removed)];  // the remaining L D L' gains weight * work * work'
  for (int k = parent(removed); k >= 0; k = parent(k)) {
    const double wk = work_[at(k)];
    work_[at(k)] = 0;
    if (removed_[at(k)] || wk == 0) continue;
    const double pivot = pivot_[at(k)] + weight * wk * wk;
    const double gain = weight * wk / pivot;
    weight *= pivot_[at(k)] / pivot;
    pivot_[at(k)] = pivot;
    for (int p = start_[at(k)]; p < start_[at(k) + 1]; ++p) {
      double& w = work_[at(row_[at(p)])];
      w -= wk * value_[at(p)];
      value_[at(p)] += gain * w;
    }
  }
}

}  // namespace inkgrid
