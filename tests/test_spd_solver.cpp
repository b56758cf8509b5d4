#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "dense_systems.h"
#include "numerics/spd_solver.h"

namespace inkgrid {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SparseLdl factor_of(const MatrixXd& a) {
  const auto size = static_cast<int>(a.rows());
  std::vector<Entry<double>> lower;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j)
      if (a(i, j) != 0) lower.push_back({i, j, a(i, j)});
  const VectorXd diagonal = a.diagonal();
  return SparseLdl(size, lower, {diagonal.data(), diagonal.data() + size});
}

TEST(SparseLdl, RemovedUnknownsLeaveTheRestOfTheSystem) {
  std::mt19937 random(10);
  const int size = 30;
  const MatrixXd a = testing::random_spd(random, size);
  const VectorXd b = VectorXd::LinSpaced(size, -1, 2);
  SparseLdl factor = factor_of(a);
  std::vector<int> order(size);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  while (!order.empty()) {
    const std::vector<double> solved = factor.solve({b.data(), b.data() + size});
    const VectorXd rest = MatrixXd(a(order, order)).llt().solve(VectorXd(b(order)));
    VectorXd expected = VectorXd::Zero(size);
    expected(order) = rest;
    EXPECT_LT((Eigen::Map<const VectorXd>(solved.data(), size) - expected).norm(), 1e-9 * expected.norm());
    factor.remove(order.back());
    order.pop_back();
  }
}

}  // namespace
}  // namespace inkgrid
