#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "base/at.h"
#include "map/cut_shifts.h"

namespace inkgrid {
namespace {

using Complex = std::complex<double>;
constexpr int kUnknowns = 4;

Complex complex(IVec2 a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y)};
}

// Sums of multiples of the unknowns that are to be zero, and the same as the rows of a matrix.
struct Equations {
  std::vector<ShiftForm> sums;
  Eigen::MatrixXcd matrix;
};

Equations random_equations(int count, std::mt19937& random) {
  std::uniform_int_distribution<int> factor(-3, 3);
  Equations equations{{}, Eigen::MatrixXcd::Zero(count, kUnknowns)};
  for (int e = 0; e < count; ++e) {
    ShiftForm sum;
    for (int k = 0; k < kUnknowns; ++k) {
      const IVec2 f{factor(random), factor(random)};
      if (f == IVec2{}) continue;
      sum.push_back({k, f});
      equations.matrix(e, k) = complex(f);
    }
    equations.sums.push_back(sum);
  }
  return equations;
}

// The unknowns by what is left free of them.
Eigen::MatrixXcd generators_of(const ShiftLattice& lattice) {
  const std::vector<int> free = lattice.free_shifts();
  Eigen::MatrixXcd generators = Eigen::MatrixXcd::Zero(kUnknowns, static_cast<Eigen::Index>(free.size()));
  for (int k = 0; k < kUnknowns; ++k)
    for (const ShiftTerm& term : lattice.resolve({{k, {1, 0}}})) {
      const auto place = std::lower_bound(free.begin(), free.end(), term.shift);
      EXPECT_TRUE(place != free.end() && *place == term.shift);
      generators(k, place - free.begin()) = complex(term.factor);
    }
  return generators;
}

// Every small integer solution of the equations is an integer combination of the generators.
void expect_generated(const Eigen::MatrixXcd& equations, const Eigen::MatrixXcd& generators) {
  const auto decomposition = generators.colPivHouseholderQr();
  for (int code = 0; code < 6561; ++code) {  // each of eight parts is -1, 0 or 1
    Eigen::VectorXcd x(kUnknowns);
    for (int k = 0, rest = code; k < kUnknowns; ++k, rest /= 9) x[k] = {rest % 3 - 1.0, rest / 3 % 3 - 1.0};
    if ((equations * x).norm() > 1e-9) continue;
    const Eigen::VectorXcd z = decomposition.solve(x);
    EXPECT_LT((generators * z - x).norm(), 1e-9);
    for (const Complex& value : z) EXPECT_LT(std::abs(value - Complex{std::round(value.real()), std::round(value.imag())}), 1e-9);
  }
}

TEST(ShiftLattice, HoldsAllIntegerSolutionsAndNoOthers) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    const Equations equations = random_equations(1 + trial % 3, random);
    ShiftLattice lattice(kUnknowns);
    for (const ShiftForm& sum : equations.sums) lattice.require_zero(sum);
    for (const ShiftForm& sum : equations.sums) EXPECT_TRUE(lattice.resolve(sum).empty());
    const Eigen::MatrixXcd generators = generators_of(lattice);
    EXPECT_EQ(generators.cols(), kUnknowns - Eigen::FullPivLU<Eigen::MatrixXcd>(equations.matrix).rank());
    if (generators.cols() > 0) expect_generated(equations.matrix, generators);
  }
}

}  // namespace
}  // namespace inkgrid
