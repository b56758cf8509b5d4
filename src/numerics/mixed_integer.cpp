#include "numerics/mixed_integer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {

namespace {

// Distances to the nearest integer that differ by less are a tie: rounding errors must not choose.
constexpr double kTie = 1e-9;

// What is left out of the integers' system, and how many integers are fixed at once.
struct Accuracy {
  double negligible;  // entries of the Schur complement, relative to its diagonal: they only reflect chains of many strong bonds
  double floor;       // part of an integer's own row below which the elimination of the reals carries it no further
  double share;       // of the integers that are left: fixed at once, at least one
};
constexpr Accuracy kExact{1e-10, 1e-13, 0}, kForMany{1e-7, 1e-9, 1.0 / 32};
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

  // Of S x - h.
  double gradient(const std::vector<double>& x, int i) const {
    double g = diagonal[at(i)] * x[at(i)] - h[at(i)];
    for (const SparseTerm& term : rows[at(i)]) g += term.value * x[at(term.index)];
    return g;
  }

  std::vector<double> gradient(const std::vector<double>& x) const {
    std::vector<double> g;
    for (int i = 0; i < size(); ++i) g.push_back(gradient(x, i));
    return g;
  }

  double energy(const std::vector<double>& x) const { return (dot(gradient(x), x) - dot(h, x)) / 2 + constant; }
};

// What is dropped strengthens the diagonal instead, so that the system stays positive definite.
void drop_negligible(Reduced& reduced, double negligible) {
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
void subtract_products(const SparseVector& half, const std::vector<SparseVector>& by_real, int i, Accumulator& row) {
  row.add(i, 0);
  for (const SparseTerm& mine : half)
    for (const SparseTerm& other : by_real[at(mine.index)]) {
      if (other.index > i) break;
      row.add(other.index, -mine.value * other.value);
    }
}

// The lower triangle of  S = integral - coupling real^(-1) coupling', by rows; the second part by products of half-solved rows.
std::vector<SparseVector> schur_complement(const MixedIntegerProblem& problem, const PairLdl& factor, double least, int threads) {
  const int size = integer_count(problem);
  const std::vector<double> diagonal = integral_diagonal(problem);
  std::vector<SparseVector> rows(at(size)), integral(at(size)), by_real(2 * problem.real_b.size());
  for (const auto& e : problem.integral) integral[at(e.row)].push_back({e.column, e.value});
  for (int first = 0; first < size; first += kRowsAtOnce) {
    const int last = std::min(size, first + kRowsAtOnce);
    const std::vector<SparseVector> halves = half_solved(problem, factor, diagonal, least, first, last, threads);
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
Reduced reduce(const MixedIntegerProblem& problem, const PairLdl& factor, const std::vector<RealPair>& answer,
               const Accuracy& accuracy, int threads) {
  const int size = integer_count(problem);
  Reduced reduced{std::vector<SparseVector>(at(size)), {}, problem.integral_b, -dot(problem.real_b, answer) / 2};
  for (int i = 0; i < size; ++i)
    for (const SparseTerm& term : problem.coupling[at(i)]) reduced.h[at(i)] -= term.value * scalar(answer, term.index);
  const std::vector<SparseVector> lower = schur_complement(problem, factor, accuracy.floor, threads);
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

// The `count` of these unknowns that are nearest to an integer, in ascending order; of those at the same distance the first ones.
std::vector<int> nearest_to_integers(const std::vector<double>& x, const std::vector<int>& free, std::size_t count) {
  std::vector<std::pair<double, int>> candidates;  // distance in ties
  for (const int i : free) candidates.emplace_back(std::floor(std::abs(x[at(i)] - nearest_integer(x[at(i)])) / kTie), i);
  std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count) - 1, candidates.end());
  std::vector<int> nearest;
  for (std::size_t k = 0; k < count; ++k) nearest.push_back(candidates[k].second);
  std::sort(nearest.begin(), nearest.end());
  return nearest;
}

void require_going_on(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "The run was cancelled while integers were rounded.");
}

// `x`: the minimum over the reals; `factor`: of S. `share` of the unknowns that are left are fixed at once, at least one; the
// others answer.
std::vector<double> round_greedily(const Reduced& reduced, std::vector<double> x, SparseLdl& factor, double share,
                                   const std::stop_token& stop) {
  std::vector<int> free(x.size());
  std::iota(free.begin(), free.end(), 0);
  while (!free.empty()) {
    require_going_on(stop);
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(free.size())));
    const std::vector<int> batch = nearest_to_integers(x, free, count);
    std::vector<double> push(x.size(), 0.0);
    for (const int j : batch) {
      const double target = nearest_integer(x[at(j)]);
      for (const SparseTerm& term : reduced.rows[at(j)]) push[at(term.index)] -= (target - x[at(j)]) * term.value;
      x[at(j)] = target;
      factor.remove(j);
    }
    std::vector<int> rest;
    std::set_difference(free.begin(), free.end(), batch.begin(), batch.end(), std::back_inserter(rest));
    free = std::move(rest);
    const std::vector<double> answer = factor.solve(push);
    for (const int i : free) x[at(i)] += answer[at(i)];
  }
  return x;
}

struct Move {
  double change = 0;  // of the energy
  int i = -1, j = -1;
  double step_i = 0, step_j = 0;
};

// Lowers the energy by moves of one integer or two coupled ones, the steepest first.  Each row keeps its best move, alone or with
// an integer of a smaller number, so that a move is followed by looking at its surroundings only.
class Descent {
 public:
  Descent(const Reduced& reduced, std::vector<double> x)
      : reduced_(reduced),
        x_(std::move(x)),
        least_(kTie * (1 + std::abs(reduced.energy(x_)))),
        gradient_(reduced.gradient(x_)),
        best_(x_.size()),
        changed_(x_.size(), 0) {
    for (int i = 0; i < reduced_.size(); ++i) best_[at(i)] = best_move(i);
  }

  // Ends because each move lowers the energy by more than rounding errors could.
  std::vector<double> run(const std::stop_token& stop) {
    while (!best_.empty()) {
      require_going_on(stop);
      const Move move = *std::ranges::min_element(best_, {}, &Move::change);
      if (move.change > -least_) break;
      x_[at(move.i)] += move.step_i;
      x_[at(move.j)] += move.step_j;
      follow(move);
    }
    return std::move(x_);
  }

 private:
  Move best_move(int i) const {
    Move best;
    const auto single = [&](int k, double step) { return step * gradient_[at(k)] + reduced_.diagonal[at(k)] / 2; };
    const auto consider = [&](const Move& move) {
      if (move.change < best.change) best = move;
    };
    for (double step_i : {-1.0, 1.0}) {
      const double alone = single(i, step_i);
      consider({alone, i, i, step_i, 0});
      for (const SparseTerm& term : reduced_.rows[at(i)])
        if (term.index < i)
          for (double step_j : {-1.0, 1.0})
            consider({alone + single(term.index, step_j) + step_i * step_j * term.value, i, term.index, step_i, step_j});
    }
    return best;
  }

  void mark(int i, std::vector<int>& marked) {
    if (std::exchange(changed_[at(i)], 1) == 0) marked.push_back(i);
  }

  void mark_with_coupled(int i, std::vector<int>& marked) {
    mark(i, marked);
    for (const SparseTerm& term : reduced_.rows[at(i)]) mark(term.index, marked);
  }

  void follow(const Move& move) {
    std::vector<int> marked;
    for (const int i : {move.i, move.j}) mark_with_coupled(i, marked);
    for (const int i : marked) gradient_[at(i)] = reduced_.gradient(x_, i);
    const std::size_t count = marked.size();
    for (std::size_t k = 0; k < count; ++k) mark_with_coupled(marked[k], marked);
    for (const int i : marked) best_[at(i)] = best_move(i), changed_[at(i)] = 0;
  }

  const Reduced& reduced_;
  std::vector<double> x_;
  const double least_;
  std::vector<double> gradient_;  // of the energy
  std::vector<Move> best_;        // of each row; no change where none lowers the energy
  std::vector<char> changed_;     // 0 between calls
};

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
  const Accuracy& accuracy = integer_count(problem) > limits.one_by_one ? kForMany : kExact;
  const Reduced reduced = reduce(problem, factor, factor.solve(problem.real_b), accuracy, limits.threads);
  SparseLdl integer_factor = factorise(reduced, integral_diagonal(problem));
  const std::vector<double> relaxed = integer_factor.solve(reduced.h);
  const std::vector<double> greedy = round_greedily(reduced, relaxed, integer_factor, accuracy.share, limits.stop);
  MixedIntegerSolution solution;
  solution.integers = Descent(reduced, greedy).run(limits.stop);
  solution.reals = answer_of_reals(problem, factor, solution.integers);
  solution.energy = reduced.energy(solution.integers);
  solution.greedy_energy = reduced.energy(greedy);
  solution.relaxed_energy = reduced.energy(relaxed);
  solution.plan = factor.plan();
  return solution;
}

}  // namespace inkgrid
