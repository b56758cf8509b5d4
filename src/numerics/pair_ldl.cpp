#include "numerics/pair_ldl.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/at.h"
#include "base/parallel.h"
#include "inkgrid/inkgrid.h"
#include "numerics/ordering.h"

// Compiled for registers of four numbers too, which are used where the processor has them; each number is computed in the same
// way.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define INKGRID_WIDE_TOO __attribute__((target_clones("avx2", "default")))
#else
#define INKGRID_WIDE_TOO
#endif

namespace inkgrid {
namespace {

// Two and four numbers in a row.
using Two = double __attribute__((vector_size(16), aligned(8), may_alias));
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));

// A pivot's smaller eigenvalue must exceed this part of the diagonal block's trace: rounding errors are smaller.
constexpr double kPivotTolerance = 1e-14;
constexpr double kTaskShare = 1.0 / 16;      // of the work of a factorisation, that is done at once on one thread
constexpr std::size_t kWorthThreads = 2000;  // nodes

Block product(const Block& x, const Block& y) {
  return {x.a * y.a + x.b * y.c, x.a * y.b + x.b * y.d, x.c * y.a + x.d * y.c, x.c * y.b + x.d * y.d};
}

// sum -= x y
void subtract_product(Block& sum, const Block& x, const Block& y) {
  sum.a -= x.a * y.a + x.b * y.c;
  sum.b -= x.a * y.b + x.b * y.d;
  sum.c -= x.c * y.a + x.d * y.c;
  sum.d -= x.c * y.b + x.d * y.d;
}

// row[places[e]] -= term blocks[e].  Block by block as a whole, so that its numbers fit a register.
INKGRID_WIDE_TOO void subtract_products(Block* row, const int* places, const Block* blocks, int count, const Block& term) {
  const Block x = term;
  for (int e = 0; e < count; ++e) {
    const Block y = blocks[e];
    Block sum = row[places[e]];
    subtract_product(sum, x, y);
    row[places[e]] = sum;
  }
}

double determinant(const Block& x) {
  return x.a * x.d - x.b * x.c;
}

double trace(const Block& x) {
  return x.a + x.d;
}

// The smaller eigenvalue exceeds `least`; both are real, as x is symmetric.
bool exceeds(const Block& x, double least) {
  return trace(x) > 0 && determinant(x) > least * trace(x);
}

Block inverse(const Block& x) {
  const double scale = 1 / determinant(x);
  return {scale * x.d, -scale * x.b, -scale * x.c, scale * x.a};
}

template <class Scalar>
Pair<Scalar> product(const Block& x, const Pair<Scalar>& v) {
  return {x.a * v.p + x.b * v.q, x.c * v.p + x.d * v.q};
}

// Turns counts, one place ahead, into the starts of lists.
void accumulate_starts(std::vector<int>& counts) {
  for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
}

void plan_rows(const PairMatrix& matrix, EliminationPlan& plan) {
  plan.row_starts.assign(at(matrix.size()) + 1, 0);
  const auto for_each_block = [&](auto visit) {
    for (int j = 0; j < matrix.size(); ++j)
      for (int k = matrix.starts()[at(j)]; k < matrix.starts()[at(j) + 1]; ++k)
        visit(plan.places[at(matrix.rows()[at(k)])], plan.places[at(j)], k);
  };
  for_each_block([&](int i, int j, int) { ++plan.row_starts[at(std::max(i, j)) + 1]; });
  accumulate_starts(plan.row_starts);
  plan.columns.resize(at(plan.row_starts.back()));
  plan.sources.resize(at(plan.row_starts.back()));
  std::vector<int> next(plan.row_starts.begin(), plan.row_starts.end() - 1);
  for_each_block([&](int i, int j, int source) {
    const int k = next[at(std::max(i, j))]++;
    plan.columns[at(k)] = std::min(i, j);
    plan.sources[at(k)] = i > j ? source : ~source;
  });
}

// The tree of elimination and the sizes of the columns.
void plan_columns(EliminationPlan& plan) {
  plan.parents.assign(plan.places.size(), -1);
  plan.starts.assign(plan.places.size() + 1, 0);
  std::vector<int> seen(plan.places.size(), -1);  // per column: the last row that visited it
  for (int k = 0; k < static_cast<int>(plan.places.size()); ++k) {
    seen[at(k)] = k;
    for (int e = plan.row_starts[at(k)]; e < plan.row_starts[at(k) + 1]; ++e)
      for (int i = plan.columns[at(e)]; seen[at(i)] != k; i = plan.parents[at(i)]) {
        if (plan.parents[at(i)] < 0) plan.parents[at(i)] = k;
        ++plan.starts[at(i) + 1];
        seen[at(i)] = k;
      }
  }
  accumulate_starts(plan.starts);
}

}  // namespace

EliminationPlan plan_elimination(const PairMatrix& matrix) {
  EliminationPlan plan;
  plan.matrix_starts = matrix.starts();
  plan.matrix_rows = matrix.rows();
  plan.places = elimination_places(matrix.starts(), matrix.rows());
  plan_rows(matrix, plan);
  plan_columns(plan);
  return plan;
}

EliminationTasks elimination_tasks(const EliminationPlan& plan, double share) {
  const std::size_t size = plan.places.size();
  std::vector<double> work(size, 0.0);  // of each subtree
  double total = 0;
  for (std::size_t k = 0; k < size; ++k) {
    const double column = plan.starts[k + 1] - plan.starts[k], own = 1 + column * column;
    total += own;
    work[k] += own;
    if (plan.parents[k] >= 0) work[at(plan.parents[k])] += work[k];
  }
  EliminationTasks tasks;
  std::vector<int> task(size, -1);
  for (std::size_t k = size; k-- > 0;) {
    if (work[k] > share * total) continue;
    const int above = plan.parents[k] < 0 ? -1 : task[at(plan.parents[k])];
    task[k] = above >= 0 ? above : static_cast<int>(tasks.subtrees.size());
    if (above < 0) tasks.subtrees.emplace_back();
  }
  for (std::size_t k = 0; k < size; ++k) (task[k] < 0 ? tasks.rest : tasks.subtrees[at(task[k])]).push_back(static_cast<int>(k));
  return tasks;
}

namespace {

// The columns of row k of the factor, each after those that contribute to it; `seen` holds the last row that visited a column.
class RowPattern {
 public:
  // For rows of at most `longest` columns.
  RowPattern(const EliminationPlan& plan, std::vector<int>& seen, std::size_t longest)
      : plan_(plan), seen_(seen), pattern_(longest) {}

  // Ascending along every path of the tree.
  const int* begin() const { return pattern_.data() + top_; }
  const int* end() const { return pattern_.data() + pattern_.size(); }

  void find(int k) {
    top_ = pattern_.size();
    seen_[at(k)] = k;
    for (int e = plan_.row_starts[at(k)]; e < plan_.row_starts[at(k) + 1]; ++e) {
      std::size_t length = 0;
      for (int i = plan_.columns[at(e)]; seen_[at(i)] != k; i = plan_.parents[at(i)]) {
        pattern_[length++] = i;
        seen_[at(i)] = k;
      }
      while (length > 0) pattern_[--top_] = pattern_[--length];
    }
  }

 private:
  const EliminationPlan& plan_;
  std::vector<int>& seen_;
  std::vector<int> pattern_;
  std::size_t top_ = 0;
};

// L without its unit diagonal, and the inverse of D.
struct Factor {
  std::vector<int> rows;
  std::vector<Block> blocks;  // transposed
  std::vector<Block> inverse_pivots;
};

// Subtrees of the tree of elimination may be eliminated at the same time: each reads and writes only what is its own.
class Elimination {
 public:
  Elimination(const PairMatrix& matrix, const EliminationPlan& plan, std::vector<Block> diagonal)
      : blocks_(matrix.blocks()),
        plan_(plan),
        pivots_(std::move(diagonal)),
        ends_(plan.starts.begin(), plan.starts.end() - 1),
        row_(pivots_.size()),
        seen_(pivots_.size(), -1),
        factor_{std::vector<int>(at(plan.starts.back())), std::vector<Block>(at(plan.starts.back())),
                std::vector<Block>(pivots_.size())} {}

  // `places` with those below them that are not eliminated yet, ascending; rows of at most `longest` columns.
  void eliminate(const std::vector<int>& places, std::size_t longest) {
    RowPattern pattern(plan_, seen_, longest);
    for (const int k : places) {
      for (int e = plan_.row_starts[at(k)]; e < plan_.row_starts[at(k) + 1]; ++e) row_[at(plan_.columns[at(e)])] = block(e);
      const double least = kPivotTolerance * trace(pivots_[at(k)]);
      pattern.find(k);
      for (const int i : pattern) subtract_column(i, k);
      if (!exceeds(pivots_[at(k)], least))
        throw Error(ErrorCode::numerics, "The matrix of a linear system is not positive definite.");
      factor_.inverse_pivots[at(k)] = inverse(pivots_[at(k)]);
    }
  }

  Factor take() { return std::move(factor_); }

 private:
  // Of the permuted matrix.
  Block block(int e) const {
    const int source = plan_.sources[at(e)];
    return source >= 0 ? blocks_[at(source)] : transposed(blocks_[at(~source)]);
  }

  // From row k, which gets its entry in column i.
  void subtract_column(int i, int k) {
    const Block term = std::exchange(row_[at(i)], {});
    const int first = plan_.starts[at(i)];
    subtract_products(row_.data(), factor_.rows.data() + first, factor_.blocks.data() + first, ends_[at(i)] - first, term);
    const Block entry = product(term, factor_.inverse_pivots[at(i)]);
    subtract_product(pivots_[at(k)], entry, transposed(term));
    factor_.rows[at(ends_[at(i)])] = k;
    factor_.blocks[at(ends_[at(i)]++)] = transposed(entry);
  }

  const std::vector<Block>& blocks_;
  const EliminationPlan& plan_;
  std::vector<Block> pivots_;
  std::vector<int> ends_;   // of the part of each column that is known
  std::vector<Block> row_;  // zero between rows
  std::vector<int> seen_;
  Factor factor_;
};

Factor factorise(const PairMatrix& matrix, const EliminationPlan& plan, int threads) {
  std::vector<Block> diagonal(plan.places.size());
  for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[at(plan.places[i])] = matrix.diagonal()[i];
  Elimination elimination(matrix, plan, std::move(diagonal));
  const EliminationTasks tasks = elimination_tasks(plan, kTaskShare);
  for_ranges(plan.places.size() < kWorthThreads ? 1 : threads, static_cast<int>(tasks.subtrees.size()), 1,
             [&](int first, int last) {
               for (int t = first; t < last; ++t) elimination.eliminate(tasks.subtrees[at(t)], tasks.subtrees[at(t)].size());
             });
  elimination.eliminate(tasks.rest, plan.places.size());
  return elimination.take();
}

}  // namespace

PairMatrix::PairMatrix(int size, const std::vector<std::array<int, 2>>& edges) : starts_(at(size) + 1, 0), diagonal_(at(size)) {
  std::vector<int> first(at(size) + 1, 0), rows(edges.size());
  for (const auto& [i, j] : edges) ++first[at(std::min(i, j)) + 1];
  accumulate_starts(first);
  std::vector<int> next(first.begin(), first.end() - 1);
  for (const auto& [i, j] : edges) rows[at(next[at(std::min(i, j))]++)] = std::max(i, j);
  for (int j = 0; j < size; ++j) {
    const auto begin = rows.begin() + first[at(j)], end = rows.begin() + first[at(j) + 1];
    std::sort(begin, end);
    rows_.insert(rows_.end(), begin, std::unique(begin, end));
    starts_[at(j) + 1] = static_cast<int>(rows_.size());
  }
  blocks_.resize(rows_.size());
}

PairMatrix::PairMatrix(std::vector<int> starts, std::vector<int> rows)
    : starts_(std::move(starts)), rows_(std::move(rows)), blocks_(rows_.size()), diagonal_(starts_.size() - 1) {}

namespace {

// y += the lower triangle, its transpose and the diagonal, times x.
INKGRID_WIDE_TOO void add_products(const PairMatrix& matrix, const ComplexPair* vector, ComplexPair* image) {
  const int* const starts = matrix.starts().data();
  const int* const rows = matrix.rows().data();
  const Four* const blocks = reinterpret_cast<const Four*>(matrix.blocks().data());
  const Four* const x = reinterpret_cast<const Four*>(vector);
  Four* const y = reinterpret_cast<Four*>(image);
  for (int j = 0; j < matrix.size(); ++j) {
    const Four xj = x[j], p = __builtin_shufflevector(xj, xj, 0, 1, 0, 1), q = __builtin_shufflevector(xj, xj, 2, 3, 2, 3);
    ComplexPair own = product(matrix.diagonal()[at(j)], vector[j]);
    Four sum = *reinterpret_cast<const Four*>(&own);
    for (int k = starts[j]; k < starts[j + 1]; ++k) {
      const Four block = blocks[k], v = x[rows[k]];
      y[rows[k]] += __builtin_shufflevector(block, block, 0, 0, 2, 2) * p + __builtin_shufflevector(block, block, 1, 1, 3, 3) * q;
      sum += __builtin_shufflevector(block, block, 0, 0, 1, 1) * __builtin_shufflevector(v, v, 0, 1, 0, 1) +
             __builtin_shufflevector(block, block, 2, 2, 3, 3) * __builtin_shufflevector(v, v, 2, 3, 2, 3);
    }
    y[j] += sum;
  }
}

}  // namespace

std::vector<ComplexPair> PairMatrix::times(const std::vector<ComplexPair>& x) const {
  std::vector<ComplexPair> y(x.size());
  add_products(*this, x.data(), y.data());
  return y;
}

PairLdl::PairLdl(const PairMatrix& matrix, EliminationPlan plan, int threads)
    : plan_(plan.starts.empty() ? plan_elimination(matrix) : std::move(plan)) {
  Factor factor = factorise(matrix, plan_, threads);
  rows_ = std::move(factor.rows);
  blocks_ = std::move(factor.blocks);
  inverse_pivots_ = std::move(factor.inverse_pivots);
}

namespace {

// The factor as arrays, of which passes over it are compiled more than once.
struct FactorArrays {
  int size;
  const int* starts;
  const int* rows;
  const Block* blocks;
  const Block* inverse_pivots;
};

// From here on numbers of a block or of a pair go through registers together: a block is {a, b, c, d}, and {a, b} with {c, d}.
INKGRID_WIDE_TOO void solve_pairs(FactorArrays factor, RealPair* pairs) {
  Two* const y = reinterpret_cast<Two*>(pairs);
  const Two* const blocks = reinterpret_cast<const Two*>(factor.blocks);
  for (int k = 0; k < factor.size; ++k) {
    const Two yk = y[k], p = {yk[0], yk[0]}, q = {yk[1], yk[1]};
    for (std::ptrdiff_t e = factor.starts[k]; e < factor.starts[k + 1]; ++e)
      y[factor.rows[e]] -= blocks[2 * e] * p + blocks[2 * e + 1] * q;
  }
  for (int k = factor.size - 1; k >= 0; --k) {
    const RealPair pivoted = product(factor.inverse_pivots[k], pairs[k]);
    Two yk = {pivoted.p, pivoted.q};
    for (std::ptrdiff_t e = factor.starts[k]; e < factor.starts[k + 1]; ++e) {
      const Two above = blocks[2 * e], below = blocks[2 * e + 1], v = y[factor.rows[e]];
      yk -= __builtin_shufflevector(above, below, 0, 2) * v[0] + __builtin_shufflevector(above, below, 1, 3) * v[1];
    }
    y[k] = yk;
  }
}

INKGRID_WIDE_TOO void solve_pairs(FactorArrays factor, ComplexPair* pairs) {
  Four* const y = reinterpret_cast<Four*>(pairs);
  const Four* const blocks = reinterpret_cast<const Four*>(factor.blocks);
  for (int k = 0; k < factor.size; ++k) {
    const Four yk = y[k], p = __builtin_shufflevector(yk, yk, 0, 1, 0, 1), q = __builtin_shufflevector(yk, yk, 2, 3, 2, 3);
    for (int e = factor.starts[k]; e < factor.starts[k + 1]; ++e) {
      const Four block = blocks[e];
      y[factor.rows[e]] -=
          __builtin_shufflevector(block, block, 0, 0, 1, 1) * p + __builtin_shufflevector(block, block, 2, 2, 3, 3) * q;
    }
  }
  for (int k = factor.size - 1; k >= 0; --k) {
    pairs[k] = product(factor.inverse_pivots[k], pairs[k]);
    Four yk = y[k];
    for (int e = factor.starts[k]; e < factor.starts[k + 1]; ++e) {
      const Four block = blocks[e], v = y[factor.rows[e]];
      yk -= __builtin_shufflevector(block, block, 0, 0, 2, 2) * __builtin_shufflevector(v, v, 0, 1, 0, 1) +
            __builtin_shufflevector(block, block, 1, 1, 3, 3) * __builtin_shufflevector(v, v, 2, 3, 2, 3);
    }
    y[k] = yk;
  }
}

}  // namespace

template <class Scalar>
std::vector<Pair<Scalar>> PairLdl::solve(const std::vector<Pair<Scalar>>& right) const {
  const int size = static_cast<int>(plan_.places.size());
  std::vector<Pair<Scalar>> y(right.size());
  for (int i = 0; i < size; ++i) y[at(plan_.places[at(i)])] = right[at(i)];
  solve_pairs({size, plan_.starts.data(), rows_.data(), blocks_.data(), inverse_pivots_.data()}, y.data());
  std::vector<Pair<Scalar>> x(right.size());
  for (int i = 0; i < size; ++i) x[at(i)] = y[at(plan_.places[at(i)])];
  return x;
}

template std::vector<RealPair> PairLdl::solve(const std::vector<RealPair>&) const;
template std::vector<ComplexPair> PairLdl::solve(const std::vector<ComplexPair>&) const;

HalfSolver::HalfSolver(const PairLdl& factor)
    : factor_(factor), work_(factor.plan_.places.size()), marked_(factor.plan_.places.size(), 0) {}

// The columns that a solve with the right hand side `a` visits, each before those it depends on: the paths from its terms to the
// root.
void HalfSolver::find_reach(const SparseVector& a) {
  const EliminationPlan& plan = factor_.plan_;
  reach_.clear();
  for (const SparseTerm& term : a) {
    path_.clear();
    for (int k = plan.places[at(term.index / 2)]; k >= 0 && !marked_[at(k)]; k = plan.parents[at(k)]) {
      marked_[at(k)] = 1;
      path_.push_back(k);
    }
    reach_.insert(reach_.end(), path_.rbegin(), path_.rend());
  }
  for (const int k : reach_) marked_[at(k)] = 0;
}

SparseVector HalfSolver::solve(const SparseVector& a, double floor) {
  find_reach(a);
  for (const SparseTerm& term : a) {
    RealPair& pair = work_[at(factor_.plan_.places[at(term.index / 2)])];
    (term.index % 2 == 0 ? pair.p : pair.q) += term.value;
  }
  SparseVector result;
  for (auto column = reach_.rbegin(); column != reach_.rend(); ++column) {
    const int k = *column;
    const RealPair yk = std::exchange(work_[at(k)], {});
    // D^(-1) = C C' with C = [root, 0; inverse.b / root, rest]; the terms are those of C' y.
    const Block& inverse = factor_.inverse_pivots_[at(k)];
    const double root = std::sqrt(inverse.a), rest = std::sqrt(std::max(0.0, inverse.d - inverse.b * inverse.b / inverse.a));
    const double first = root * yk.p + inverse.b / root * yk.q, second = rest * yk.q;
    if (std::abs(first) > floor) result.push_back({2 * k, first});
    if (std::abs(second) > floor) result.push_back({2 * k + 1, second});
    if (std::abs(first) <= floor && std::abs(second) <= floor) continue;
    for (int e = factor_.plan_.starts[at(k)]; e < factor_.plan_.starts[at(k) + 1]; ++e)
      work_[at(factor_.rows_[at(e)])] -= product(transposed(factor_.blocks_[at(e)]), yk);
  }
  return result;
}

}  // namespace inkgrid
