#include "map/known.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/at.h"

namespace inkgrid {
namespace {

// The corners of a face in ascending order of their lattice points, and these.
struct Triangle {
  std::array<LatticePoint, 3> points;
  std::array<int, 3> corners;

  friend bool operator<(const Triangle& a, const Triangle& b) { return a.points < b.points; }
};

// In units of the lattice that is `ratio` times as coarse; nothing where the face is none of it.
std::optional<Triangle> triangle_of(const BandMesh& mesh, int face, int ratio) {
  Triangle triangle;
  std::array<int, 3> order{0, 1, 2};
  const auto point = [&](int k) { return mesh.lattice[at(mesh.faces[at(face)][at(k)])]; };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return point(a) < point(b); });
  for (int k = 0; k < 3; ++k) {
    const LatticePoint p = point(order[at(k)]);
    if (p.i % ratio != 0 || p.j % ratio != 0) return std::nullopt;
    triangle.points[at(k)] = {p.i / ratio, p.j / ratio};
    triangle.corners[at(k)] = 3 * face + order[at(k)];
  }
  return triangle;
}

struct Bounds {
  LatticePoint low, high;

  bool contains(LatticePoint p) const { return low.i <= p.i && p.i <= high.i && low.j <= p.j && p.j <= high.j; }
};

Bounds bounds_of(const BandMesh& mesh, int ratio) {
  Bounds bounds{mesh.lattice.front(), mesh.lattice.front()};
  for (const LatticePoint p : mesh.lattice) {
    bounds.low = {std::min(bounds.low.i, p.i), std::min(bounds.low.j, p.j)};
    bounds.high = {std::max(bounds.high.i, p.i), std::max(bounds.high.j, p.j)};
  }
  const auto outwards = [&](int v, int towards) { return v / ratio + towards; };
  return {{outwards(bounds.low.i, -1), outwards(bounds.low.j, -1)}, {outwards(bounds.high.i, 1), outwards(bounds.high.j, 1)}};
}

// Ascending.
std::vector<Triangle> triangles_within(const BandMesh& mesh, const Bounds& bounds) {
  std::vector<Triangle> triangles;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (bounds.contains(mesh.lattice[at(mesh.faces[at(f)][0])])) triangles.push_back(*triangle_of(mesh, f, 1));
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

bool failed(const Solution& solution, int face) {
  const auto& failed = solution.map.failed_components;
  return std::binary_search(failed.begin(), failed.end(), solution.mesh.component[at(face)]);
}

void copy_face(const Solution& before, const Triangle& old, const Triangle& now, Known& known) {
  const int from = face_of(old.corners[0]), to = face_of(now.corners[0]);
  known.faces[at(to)] = 1;
  known.s[at(to)] = before.charts.s[at(from)];
  known.t[at(to)] = before.charts.t[at(from)];
  known.labels[at(to)] = before.labels[at(from)];
  for (std::size_t k = 0; k < 3; ++k) {
    known.corners[at(now.corners[k])] = old.corners[k];
    known.uv[at(now.corners[k])] = before.map.uv(old.corners[k]);
    known.uncut[at(now.corners[k])] = !before.charts.cut[at(old.corners[k])];
  }
}

}  // namespace

Known known_from(const Solution& before, const BandMesh& mesh, const std::function<bool(Vec2)>& holds) {
  const std::size_t faces = mesh.faces.size();
  Known known{std::vector<std::uint8_t>(faces, 0),
              std::vector<Vec2>(faces),
              std::vector<Vec2>(faces),
              std::vector<std::uint8_t>(3 * faces, 0),
              std::vector<Label>(faces, Label::none),
              std::vector<Vec2>(3 * faces),
              std::vector<int>(3 * faces, -1)};
  if (faces == 0) return known;
  const int ratio = static_cast<int>(std::lround(before.mesh.side / mesh.side));
  const std::vector<Triangle> old = triangles_within(before.mesh, bounds_of(mesh, ratio));
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto now = triangle_of(mesh, f, ratio);
    if (!now || !holds(mesh.barycentre(f))) continue;
    const auto found = std::lower_bound(old.begin(), old.end(), *now);
    if (found == old.end() || found->points != now->points || failed(before, face_of(found->corners[0]))) continue;
    copy_face(before, *found, *now, known);
  }
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int twin = mesh.twins[at(h)];
    if (twin < 0 || !known.faces[at(face_of(h))] || !known.faces[at(face_of(twin))]) known.uncut[at(h)] = 0;
  }
  return known;
}

}  // namespace inkgrid
