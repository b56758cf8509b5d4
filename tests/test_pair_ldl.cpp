#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "inkgrid/inkgrid.h"
#include "numerics/pair_ldl.h"

namespace inkgrid {
namespace {

using Complex = std::complex<double>;

// Random positive semidefinite blocks between random nodes, and `shift` on the diagonal; kept as a dense matrix too.
struct RandomSystem {
  PairMatrix matrix;
  std::vector<std::vector<double>> dense;

  RandomSystem(std::mt19937& random, int nodes, int edges, double shift)
      : RandomSystem(nodes, random_edges(random, nodes, edges), shift) {
    for (const auto& [i, j] : edges_) add_square(random, i, j);
  }

 private:
  RandomSystem(int nodes, std::vector<std::array<int, 2>> edges, double shift)
      : matrix(nodes, edges),
        dense(static_cast<std::size_t>(2 * nodes), std::vector<double>(static_cast<std::size_t>(2 * nodes), 0.0)),
        edges_(std::move(edges)) {
    for (int i = 0; i < nodes; ++i) add(i, i, {shift, 0, 0, shift});
  }

  static std::vector<std::array<int, 2>> random_edges(std::mt19937& random, int nodes, int edges) {
    std::uniform_int_distribution<int> node(0, nodes - 1);
    std::vector<std::array<int, 2>> result;
    while (static_cast<int>(result.size()) < edges) {
      const int i = node(random), j = node(random);
      if (i != j) result.push_back({i, j});
    }
    return result;
  }

  void add(int i, int j, const Block& b) {
    matrix.add(i, j, b);
    const double entries[2][2] = {{b.a, b.b}, {b.c, b.d}};
    for (int r : {0, 1})
      for (int c : {0, 1}) {
        const auto row = static_cast<std::size_t>(2 * i + r), column = static_cast<std::size_t>(2 * j + c);
        dense[row][column] += entries[r][c];
        if (i != j) dense[column][row] += entries[r][c];
      }
  }

  // (u' x_i + v' x_j)^2
  void add_square(std::mt19937& random, int i, int j) {
    std::normal_distribution<double> normal;
    const double u[2] = {normal(random), normal(random)}, v[2] = {normal(random), normal(random)};
    add(i, i, {u[0] * u[0], u[0] * u[1], u[0] * u[1], u[1] * u[1]});
    add(j, j, {v[0] * v[0], v[0] * v[1], v[0] * v[1], v[1] * v[1]});
    add(i, j, {u[0] * v[0], u[0] * v[1], u[1] * v[0], u[1] * v[1]});
  }

  std::vector<std::array<int, 2>> edges_;
};

std::vector<ComplexPair> random_pairs(std::mt19937& random, int size) {
  std::normal_distribution<double> normal;
  std::vector<ComplexPair> x(static_cast<std::size_t>(size));
  for (auto& pair : x) pair = {{normal(random), normal(random)}, {normal(random), normal(random)}};
  return x;
}

Complex entry(const std::vector<ComplexPair>& x, std::size_t i) {
  return i % 2 ? x[i / 2].q : x[i / 2].p;
}

TEST(PairMatrix, TimesAVectorIsTheDenseProduct) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const RandomSystem system(random, 15, 30, 0.5);
    const auto x = random_pairs(random, 15), y = system.matrix.times(x);
    for (std::size_t i = 0; i < 30; ++i) {
      Complex expected = 0;
      for (std::size_t j = 0; j < 30; ++j) expected += system.dense[i][j] * entry(x, j);
      EXPECT_LT(std::abs(entry(y, i) - expected), 1e-12);
    }
  }
}

TEST(PairLdl, SolvesSparseAndDenseSystems) {
  std::mt19937 random(4);
  for (const auto& [nodes, edges] : {std::pair{1, 0}, {2, 1}, {20, 0}, {40, 60}, {300, 500}, {30, 400}}) {
    const RandomSystem system(random, nodes, edges, 0.3);
    const auto x = random_pairs(random, nodes);
    const auto found = PairLdl(system.matrix).solve(system.matrix.times(x));
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_LT(std::abs(found[i].p - x[i].p), 1e-9) << nodes << ' ' << edges;
      EXPECT_LT(std::abs(found[i].q - x[i].q), 1e-9) << nodes << ' ' << edges;
    }
  }
}

// Other values at the same places.
TEST(PairLdl, APlanIsOfUseForOtherValuesToTheLastDigit) {
  std::mt19937 random(5);
  const RandomSystem first(random, 60, 90, 0.3);
  PairMatrix other = first.matrix;
  std::normal_distribution<double> normal;
  for (int i = 0; i < other.size(); ++i) other.add(i, i, {1 + std::abs(normal(random)), 0, 0, 2});
  const auto right = random_pairs(random, 60);
  const auto afresh = PairLdl(other).solve(right), planned = PairLdl(other, PairLdl(first.matrix).plan()).solve(right);
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_EQ(planned[i].p, afresh[i].p);
    EXPECT_EQ(planned[i].q, afresh[i].q);
  }
}

TEST(PairLdl, RealAndComplexSolutionsAgree) {
  std::mt19937 random(6);
  const RandomSystem system(random, 40, 70, 0.3);
  const auto right = random_pairs(random, 40);
  std::vector<RealPair> real_part;
  for (const auto& pair : right) real_part.push_back({pair.p.real(), pair.q.real()});
  const PairLdl factor(system.matrix);
  const auto complex_solution = factor.solve(right);
  const auto real_solution = factor.solve(real_part);
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_NEAR(real_solution[i].p, complex_solution[i].p.real(), 1e-12);
    EXPECT_NEAR(real_solution[i].q, complex_solution[i].q.real(), 1e-12);
  }
}

TEST(PairLdl, ProductsOfHalfSolvedVectorsAreThoseOfTheInverse) {
  std::mt19937 random(11);
  const int nodes = 15;
  const RandomSystem system(random, nodes, 25, 0.2);
  PairLdl factor(system.matrix);
  std::uniform_int_distribution<int> pick(0, 2 * nodes - 1);
  for (int trial = 0; trial < 20; ++trial) {
    std::array<std::vector<RealPair>, 2> vectors;
    std::array<std::vector<double>, 2> halves;
    for (std::size_t k = 0; k < 2; ++k) {
      vectors[k].resize(nodes);
      halves[k].assign(2 * nodes, 0.0);
      SparseVector sparse;
      for (int t = 0; t < 3; ++t) {
        sparse.push_back({pick(random), 1.0 + t});
        RealPair& pair = vectors[k][static_cast<std::size_t>(sparse.back().index / 2)];
        (sparse.back().index % 2 ? pair.q : pair.p) += 1.0 + t;
      }
      for (const SparseTerm& term : HalfSolver(factor).solve(sparse, 0))
        halves[k][static_cast<std::size_t>(term.index)] += term.value;
    }
    const auto solved = factor.solve(vectors[1]);
    double expected = 0, product = 0;
    for (std::size_t i = 0; i < vectors[0].size(); ++i) expected += vectors[0][i].p * solved[i].p + vectors[0][i].q * solved[i].q;
    for (std::size_t i = 0; i < halves[0].size(); ++i) product += halves[0][i] * halves[1][i];
    EXPECT_NEAR(product, expected, 1e-9 * (1 + std::abs(expected)));
  }
}

// A grid of nodes, each coupled to the next ones in its row and column.
PairMatrix grid_matrix(int side) {
  std::vector<std::array<int, 2>> edges;
  for (int i = 0; i < side * side; ++i) {
    if (i % side > 0) edges.push_back({i, i - 1});
    if (i >= side) edges.push_back({i, i - side});
  }
  PairMatrix matrix(side * side, edges);
  for (int i = 0; i < side * side; ++i) matrix.add(i, i, {4.1, 0.3, 0.3, 4.5 + 0.01 * (i % 7)});
  for (const auto& [i, j] : edges) matrix.add(i, j, {-1, 0.1, -0.1, -0.9});
  return matrix;
}

TEST(EliminationTasks, SubtreesHoldAllBelowTheirPlacesAndAreSmall) {
  const EliminationPlan plan = PairLdl(grid_matrix(30)).plan();
  const EliminationTasks tasks = elimination_tasks(plan, 0.125);
  constexpr int kRest = -2;
  std::vector<int> task(900, -1);
  const auto put = [&](const std::vector<int>& places, int number) {
    EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
    for (const int k : places) EXPECT_EQ(std::exchange(task[static_cast<std::size_t>(k)], number), -1) << "twice";
  };
  for (int t = 0; t < static_cast<int>(tasks.subtrees.size()); ++t) put(tasks.subtrees[static_cast<std::size_t>(t)], t);
  put(tasks.rest, kRest);
  std::vector<double> work(tasks.subtrees.size(), 0.0);
  double all = 0;
  for (std::size_t k = 0; k < 900; ++k) {
    ASSERT_NE(task[k], -1);
    const double own = 1 + std::pow(plan.starts[k + 1] - plan.starts[k], 2);
    all += own;
    if (task[k] != kRest) work[static_cast<std::size_t>(task[k])] += own;
    const int parent = plan.parents[k];
    if (parent < 0) continue;
    const int above = task[static_cast<std::size_t>(parent)];
    EXPECT_TRUE(above == task[k] || above == kRest);
  }
  EXPECT_GE(tasks.subtrees.size(), 8U);
  EXPECT_LE(*std::max_element(work.begin(), work.end()), 0.125 * all);
  EXPECT_LT(static_cast<double>(tasks.rest.size()), 0.3 * 900);
}

TEST(PairLdl, IsTheSameForAnyNumberOfThreads) {
  constexpr int kSide = 60;
  const PairMatrix matrix = grid_matrix(kSide);
  std::mt19937 random(8);
  const auto right = random_pairs(random, kSide * kSide);
  std::vector<RealPair> real_part;
  for (const ComplexPair& pair : right) real_part.push_back({pair.p.real(), pair.q.real()});
  const auto alone = PairLdl(matrix).solve(right);
  const auto residual = matrix.times(alone);
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_LT(std::abs(residual[i].p - right[i].p), 1e-9);
    ASSERT_LT(std::abs(residual[i].q - right[i].q), 1e-9);
  }
  for (const int threads : {2, 5}) {
    const PairLdl factor(matrix, {}, threads);
    const auto shared = factor.solve(right);
    const auto shared_of_reals = factor.solve(real_part);
    for (std::size_t i = 0; i < right.size(); ++i) {
      ASSERT_EQ(shared[i].p, alone[i].p);
      ASSERT_EQ(shared[i].q, alone[i].q);
      ASSERT_EQ(shared_of_reals[i].p, alone[i].p.real());
      ASSERT_EQ(shared_of_reals[i].q, alone[i].q.real());
    }
  }
}

TEST(PairLdl, RefusesWhatIsNotPositiveDefinite) {
  std::mt19937 random(5);
  const auto refused = [](const PairMatrix& matrix) {
    try {
      PairLdl{matrix};
      return false;
    } catch (const Error& error) {
      return error.code() == ErrorCode::numerics;
    }
  };
  EXPECT_TRUE(refused(RandomSystem(random, 10, 3, 0).matrix)) << "singular";
  EXPECT_TRUE(refused(RandomSystem(random, 10, 12, -0.1).matrix)) << "indefinite";
  PairMatrix negative(1, {});
  negative.add(0, 0, {-1, 0, 0, -1});
  EXPECT_TRUE(refused(negative)) << "negative, with a positive determinant";
  PairMatrix strange(1, {});
  strange.add(0, 0, {std::nan(""), 0, 0, 1});
  EXPECT_TRUE(refused(strange)) << "no number";
}

TEST(PairLdl, KeepsWhatIsHeldWeakly) {
  PairMatrix matrix(2, {{1, 0}});
  const double weak = 1e-9;
  matrix.add(0, 0, {1 + weak, 0, 0, weak});
  matrix.add(1, 1, {1 + weak, 0, 0, weak});
  matrix.add(1, 0, {-1, 0, 0, 0});
  const auto x = PairLdl(matrix).solve(std::vector<RealPair>{{weak, 2 * weak}, {weak, 3 * weak}});
  EXPECT_NEAR(x[0].p, 1, 1e-6);
  EXPECT_NEAR(x[1].p, 1, 1e-6);
  EXPECT_NEAR(x[0].q, 2, 1e-6);
  EXPECT_NEAR(x[1].q, 3, 1e-6);
}

}  // namespace
}  // namespace inkgrid
