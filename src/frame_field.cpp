#include "frame_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "field_system.h"

namespace inkgrid {
namespace {

constexpr int kMostIterations = 200;  // of a re-weighting round
constexpr double kResidual = 1e-4;

constexpr std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// i z
Complex quarter_turned(Complex z) {
  return {-z.imag(), z.real()};
}

bool is_degenerate(const Frame& frame, const FieldOptions& options) {
  const double a = norm(frame.a), b = norm(frame.b);
  if (std::min(a, b) < options.degenerate_ratio * std::max(a, b)) return true;
  const double sine = std::abs(cross(frame.a, frame.b)), cosine = std::abs(dot(frame.a, frame.b));
  return std::atan2(sine, cosine) < options.degenerate_angle * std::numbers::pi / 180;
}

double real_dot(const std::vector<ComplexPair>& a, const std::vector<ComplexPair>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i].p.real() * b[i].p.real() + a[i].p.imag() * b[i].p.imag() + a[i].q.real() * b[i].q.real() +
           a[i].q.imag() * b[i].q.imag();
  return sum;
}

// a += factor b
void add(std::vector<ComplexPair>& a, double factor, const std::vector<ComplexPair>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i].p += factor * b[i].p;
    a[i].q += factor * b[i].q;
  }
}

// The system with orthogonality weights that grow: one factorisation, then conjugate gradients with it as preconditioner.
class ReweightedSystem {
 public:
  explicit ReweightedSystem(const FieldSystem& system)
      : system_(system), factor_(system.matrix), weights_(system.right.size(), 0.0), x_(factor_.solve(system.right)) {
    goal_ = kResidual * kResidual * real_dot(system.right, x_);
  }

  const std::vector<ComplexPair>& solution() const { return x_; }

  void add_weight(int node, double weight) { weights_[at(node)] += weight; }

  // From the last solution on.
  void solve() {
    std::vector<ComplexPair> r = system_.right;
    add(r, -1, times(x_));
    std::vector<ComplexPair> z = factor_.solve(r), direction = z;
    double rz = real_dot(r, z);
    for (int k = 0; k < kMostIterations && rz > goal_; ++k) {
      const std::vector<ComplexPair> image = times(direction);
      const double step = rz / real_dot(direction, image);
      add(x_, step, direction);
      add(r, -step, image);
      z = factor_.solve(r);
      const double next = real_dot(r, z);
      const double ratio = next / rz;
      for (std::size_t i = 0; i < z.size(); ++i) {
        direction[i].p = z[i].p + ratio * direction[i].p;
        direction[i].q = z[i].q + ratio * direction[i].q;
      }
      rz = next;
    }
  }

 private:
  std::vector<ComplexPair> times(const std::vector<ComplexPair>& x) const {
    std::vector<ComplexPair> y = system_.matrix.times(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Complex c2 = x[i].p - quarter_turned(x[i].q);
      y[i].p += weights_[i] * c2;
      y[i].q += weights_[i] * quarter_turned(c2);
    }
    return y;
  }

  const FieldSystem& system_;
  PairLdl factor_;
  std::vector<double> weights_;  // of |c2|^2, per node
  std::vector<ComplexPair> x_;
  double goal_;
};

// The coefficients at every vertex.
void interpolate(const FieldSpace& space, const std::vector<ComplexPair>& x, FrameField& field) {
  for (std::size_t v = 0; v < space.nodes.size(); ++v) {
    const ComplexPair &a = x[at(space.nodes[v][0])], &b = x[at(space.nodes[v][1])];
    const Complex p = 0.5 * (a.p + b.p), turned_q = quarter_turned(0.5 * (a.q + b.q));
    field.c0[v] = p + turned_q;
    field.c2[v] = p - turned_q;
  }
}

}  // namespace

Frame frame_of(Complex c0, Complex c2) {
  const Complex root = std::sqrt(c2 * c2 - 4.0 * c0);
  // The larger of the two squares first; the other follows from their product without cancellation.
  const Complex larger = std::abs(-c2 + root) >= std::abs(-c2 - root) ? 0.5 * (-c2 + root) : 0.5 * (-c2 - root);
  const Complex smaller = std::abs(larger) > 0 ? c0 / larger : Complex(0);
  const Complex a = std::sqrt(larger), b = std::sqrt(smaller);
  return {{a.real(), a.imag()}, {b.real(), b.imag()}};
}

FrameField solve_field(const BandMesh& mesh, const Ink& ink, const FieldOptions& options, const Control& control) {
  const std::size_t n = mesh.points.size();
  FrameField field{std::vector<Complex>(n), std::vector<Complex>(n)};
  if (n == 0) return field;
  const FieldSpace space = coarse_space(mesh);
  const FieldSystem system = assemble_field(mesh, space, ink);
  for (ReweightedSystem reweighted(system);; ++field.rounds) {
    if (control.stop.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
    interpolate(space, reweighted.solution(), field);
    int degenerate = 0;
    for (std::size_t v = 0; v < n; ++v) {
      if (!is_degenerate(frame_of(field.c0[v], field.c2[v]), options)) continue;
      ++degenerate;
      for (const int node : space.nodes[v]) reweighted.add_weight(node, 0.5 * system.orthogonality[v]);
    }
    field.degenerate_fraction = static_cast<double>(degenerate) / static_cast<double>(n);
    if (field.degenerate_fraction < options.degenerate_fraction || field.rounds >= options.rounds) return field;
    reweighted.solve();
  }
}

}  // namespace inkgrid
