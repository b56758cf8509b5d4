#include "graph/edge_support.h"

#include "base/polyline.h"

namespace inkgrid {

namespace {

bool agrees(Label label, int family) {
  return label == Label::none || (label == Label::along_t) == (family == 0);
}

}  // namespace

std::vector<Interval> supported_intervals(const GraphEdge& edge, const BandMesh& mesh, const std::vector<Label>& labels,
                                          double bridged) {
  const auto lengths = lengths_along(edge.path);
  std::vector<Interval> parts;
  for (std::size_t i = 0; i < edge.faces.size(); ++i) {
    const auto f = static_cast<std::size_t>(edge.faces[i]);
    if (!mesh.in_stroke[f] || !agrees(labels[f], edge.family[i])) continue;
    if (!parts.empty() && lengths[i] - parts.back().to <= bridged)
      parts.back().to = lengths[i + 1];
    else
      parts.push_back({lengths[i], lengths[i + 1]});
  }
  return parts;
}

std::vector<Vec2> cut_out(const std::vector<Vec2>& path, const std::vector<double>& lengths, Interval part) {
  std::vector<Vec2> points{point_at(path, lengths, part.from)};
  for (std::size_t i = 0; i < path.size(); ++i)
    if (lengths[i] > part.from && lengths[i] < part.to) points.push_back(path[i]);
  points.push_back(point_at(path, lengths, part.to));
  return points;
}

}  // namespace inkgrid
