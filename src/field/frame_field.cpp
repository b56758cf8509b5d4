#include "field/frame_field.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/at.h"
#include "base/parallel.h"
#include "field/field_system.h"

namespace inkgrid {
namespace {

constexpr int kMostIterations = 200;  // of a re-weighting round
constexpr double kResidual = 1e-4;
constexpr int kVerticesOfTask = 4096;

// i z
Complex quarter_turned(Complex z) {
  return {-z.imag(), z.real()};
}

// A frame is degenerate where its directions, or their lengths, differ by less than these.
class Degeneracy {
 public:
  explicit Degeneracy(const FieldOptions& options)
      : tangent_(std::tan(options.degenerate_angle * std::numbers::pi / 180)), ratio_(options.degenerate_ratio) {}

  bool holds(const Frame& frame) const {
    const double a = norm2(frame.a), b = norm2(frame.b);
    if (std::min(a, b) < ratio_ * ratio_ * std::max(a, b)) return true;
    return std::abs(cross(frame.a, frame.b)) < tangent_ * std::abs(dot(frame.a, frame.b));
  }

 private:
  double tangent_;
  double ratio_;
};

// The root with a real part of at least zero.
Complex square_root(Complex z) {
  const double size = std::sqrt(std::norm(z));
  if (size == 0) return 0;
  const double larger = std::sqrt(0.5 * (size + std::abs(z.real()))), smaller = 0.5 * std::abs(z.imag()) / larger;
  return z.real() >= 0 ? Complex(larger, std::copysign(smaller, z.imag())) : Complex(smaller, std::copysign(larger, z.imag()));
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
  ReweightedSystem(FieldSystem system, int threads)
      : system_(std::move(system)),
        factor_(system_.matrix, std::move(system_.plan), threads),
        weights_(system_.right.size(), 0.0),
        x_(factor_.solve(system_.right)),
        goal_(kResidual * kResidual * real_dot(system_.right, x_)) {}

  const std::vector<ComplexPair>& solution() const { return x_; }

  // Of |c2|^2, at a vertex between these nodes.
  void add_weight(std::size_t vertex, const std::array<int, 2>& nodes) {
    for (const int node : nodes) weights_[at(node)] += 0.5 * system_.orthogonality[vertex];
  }

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

  FieldSystem system_;
  PairLdl factor_;
  std::vector<double> weights_;  // of |c2|^2, per node
  std::vector<ComplexPair> x_;
  double goal_;
};

// The coefficients at every vertex; returns where its frame is degenerate.
std::vector<std::uint8_t> interpolate(const FieldSpace& space, const std::vector<ComplexPair>& x, const Degeneracy& degeneracy,
                                      int threads, FrameField& field) {
  std::vector<std::uint8_t> degenerate(space.nodes.size());
  for_ranges(threads, static_cast<int>(space.nodes.size()), kVerticesOfTask, [&](int first, int last) {
    for (auto v = at(first); v < at(last); ++v) {
      const ComplexPair &a = x[at(space.nodes[v][0])], &b = x[at(space.nodes[v][1])];
      const Complex p = 0.5 * (a.p + b.p), turned_q = quarter_turned(0.5 * (a.q + b.q));
      field.c0[v] = p + turned_q;
      field.c2[v] = p - turned_q;
      degenerate[v] = degeneracy.holds(frame_of(field.c0[v], field.c2[v]));
    }
  });
  return degenerate;
}

}  // namespace

Frame frame_of(Complex c0, Complex c2) {
  const Complex root = square_root(c2 * c2 - 4.0 * c0);
  // The larger of the two squares first; the other follows from their product without cancellation.
  const Complex larger = std::norm(root - c2) >= std::norm(root + c2) ? 0.5 * (root - c2) : -0.5 * (root + c2);
  const Complex smaller = std::norm(larger) > 0 ? c0 / larger : Complex(0);
  const Complex a = square_root(larger), b = square_root(smaller);
  return {{a.real(), a.imag()}, {b.real(), b.imag()}};
}

FrameField solve_field(const BandMesh& mesh, const Ink& ink, const FieldOptions& options, const Control& control) {
  const std::size_t n = mesh.points.size();
  FrameField field{std::vector<Complex>(n), std::vector<Complex>(n)};
  if (n == 0) return field;
  const FieldSpace space = coarse_space(mesh);
  const Degeneracy degeneracy(options);
  for (ReweightedSystem reweighted(assemble_field(mesh, space, ink, options.threads), options.threads);; ++field.rounds) {
    if (control.stop.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
    const auto degenerate = interpolate(space, reweighted.solution(), degeneracy, options.threads, field);
    std::size_t count = 0;
    for (std::size_t v = 0; v < n; ++v) {
      if (!degenerate[v]) continue;
      ++count;
      reweighted.add_weight(v, space.nodes[v]);
    }
    field.degenerate_fraction = static_cast<double>(count) / static_cast<double>(n);
    if (field.degenerate_fraction < options.degenerate_fraction || field.rounds >= options.rounds) return field;
    reweighted.solve();
  }
}

}  // namespace inkgrid
