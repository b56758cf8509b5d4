#include "numerics/ordering.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace inkgrid {

std::vector<int> elimination_places(const std::vector<int>& starts, const std::vector<int>& rows) {
  const int size = static_cast<int>(starts.size()) - 1;
  const std::vector<double> ones(rows.size(), 1.0);
  const Eigen::Map<const Eigen::SparseMatrix<double>> lower(size, size, static_cast<int>(rows.size()), starts.data(), rows.data(),
                                                            ones.data());
  Eigen::SparseMatrix<double> graph;
  graph = lower.selfadjointView<Eigen::Lower>();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;  // order(k): the unknown eliminated as number k
  Eigen::internal::minimum_degree_ordering(graph, order);
  std::vector<int> places(static_cast<std::size_t>(size));
  for (int k = 0; k < size; ++k) places[static_cast<std::size_t>(order.indices()[k])] = k;
  return places;
}

}  // namespace inkgrid
