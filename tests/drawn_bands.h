// From a painted drawing to its ink and its band, with the options of the program.
#pragma once

#include <vector>

#include "drawings.h"
#include "ink/band_mesh.h"
#include "ink/threshold.h"

namespace inkgrid::testing {

inline Ink drawn_ink(const Image& image) {
  return measure_ink(binarise(image, 128.0));
}

// Strokes of one width on an image of size x size.
inline Ink drawn_ink(const std::vector<std::vector<Vec2>>& strokes, double width, int size) {
  Image image = blank(size, size);
  for (const auto& stroke : strokes) paint(image, stroke, width);
  return drawn_ink(image);
}

inline int edge_count(const BandMesh& mesh) {
  int edges = 0;
  for (int h = 0; h < 3 * mesh.face_count(); ++h) edges += mesh.twins[static_cast<std::size_t>(h)] < h;
  return edges;
}

inline int holes(const BandMesh& mesh) {
  return mesh.components - (mesh.vertex_count() - edge_count(mesh) + mesh.face_count());
}

}  // namespace inkgrid::testing
