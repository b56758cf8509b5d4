// Meshes, charts, labels and ink made by hand, for tests of the grid map.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/at.h"
#include "map/grid_map.h"

namespace inkgrid::testing {

inline constexpr double kPi = std::numbers::pi;

inline Vec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

inline Vec2 real(IVec2 a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y)};
}

inline BandMesh mesh_of(std::vector<Vec2> points, std::vector<std::array<int, 3>> faces) {
  BandMesh mesh;
  mesh.points = std::move(points);
  mesh.faces = std::move(faces);
  mesh.twins.assign(3 * mesh.faces.size(), -1);
  std::map<std::pair<int, int>, int> halfedges;
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const auto& face = mesh.faces[at(face_of(h))];
    halfedges[{face[at(h % 3)], face[at((h + 1) % 3)]}] = h;
  }
  for (const auto& [ends, h] : halfedges) {
    const auto back = halfedges.find({ends.second, ends.first});
    if (back != halfedges.end()) mesh.twins[at(h)] = back->second;
  }
  mesh.component.assign(mesh.faces.size(), -1);
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (mesh.component[at(f)] >= 0) continue;
    std::vector<int> open{f};
    mesh.component[at(f)] = mesh.components;
    while (!open.empty()) {
      const int g = open.back();
      open.pop_back();
      for (int h = 3 * g; h < 3 * g + 3; ++h) {
        if (mesh.twins[at(h)] < 0 || mesh.component[at(face_of(mesh.twins[at(h)]))] >= 0) continue;
        mesh.component[at(face_of(mesh.twins[at(h)]))] = mesh.components;
        open.push_back(face_of(mesh.twins[at(h)]));
      }
    }
    ++mesh.components;
  }
  mesh.scale.assign(mesh.faces.size(), 1);
  mesh.on_ink.assign(mesh.faces.size(), 0);
  return mesh;
}

// Equilateral triangles of unit side.
inline BandMesh lattice(int columns, int rows, Vec2 corner = {3, 3}) {
  std::vector<Vec2> points;
  std::vector<std::array<int, 3>> faces;
  const auto index = [&](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) points.push_back(corner + Vec2{i + 0.5 * (j % 2), j * std::sqrt(0.75)});
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = index(i, j), b = index(i + 1, j), c = index(i, j + 1), d = index(i + 1, j + 1);
      if (j % 2 == 0) {
        faces.push_back({a, b, c});
        faces.push_back({b, d, c});
      } else {
        faces.push_back({a, b, d});
        faces.push_back({a, d, c});
      }
    }
  return mesh_of(points, faces);
}

// Rings of triangles about a centre; inner == 0: a disc with a vertex in its middle, vertex 0.  Ring r has its vertices at first
// + r * sectors.
inline BandMesh polar(Vec2 centre, double inner, double outer, int rings, int sectors) {
  std::vector<Vec2> points;
  std::vector<std::array<int, 3>> faces;
  const int first = inner == 0 ? 1 : 0, circles = inner == 0 ? rings : rings + 1;
  if (inner == 0) points.push_back(centre);
  for (int r = 0; r < circles; ++r)
    for (int k = 0; k < sectors; ++k)
      points.push_back(centre + (inner + (outer - inner) * (r + first) / rings) * direction(2 * kPi * k / sectors));
  const auto index = [&](int r, int k) { return first + r * sectors + k % sectors; };
  for (int k = 0; k < sectors && inner == 0; ++k) faces.push_back({0, index(0, k), index(0, k + 1)});
  for (int r = 0; r + 1 < circles; ++r)
    for (int k = 0; k < sectors; ++k) {
      faces.push_back({index(r, k), index(r + 1, k), index(r + 1, k + 1)});
      faces.push_back({index(r, k), index(r + 1, k + 1), index(r, k + 1)});
    }
  return mesh_of(points, faces);
}

// 0 .. 2 pi
inline double angle_about(Vec2 centre, Vec2 p) {
  const double a = std::atan2(p.y - centre.y, p.x - centre.x);
  return a < 0 ? a + 2 * kPi : a;
}

using CutEdge = std::function<bool(Vec2, Vec2)>;
inline bool no_cut(Vec2, Vec2) {
  return false;
}

// The ray from the centre at this angle.
inline CutEdge ray(Vec2 centre, double angle) {
  return [=](Vec2 a, Vec2 b) {
    const auto on = [&](Vec2 p) {
      return std::abs(cross(direction(angle), p - centre)) < 1e-9 && dot(direction(angle), p - centre) > -1e-9;
    };
    return on(a) && on(b);
  };
}

// Orthonormal frames from the angle of s per face; edges between frames that differ by quarter turns are cut, and so are those of
// `cut`.
inline Charts charts_of(const BandMesh& mesh, const std::function<double(int)>& angle, const CutEdge& cut) {
  Charts charts;
  for (int f = 0; f < mesh.face_count(); ++f) {
    charts.s.push_back(direction(angle(f)));
    charts.t.push_back(quarter_turn(direction(angle(f))));
  }
  charts.singular.assign(mesh.points.size(), 0);
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int twin = mesh.twins[at(h)];
    const double difference = twin < 0 ? 0 : angle(face_of(h)) - angle(face_of(twin));
    const int turns = static_cast<int>(std::lround(difference / (kPi / 2))) & 3;
    const auto& face = mesh.faces[at(face_of(h))];
    charts.turns.push_back(static_cast<std::uint8_t>(turns));
    charts.cut.push_back(twin >= 0 &&
                         (turns != 0 || cut(mesh.points[at(face[at(h % 3)])], mesh.points[at(face[at((h + 1) % 3)])])));
  }
  return charts;
}

// A stroke of this width whose centre line is where `distance` is 0.
inline Ink ink_of(
    double stroke_width, const std::function<double(Vec2)>& distance = [](Vec2) { return 1e9; }) {
  Ink ink;
  ink.stroke_width = stroke_width;
  ink.rise = Raster<float>(60, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      ink.rise(x, y) = 1 - static_cast<float>(std::min(1.0, std::abs(distance({x + 0.5, y + 0.5})) / (stroke_width / 2)));
  return ink;
}

inline std::vector<Label> unlabelled(const BandMesh& mesh) {
  return std::vector<Label>(mesh.faces.size(), Label::none);
}

inline std::vector<Label> labels_where(const BandMesh& mesh, Label label, const std::function<bool(Vec2)>& where) {
  std::vector<Label> labels = unlabelled(mesh);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (where(mesh.barycentre(f))) labels[at(f)] = label;
  return labels;
}

}  // namespace inkgrid::testing
