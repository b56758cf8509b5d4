#include "labels.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "base/sample.h"
#include "base/transition.h"

namespace inkgrid {
namespace {

// Section 6.1: the ink thickened by round(stroke width / 4) px.
Raster<std::uint8_t> dilated(const Ink& ink) {
  const auto radius = static_cast<float>(std::lround(ink.stroke_width / 4));
  Raster<std::uint8_t> thick(ink.width(), ink.height());
  for (std::size_t i = 0; i < thick.data.size(); ++i) thick.data[i] = ink.gap.data[i] <= radius;
  return thick;
}

// A direction as an axis of the frame: 0 s, 1 t, 2 -s, 3 -t.
Vec2 direction(const Charts& charts, int face, int axis) {
  const auto f = static_cast<std::size_t>(face);
  const Vec2 d = (axis & 1) ? charts.t[f] : charts.s[f];
  return axis >= 2 ? -d : d;
}

// Where the ray from p inside face f leaves it: through halfedge 3 f + side, at p + length * d.
struct Exit {
  int side = -1;
  double length = 0;
};

Exit leave(const BandMesh& mesh, int face, Vec2 p, Vec2 d, int entered_side) {
  const auto& t = mesh.faces[static_cast<std::size_t>(face)];
  Exit exit;
  double best = 1e300;
  for (int k = 0; k < 3; ++k) {
    if (k == entered_side) continue;
    const Vec2 a = mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
    const Vec2 e = mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>((k + 1) % 3)])] - a;
    const double outward = cross(d, e);  // > 0 where d leaves through this side
    if (outward <= 0) continue;
    const double length = cross(a - p, e) / outward;
    if (length < best) {
      best = length;
      exit = {k, std::max(0.0, length)};
    }
  }
  return exit;
}

class StreamlineTracer {
 public:
  StreamlineTracer(const BandMesh& mesh, const Charts& charts, const Raster<std::uint8_t>& ink)
      : mesh_(mesh), charts_(charts), ink_(ink) {}

  // Length over ink of the streamline that starts at the barycentre of a face along an axis of its frame.
  double ink_length(int face, int axis, double reach) const {
    const Vec2 start = mesh_.barycentre(face);
    Vec2 p = start;
    double covered = 0;
    int entered = -1;
    // A streamline of this many triangles turns on the spot.
    for (int steps = 0; steps < 2000; ++steps) {
      const Vec2 d = direction(charts_, face, axis);
      const Exit exit = leave(mesh_, face, p, d, entered);
      if (exit.side < 0) break;
      covered += covered_length(p, d, exit.length);
      p += exit.length * d;
      if (norm2(p - start) > reach * reach) break;
      const int h = 3 * face + exit.side, twin = mesh_.twins[static_cast<std::size_t>(h)];
      if (twin < 0) break;
      axis = (axis + charts_.turns[static_cast<std::size_t>(h)]) & 3;
      face = face_of(twin);
      entered = twin % 3;
    }
    return covered;
  }

 private:
  double covered_length(Vec2 p, Vec2 d, double length) const {
    const int samples = std::max(1, static_cast<int>(std::ceil(length)));
    int hits = 0;
    for (int k = 0; k < samples; ++k) hits += nearest(ink_, p + ((k + 0.5) / samples * length) * d, std::uint8_t{0});
    return length * hits / samples;
  }

  const BandMesh& mesh_;
  const Charts& charts_;
  const Raster<std::uint8_t>& ink_;
};

}  // namespace

std::vector<Label> spread_labels(const BandMesh& mesh, const Charts& charts, std::vector<Label> labels) {
  std::deque<int> queue;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (labels[static_cast<std::size_t>(f)] != Label::none) queue.push_back(f);
  while (!queue.empty()) {
    const int f = queue.front();
    queue.pop_front();
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int twin = mesh.twins[static_cast<std::size_t>(h)];
      if (twin < 0) continue;
      const auto g = static_cast<std::size_t>(face_of(twin));
      if (labels[g] != Label::none || mesh.on_ink[g] || !mesh.in_stroke[g]) continue;
      const bool along_s =
          (labels[static_cast<std::size_t>(f)] == Label::along_s) == (charts.turns[static_cast<std::size_t>(h)] % 2 == 0);
      labels[g] = along_s ? Label::along_s : Label::along_t;
      queue.push_back(face_of(twin));
    }
  }
  return labels;
}

std::vector<Label> label_strokes(const BandMesh& mesh, const Charts& charts, const Ink& ink, const LabelOptions& options) {
  std::vector<Label> labels(mesh.faces.size(), Label::none);
  if (mesh.faces.empty()) return labels;
  const auto thick = dilated(ink);
  const StreamlineTracer tracer(mesh, charts, thick);
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!mesh.on_ink[static_cast<std::size_t>(f)]) continue;
    const double reach = options.length * ink.stroke_width * static_cast<double>(mesh.scale[static_cast<std::size_t>(f)]);
    const double s = tracer.ink_length(f, 0, reach) + tracer.ink_length(f, 2, reach);
    const double t = tracer.ink_length(f, 1, reach) + tracer.ink_length(f, 3, reach);
    if (std::min(s, t) > options.ratio * (s + t)) continue;
    labels[static_cast<std::size_t>(f)] = s > t ? Label::along_s : Label::along_t;
  }
  return labels;
}

}  // namespace inkgrid
