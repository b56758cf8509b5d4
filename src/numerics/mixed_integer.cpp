#include "numerics/mixed_integer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {

namespace {

// Distances to the nearest integer that differ by less are a tie: rounding errors must not choose.
constexpr double kTie = 1e-9;
// Entries of the Schur complement this small, relative to its diagonal, only reflect chains of many strong bonds.
constexpr double kNegligible = 1e-10;
// Part of an integer's own row below which the elimination of the reals carries it no further.
constexpr double kHalfSolveFloor = 1e-13;
constexpr int kRowsAtOnce = 512;  // of the integers' system, half-solved before they are multiplied with each other
constexpr int kRowsOfTask = 32;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

int integer_count(const MixedIntegerProblem& problem) {
  return static_cast<int>(problem.integral_b.size());
}

std::vector<double> integral_diagonal(const MixedIntegerProblem& problem) {
  std::vector<double> diagonal(problem.integral_b.size(), 0.0);
  for (const auto& e : problem.integral)
    if (e.row == e.column) diagonal[at(e.row)] += e.value;
  return diagonal;
}

double& scalar(std::vector<RealPair>& reals, int index) {
  return index % 2 == 0 ? reals[at(index / 2)].p : reals[at(index / 2)].q;
}

double scalar(const std::vector<RealPair>& reals, int index) {
  return index % 2 == 0 ? reals[at(index / 2)].p : reals[at(index / 2)].q;
}

double dot(const std::vector<RealPair>& a, const std::vector<RealPair>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].p * b[i].p + a[i].q * b[i].q;
  return sum;
}

// x' S x / 2 - h' x + constant: the least energy that the integers x allow, the reals having answered.
struct Reduced {
  std::vector<SparseVector> rows;  // of S, without its diagonal
  std::vector<double> diagonal;
  std::vector<double> h;
  double constant = 0;

  int size() const { return static_cast<int>(diagonal.size()); }

  // S x - h.
  std::vector<double> gradient(const std::vector<double>& x) const {
    std::vector<double> g(diagonal.size());
    for (std::size_t i = 0; i < g.size(); ++i) {
      g[i] = diagonal[i] * x[i] - h[i];
      for (const SparseTerm& term : rows[i]) g[i] += term.value * x[at(term.index)];
    }
    return g;
  }

  double energy(const std::vector<double>& x) const { return (dot(gradient(x), x) - dot(h, x)) / 2 + constant; }
};

void drop_negligible(std::vector<SparseVector>& rows, const std::vector<double>& diagonal) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::erase_if(rows[i], [&](const SparseTerm& term) {
      return std::abs(term.value) < kNegligible * std::sqrt(diagonal[i] * diagonal[at(term.index)]);
    });
}

// A sparse sum under construction; terms come out in ascending order.
class Accumulator {
 public:
  explicit Accumulator(int size) : sum_(at(size), 0.0), touched_(at(size), 0) {}

  void add(int i, double value) {
    if (!touched_[at(i)]) indices_.push_back(i);
    touched_[at(i)] = 1;
    sum_[at(i)] += value;
  }

  SparseVector take() {
    std::sort(indices_.begin(), indices_.end());
    SparseVector result;
    for (int i : indices_) {
      result.push_back({i, sum_[at(i)]});
      sum_[at(i)] = 0;
      touched_[at(i)] = 0;
    }
    indices_.clear();
    return result;
  }

 private:
  std::vector<double> sum_;
  std::vector<char> touched_;
  std::vector<int> indices_;
};

// Some rows of the coupling, half-solved.
std::vector<SparseVector> half_solved(const MixedIntegerProblem& problem, const PairLdl& factor,
                                      const std::vector<double>& diagonal, int first, int last, int threads) {
  std::vector<SparseVector> halves(at(last - first));
  const int task = std::max(kRowsOfTask, (last - first) / (2 * thread_count(threads)));  // each has a solver of its own
  for_ranges(threads, last - first, task, [&](int from, int end) {
    HalfSolver solver(factor);
    for (int i = from; i < end; ++i) {
      const double floor = kHalfSolveFloor * std::sqrt(std::max(0.0, diagonal[at(first + i)]));
      halves[at(i)] = solver.solve(problem.coupling[at(first + i)], floor);
    }
  });
  return halves;
}

// With the half-solved rows up to number i, which is `half`; row i has a diagonal even where all is zero.
void subtract_products(const SparseVector& half, const std::vector<SparseVector>& by_real, int i, Accumulator& row) {
  row.add(i, 0);
  for (const SparseTerm& mine : half)
    for (const SparseTerm& other : by_real[at(mine.index)]) {
      if (other.index > i) break;
      row.add(other.index, -mine.value * other.value);
    }
}

// The lower triangle of  S = integral - coupling real^(-1) coupling', by rows; the second part by products of half-solved rows.
std::vector<SparseVector> schur_complement(const MixedIntegerProblem& problem, const PairLdl& factor, int threads) {
  const int size = integer_count(problem);
  const std::vector<double> diagonal = integral_diagonal(problem);
  std::vector<SparseVector> rows(at(size)), integral(at(size)), by_real(2 * problem.real_b.size());
  for (const auto& e : problem.integral) integral[at(e.row)].push_back({e.column, e.value});
  for (int first = 0; first < size; first += kRowsAtOnce) {
    const int last = std::min(size, first + kRowsAtOnce);
    const std::vector<SparseVector> halves = half_solved(problem, factor, diagonal, first, last, threads);
    for (int i = first; i < last; ++i)
      for (const SparseTerm& term : halves[at(i - first)]) by_real[at(term.index)].push_back({i, term.value});
    for_ranges(threads, last - first, kRowsOfTask, [&](int from, int end) {
      Accumulator sum(size);
      for (int i = first + from; i < first + end; ++i) {
        for (const SparseTerm& term : integral[at(i)]) sum.add(term.index, term.value);
        subtract_products(halves[at(i - first)], by_real, i, sum);
        rows[at(i)] = sum.take();
      }
    });
  }
  return rows;
}

// `answer`: the reals when all integers are zero.
Reduced reduce(const MixedIntegerProblem& problem, const PairLdl& factor, const std::vector<RealPair>& answer, int threads) {
  const int size = integer_count(problem);
  Reduced reduced{std::vector<SparseVector>(at(size)), {}, problem.integral_b, -dot(problem.real_b, answer) / 2};
  for (int i = 0; i < size; ++i)
    for (const SparseTerm& term : problem.coupling[at(i)]) reduced.h[at(i)] -= term.value * scalar(answer, term.index);
  const std::vector<SparseVector> lower = schur_complement(problem, factor, threads);
  for (int i = 0; i < size; ++i)
    for (const SparseTerm& term : lower[at(i)]) {
      if (term.index == i) {
        reduced.diagonal.push_back(term.value);
      } else {
        reduced.rows[at(i)].push_back(term);
        reduced.rows[at(term.index)].push_back({i, term.value});
      }
    }
  drop_negligible(reduced.rows, reduced.diagonal);
  return reduced;
}

SparseLdl factorise(const Reduced& reduced, const std::vector<double>& scale) {
  std::vector<Entry<double>> lower;
  for (int i = 0; i < reduced.size(); ++i) {
    lower.push_back({i, i, reduced.diagonal[at(i)]});
    for (const SparseTerm& term : reduced.rows[at(i)])
      if (term.index < i) lower.push_back({i, term.index, term.value});
  }
  return SparseLdl(reduced.size(), lower, scale);
}

// Halves go up, also those that rounding errors have lowered.
double nearest_integer(double x) {
  return std::floor(x + 0.5 + kTie);
}

int nearest_to_an_integer(const std::vector<double>& x, const std::vector<char>& fixed) {
  int best = -1;
  double distance = 1;
  for (int i = 0; i < static_cast<int>(x.size()); ++i) {
    if (fixed[at(i)]) continue;
    const double d = std::abs(x[at(i)] - nearest_integer(x[at(i)]));
    if (best >= 0 && d >= distance - kTie) continue;
    best = i;
    distance = d;
  }
  return best;
}

void require_going_on(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "The run was cancelled while integers were rounded.");
}

// `x`: the minimum over the reals; `factor`: of S.  Moving x_j by delta moves the others along column j of the inverse of what is
// left.
std::vector<double> round_greedily(std::vector<double> x, SparseLdl& factor, const std::stop_token& stop) {
  std::vector<char> fixed(x.size(), 0);
  for (int j; (j = nearest_to_an_integer(x, fixed)) >= 0; fixed[at(j)] = 1) {
    require_going_on(stop);
    const double target = nearest_integer(x[at(j)]), delta = target - x[at(j)];
    if (delta != 0) {
      std::vector<double> column(x.size(), 0.0);
      column[at(j)] = 1;
      column = factor.solve(column);
      const double step = delta / column[at(j)];
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * column[i];
    }
    x[at(j)] = target;
    factor.remove(j);
  }
  return x;
}

struct Move {
  double change = 0;  // of the energy
  int i = -1, j = -1;
  double step_i = 0, step_j = 0;
};

Move steepest_move(const Reduced& reduced, const std::vector<double>& gradient) {
  Move best;
  const auto single = [&](int i, double step) { return step * gradient[at(i)] + reduced.diagonal[at(i)] / 2; };
  const auto consider = [&](const Move& move) {
    if (move.change < best.change) best = move;
  };
  for (int i = 0; i < reduced.size(); ++i)
    for (double step_i : {-1.0, 1.0}) {
      const double alone = single(i, step_i);
      consider({alone, i, i, step_i, 0});
      for (const SparseTerm& term : reduced.rows[at(i)])
        if (term.index < i)
          for (double step_j : {-1.0, 1.0})
            consider({alone + single(term.index, step_j) + step_i * step_j * term.value, i, term.index, step_i, step_j});
    }
  return best;
}

// Ends because each move lowers the energy by more than rounding errors could.
std::vector<double> descend(const Reduced& reduced, std::vector<double> x, const std::stop_token& stop) {
  const double least = kTie * (1 + std::abs(reduced.energy(x)));
  for (;;) {
    require_going_on(stop);
    const Move move = steepest_move(reduced, reduced.gradient(x));
    if (move.change > -least) return x;
    x[at(move.i)] += move.step_i;
    x[at(move.j)] += move.step_j;
  }
}

void require_finite(const MixedIntegerProblem& problem) {
  double sum = 0;  // of zeros, unless a value is not finite
  const auto add = [&](double value) { sum += 0 * value; };
  const auto add_block = [&](const Block& x) { add(x.a), add(x.b), add(x.c), add(x.d); };
  for (const Block& block : problem.reals.diagonal()) add_block(block);
  for (const Block& block : problem.reals.blocks()) add_block(block);
  for (const RealPair& b : problem.real_b) add(b.p), add(b.q);
  for (const SparseVector& row : problem.coupling)
    for (const SparseTerm& term : row) add(term.value);
  for (const auto& e : problem.integral) add(e.value);
  for (const double b : problem.integral_b) add(b);
  if (std::isnan(sum)) throw Error(ErrorCode::numerics, "A linear system holds a value that is not finite.");
}

// The reals, given the integers.
std::vector<RealPair> answer_of_reals(const MixedIntegerProblem& problem, const PairLdl& factor,
                                      const std::vector<double>& integers) {
  std::vector<RealPair> b = problem.real_b;
  for (std::size_t i = 0; i < integers.size(); ++i)
    for (const SparseTerm& term : problem.coupling[i]) scalar(b, term.index) -= term.value * integers[i];
  return factor.solve(b);
}

}  // namespace

MixedIntegerSolution solve_mixed_integer(const MixedIntegerProblem& problem, EliminationPlan plan,
                                         const MixedIntegerLimits& limits) {
  require_finite(problem);
  const PairLdl factor(problem.reals, std::move(plan), limits.threads);
  const Reduced reduced = reduce(problem, factor, factor.solve(problem.real_b), limits.threads);
  SparseLdl integer_factor = factorise(reduced, integral_diagonal(problem));
  if (static_cast<double>(reduced.size()) * static_cast<double>(integer_factor.entries()) > limits.work)
    throw Error(ErrorCode::usage,
                std::to_string(reduced.size()) + " integers depend on each other too closely to be rounded one after the other");
  const std::vector<double> relaxed = integer_factor.solve(reduced.h);
  const std::vector<double> greedy = round_greedily(relaxed, integer_factor, limits.stop);
  MixedIntegerSolution solution;
  solution.integers = descend(reduced, greedy, limits.stop);
  solution.reals = answer_of_reals(problem, factor, solution.integers);
  solution.energy = reduced.energy(solution.integers);
  solution.greedy_energy = reduced.energy(greedy);
  solution.relaxed_energy = reduced.energy(relaxed);
  solution.plan = factor.plan();
  return solution;
}

}  // namespace inkgrid
