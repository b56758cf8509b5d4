#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "dense_systems.h"
#include "inkgrid/inkgrid.h"
#include "numerics/mixed_integer.h"

namespace inkgrid {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Reals and integers in any order; entries at the same place add up.
struct Problem {
  int size = 0;
  std::vector<Entry<double>> lower;
  std::vector<double> b;
  std::vector<int> integers;  // ascending
};

struct Solution : MixedIntegerSolution {
  std::vector<double> x;
};

// Where each unknown of a problem stands: among the reals, two of which are a pair, or among the integers.
struct Places {
  std::vector<int> real, integer;  // -1 where it is the other
  int reals = 0;
};

Places places_of(const Problem& problem) {
  Places places{std::vector<int>(static_cast<std::size_t>(problem.size), -1),
                std::vector<int>(static_cast<std::size_t>(problem.size), -1)};
  int integers = 0;
  for (std::size_t i = 0; i < places.real.size(); ++i) {
    const bool integer = std::binary_search(problem.integers.begin(), problem.integers.end(), static_cast<int>(i));
    (integer ? places.integer[i] : places.real[i]) = integer ? integers++ : places.reals++;
  }
  return places;
}

Block block_of(int row, int column, double value) {
  Block block;
  (row % 2 == 0 ? (column % 2 == 0 ? block.a : block.b) : (column % 2 == 0 ? block.c : block.d)) = value;
  return block;
}

void add_real_entry(PairMatrix& reals, int row, int column, double value) {
  reals.add(row / 2, column / 2, block_of(row, column, value));
  if (row / 2 == column / 2 && row != column) reals.add(row / 2, column / 2, block_of(column, row, value));
}

// An odd real is paired with one of its own that nothing else knows.
MixedIntegerProblem paired(const Problem& problem) {
  const Places places = places_of(problem);
  const std::size_t pairs = static_cast<std::size_t>(places.reals + 1) / 2;
  const auto real = [&](int i) { return places.real[static_cast<std::size_t>(i)]; };
  std::vector<std::array<int, 2>> edges;
  for (const auto& e : problem.lower)
    if (real(e.row) >= 0 && real(e.column) >= 0 && real(e.row) / 2 != real(e.column) / 2)
      edges.push_back({real(e.row) / 2, real(e.column) / 2});
  MixedIntegerProblem result{PairMatrix(static_cast<int>(pairs), edges),
                             std::vector<RealPair>(pairs),
                             std::vector<SparseVector>(problem.integers.size()),
                             {},
                             {}};
  if (places.reals % 2 != 0) add_real_entry(result.reals, places.reals, places.reals, 1);
  for (const auto& e : problem.lower) {
    const int row = real(e.row), column = real(e.column);
    const int i = places.integer[static_cast<std::size_t>(e.row)], j = places.integer[static_cast<std::size_t>(e.column)];
    if (row >= 0 && column >= 0)
      add_real_entry(result.reals, row, column, e.value);
    else if (row < 0 && column < 0)
      result.integral.push_back({i, j, e.value});
    else
      result.coupling[static_cast<std::size_t>(std::max(i, j))].push_back({std::max(row, column), e.value});
  }
  for (int i = 0; i < problem.size; ++i) {
    const double b = problem.b[static_cast<std::size_t>(i)];
    if (real(i) < 0)
      result.integral_b.push_back(b);
    else
      (real(i) % 2 == 0 ? result.real_b[static_cast<std::size_t>(real(i) / 2)].p
                        : result.real_b[static_cast<std::size_t>(real(i) / 2)].q) = b;
  }
  return result;
}

Solution solve_mixed_integer(const Problem& problem) {
  const Places places = places_of(problem);
  Solution solution{solve_mixed_integer(paired(problem)), {}};
  for (std::size_t i = 0; i < places.real.size(); ++i) {
    const int real = places.real[i];
    const RealPair pair = real < 0 ? RealPair{} : solution.reals[static_cast<std::size_t>(real / 2)];
    solution.x.push_back(real < 0        ? solution.integers[static_cast<std::size_t>(places.integer[i])]
                         : real % 2 == 0 ? pair.p
                                         : pair.q);
  }
  return solution;
}

MatrixXd dense_matrix(const Problem& problem) {
  MatrixXd a = MatrixXd::Zero(problem.size, problem.size);
  for (const auto& e : problem.lower) {
    a(e.row, e.column) += e.value;
    if (e.row != e.column) a(e.column, e.row) += e.value;
  }
  return a;
}

VectorXd dense_vector(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

double energy_of(const Problem& problem, const VectorXd& x) {
  return 0.5 * x.dot(dense_matrix(problem) * x) - dense_vector(problem.b).dot(x);
}

Problem problem_of(const MatrixXd& a, const VectorXd& b, const std::vector<int>& integers) {
  Problem problem{static_cast<int>(a.rows()), {}, {b.data(), b.data() + b.size()}, integers};
  for (int i = 0; i < problem.size; ++i)
    for (int j = 0; j <= i; ++j)
      if (a(i, j) != 0) problem.lower.push_back({i, j, a(i, j)});
  return problem;
}

// A sum of squares of few-term residuals, as in a map, plus a small damping.
Problem random_problem(std::mt19937& random, int size, int integer_count) {
  std::normal_distribution<double> normal;
  VectorXd b(size);
  for (int i = 0; i < size; ++i) b[i] = 3 * normal(random);
  const MatrixXd a = testing::random_spd(random, size);
  std::vector<int> order(static_cast<std::size_t>(size));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<int> integers(order.begin(), order.begin() + integer_count);
  std::sort(integers.begin(), integers.end());
  return problem_of(a, b, integers);
}

// S and h of  x' S x / 2 - h' x + constant, the least energy for given integers; dense and independent of the code under test.
struct DenseReduction {
  MatrixXd s;
  VectorXd h;
  double constant;
};

DenseReduction reduce_densely(const Problem& problem) {
  const MatrixXd a = dense_matrix(problem);
  const VectorXd b = dense_vector(problem.b);
  const auto& integers = problem.integers;
  std::vector<int> reals;
  for (int i = 0; i < problem.size; ++i)
    if (!std::binary_search(integers.begin(), integers.end(), i)) reals.push_back(i);
  const MatrixXd inverse = MatrixXd(a(reals, reals)).inverse();
  const VectorXd real_b = b(reals);
  return {a(integers, integers) - a(integers, reals) * inverse * a(reals, integers),
          b(integers) - a(integers, reals) * inverse * real_b, -0.5 * real_b.dot(inverse * real_b)};
}

double reduced_energy(const DenseReduction& r, const VectorXd& x) {
  return 0.5 * x.dot(r.s * x) - r.h.dot(x) + r.constant;
}

// The best integers by depth-first search, cut off by the (exact) bound of each Cholesky level.
double brute_force_energy(const DenseReduction& r) {
  const int m = static_cast<int>(r.h.size());
  const VectorXd centre = r.s.ldlt().solve(r.h);
  const MatrixXd upper = r.s.llt().matrixU();
  double best = std::numeric_limits<double>::infinity();
  VectorXd x = centre;
  std::function<void(int, double)> descend = [&](int level, double cost) {
    if (cost >= best) return;
    if (level < 0) {
      best = cost;
      return;
    }
    double tail = 0;
    for (int j = level + 1; j < m; ++j) tail += upper(level, j) * (x[j] - centre[j]);
    const double middle = centre[level] - tail / upper(level, level);
    const double reach = std::sqrt(2 * std::min(best - cost, 1e6)) / upper(level, level);
    const double limit = std::isfinite(best) ? reach : 40;
    for (double v = std::ceil(middle - limit); v <= middle + limit; ++v) {
      x[level] = v;
      const double residual = upper(level, level) * (v - middle);
      descend(level - 1, cost + 0.5 * residual * residual);
    }
  };
  descend(m - 1, 0);
  return best + reduced_energy(r, centre);
}

TEST(MixedInteger, WithoutIntegersIsTheLinearSolution) {
  std::mt19937 random(1);
  const Problem problem = random_problem(random, 40, 0);
  const auto solution = solve_mixed_integer(problem);
  const VectorXd expected = dense_matrix(problem).llt().solve(dense_vector(problem.b));
  EXPECT_LT((dense_vector(solution.x) - expected).norm(), 1e-9 * expected.norm());
  EXPECT_NEAR(solution.energy, solution.relaxed_energy, 1e-9 * std::abs(solution.energy));
}

TEST(MixedInteger, EmptyProblem) {
  EXPECT_TRUE(solve_mixed_integer({}).x.empty());
}

TEST(MixedInteger, DuplicateEntriesAddUp) {
  const Problem problem{2, {{0, 0, 1.0}, {1, 1, 2.0}, {1, 0, 0.25}, {0, 0, 1.0}, {1, 0, 0.25}}, {1, 1}, {}};
  const auto solution = solve_mixed_integer(problem);
  EXPECT_NEAR(2 * solution.x[0] + 0.5 * solution.x[1], 1, 1e-14);
  EXPECT_NEAR(0.5 * solution.x[0] + 2 * solution.x[1], 1, 1e-14);
}

TEST(MixedInteger, EnergiesAreThoseOfTheirDefinition) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 30; ++trial) {
    const Problem problem = random_problem(random, 30, 1 + trial % 12);
    const auto solution = solve_mixed_integer(problem);
    const double magnitude = 1 + std::abs(solution.relaxed_energy);
    for (int i : problem.integers)
      EXPECT_EQ(solution.x[static_cast<std::size_t>(i)], std::round(solution.x[static_cast<std::size_t>(i)]));
    EXPECT_NEAR(solution.energy, energy_of(problem, dense_vector(solution.x)), 1e-9 * magnitude);
    const VectorXd relaxed = dense_matrix(problem).llt().solve(dense_vector(problem.b));
    EXPECT_NEAR(solution.relaxed_energy, energy_of(problem, relaxed), 1e-8 * magnitude);
  }
}

TEST(MixedInteger, RealsAnswerTheIntegers) {
  std::mt19937 random(3);
  const Problem problem = random_problem(random, 60, 15);
  const auto solution = solve_mixed_integer(problem);
  const VectorXd gradient = dense_matrix(problem) * dense_vector(solution.x) - dense_vector(problem.b);
  for (int i = 0; i < problem.size; ++i)
    if (!std::binary_search(problem.integers.begin(), problem.integers.end(), i)) {
      EXPECT_NEAR(gradient[i], 0, 1e-9);
    }
}

TEST(MixedInteger, OneIntegerIsOptimal) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Problem problem = random_problem(random, 12, 1);
    const DenseReduction r = reduce_densely(problem);
    EXPECT_EQ(solve_mixed_integer(problem).x[static_cast<std::size_t>(problem.integers[0])], std::round(r.h[0] / r.s(0, 0)));
  }
}

TEST(MixedInteger, UncoupledIntegersAreOptimal) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-9, 9), weight(1e-3, 1e3);
  MatrixXd a = MatrixXd::Zero(20, 20);
  VectorXd b(20);
  for (int i = 0; i < 20; ++i) {
    a(i, i) = weight(random);
    b[i] = a(i, i) * value(random);
  }
  std::vector<int> all(20);
  std::iota(all.begin(), all.end(), 0);
  const auto solution = solve_mixed_integer(problem_of(a, b, all));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(solution.x[static_cast<std::size_t>(i)], std::round(b[i] / a(i, i)));
}

// Fixing an integer costs at most an eighth of its row's diagonal of S, since it moves by 1/2 at most and the others answer.
TEST(MixedInteger, LiesBetweenTheOptimumAndTheBoundOfGreedyRounding) {
  std::mt19937 random(6);
  int optimal = 0, improved = 0;
  const int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    const Problem problem = random_problem(random, 14, 2 + trial % 5);
    const auto solution = solve_mixed_integer(problem);
    const DenseReduction r = reduce_densely(problem);
    const double best = brute_force_energy(r), tolerance = 1e-7 * (1 + std::abs(best));
    EXPECT_GE(solution.energy, best - tolerance);
    EXPECT_LE(solution.energy, solution.greedy_energy + tolerance);
    EXPECT_LE(solution.greedy_energy, solution.relaxed_energy + r.s.trace() / 8 + tolerance);
    optimal += solution.energy <= best + tolerance;
    improved += solution.energy < solution.greedy_energy - tolerance;
  }
  EXPECT_GT(optimal, trials * 9 / 10);
  EXPECT_GT(improved, 0);
}

TEST(MixedInteger, GreedyFixesTheNearestToAnIntegerFirst) {
  // x1 = 0.85 goes to 1 and drags x0 from 0.4 to 0.4 + 0.9 * 0.15 > 1/2; had x0 gone to 0 first, x1 would have followed.
  const double c = 0.9;
  MatrixXd s(2, 2);
  s << 1, -c, -c, 1;
  const VectorXd relaxed = (VectorXd(2) << 0.4, 0.85).finished();
  const auto solution = solve_mixed_integer(problem_of(s, s * relaxed, {0, 1}));
  const VectorXd error = VectorXd::Ones(2) - relaxed;
  EXPECT_EQ(solution.x, (std::vector<double>{1, 1}));
  EXPECT_NEAR(solution.greedy_energy - solution.relaxed_energy, 0.5 * error.dot(s * error), 1e-12);
}

TEST(MixedInteger, NoStepOfOneOrTwoIntegersLowersTheEnergy) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const Problem problem = random_problem(random, 25, 10);
    const auto solution = solve_mixed_integer(problem);
    const DenseReduction r = reduce_densely(problem);
    VectorXd x = dense_vector(solution.x)(problem.integers);
    const double energy = reduced_energy(r, x);
    for (int i = 0; i < 10; ++i)
      for (int j = 0; j < 10; ++j)
        for (int si = -1; si <= 1; ++si)
          for (int sj = -1; sj <= 1; ++sj) {
            VectorXd moved = x;
            moved[i] += si;
            moved[j] += i == j ? 0 : sj;
            EXPECT_GE(reduced_energy(r, moved), energy - 1e-7 * (1 + std::abs(energy)));
          }
  }
}

TEST(MixedInteger, AnOrderOfTheUnknownsIsOnlyAnOrder) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const Problem problem = random_problem(random, 40, 12);
    std::vector<int> to(40);
    std::iota(to.begin(), to.end(), 0);
    std::shuffle(to.begin(), to.end(), random);
    const auto moved = [&](int i) { return to[static_cast<std::size_t>(i)]; };
    Problem permuted{problem.size, {}, std::vector<double>(40), {}};
    for (const auto& e : problem.lower)
      permuted.lower.push_back({std::max(moved(e.row), moved(e.column)), std::min(moved(e.row), moved(e.column)), e.value});
    for (int i = 0; i < 40; ++i) permuted.b[static_cast<std::size_t>(moved(i))] = problem.b[static_cast<std::size_t>(i)];
    for (int i : problem.integers) permuted.integers.push_back(moved(i));
    std::sort(permuted.integers.begin(), permuted.integers.end());
    const auto a = solve_mixed_integer(problem), b = solve_mixed_integer(permuted);
    for (int i = 0; i < 40; ++i) EXPECT_NEAR(a.x[static_cast<std::size_t>(i)], b.x[static_cast<std::size_t>(moved(i))], 1e-7);
  }
}

// A chain of strong pins, real and integer in turn: what couples far integers is negligible, and left out; the energies must not
// notice.
TEST(MixedInteger, ALongChainKeepsItsEnergies) {
  const int pairs = 150;
  Problem problem{2 * pairs, {}, std::vector<double>(2 * pairs, 0.0), {}};
  const auto bond = [&](int i, int j, double weight, double difference) {  // weight / 2 * (x_i - x_j - difference)^2
    problem.lower.push_back({i, i, weight});
    problem.lower.push_back({j, j, weight});
    problem.lower.push_back({std::max(i, j), std::min(i, j), -weight});
    problem.b[static_cast<std::size_t>(i)] += weight * difference;
    problem.b[static_cast<std::size_t>(j)] -= weight * difference;
  };
  for (int k = 0; k < pairs; ++k) {
    bond(2 * k, 2 * k + 1, 2500, 0);
    if (k > 0) bond(2 * k, 2 * k - 2, 0.7, 1.37 + 0.2 * std::sin(k));
    problem.lower.push_back({2 * k, 2 * k, 1e-6});
    problem.integers.push_back(2 * k + 1);
  }
  const auto solution = solve_mixed_integer(problem);
  EXPECT_NEAR(solve_mixed_integer(paired(problem), {}, {1, {}, 10}).relaxed_energy, solution.relaxed_energy, 0.1);
  EXPECT_NEAR(solution.energy, energy_of(problem, dense_vector(solution.x)), 1e-5);
  const VectorXd relaxed = dense_matrix(problem).ldlt().solve(dense_vector(problem.b));
  EXPECT_NEAR(solution.relaxed_energy, energy_of(problem, relaxed), 1e-5);
  for (int k = 1; k < pairs; ++k) {
    const double step = solution.x[static_cast<std::size_t>(2 * k + 1)] - solution.x[static_cast<std::size_t>(2 * k - 1)];
    EXPECT_LT(std::abs(step - (1.37 + 0.2 * std::sin(k))), 1.0);
  }
}

// A long chain of pairs of reals, and integers that pull two of them each.
MixedIntegerProblem many_integers(int pairs, int integers) {
  std::vector<std::array<int, 2>> edges;
  for (int i = 1; i < pairs; ++i) edges.push_back({i, i - 1});
  MixedIntegerProblem problem{PairMatrix(pairs, edges),
                              std::vector<RealPair>(static_cast<std::size_t>(pairs)),
                              std::vector<SparseVector>(static_cast<std::size_t>(integers)),
                              {},
                              {}};
  for (int i = 0; i < pairs; ++i) problem.reals.add(i, i, {4, 0.2, 0.2, 4.5});
  for (const auto& [i, j] : edges) problem.reals.add(i, j, {-1, 0.1, 0.2, -0.9});
  for (int i = 0; i < integers; ++i) {
    problem.coupling[static_cast<std::size_t>(i)] = {{7 * i % (2 * pairs), -1}, {(13 * i + 5) % (2 * pairs), 0.5}};
    problem.integral.push_back({i, i, 5});
    problem.integral_b.push_back(0.37 * (i % 41));
  }
  return problem;
}

// x' A x / 2 - b' x, from the problem alone.
double energy_of(const MixedIntegerProblem& problem, const MixedIntegerSolution& solution) {
  std::vector<ComplexPair> reals;
  for (const RealPair& pair : solution.reals) reals.push_back({pair.p, pair.q});
  const std::vector<ComplexPair> image = problem.reals.times(reals);
  double energy = 0;
  for (std::size_t i = 0; i < reals.size(); ++i)
    energy += 0.5 * (reals[i].p * image[i].p + reals[i].q * image[i].q).real() - problem.real_b[i].p * solution.reals[i].p -
              problem.real_b[i].q * solution.reals[i].q;
  for (std::size_t i = 0; i < solution.integers.size(); ++i) {
    energy += solution.integers[i] * (0.5 * problem.integral[i].value * solution.integers[i] - problem.integral_b[i]);
    for (const SparseTerm& term : problem.coupling[i]) {
      const RealPair& pair = solution.reals[static_cast<std::size_t>(term.index / 2)];
      energy += solution.integers[i] * term.value * (term.index % 2 == 0 ? pair.p : pair.q);
    }
  }
  return energy;
}

TEST(MixedInteger, IsTheSameForAnyNumberOfThreads) {
  const MixedIntegerProblem problem = many_integers(450, 600);
  const MixedIntegerSolution alone = solve_mixed_integer(problem);
  EXPECT_NEAR(alone.energy, energy_of(problem, alone), 1e-9 * std::abs(alone.energy));
  for (const int threads : {2, 5}) {
    const MixedIntegerSolution shared = solve_mixed_integer(problem, {}, {threads, {}});
    EXPECT_EQ(shared.integers, alone.integers);
    EXPECT_EQ(shared.energy, alone.energy);
    EXPECT_EQ(shared.relaxed_energy, alone.relaxed_energy);
    for (std::size_t i = 0; i < alone.reals.size(); ++i) {
      ASSERT_EQ(shared.reals[i].p, alone.reals[i].p);
      ASSERT_EQ(shared.reals[i].q, alone.reals[i].q);
    }
  }
}

TEST(MixedInteger, RefusesWhatHasNoMinimum) {
  const auto code_of = [](const Problem& problem) {
    try {
      solve_mixed_integer(problem);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::usage;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of({2, {{0, 0, 1.0}, {1, 1, -1.0}}, {0, 0}, {}}), ErrorCode::numerics);
  EXPECT_EQ(code_of({2, {{0, 0, 1.0}, {1, 1, -1.0}}, {0, 0}, {1}}), ErrorCode::numerics);
  EXPECT_EQ(code_of({2, {{0, 0, 1.0}, {1, 1, 1.0}, {1, 0, 2.0}}, {0, 0}, {1}}), ErrorCode::numerics);
  EXPECT_EQ(code_of({2, {{0, 0, 1.0}, {1, 1, 1.0}, {1, 0, -1.0}}, {0, 0}, {0, 1}}), ErrorCode::numerics);  // singular
  EXPECT_EQ(code_of({2, {{0, 0, 1.0}}, {0, 0}, {}}), ErrorCode::numerics);
  EXPECT_EQ(code_of({1, {{0, 0, nan}}, {0}, {}}), ErrorCode::numerics);
  EXPECT_EQ(code_of({1, {{0, 0, 1.0}}, {nan}, {0}}), ErrorCode::numerics);
}

TEST(MixedInteger, StopsWhereItIsAskedTo) {
  std::mt19937 random(12);
  std::stop_source stop;
  const MixedIntegerProblem problem = paired(random_problem(random, 20, 6));
  const auto solve = [&] { solve_mixed_integer(problem, {}, {1, stop.get_token()}); };
  EXPECT_NO_THROW(solve());
  stop.request_stop();
  try {
    solve();
    ADD_FAILURE() << "it went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace inkgrid
