// Hand-made meshes with maps whose isolines are known, and ways to disturb them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include "base/at.h"
#include "base/union_find.h"
#include "map/exact_map.h"

namespace inkgrid {

struct Mapped {
  BandMesh mesh;
  GridMap map;
};

inline void link(BandMesh& mesh) {
  std::map<std::pair<int, int>, int> halfedges;
  const int count = 3 * mesh.face_count();
  auto ends = [&](int h) { return std::pair{mesh.faces[at(h / 3)][at(h % 3)], mesh.faces[at(h / 3)][at((h + 1) % 3)]}; };
  for (int h = 0; h < count; ++h) halfedges[ends(h)] = h;
  mesh.twins.assign(at(count), -1);
  UnionFind sets(mesh.face_count());
  for (int h = 0; h < count; ++h) {
    const auto [a, b] = ends(h);
    if (const auto found = halfedges.find({b, a}); found != halfedges.end()) {
      mesh.twins[at(h)] = found->second;
      sets.unite(h / 3, found->second / 3);
    }
  }
  mesh.component.resize(mesh.faces.size());
  for (int f = 0; f < mesh.face_count(); ++f) {
    mesh.component[at(f)] = sets.find(f) == f ? mesh.components++ : mesh.component[at(sets.find(f))];
  }
  mesh.scale.assign(mesh.faces.size(), 1.0F);
  mesh.on_ink.assign(mesh.faces.size(), 0);
}

// One chart: all corners are their vertex's base.
inline Mapped with_one_chart(BandMesh mesh, const std::function<Vec2(Vec2)>& uv) {
  GridMap map;
  for (const Vec2 p : mesh.points) map.base.push_back(uv(p));
  for (const auto& face : mesh.faces) map.corner_base.insert(map.corner_base.end(), face.begin(), face.end());
  map.corner_turn.assign(map.corner_base.size(), 0);
  map.corner_shift.assign(map.corner_base.size(), {});
  map.transitions.assign(map.corner_base.size(), {});
  map.half_integer.assign(map.base.size(), 0);
  return {std::move(mesh), std::move(map)};
}

// columns x rows cells of size step from the origin, each cut into two triangles by alternating diagonals; numbered in random
// order where seed > 0, so that the canonical directions of edges are mixed.
inline BandMesh lattice(int columns, int rows, double step, unsigned seed = 0) {
  BandMesh mesh;
  std::vector<int> number(at((columns + 1) * (rows + 1)));
  std::iota(number.begin(), number.end(), 0);
  if (seed > 0) std::shuffle(number.begin(), number.end(), std::mt19937(seed));
  mesh.points.resize(number.size());
  auto vertex = [&](int i, int j) { return number[at(j * (columns + 1) + i)]; };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) mesh.points[at(vertex(i, j))] = {i * step, j * step};
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      if ((i + j) % 2 == 0) {
        mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
      } else {
        mesh.faces.insert(mesh.faces.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  link(mesh);
  return mesh;
}

inline Transition composed(const Transition& second, const Transition& first) {
  return {(first.turn + second.turn) & 3, turned(first.shift, second.turn) + second.shift};
}

// `quadrants` square patches of the grid around one vertex whose coordinates are `apex`.  Each chart holds `per_chart` quadrants
// (1, or 2 for an apex with only one integer coordinate).
class Cone {
 public:
  Cone(int quadrants, int per_chart, Vec2 apex, int cells, double step)
      : quadrants_(quadrants), per_chart_(per_chart), apex_(apex), cells_(cells), step_(step) {}

  Mapped build() {
    place_points();
    for (int q = 0; q < quadrants_; ++q)
      for (int j = 0; j < cells_; ++j)
        for (int i = 0; i < cells_; ++i) {
          add_face(q, {{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
          add_face(q, {{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
    link(mesh_);
    map_.half_integer.assign(map_.base.size(), 0);
    map_.half_integer[0] = 1;
    return {std::move(mesh_), std::move(map_)};
  }

 private:
  int previous(int q) const { return (q + quadrants_ - 1) % quadrants_; }

  // Grid points of quadrant q that are not on its side v = 0 belong to it; that side belongs to quadrant q - 1, the apex to all.
  int vertex(int q, int i, int j) const {
    if (i == 0 && j == 0) return 0;
    if (j == 0) return 1 + previous(q) * cells_ * (cells_ + 1) + (i - 1) * (cells_ + 1);
    return 1 + q * cells_ * (cells_ + 1) + (j - 1) * (cells_ + 1) + i;
  }

  void place_points() {
    mesh_.points.resize(at(1 + quadrants_ * cells_ * (cells_ + 1)));
    map_.base.resize(mesh_.points.size());
    map_.base[0] = apex_;
    for (int q = 0; q < quadrants_; ++q)
      for (int j = 1; j <= cells_; ++j)
        for (int i = 0; i <= cells_; ++i) {
          const Vec2 local{i * step_, j * step_};
          const double angle = 2 * std::numbers::pi / quadrants_ * (q + std::atan2(local.y, local.x) / (std::numbers::pi / 2));
          mesh_.points[at(vertex(q, i, j))] = norm(local) * Vec2{std::cos(angle), std::sin(angle)};
          map_.base[at(vertex(q, i, j))] = apex_ + turned(local, q % per_chart_);
        }
  }

  // From quadrant q to the next: about the apex.
  Transition seam(int q) const {
    const int turn = (q + 1) % quadrants_ % per_chart_ - q % per_chart_ - 1;
    const Vec2 shift = apex_ - turned(apex_, turn);
    return {turn & 3, {std::llround(shift.x), std::llround(shift.y)}};
  }

  void add_face(int q, std::array<std::pair<int, int>, 3> corners) {
    std::array<int, 3> face{};
    for (int k = 0; k < 3; ++k) {
      const auto [i, j] = corners[at(k)];
      const auto [i_next, j_next] = corners[at((k + 1) % 3)];
      face[at(k)] = vertex(q, i, j);
      const Transition t = j == 0 && i > 0 ? seam(previous(q)) : Transition{};
      map_.corner_base.push_back(face[at(k)]);
      map_.corner_turn.push_back(static_cast<std::uint8_t>(t.turn));
      map_.corner_shift.push_back(t.shift);
      const bool along_u = j == 0 && j_next == 0, along_v = i == 0 && i_next == 0;
      map_.transitions.push_back(along_u ? inverse(seam(previous(q))) : along_v ? seam(q) : Transition{});
    }
    mesh_.faces.push_back(face);
  }

  int quadrants_, per_chart_;
  Vec2 apex_;
  int cells_;
  double step_;
  BandMesh mesh_;
  GridMap map_;
};

inline Mapped cone(int quadrants, int per_chart, Vec2 apex, int cells, double step) {
  return Cone(quadrants, per_chart, apex, cells, step).build();
}

// A ring cut along angle 0; u grows with the radius, v by `turns` grid units around.
inline Mapped ring(int around, int cells, double u0, double step, int turns, const std::function<double(double)>& v_of_angle) {
  BandMesh mesh;
  GridMap map;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      mesh.points.push_back((2 + j * step) * Vec2{std::cos(angle), std::sin(angle)});
      map.base.push_back({u0 + j * step, v_of_angle(angle)});
    }
  }
  auto add_face = [&](std::array<std::pair<int, int>, 3> corners) {
    std::array<int, 3> face{};
    for (int k = 0; k < 3; ++k) {
      const auto [i, j] = corners[at(k)];
      face[at(k)] = j * around + i % around;
      map.corner_base.push_back(face[at(k)]);
      map.corner_shift.push_back({0, i == around ? turns : 0});
    }
    mesh.faces.push_back(face);
  };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < around; ++i) {
      add_face({{{i, j}, {i, j + 1}, {i + 1, j + 1}}});
      add_face({{{i, j}, {i + 1, j + 1}, {i + 1, j}}});
    }
  }
  for (auto& face : mesh.faces)
    EXPECT_GT(cross(mesh.points[at(face[1])] - mesh.points[at(face[0])], mesh.points[at(face[2])] - mesh.points[at(face[0])]), 0);
  link(mesh);
  map.corner_turn.assign(map.corner_base.size(), 0);
  map.half_integer.assign(map.base.size(), 0);
  map.transitions.resize(mesh.twins.size());
  for (int h = 0; h < static_cast<int>(mesh.twins.size()); ++h) {
    if (mesh.twins[at(h)] < 0) continue;
    map.transitions[at(h)].shift = map.corner_shift[at(next_halfedge(mesh.twins[at(h)]))] - map.corner_shift[at(h)];
  }
  return {std::move(mesh), std::move(map)};
}

inline std::vector<Transition> random_charts(int faces, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Transition> charts(at(faces));
  for (Transition& t : charts)
    t = {static_cast<int>(random() % 4), {static_cast<int>(random() % 41) - 20, static_cast<int>(random() % 41) - 20}};
  return charts;
}

// Each face in a chart of its own: its old chart followed by charts[face].
inline GridMap recharted(const Mapped& m, const std::vector<Transition>& charts) {
  GridMap map = m.map;
  for (int c = 0; c < static_cast<int>(map.corner_base.size()); ++c) {
    const Transition t = composed(charts[at(c / 3)], {map.corner_turn[at(c)], map.corner_shift[at(c)]});
    map.corner_turn[at(c)] = static_cast<std::uint8_t>(t.turn);
    map.corner_shift[at(c)] = t.shift;
    const int other = m.mesh.twins[at(c)];
    if (other >= 0)
      map.transitions[at(c)] = composed(charts[at(other / 3)], composed(map.transitions[at(c)], inverse(charts[at(c / 3)])));
  }
  return map;
}

// Interior vertices moved in the (u, v) plane by up to `size`, in multiples of `grain` where it is not 0.
inline void perturb(Mapped& m, double size, double grain, unsigned seed) {
  std::mt19937 random(seed);
  auto noise = [&] {
    const double x = size * (2 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1);
    return grain > 0 ? grain * std::round(x / grain) : x;
  };
  const std::vector<std::uint8_t> boundary = [&] {
    std::vector<std::uint8_t> marked(m.mesh.points.size(), 0);
    for (int h = 0; h < static_cast<int>(m.mesh.twins.size()); ++h) {
      if (m.mesh.twins[at(h)] < 0)
        marked[at(m.mesh.faces[at(h / 3)][at(h % 3)])] = marked[at(m.mesh.faces[at(h / 3)][at((h + 1) % 3)])] = 1;
    }
    return marked;
  }();
  for (std::size_t v = 0; v < m.map.base.size(); ++v) {
    const Vec2 move{noise(), noise()};
    if (!boundary[v] && !m.map.half_integer[v]) m.map.base[v] += move;
  }
}

inline void expect_transitions_hold(const BandMesh& mesh, const ExactMap& exact) {
  for (int h = 0; h < static_cast<int>(mesh.twins.size()); ++h) {
    const int other = mesh.twins[at(h)];
    if (other < 0) continue;
    const Transition& t = exact.transitions[at(h)];
    EXPECT_EQ(turned(exact.uv[at(h)], t.turn) + kFixedOne * t.shift, exact.uv[at(next_halfedge(other))]);
    EXPECT_EQ(turned(exact.uv[at(next_halfedge(h))], t.turn) + kFixedOne * t.shift, exact.uv[at(other)]);
  }
}

}  // namespace inkgrid
