#include "field/field_space.h"

#include "base/at.h"
#include "base/union_find.h"

namespace inkgrid {
namespace {

// The ends of the side of the coarse lattice in whose middle p lies; p itself twice where it is a coarse point.
std::array<LatticePoint, 2> coarse_points(LatticePoint p) {
  const int i = p.i & 1, j = p.j & 1;
  return {LatticePoint{p.i - i, p.j + (i && j ? 1 : -j)}, LatticePoint{p.i + i, p.j + (i && j ? -1 : j)}};
}

}  // namespace

FieldSpace vertex_space(const BandMesh& mesh) {
  FieldSpace space;
  space.size = mesh.vertex_count();
  for (int v = 0; v < space.size; ++v) space.nodes.push_back({v, v});
  return space;
}

FieldSpace coarse_space(const BandMesh& mesh) {
  if (mesh.lattice.empty()) return vertex_space(mesh);
  // Vertex v uses two coarse points, numbered 2 v and 2 v + 1.
  UnionFind same(2 * mesh.vertex_count());
  const auto unite_equal = [&](int v, int w) {
    const auto of_v = coarse_points(mesh.lattice[at(v)]), of_w = coarse_points(mesh.lattice[at(w)]);
    for (int a : {0, 1})
      for (int b : {0, 1})
        if (of_v[at(a)] == of_w[at(b)]) same.unite(2 * v + a, 2 * w + b);
  };
  for (int v = 0; v < mesh.vertex_count(); ++v) unite_equal(v, v);
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const auto& face = mesh.faces[at(face_of(h))];
    if (mesh.twins[at(h)] < h) unite_equal(face[at(h % 3)], face[at(next_halfedge(h) % 3)]);
  }
  FieldSpace space;
  std::vector<int> number(2 * mesh.points.size(), -1);
  const auto node = [&](int use) {
    int& n = number[at(same.find(use))];
    if (n < 0) n = space.size++;
    return n;
  };
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const int first = node(2 * v);
    space.nodes.push_back({first, node(2 * v + 1)});
  }
  return space;
}

}  // namespace inkgrid
