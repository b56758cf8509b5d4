#include "map/snap_regions.h"

#include <cmath>

#include "base/at.h"
#include "base/sample.h"
#include "base/union_find.h"

namespace inkgrid {

namespace {

// A weight below this cannot move a coordinate, but would leave an integer undetermined.
constexpr double kLeastWeight = 1e-9;

// Coordinates that map the frame to (1 / unit, 0) and (0, 1 / unit), for one face at a time.
double local_estimate(const Charts& charts, int f, int coordinate, Vec2 p, double unit) {
  const Vec2 s = charts.s[at(f)], t = charts.t[at(f)];
  return (coordinate == 0 ? cross(p, t) : cross(s, p)) / (cross(s, t) * unit);
}

void merge_within_face(const BandMesh& mesh, const Charts& charts, int f, int coordinate, double unit, double merge_difference,
                       UnionFind& regions) {
  const auto& face = mesh.faces[at(f)];
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Vec2 side = mesh.points[at(face[at(next)])] - mesh.points[at(face[at(k)])];
    if (std::abs(local_estimate(charts, f, coordinate, side, unit)) < merge_difference) regions.unite(3 * f + k, 3 * f + next);
  }
}

// Neighbours over an edge only: strokes side by side may touch in a vertex far from both centre lines.
void merge_neighbours(const BandMesh& mesh, const Charts& charts, const std::vector<Label>& labels, UnionFind& regions) {
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    const int twin = mesh.twins[at(h)];
    if (twin < h || charts.cut[at(h)]) continue;
    const Label label = labels[at(face_of(h))];
    if (label == Label::none || label != labels[at(face_of(twin))]) continue;
    regions.unite(h, next_halfedge(twin));
    regions.unite(next_halfedge(h), twin);
  }
}

// How strongly a vertex snaps, computed where it is asked for.
class SnappingWeights {
 public:
  SnappingWeights(const BandMesh& mesh, const Ink& ink, double sigma)
      : mesh_(mesh), ink_(ink), sigma_(sigma), known_(mesh.points.size(), kUnknown) {}

  double at_vertex(int v) {
    double& weight = known_[at(v)];
    if (weight != kUnknown) return weight;
    const double d = bilinear(ink_.rise.width, ink_.rise.height, mesh_.points[at(v)],
                              [&](int x, int y) { return ink_.centre_distance(x, y); });
    return weight = std::exp(-d * d / (2 * sigma_ * sigma_));
  }

 private:
  static constexpr double kUnknown = -1;

  const BandMesh& mesh_;
  const Ink& ink_;
  double sigma_;  // half-widths
  std::vector<double> known_;
};

}  // namespace

double grid_unit(const BandMesh& mesh, const Ink& ink, const GridMapOptions& options, int f) {
  return options.spacing * ink.stroke_width * double{mesh.scale[at(f)]};
}

SnapRegions merge_snapping(const BandMesh& mesh, const Charts& charts, const std::vector<Label>& labels, const Ink& ink,
                           const GridMapOptions& options) {
  const int corners = 3 * mesh.face_count();
  UnionFind merged(corners);
  merge_neighbours(mesh, charts, labels, merged);
  SnapRegions snap{std::vector<int>(at(corners), -1), std::vector<double>(at(corners), 0.0), {}};
  SnappingWeights weights(mesh, ink, options.snap_sigma);
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (labels[at(f)] == Label::none) continue;
    merge_within_face(mesh, charts, f, snapping_coordinate(labels[at(f)]), grid_unit(mesh, ink, options, f),
                      options.merge_difference, merged);
    for (int k = 0; k < 3; ++k) snap.weight[at(3 * f + k)] = weights.at_vertex(mesh.faces[at(f)][at(k)]);
  }
  std::vector<int> number(at(corners), -1);
  for (int c = 0; c < corners; ++c) {
    if (snap.weight[at(c)] < kLeastWeight) continue;
    int& region = number[at(merged.find(c))];
    if (region < 0) {
      region = static_cast<int>(snap.component.size());
      snap.component.push_back(mesh.component[at(face_of(c))]);
    }
    snap.region[at(c)] = region;
  }
  return snap;
}

}  // namespace inkgrid
