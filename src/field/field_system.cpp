#include "field/field_system.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"
#include "base/blur.h"
#include "base/parallel.h"
#include "base/sample.h"

namespace inkgrid {
namespace {

using Complex = std::complex<double>;

// Balance of the terms (the paper leaves it to Bessmeltsev and Solomon 2019); with these the energy does not change when the
// drawing is scaled.
constexpr double kAlignment = 1.0;           // per px of rim, over the stroke width
constexpr double kSmoothness = 4.0;          // of the Dirichlet energy
constexpr double kOrthogonality = 0.2;       // per unit of weight, times area over the stroke width squared
constexpr double kRestOrthogonality = 1e-6;  // keeps the first round definite where a component knows one direction only

constexpr int kFacesAtOnce = 2048;  // whose terms are held until they are added in their order
constexpr int kFacesOfTask = 128;

// Blur that makes gradients of staircase edges point across the stroke.
double blur_radius(double stroke_width) {
  return std::clamp(0.2 * stroke_width, 1.0, 3.0);
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
  const auto first = [](double v) { return std::max(0, -floor_of(0.5 - v)); };
  const int y1 = std::min(height - 1, floor_of(std::max({p[0].y, p[1].y, p[2].y}) - 0.5));
  const int x1 = std::min(width - 1, floor_of(std::max({p[0].x, p[1].x, p[2].x}) - 0.5));
  for (int y = first(std::min({p[0].y, p[1].y, p[2].y})); y <= y1; ++y)
    for (int x = first(std::min({p[0].x, p[1].x, p[2].x})); x <= x1; ++x) {
      const Vec2 q{x + 0.5, y + 0.5};
      const double b0 = cross(p[1] - q, p[2] - q) / area, b1 = cross(p[2] - q, p[0] - q) / area, b2 = 1 - b0 - b1;
      if (b0 >= 0 && b1 >= 0 && b2 >= 0) visit(x, y, std::array<double, 3>{b0, b1, b2});
    }
}

std::array<Vec2, 3> corners(const BandMesh& mesh, std::size_t f) {
  const auto& t = mesh.faces[f];
  return {mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])]};
}

// The nodes that the corners of a face are made of, and how much of each is in each corner.
struct FaceNodes {
  int count = 0;
  std::array<int, 6> node;
  std::array<std::array<double, 6>, 3> share = {};  // [corner][place of the node]

  FaceNodes() = default;
  FaceNodes(const BandMesh& mesh, const FieldSpace& space, std::size_t f) {
    for (std::size_t k = 0; k < 3; ++k)
      for (const int n : space.nodes[at(mesh.faces[f][k])]) share[k][place_of(n)] += 0.5;
  }

  bool are_among(const FaceNodes& others) const {
    const auto others_end = others.node.begin() + others.count;
    return std::all_of(node.begin(), node.begin() + count,
                       [&](int n) { return std::find(others.node.begin(), others_end, n) != others_end; });
  }

  std::size_t place_of(int n) {
    std::size_t place = 0;
    while (place < at(count) && node[place] != n) ++place;
    if (place == at(count)) node[at(count++)] = n;
    return place;
  }

  // The shares of the nodes at a point given by its barycentric coordinates.
  std::array<double, 6> within(const std::array<double, 3>& b) const {
    std::array<double, 6> sum;
    for (std::size_t n = 0; n < at(count); ++n) sum[n] = b[0] * share[0][n] + b[1] * share[1][n] + b[2] * share[2][n];
    return sum;
  }
};

// The terms of one face, among its nodes.
struct FaceSystem {
  std::array<std::array<Block, 6>, 6> matrix;  // [row][column], row >= column
  std::array<ComplexPair, 6> right;

  void clear(int count) {
    for (std::size_t i = 0; i < at(count); ++i) {
      std::fill_n(matrix[i].begin(), i + 1, Block{});
      right[i] = {};
    }
  }
};

// The Dirichlet energy of c0 and c2 with linear elements; |grad c0|^2 + |grad c2|^2 = 2 |grad p|^2 + 2 |grad q|^2.
void add_smoothness(const std::array<Vec2, 3>& p, const FaceNodes& nodes, FaceSystem& system) {
  const double area = cross(p[1] - p[0], p[2] - p[0]) / 2;
  std::array<Vec2, 6> gradient = {};
  for (std::size_t n = 0; n < at(nodes.count); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      gradient[n] += (nodes.share[k][n] / (2 * area)) * quarter_turn(p[(k + 2) % 3] - p[(k + 1) % 3]);
  for (std::size_t i = 0; i < at(nodes.count); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const double weight = 2 * kSmoothness * area * dot(gradient[i], gradient[j]);
      system.matrix[i][j] += {weight, 0, 0, weight};
    }
}

// |tau^3 + 2 (tau_x p + tau_y q)|^2 for the tangent tau of each pixel, the unknowns interpolated at its centre.
void add_alignment(const std::array<Vec2, 3>& p, const Raster<float>& darkness, double stroke_width, const FaceNodes& nodes,
                   FaceSystem& system) {
  for_each_pixel(p, darkness.width, darkness.height, [&](int x, int y, const std::array<double, 3>& b) {
    const Vec2 g = gradient(darkness, x, y);
    const double size = std::sqrt(norm2(g));
    if (size < 1e-3) return;
    const Vec2 tau{-g.y / size, g.x / size}, cube = tau * tau * tau;
    const double weight = kAlignment * size * size / (size + 0.05) / stroke_width;
    const auto share = nodes.within(b);
    const Block mass{4 * weight * tau.x * tau.x, 4 * weight * tau.x * tau.y, 4 * weight * tau.x * tau.y,
                     4 * weight * tau.y * tau.y};
    for (std::size_t i = 0; i < at(nodes.count); ++i) {
      const double pull = -2 * weight * share[i];
      system.right[i].p += pull * tau.x * Complex(cube.x, cube.y);
      system.right[i].q += pull * tau.y * Complex(cube.x, cube.y);
      for (std::size_t j = 0; j <= i; ++j) system.matrix[i][j] += (share[i] * share[j]) * mass;
    }
  });
}

// What one face adds to the system.
struct FaceTerms {
  FaceNodes nodes;
  FaceSystem part;

  void collect(const BandMesh& mesh, const FieldSpace& space, std::size_t f, const Raster<float>& darkness, double stroke_width) {
    const auto p = corners(mesh, f);
    nodes = FaceNodes(mesh, space, f);
    part.clear(nodes.count);
    add_smoothness(p, nodes, part);
    add_alignment(p, darkness, stroke_width, nodes, part);
  }

  void add_to(FieldSystem& system) const {
    for (int i = 0; i < nodes.count; ++i) {
      const int row = nodes.node[at(i)];
      system.right[at(row)] += part.right[at(i)];
      for (int j = 0; j <= i; ++j) system.matrix.add(row, nodes.node[at(j)], part.matrix[at(i)][at(j)]);
    }
  }
};

void add_orthogonality(const BandMesh& mesh, std::size_t f, double stroke_width, FieldSystem& system) {
  const auto p = corners(mesh, f);
  const double unit = stroke_width * static_cast<double>(mesh.scale[f]);
  const double third = cross(p[1] - p[0], p[2] - p[0]) / 6 / (unit * unit);
  for (const int v : mesh.faces[f]) system.orthogonality[at(v)] += kOrthogonality * third;
}

// Those of a face once where the one before it has the same nodes, as half of them do: four are a triangle of the coarse lattice.
std::vector<std::array<int, 2>> edges_between_nodes(const BandMesh& mesh, const FieldSpace& space) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(3 * mesh.faces.size() / 2);
  FaceNodes before;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceNodes nodes(mesh, space, f);
    if (nodes.are_among(before)) continue;
    before = nodes;
    for (int i = 0; i < nodes.count; ++i)
      for (int j = 0; j < i; ++j) edges.push_back({nodes.node[at(i)], nodes.node[at(j)]});
  }
  return edges;
}

void add_faces(const BandMesh& mesh, const FieldSpace& space, const Ink& ink, int threads, FieldSystem& system) {
  const Raster<float> darkness = blurred(ink.darkness, blur_radius(ink.stroke_width), threads);
  std::vector<FaceTerms> terms(at(std::min(kFacesAtOnce, mesh.face_count())));
  for (int first = 0; first < mesh.face_count(); first += kFacesAtOnce) {
    const int count = std::min(kFacesAtOnce, mesh.face_count() - first);
    for_ranges(threads, count, kFacesOfTask, [&](int from, int end) {
      for (int k = from; k < end; ++k) terms[at(k)].collect(mesh, space, at(first + k), darkness, ink.stroke_width);
    });
    for (int k = 0; k < count; ++k) {
      terms[at(k)].add_to(system);
      add_orthogonality(mesh, at(first + k), ink.stroke_width, system);
    }
  }
}

void add_rest(const FieldSpace& space, FieldSystem& system) {
  for (std::size_t v = 0; v < space.nodes.size(); ++v)
    for (const int node : space.nodes[v]) {
      const double rest = kRestOrthogonality * system.orthogonality[v];
      system.matrix.add(node, node, {rest, 0, 0, rest});
    }
}

}  // namespace

FieldSystem assemble_field(const BandMesh& mesh, const FieldSpace& space, const Ink& ink, int threads) {
  FieldSystem system{{space.size, edges_between_nodes(mesh, space)},
                     std::vector<ComplexPair>(at(space.size)),
                     std::vector<double>(mesh.points.size(), 0.0),
                     {}};
  at_once(
      threads, [&] { add_faces(mesh, space, ink, threads, system); }, [&] { system.plan = plan_elimination(system.matrix); });
  add_rest(space, system);
  return system;
}

}  // namespace inkgrid
