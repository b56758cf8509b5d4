#include "map/labels.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "base/at.h"
#include "base/parallel.h"
#include "base/sample.h"
#include "base/transition.h"
#include "map/known.h"

namespace inkgrid {
namespace {

// Section 6.1: the ink thickened by round(stroke width / 4) px; less where that would close paper as wide as a stroke of few
// pixels.
Raster<std::uint8_t> dilated(const Ink& ink) {
  const auto radius = static_cast<float>(std::min(std::round(ink.stroke_width / 4), 0.5 * (ink.stroke_width - 1)));
  Raster<std::uint8_t> thick(ink.width(), ink.height());
  for (std::size_t i = 0; i < thick.data.size(); ++i)
    if (ink.gap.data[i] <= radius) thick.data[i] = 1;
  return thick;
}

// A direction as an axis of the frame: 0 s, 1 t, 2 -s, 3 -t.
Vec2 direction(const Charts& charts, int face, int axis) {
  const auto f = static_cast<std::size_t>(face);
  const Vec2 d = (axis & 1) ? charts.t[f] : charts.s[f];
  return axis >= 2 ? -d : d;
}

class StreamlineTracer {
 public:
  StreamlineTracer(const BandMesh& mesh, const Charts& charts, const Raster<std::uint8_t>& ink)
      : mesh_(mesh), charts_(charts), ink_(ink) {
    corners_.reserve(mesh.faces.size());
    for (const auto& t : mesh.faces) corners_.push_back({mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])]});
  }

  // Length over ink of the streamlines that start at the barycentre of a face along an axis of its frame, both ways; or less,
  // where it exceeds `enough`.
  double ink_length(int face, int axis, double reach, double enough) const {
    const double one_way = ink_length_one_way(face, axis, reach, enough);
    return one_way > enough ? one_way : one_way + ink_length_one_way(face, axis + 2, reach, enough - one_way);
  }

 private:
  double ink_length_one_way(int face, int axis, double reach, double enough) const {
    const Vec2 start = mesh_.barycentre(face);
    Vec2 p = start;
    double covered = 0;
    int entered = -1;
    // A streamline of this many triangles turns on the spot.
    for (int steps = 0; steps < 2000; ++steps) {
      const Vec2 d = direction(charts_, face, axis);
      const Exit exit = leave(face, p, d, entered);
      if (exit.side < 0) break;
      covered += covered_length(p, d, exit.length);
      if (covered > enough) break;
      p += exit.length * d;
      if (norm2(p - start) > reach * reach) break;
      const int h = 3 * face + exit.side, twin = mesh_.twins[at(h)];
      if (twin < 0) break;
      axis = (axis + charts_.turns[at(h)]) & 3;
      face = face_of(twin);
      entered = twin - 3 * face;
    }
    return covered;
  }

  // Where the ray from p inside face f leaves it: through halfedge 3 f + side, at p + length * d.
  struct Exit {
    int side = -1;
    double length = 0;
  };

  Exit leave(int face, Vec2 p, Vec2 d, int entered_side) const {
    const auto& corner = corners_[at(face)];
    int side = -1;
    double ahead = 0, outward = 1;  // the length is their quotient
    for (int k = 0; k < 3; ++k) {
      if (k == entered_side) continue;
      const Vec2 a = corner[at(k)], e = corner[at(k == 2 ? 0 : k + 1)] - a;
      const double out = cross(d, e);  // > 0 where d leaves through this side
      if (out <= 0) continue;
      const double to_side = cross(a - p, e);
      if (side >= 0 && to_side * outward >= ahead * out) continue;
      side = k;
      ahead = to_side;
      outward = out;
    }
    return {side, std::max(0.0, ahead / outward)};
  }

  double covered_length(Vec2 p, Vec2 d, double length) const {
    if (length <= 1) return nearest(ink_, p + 0.5 * length * d, std::uint8_t{0}) ? length : 0;
    const int samples = static_cast<int>(std::ceil(length));
    int hits = 0;
    for (int k = 0; k < samples; ++k) hits += nearest(ink_, p + ((k + 0.5) / samples * length) * d, std::uint8_t{0});
    return length * hits / samples;
  }

  const BandMesh& mesh_;
  const Charts& charts_;
  const Raster<std::uint8_t>& ink_;
  std::vector<std::array<Vec2, 3>> corners_;  // per face
};

// Lengths over ink along s and along t.  The axis across the stroke is traced first, as its streamlines are short, and the one
// that is expected to run along it only until it has won.
std::array<double, 2> ink_lengths(const StreamlineTracer& tracer, int face, std::size_t along, double reach, double ratio) {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  std::array<double, 2> length;
  const double across = length[1 - along] = tracer.ink_length(face, 1 - static_cast<int>(along), reach, kAll);
  const double winning = ratio > 0 ? across * std::max(1.0, 1 / ratio - 1) : kAll;
  length[along] = tracer.ink_length(face, static_cast<int>(along), reach, (1 + 1e-9) * winning);
  return length;
}

}  // namespace

std::vector<Label> spread_labels(const BandMesh& mesh, const Charts& charts, std::vector<Label> labels) {
  std::deque<int> queue;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (labels[at(f)] != Label::none) queue.push_back(f);
  while (!queue.empty()) {
    const int f = queue.front();
    queue.pop_front();
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int twin = mesh.twins[at(h)];
      if (twin < 0) continue;
      const auto g = static_cast<std::size_t>(face_of(twin));
      if (labels[g] != Label::none || mesh.on_ink[g] || !mesh.in_stroke[g]) continue;
      const bool along_s = (labels[at(f)] == Label::along_s) == (charts.turns[at(h)] % 2 == 0);
      labels[g] = along_s ? Label::along_s : Label::along_t;
      queue.push_back(face_of(twin));
    }
  }
  return labels;
}

std::vector<Label> label_strokes(const BandMesh& mesh, const Charts& charts, const Ink& ink, const LabelOptions& options,
                                 const Known* known) {
  std::vector<Label> labels(mesh.faces.size(), Label::none);
  if (mesh.faces.empty()) return labels;
  const auto thick = dilated(ink);
  const StreamlineTracer tracer(mesh, charts, thick);
  for_ranges(options.threads, mesh.face_count(), 1024, [&](int first, int last) {
    std::size_t along = 0;
    for (int f = first; f < last; ++f) {
      if (known && known->faces[at(f)]) {
        labels[at(f)] = known->labels[at(f)];
        continue;
      }
      if (!mesh.on_ink[at(f)]) continue;
      const double reach = options.length * ink.stroke_width * static_cast<double>(mesh.scale[at(f)]);
      const auto length = ink_lengths(tracer, f, along, reach, options.ratio);
      if (std::min(length[0], length[1]) > options.ratio * (length[0] + length[1])) continue;
      along = length[0] > length[1] ? 0 : 1;
      labels[at(f)] = along == 0 ? Label::along_s : Label::along_t;
    }
  });
  return labels;
}

}  // namespace inkgrid
