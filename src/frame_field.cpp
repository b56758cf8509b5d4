#include "frame_field.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/sample.h"

namespace inkgrid {
namespace {

using Matrix = Eigen::SparseMatrix<Complex>;
using Vector = Eigen::VectorXcd;

// Balance of the terms (the paper leaves it to Bessmeltsev and Solomon 2019); with these the energy does not change when the
// drawing is scaled.
constexpr double kAlignment = 1.0;           // per px of rim, over the stroke width
constexpr double kSmoothness = 4.0;          // of the Dirichlet energy
constexpr double kOrthogonality = 0.2;       // per unit of weight, times area over the stroke width squared
constexpr double kRestOrthogonality = 1e-6;  // keeps the first round definite where a component knows one direction only

constexpr int kMostIterations = 12;  // of a re-weighting round before the factorisation is renewed
constexpr double kResidual = 1e-5;

// Blur that makes gradients of staircase edges point across the stroke.
double blur_radius(double stroke_width) {
  return std::clamp(0.2 * stroke_width, 1.0, 3.0);
}

std::vector<float> gaussian_kernel(double sigma) {
  const int r = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> kernel;
  float sum = 0;
  for (int i = -r; i <= r; ++i) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
    sum += kernel.back();
  }
  for (float& k : kernel) k /= sum;
  return kernel;
}

Raster<float> blurred(const Raster<float>& in, double sigma) {
  const auto kernel = gaussian_kernel(sigma);
  const int r = static_cast<int>(kernel.size() / 2);
  Raster<float> rows(in.width, in.height), out(in.width, in.height);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      float sum = 0;
      for (int k = -r; k <= r; ++k) sum += kernel[static_cast<std::size_t>(k + r)] * in(std::clamp(x + k, 0, in.width - 1), y);
      rows(x, y) = sum;
    }
  for (int y = 0; y < in.height; ++y)
    for (int k = -r; k <= r; ++k) {
      const float weight = kernel[static_cast<std::size_t>(k + r)];
      const float* const from = &rows.data[rows.index(0, std::clamp(y + k, 0, in.height - 1))];
      float* const to = &out.data[out.index(0, y)];
      for (int x = 0; x < in.width; ++x) to[x] += weight * from[x];
    }
  return out;
}

Vec2 gradient(const Raster<float>& r, int x, int y) {
  const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, r.width - 1), y0 = std::max(y - 1, 0),
            y1 = std::min(y + 1, r.height - 1);
  return {static_cast<double>(r(x1, y) - r(x0, y)) / std::max(1, x1 - x0),
          static_cast<double>(r(x, y1) - r(x, y0)) / std::max(1, y1 - y0)};
}

// Calls visit(x, y, barycentric coordinates) for each pixel whose centre is in the triangle.
template <class Visit>
void for_each_pixel(const std::array<Vec2, 3>& p, int width, int height, Visit visit) {
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  const auto first = [](double v) { return std::max(0, static_cast<int>(std::ceil(v - 0.5))); };
  const int y1 = std::min(height - 1, static_cast<int>(std::floor(std::max({p[0].y, p[1].y, p[2].y}) - 0.5)));
  const int x1 = std::min(width - 1, static_cast<int>(std::floor(std::max({p[0].x, p[1].x, p[2].x}) - 0.5)));
  for (int y = first(std::min({p[0].y, p[1].y, p[2].y})); y <= y1; ++y)
    for (int x = first(std::min({p[0].x, p[1].x, p[2].x})); x <= x1; ++x) {
      const Vec2 q{x + 0.5, y + 0.5};
      const double b0 = cross(p[1] - q, p[2] - q) / area, b1 = cross(p[2] - q, p[0] - q) / area, b2 = 1 - b0 - b1;
      if (b0 >= 0 && b1 >= 0 && b2 >= 0) visit(x, y, std::array<double, 3>{b0, b1, b2});
    }
}

// Unknown 2 v is c0 of vertex v, unknown 2 v + 1 is c2.
struct System {
  std::vector<Eigen::Triplet<Complex>> entries;  // lower triangle
  Vector right;
  std::vector<double> area;  // per vertex: a third of its faces', over the stroke width squared

  void add(int row, int column, Complex value) {
    if (row >= column) entries.emplace_back(row, column, value);
  }
};

std::array<Vec2, 3> corners(const BandMesh& mesh, std::size_t f) {
  const auto& t = mesh.faces[f];
  return {mesh.points[static_cast<std::size_t>(t[0])], mesh.points[static_cast<std::size_t>(t[1])],
          mesh.points[static_cast<std::size_t>(t[2])]};
}

// E_smooth: the Dirichlet energy of c0 and c2 with linear elements.
void add_smoothness(const BandMesh& mesh, std::size_t f, System& system) {
  const auto p = corners(mesh, f);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = p[k] - p[(k + 2) % 3], b = p[(k + 1) % 3] - p[(k + 2) % 3];
    const double weight = kSmoothness * 0.5 * dot(a, b) / cross(a, b);
    const int i = mesh.faces[f][k], j = mesh.faces[f][(k + 1) % 3];
    for (int c = 0; c < 2; ++c) {
      system.add(2 * i + c, 2 * i + c, weight);
      system.add(2 * j + c, 2 * j + c, weight);
      system.add(std::max(2 * i + c, 2 * j + c), std::min(2 * i + c, 2 * j + c), -weight);
    }
  }
}

// E_align: |tau^4 + c2 tau^2 + c0|^2 for the tangent tau of each pixel, the coefficients interpolated at its centre.
void add_alignment(const BandMesh& mesh, std::size_t f, const Raster<float>& darkness, double stroke_width, System& system) {
  double mass[3][3] = {};
  Complex twisted[3][3] = {};  // mass times tau^2
  Complex to_c0[3] = {}, to_c2[3] = {};
  for_each_pixel(corners(mesh, f), darkness.width, darkness.height, [&](int x, int y, const std::array<double, 3>& b) {
    const Vec2 g = gradient(darkness, x, y);
    const double size = norm(g);
    if (size < 1e-3) return;
    const Complex tau(-g.y / size, g.x / size);
    const Complex tau2 = tau * tau;
    const double weight = kAlignment * size * size / (size + 0.05) / stroke_width;
    for (std::size_t i = 0; i < 3; ++i) {
      to_c0[i] -= weight * b[i] * tau2 * tau2;
      to_c2[i] -= weight * b[i] * tau2;
      for (std::size_t j = 0; j < 3; ++j) {
        mass[i][j] += weight * b[i] * b[j];
        twisted[i][j] += weight * b[i] * b[j] * tau2;
      }
    }
  });
  if (mass[0][0] + mass[1][1] + mass[2][2] == 0) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const int vi = mesh.faces[f][i];
    system.right[2 * vi] += to_c0[i];
    system.right[2 * vi + 1] += to_c2[i];
    for (std::size_t j = 0; j < 3; ++j) {
      const int vj = mesh.faces[f][j];
      system.add(2 * vi, 2 * vj, mass[i][j]);
      system.add(2 * vi + 1, 2 * vj + 1, mass[i][j]);
      // The row of the tangent is (1, tau^2): entry (c0, c2) is tau^2, entry (c2, c0) its conjugate.
      system.add(2 * vi, 2 * vj + 1, twisted[i][j]);
      system.add(2 * vi + 1, 2 * vj, std::conj(twisted[i][j]));
    }
  }
}

System assemble(const BandMesh& mesh, const Ink& ink) {
  System system;
  system.right = Vector::Zero(2 * mesh.vertex_count());
  system.area.assign(mesh.points.size(), 0);
  system.entries.reserve(mesh.faces.size() * 36);
  const Raster<float> darkness = blurred(ink.darkness, blur_radius(ink.stroke_width));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto p = corners(mesh, f);
    const double unit = ink.stroke_width * static_cast<double>(mesh.scale[f]);
    const double third = cross(p[1] - p[0], p[2] - p[0]) / 6 / (unit * unit);
    for (const int v : mesh.faces[f]) system.area[static_cast<std::size_t>(v)] += third;
    add_smoothness(mesh, f, system);
    add_alignment(mesh, f, darkness, ink.stroke_width, system);
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const double rest = kRestOrthogonality * kOrthogonality * system.area[static_cast<std::size_t>(v)];
    system.add(2 * v, 2 * v, rest);
    system.add(2 * v + 1, 2 * v + 1, rest);
  }
  return system;
}

bool is_degenerate(const Frame& frame, const FieldOptions& options) {
  const double a = norm(frame.a), b = norm(frame.b);
  if (std::min(a, b) < options.degenerate_ratio * std::max(a, b)) return true;
  const double sine = std::abs(cross(frame.a, frame.b)), cosine = std::abs(dot(frame.a, frame.b));
  return std::atan2(sine, cosine) < options.degenerate_angle * std::numbers::pi / 180;
}

// Factorises now and then, and in between solves by conjugate gradients with the last factor as preconditioner.
class ReweightedSolver {
 public:
  ReweightedSolver(const Matrix& lower, int vertices) : order_(vertex_order(lower, vertices)) {
    Matrix permuted = permute(lower);
    factor_.analyzePattern(permuted);
    factorize(permuted);
  }

  Vector solve(const Matrix& lower, const Vector& right, const Vector& start) {
    Vector x = start;
    if (start.size() > 0 && refine(lower, right, x)) return x;
    if (start.size() > 0) factorize(permute(lower));
    return precondition(right);
  }

 private:
  using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

  // Fill-reducing order found on vertices and doubled: the pattern of the unknowns is that of the vertices, in 2 x 2 blocks.
  static Permutation vertex_order(const Matrix& lower, int vertices) {
    std::vector<Eigen::Triplet<double>> pattern;
    for (int k = 0; k < lower.outerSize(); k += 2)
      for (Matrix::InnerIterator it(lower, k); it; ++it)
        if (it.row() % 2 == 0) pattern.emplace_back(static_cast<int>(it.row()) / 2, k / 2, 1.0);
    Eigen::SparseMatrix<double> graph(vertices, vertices);
    graph.setFromTriplets(pattern.begin(), pattern.end());
    Eigen::SparseMatrix<double> symmetric;
    symmetric = graph.selfadjointView<Eigen::Lower>();
    Permutation inverse;
    Eigen::AMDOrdering<int> ordering;
    ordering(symmetric, inverse);
    const Permutation order = inverse.inverse();
    Permutation doubled(2 * vertices);
    for (int v = 0; v < vertices; ++v) {
      doubled.indices()[2 * v] = 2 * order.indices()[v];
      doubled.indices()[2 * v + 1] = 2 * order.indices()[v] + 1;
    }
    return doubled;
  }

  Matrix permute(const Matrix& lower) const {
    Matrix permuted(lower.rows(), lower.cols());
    permuted.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(order_);
    return permuted;
  }

  void factorize(const Matrix& permuted) {
    factor_.factorize(permuted);
    if (factor_.info() != Eigen::Success) throw Error(ErrorCode::numerics, "the frame field system could not be factorised");
  }

  Vector precondition(const Vector& r) const { return order_.transpose() * Vector(factor_.solve(Vector(order_ * r))); }

  // True when x solves the system well enough within a few iterations.
  bool refine(const Matrix& lower, const Vector& right, Vector& x) const {
    const auto a = lower.selfadjointView<Eigen::Lower>();
    Vector r = right - a * x;
    Vector z = precondition(r), p = z, ap;
    double rz = r.dot(z).real();
    const double goal = kResidual * kResidual * right.dot(precondition(right)).real();
    for (int k = 0; k < kMostIterations; ++k) {
      if (!(std::abs(rz) > goal)) return std::isfinite(rz);
      ap = a * p;
      const double alpha = rz / p.dot(ap).real();
      x += alpha * p;
      r -= alpha * ap;
      z = precondition(r);
      const double next = r.dot(z).real();
      p = z + (next / rz) * p;
      rz = next;
    }
    return std::abs(rz) <= goal;
  }

  Permutation order_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;
};

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
  FrameField field;
  const int n = mesh.vertex_count();
  if (n == 0) return field;
  System system = assemble(mesh, ink);
  Matrix lower(2 * n, 2 * n);
  lower.setFromTriplets(system.entries.begin(), system.entries.end());
  system.entries = {};
  ReweightedSolver solver(lower, n);
  Vector x = solver.solve(lower, system.right, {});
  for (;; ++field.rounds) {
    if (control.stop.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
    int degenerate = 0;
    for (int v = 0; v < n; ++v) {
      if (!is_degenerate(frame_of(x[2 * v], x[2 * v + 1]), options)) continue;
      ++degenerate;
      lower.coeffRef(2 * v + 1, 2 * v + 1) += kOrthogonality * system.area[static_cast<std::size_t>(v)];
    }
    field.degenerate_fraction = static_cast<double>(degenerate) / n;
    if (field.degenerate_fraction < options.degenerate_fraction || field.rounds >= options.rounds) break;
    x = solver.solve(lower, system.right, x);
  }
  for (int v = 0; v < n; ++v) {
    field.c0.push_back(x[2 * v]);
    field.c2.push_back(x[2 * v + 1]);
  }
  return field;
}

}  // namespace inkgrid
