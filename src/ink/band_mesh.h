// What:   a triangle mesh of the narrow band around the ink, and of nothing else.
// Source: section 5, last two paragraphs.
// Differs: an equilateral lattice instead of a Delaunay mesh; graded by the mask (docs/METHOD.md, "Band mesh").
// Cost:   linear in the area of the band.
#pragma once

#include <array>
#include <vector>

#include "base/at.h"
#include "ink/ink.h"
#include "inkgrid/image.h"
#include "inkgrid/options.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

// A point of the finest lattice as multiples of its two directions, which are 60 degrees apart.
struct LatticePoint {
  int i;
  int j;
  friend bool operator==(LatticePoint a, LatticePoint b) { return a.i == b.i && a.j == b.j; }
  friend bool operator<(LatticePoint a, LatticePoint b) { return a.j != b.j ? a.j < b.j : a.i < b.i; }
};

// Halfedge h = 3 f + k runs from faces[f][k] to faces[f][(k + 1) % 3]; faces are positively oriented (cross product > 0, y down).
struct BandMesh {
  std::vector<Vec2> points;               // px
  std::vector<LatticePoint> lattice;      // per vertex; empty where the mesh is no lattice
  std::vector<std::array<int, 3>> faces;  // indices into points
  std::vector<int> twins;                 // per halfedge: the halfedge of the neighbour, or -1 on the boundary
  std::vector<int> component;             // per face: its connected component over edges, numbered by smallest face
  std::vector<float> scale;               // per face: the mask's factor there
  std::vector<std::uint8_t> on_ink;       // per face: the pixel at its barycentre, or the nearest one inside, is a stroke pixel
  std::vector<std::uint8_t> in_stroke;  // per face: on ink, or on paper between strokes nearer to each other than twice the reach
  int components = 0;
  double side = 0;  // px, of the finest lattice

  int face_count() const { return static_cast<int>(faces.size()); }
  int vertex_count() const { return static_cast<int>(points.size()); }
  // Corner 3 f + k of face f is where halfedge 3 f + k begins.
  int vertex_of(int corner) const { return faces[at(corner / 3)][at(corner % 3)]; }
  Vec2 barycentre(int f) const {
    const auto& t = faces[at(f)];
    return (points[at(t[0])] + points[at(t[1])] + points[at(t[2])]) / 3;
  }
};

constexpr int face_of(int halfedge) {
  return halfedge / 3;
}
constexpr int next_halfedge(int halfedge) {
  return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1;
}
constexpr int previous_halfedge(int halfedge) {
  return halfedge % 3 == 0 ? halfedge + 2 : halfedge - 1;
}

struct BandOptions {
  double reach = 0.3;                      // beta, strokes
  double mesh_size = Options{}.mesh_size;  // largest circumdiameter, strokes
  int threads = 0;                         // 0: as many as the machine has
};

// Triangles with their barycentre nearer than reach x stroke width x mask factor to a stroke pixel.  Every vertex's faces form
// one fan: a vertex where the band only touches itself is split.  `mask` may be null.
BandMesh build_band(const Ink& ink, const ScaleMask* mask, const BandOptions& options);

// Numbers the connected components by their smallest face.
void number_components(BandMesh& mesh);

// Vertices on a boundary edge.
std::vector<std::uint8_t> boundary_vertices(const BandMesh& mesh);

}  // namespace inkgrid
