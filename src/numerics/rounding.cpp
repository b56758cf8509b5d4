#include "numerics/rounding.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "base/at.h"
#include "inkgrid/inkgrid.h"
#include "numerics/spd_solver.h"

namespace inkgrid {

namespace {

// Distances to the nearest integer that differ by less are a tie: rounding errors must not choose.
constexpr double kTie = 1e-9;
constexpr double kBatch = 1.0 / 32;  // of the integers that are left
constexpr double kRelaxed = 1e-3;    // the residual of an integer's row, in that integer, while all are real
constexpr int kMostSteps = 10000;    // of conjugate gradients
constexpr double kAnswered = 1e-2;   // and after some were fixed

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void require_going_on(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "The run was cancelled while integers were rounded.");
}

SparseLdl factorise(const Quadratic& energy, const std::vector<double>& scale) {
  std::vector<Entry<double>> lower;
  for (int i = 0; i < energy.size(); ++i) {
    lower.push_back({i, i, energy.diagonal[at(i)]});
    for (const SparseTerm& term : energy.rows[at(i)])
      if (term.index < i) lower.push_back({i, term.index, term.value});
  }
  return SparseLdl(energy.size(), lower, scale);
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

// An integer that was fixed, and how far it went.
struct Step {
  int i;
  double by;
};

// `share` of those that are left are fixed at once, at least one; then answer(steps, free, x) moves the others.
template <class Answer>
std::vector<double> round_greedily(std::vector<double> x, double share, const std::stop_token& stop, Answer answer) {
  std::vector<int> free(x.size());
  std::iota(free.begin(), free.end(), 0);
  while (!free.empty()) {
    require_going_on(stop);
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(free.size())));
    std::vector<Step> steps;
    for (const int i : nearest_to_integers(x, free, count)) {
      const double target = nearest_integer(x[at(i)]);
      steps.push_back({i, target - x[at(i)]});
      x[at(i)] = target;
    }
    std::erase_if(free, [&](int i) { return std::ranges::binary_search(steps, i, {}, &Step::i); });
    answer(steps, free, x);
  }
  return x;
}

// Conjugate gradients on the unknowns that are free, from x, scaled by the diagonal.
class Settling {
 public:
  Settling(const Quadratic& energy, const std::vector<int>& free, std::vector<double>& x)
      : energy_(energy), free_(free), x_(x), residual_(x.size(), 0.0), direction_(x.size(), 0.0), image_(x.size(), 0.0) {
    for (const int i : free_) residual_[at(i)] = -energy_.gradient(x_, i);
    turn(0);
  }

  // The largest residual of a row, over its diagonal.
  double worst() const {
    double most = 0;
    for (const int i : free_) most = std::max(most, std::abs(residual_[at(i)]) / energy_.diagonal[at(i)]);
    return most;
  }

  void step() {
    double curvature = 0;
    for (const int i : free_) {
      double& image = image_[at(i)] = energy_.diagonal[at(i)] * direction_[at(i)];
      for (const SparseTerm& term : energy_.rows[at(i)]) image += term.value * direction_[at(term.index)];
      curvature += image * direction_[at(i)];
    }
    if (!(curvature > 0)) throw Error(ErrorCode::numerics, "The matrix of a linear system is not positive definite.");
    const double length = size_ / curvature;
    for (const int i : free_) x_[at(i)] += length * direction_[at(i)], residual_[at(i)] -= length * image_[at(i)];
    turn(size_);
  }

 private:
  // To the residual, conjugate to the direction before, of which the scaled residual had size `before`; 0: there was none.
  void turn(double before) {
    size_ = 0;
    for (const int i : free_) size_ += residual_[at(i)] * residual_[at(i)] / energy_.diagonal[at(i)];
    const double kept = before > 0 ? size_ / before : 0;
    for (const int i : free_) direction_[at(i)] = residual_[at(i)] / energy_.diagonal[at(i)] + kept * direction_[at(i)];
  }

  const Quadratic& energy_;
  const std::vector<int>& free_;
  std::vector<double>& x_;
  std::vector<double> residual_, direction_, image_;  // 0 where not free
  double size_ = 0;
};

void settle(const Quadratic& energy, const std::vector<int>& free, double tolerance, const std::stop_token& stop,
            std::vector<double>& x) {
  Settling settling(energy, free, x);
  for (int step = 0; step < kMostSteps && settling.worst() > tolerance; ++step) {
    require_going_on(stop);
    settling.step();
  }
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
  Descent(const Quadratic& energy, std::vector<double> x)
      : energy_(energy),
        x_(std::move(x)),
        least_(kTie * (1 + std::abs(energy.energy(x_)))),
        gradient_(x_.size()),
        best_(x_.size()),
        changed_(x_.size(), 0) {
    for (int i = 0; i < energy_.size(); ++i) gradient_[at(i)] = energy_.gradient(x_, i);
    for (int i = 0; i < energy_.size(); ++i) best_[at(i)] = best_move(i);
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
    const auto single = [&](int k, double step) { return step * gradient_[at(k)] + energy_.diagonal[at(k)] / 2; };
    const auto consider = [&](const Move& move) {
      if (move.change < best.change) best = move;
    };
    for (double step_i : {-1.0, 1.0}) {
      const double alone = single(i, step_i);
      consider({alone, i, i, step_i, 0});
      for (const SparseTerm& term : energy_.rows[at(i)])
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
    for (const SparseTerm& term : energy_.rows[at(i)]) mark(term.index, marked);
  }

  void follow(const Move& move) {
    std::vector<int> marked;
    for (const int i : {move.i, move.j}) mark_with_coupled(i, marked);
    for (const int i : marked) gradient_[at(i)] = energy_.gradient(x_, i);
    const std::size_t count = marked.size();
    for (std::size_t k = 0; k < count; ++k) mark_with_coupled(marked[k], marked);
    for (const int i : marked) best_[at(i)] = best_move(i), changed_[at(i)] = 0;
  }

  const Quadratic& energy_;
  std::vector<double> x_;
  const double least_;
  std::vector<double> gradient_;  // of the energy
  std::vector<Move> best_;        // of each row; no change where none lowers the energy
  std::vector<char> changed_;     // 0 between calls
};

}  // namespace

double Quadratic::gradient(const std::vector<double>& x, int i) const {
  double g = diagonal[at(i)] * x[at(i)] - h[at(i)];
  for (const SparseTerm& term : rows[at(i)]) g += term.value * x[at(term.index)];
  return g;
}

double Quadratic::energy(const std::vector<double>& x) const {
  std::vector<double> g;
  for (int i = 0; i < size(); ++i) g.push_back(gradient(x, i));
  return (dot(g, x) - dot(h, x)) / 2 + constant;
}

Rounding round_one_by_one(const Quadratic& energy, const std::vector<double>& scale, const std::stop_token& stop) {
  SparseLdl factor = factorise(energy, scale);
  Rounding rounding{factor.solve(energy.h), {}};
  const auto answer = [&](const std::vector<Step>& steps, const std::vector<int>& free, std::vector<double>& x) {
    std::vector<double> push(x.size(), 0.0);
    for (const Step& step : steps) {
      for (const SparseTerm& term : energy.rows[at(step.i)]) push[at(term.index)] -= step.by * term.value;
      factor.remove(step.i);
    }
    const std::vector<double> moves = factor.solve(push);
    for (const int i : free) x[at(i)] += moves[at(i)];
  };
  rounding.rounded = round_greedily(rounding.relaxed, 0, stop, answer);
  return rounding;
}

Rounding round_in_batches(const Quadratic& energy, const std::stop_token& stop) {
  std::vector<int> all(energy.diagonal.size());
  std::iota(all.begin(), all.end(), 0);
  Rounding rounding{std::vector<double>(all.size(), 0.0), {}};
  settle(energy, all, kRelaxed, stop, rounding.relaxed);
  const auto answer = [&](const std::vector<Step>&, const std::vector<int>& free, std::vector<double>& x) {
    settle(energy, free, kAnswered, stop, x);
  };
  rounding.rounded = round_greedily(rounding.relaxed, kBatch, stop, answer);
  return rounding;
}

std::vector<double> descend(const Quadratic& energy, std::vector<double> x, const std::stop_token& stop) {
  return Descent(energy, std::move(x)).run(stop);
}

}  // namespace inkgrid
