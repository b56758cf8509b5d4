#include "numerics/mixed_integer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"
#include "inkgrid/inkgrid.h"
#include "numerics/rounding.h"

namespace inkgrid {

namespace {

// What is left out of the integers' system.
struct Accuracy {
  double negligible;  // entries of the Schur complement, relative to its diagonal: they only reflect chains of many strong bonds
  double floor;       // part of an integer's own row below which the elimination of the reals carries it no further
};
constexpr Accuracy kExact{1e-10, 1e-13}, kForMany{1e-7, 1e-9};
constexpr int kRowsAtOnce = 512;  // of the integers' system, half-solved before they are multiplied with each other
constexpr int kRowsOfTask = 32;

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

// What is dropped strengthens the diagonal instead, so that the system stays positive definite.
void drop_negligible(Quadratic& reduced, double negligible) {
  const std::vector<double> diagonal = reduced.diagonal;
  for (std::size_t i = 0; i < reduced.rows.size(); ++i)
    std::erase_if(reduced.rows[i], [&](const SparseTerm& term) {
      const bool dropped = std::abs(term.value) < negligible * std::sqrt(diagonal[i] * diagonal[at(term.index)]);
      if (dropped) reduced.diagonal[i] += std::abs(term.value);
      return dropped;
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

// Lists of terms, each in ascending order of indices; most hold few, so that they share their memory.
class TermLists {
 public:
  explicit TermLists(std::size_t count) : first_(count, -1), last_(count, -1) {}

  void append(int list, const SparseTerm& term) {
    int& last = last_[at(list)];
    if (last < 0 || count_of(chunks_[at(last)]) == kTermsOfChunk) {
      const int added = static_cast<int>(chunks_.size());
      (last < 0 ? first_[at(list)] : chunks_[at(last)].next) = added;
      last = added;
      chunks_.emplace_back();
    }
    Chunk& chunk = chunks_[at(last)];
    const int place = count_of(chunk);
    chunk.indices[at(place)] = term.index;
    chunk.values[at(place)] = term.value;
  }

  // Calls visit(index, value) for the terms of a list whose indices are no more than `most`.
  template <class Visit>
  void for_each_up_to(int most, int list, const Visit& visit) const {
    for (int k = first_[at(list)]; k >= 0; k = chunks_[at(k)].next) {
      const Chunk& chunk = chunks_[at(k)];
      for (int e = 0; e < kTermsOfChunk && chunk.indices[at(e)] != kNone; ++e) {
        if (chunk.indices[at(e)] > most) return;
        visit(chunk.indices[at(e)], chunk.values[at(e)]);
      }
    }
  }

 private:
  static constexpr int kTermsOfChunk = 3, kNone = -1;

  struct Chunk {
    std::array<int, kTermsOfChunk> indices = {kNone, kNone, kNone};
    int next = -1;
    std::array<double, kTermsOfChunk> values;
  };

  static int count_of(const Chunk& chunk) {
    return static_cast<int>(std::find(chunk.indices.begin(), chunk.indices.end(), kNone) - chunk.indices.begin());
  }

  std::vector<int> first_, last_;  // chunk of each list, -1 where it is empty
  std::deque<Chunk> chunks_;       // a vector would hold three times as much when it grows
};

// Some rows of the coupling, half-solved down to `least` of their own diagonal.
std::vector<SparseVector> half_solved(const MixedIntegerProblem& problem, const PairLdl& factor,
                                      const std::vector<double>& diagonal, double least, int first, int last, int threads) {
  std::vector<SparseVector> halves(at(last - first));
  const int task = std::max(kRowsOfTask, (last - first) / (2 * thread_count(threads)));  // each has a solver of its own
  for_ranges(threads, last - first, task, [&](int from, int end) {
    HalfSolver solver(factor);
    for (int i = from; i < end; ++i) {
      const double floor = least * std::sqrt(std::max(0.0, diagonal[at(first + i)]));
      halves[at(i)] = solver.solve(problem.coupling[at(first + i)], floor);
    }
  });
  return halves;
}

// With the half-solved rows up to number i, which is `half`; row i has a diagonal even where all is zero.
void subtract_products(const SparseVector& half, const TermLists& by_real, int i, Accumulator& row) {
  row.add(i, 0);
  for (const SparseTerm& mine : half)
    by_real.for_each_up_to(i, mine.index, [&](int index, double value) { row.add(index, -mine.value * value); });
}

// The lower triangle of  S = integral - coupling real^(-1) coupling', by rows; the second part by products of half-solved rows.
std::vector<SparseVector> schur_complement(const MixedIntegerProblem& problem, const PairLdl& factor, double least, int threads) {
  const int size = integer_count(problem);
  const std::vector<double> diagonal = integral_diagonal(problem);
  std::vector<SparseVector> rows(at(size)), integral(at(size));
  TermLists by_real(2 * problem.real_b.size());
  for (const auto& e : problem.integral) integral[at(e.row)].push_back({e.column, e.value});
  for (int first = 0; first < size; first += kRowsAtOnce) {
    const int last = std::min(size, first + kRowsAtOnce);
    const std::vector<SparseVector> halves = half_solved(problem, factor, diagonal, least, first, last, threads);
    for (int i = first; i < last; ++i)
      for (const SparseTerm& term : halves[at(i - first)]) by_real.append(term.index, {i, term.value});
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

// The least energy that the integers allow, the reals having answered.
Quadratic reduce(const MixedIntegerProblem& problem, const PairLdl& factor, const Accuracy& accuracy, int threads) {
  const int size = integer_count(problem);
  std::vector<RealPair> answer;  // the reals when all integers are zero
  std::vector<SparseVector> lower;
  at_once(
      threads, [&] { answer = factor.solve(problem.real_b); },
      [&] { lower = schur_complement(problem, factor, accuracy.floor, threads); });
  Quadratic reduced{std::vector<SparseVector>(at(size)), {}, problem.integral_b, -dot(problem.real_b, answer) / 2};
  for (int i = 0; i < size; ++i)
    for (const SparseTerm& term : problem.coupling[at(i)])
      reduced.h[at(i)] -= term.value * scalar(std::as_const(answer), term.index);
  for (int i = 0; i < size; ++i)
    for (const SparseTerm& term : lower[at(i)]) {
      if (term.index == i) {
        reduced.diagonal.push_back(term.value);
      } else {
        reduced.rows[at(i)].push_back(term);
        reduced.rows[at(term.index)].push_back({i, term.value});
      }
    }
  drop_negligible(reduced, accuracy.negligible);
  return reduced;
}

void require_finite(const MixedIntegerProblem& problem) {
  bool finite = true;
  const auto look_at = [&](double value) { finite &= std::isfinite(value); };
  const auto look_at_block = [&](const Block& x) { look_at(x.a), look_at(x.b), look_at(x.c), look_at(x.d); };
  for (const Block& block : problem.reals.diagonal()) look_at_block(block);
  for (const Block& block : problem.reals.blocks()) look_at_block(block);
  for (const RealPair& b : problem.real_b) look_at(b.p), look_at(b.q);
  for (const SparseVector& row : problem.coupling)
    for (const SparseTerm& term : row) look_at(term.value);
  for (const auto& e : problem.integral) look_at(e.value);
  for (const double b : problem.integral_b) look_at(b);
  if (!finite) throw Error(ErrorCode::numerics, "A linear system holds a value that is not finite.");
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
  PairLdl factor(problem.reals, std::move(plan), limits.threads);
  const bool many = integer_count(problem) > limits.one_by_one;
  const Quadratic reduced = reduce(problem, factor, many ? kForMany : kExact, limits.threads);
  const Rounding rounding =
      many ? round_in_batches(reduced, limits.stop) : round_one_by_one(reduced, integral_diagonal(problem), limits.stop);
  MixedIntegerSolution solution;
  solution.integers = descend(reduced, rounding.rounded, limits.stop);
  solution.reals = answer_of_reals(problem, factor, solution.integers);
  solution.energy = reduced.energy(solution.integers);
  solution.greedy_energy = reduced.energy(rounding.rounded);
  solution.relaxed_energy = reduced.energy(rounding.relaxed);
  solution.plan = std::move(factor).plan();
  return solution;
}

}  // namespace inkgrid
