// Dense systems beside which sparse ones are checked.
#pragma once

#include <Eigen/Dense>
#include <random>

namespace inkgrid::testing {

// Symmetric positive definite; about six couplings a row.
inline Eigen::MatrixXd random_spd(std::mt19937& random, int size) {
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> pick(0, size - 1);
  Eigen::MatrixXd a = 0.05 * Eigen::MatrixXd::Identity(size, size);
  for (int k = 0; k < 2 * size; ++k) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
    for (int t = 0; t < 3; ++t) row[pick(random)] += normal(random);
    a += row * row.transpose();
  }
  return a;
}

}  // namespace inkgrid::testing
