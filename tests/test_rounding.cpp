#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stop_token>
#include <vector>

#include "dense_systems.h"
#include "inkgrid/inkgrid.h"
#include "numerics/rounding.h"

namespace inkgrid {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Quadratic quadratic_of(const MatrixXd& s, const VectorXd& h) {
  const auto size = static_cast<int>(s.rows());
  Quadratic q{std::vector<SparseVector>(static_cast<std::size_t>(size)), {}, {h.data(), h.data() + size}, 0};
  for (int i = 0; i < size; ++i) {
    q.diagonal.push_back(s(i, i));
    for (int j = 0; j < size; ++j)
      if (i != j && s(i, j) != 0) q.rows[static_cast<std::size_t>(i)].push_back({j, s(i, j)});
  }
  return q;
}

VectorXd random_vector(std::mt19937& random, int size) {
  std::normal_distribution<double> normal(0, 3);
  return VectorXd::NullaryExpr(size, [&](Eigen::Index) { return normal(random); });
}

VectorXd dense(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

TEST(Rounding, EnergyAndGradientAreThoseOfTheDenseForm) {
  std::mt19937 random(1);
  const MatrixXd s = testing::random_spd(random, 12);
  const VectorXd h = random_vector(random, 12), x = random_vector(random, 12), gradient = s * x - h;
  Quadratic q = quadratic_of(s, h);
  q.constant = 7;
  const std::vector<double> values(x.data(), x.data() + 12);
  EXPECT_NEAR(q.energy(values), 0.5 * x.dot(s * x) - h.dot(x) + 7, 1e-9);
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(q.gradient(values, i), gradient[i], 1e-9);
}

TEST(Rounding, BothBeginAtTheMinimumOverTheReals) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const MatrixXd s = testing::random_spd(random, 60);
    const VectorXd h = random_vector(random, 60), minimum = s.llt().solve(h);
    const Quadratic q = quadratic_of(s, h);
    EXPECT_LT((dense(round_one_by_one(q, q.diagonal, {}).relaxed) - minimum).norm(), 1e-8 * minimum.norm());
    const VectorXd residual = s * dense(round_in_batches(q, {}).relaxed) - h;
    EXPECT_LE(residual.cwiseQuotient(s.diagonal()).cwiseAbs().maxCoeff(), 1.001e-3);
  }
}

// Fixing some at once is worse than one by one by less than what the search gains.
TEST(Rounding, ManyAreFixedInBatches) {
  std::mt19937 random(3);
  double one_by_one = 0, batches = 0, searched = 0;
  int different = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Quadratic q = quadratic_of(testing::random_spd(random, 200), random_vector(random, 200));
    const Rounding one = round_one_by_one(q, q.diagonal, {}), many = round_in_batches(q, {});
    const std::vector<double> found = descend(q, many.rounded, {});
    for (const double x : many.rounded) EXPECT_EQ(x, std::round(x));
    for (const double x : found) EXPECT_EQ(x, std::round(x));
    const double relaxed = q.energy(one.relaxed);
    one_by_one += q.energy(one.rounded) - relaxed;
    batches += q.energy(many.rounded) - relaxed;
    searched += q.energy(found) - relaxed;
    different += many.rounded != one.rounded;
  }
  EXPECT_GT(different, 0) << "nothing was fixed at once";
  EXPECT_LT(batches, 1.1 * one_by_one);
  EXPECT_LT(searched, one_by_one);
}

TEST(Rounding, InBatchesRefusesWhatHasNoMinimum) {
  MatrixXd s = MatrixXd::Identity(2, 2);
  s(0, 1) = s(1, 0) = 2;
  try {
    round_in_batches(quadratic_of(s, VectorXd{{1, -1}}), {});
    ADD_FAILURE() << "it went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::numerics);
  }
}

}  // namespace
}  // namespace inkgrid
