#include "numerics/ordering.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include "base/at.h"

namespace inkgrid {
namespace {

// The whole pattern, in the form that Eigen asks for: with the diagonal, and with room for the elements of the elimination.
Eigen::SparseMatrix<double> symmetric_pattern(const std::vector<int>& starts, const std::vector<int>& rows) {
  const int size = static_cast<int>(starts.size()) - 1;
  Eigen::SparseMatrix<double> pattern(size, size);
  int* const outer = pattern.outerIndexPtr();
  for (int j = 0; j < size; ++j) {
    outer[j + 1] += 1 + starts[at(j) + 1] - starts[at(j)];
    for (int k = starts[at(j)]; k < starts[at(j) + 1]; ++k) ++outer[rows[at(k)] + 1];
  }
  for (int j = 0; j < size; ++j) outer[j + 1] += outer[j];
  pattern.resizeNonZeros(outer[size]);
  std::vector<int> next(outer, outer + size);
  const auto put = [&](int column, int row) { pattern.innerIndexPtr()[next[at(column)]++] = row; };
  for (int j = 0; j < size; ++j) {
    put(j, j);
    for (int k = starts[at(j)]; k < starts[at(j) + 1]; ++k) {
      put(j, rows[at(k)]);
      put(rows[at(k)], j);
    }
  }
  return pattern;
}

}  // namespace

std::vector<int> elimination_places(const std::vector<int>& starts, const std::vector<int>& rows) {
  Eigen::SparseMatrix<double> pattern = symmetric_pattern(starts, rows);
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;  // order(k): the unknown eliminated as number k
  Eigen::internal::minimum_degree_ordering(pattern, order);
  std::vector<int> places(static_cast<std::size_t>(order.size()));
  for (int k = 0; k < order.size(); ++k) places[at(order.indices()[k])] = k;
  return places;
}

}  // namespace inkgrid
