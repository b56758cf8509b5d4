#include "map/charts.h"

#include "base/at.h"
#include "base/parallel.h"
#include "map/known.h"

namespace inkgrid {
namespace {

constexpr int kFacesOfTask = 1024;

// A combed frame: unit directions with cross(s, t) > 0.
struct Axes {
  Vec2 s;
  Vec2 t;
};

// (s, t) -> (t, -s): the frame's own quarter turn, also when it is not orthogonal.
Axes turned_axes(Axes a, int quarter_turns) {
  for (int k = 0; k < (quarter_turns & 3); ++k) a = {a.t, -a.s};
  return a;
}

Axes axes_of(const Frame& frame) {
  Vec2 s = unit(frame.a), t = unit(frame.b);
  if (s == Vec2{}) s = {1, 0};
  if (std::abs(cross(s, t)) < 1e-6) t = quarter_turn(s);
  return {s, cross(s, t) > 0 ? t : -t};
}

// Section 4: the number of quarter turns that bring `other` nearest to `axes`.  Half a turn changes the sign of the agreement.
int best_match(const Axes& axes, const Axes& other) {
  const double even = dot(axes.s, other.s) + dot(axes.t, other.t), odd = dot(axes.s, other.t) - dot(axes.t, other.s);
  int best = 0;
  double most = -3;
  int turns = 0;
  for (const double agreement : {even, odd, -even, -odd}) {
    if (agreement > most + 1e-12) {
      most = agreement;
      best = turns;
    }
    ++turns;
  }
  return best;
}

std::vector<Axes> face_axes(const BandMesh& mesh, const FrameField& field, int threads) {
  std::vector<Axes> axes(mesh.faces.size());
  for_ranges(threads, mesh.face_count(), kFacesOfTask, [&](int first, int last) {
    for (int f = first; f < last; ++f) {
      Complex c0 = 0, c2 = 0;
      for (const int v : mesh.faces[at(f)]) {
        c0 += field.c0[at(v)] / 3.0;
        c2 += field.c2[at(v)] / 3.0;
      }
      axes[at(f)] = axes_of(frame_of(c0, c2));
    }
  });
  return axes;
}

// Combs the frames along a breadth-first dual spanning tree of each component, or from all that is known in it; returns which
// halfedges the tree crosses, and those that are known to be uncut.
std::vector<std::uint8_t> comb(const BandMesh& mesh, const Known* known, std::vector<Axes>& axes) {
  std::vector<std::uint8_t> crossed(3 * mesh.faces.size(), 0), seen(mesh.faces.size(), 0);
  std::vector<int> queue;  // all that were seen, in their order
  queue.reserve(mesh.faces.size());
  if (known) {
    crossed = known->uncut;
    seen = known->faces;
    for (int f = 0; f < mesh.face_count(); ++f)
      if (seen[at(f)]) queue.push_back(f);
  }
  std::size_t next = 0;
  // Without a face at first: what is known.
  for (int seed = -1; seed < mesh.face_count(); ++seed) {
    if (seed >= 0 && !seen[at(seed)]) {
      seen[at(seed)] = 1;
      queue.push_back(seed);
    }
    while (next < queue.size()) {
      const int f = queue[next++];
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int twin = mesh.twins[at(h)];
        if (twin < 0 || seen[at(face_of(twin))]) continue;
        const auto g = static_cast<std::size_t>(face_of(twin));
        axes[g] = turned_axes(axes[g], best_match(axes[at(f)], axes[g]));
        crossed[at(h)] = crossed[at(twin)] = 1;
        seen[g] = 1;
        queue.push_back(face_of(twin));
      }
    }
  }
  return crossed;
}

// Quarter turns collected on a walk around each interior vertex.
std::vector<std::uint8_t> singular_vertices(const BandMesh& mesh, const std::vector<std::uint8_t>& turns,
                                            const std::vector<std::uint8_t>& boundary) {
  std::vector<std::uint8_t> sum(mesh.points.size(), 0);
  // Walking around a vertex crosses each of its halfedges once, outgoing ones from one side.
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    if (turns[at(h)] == 0) continue;
    auto& s = sum[at(mesh.vertex_of(h))];
    s = static_cast<std::uint8_t>((s + turns[at(h)]) & 3);
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (boundary[v]) sum[v] = 0;
  return sum;
}

// Removes open cuts that end neither at a singular vertex nor at the boundary.
void prune_open_cuts(const BandMesh& mesh, const std::vector<std::uint8_t>& boundary, Charts& charts) {
  std::vector<int> degree(mesh.points.size(), 0);
  std::vector<int> first(mesh.points.size() + 1, 0);
  const auto cut_at = [&](int h) { return charts.cut[at(h)] != 0; };
  for (int h = 0; h < 3 * mesh.face_count(); ++h)
    if (cut_at(h)) ++first[at(mesh.vertex_of(h)) + 1];
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    degree[v] = first[v + 1];
    first[v + 1] += first[v];
  }
  std::vector<int> outgoing(static_cast<std::size_t>(first.back())), fill(first.begin(), first.end() - 1);
  for (int h = 0; h < 3 * mesh.face_count(); ++h)
    if (cut_at(h)) outgoing[at(fill[at(mesh.vertex_of(h))]++)] = h;
  const auto is_loose = [&](std::size_t v) { return degree[v] == 1 && !boundary[v] && !charts.singular[v]; };
  for (int start = 0; start < mesh.vertex_count(); ++start) {
    auto v = static_cast<std::size_t>(start);
    while (is_loose(v)) {
      int h = -1;
      for (int k = first[v]; k < first[v + 1]; ++k)
        if (cut_at(outgoing[at(k)])) h = outgoing[at(k)];
      const int twin = mesh.twins[at(h)];
      charts.cut[at(h)] = charts.cut[at(twin)] = 0;
      --degree[v];
      v = static_cast<std::size_t>(mesh.vertex_of(twin));
      --degree[v];
    }
  }
}

}  // namespace

Charts comb_charts(const BandMesh& mesh, const FrameField& field, const Known* known, int threads) {
  std::vector<Axes> axes = face_axes(mesh, field, threads);
  if (known)
    for (std::size_t f = 0; f < axes.size(); ++f)
      if (known->faces[f]) axes[f] = {known->s[f], known->t[f]};
  const auto crossed = comb(mesh, known, axes);
  Charts charts;
  const std::size_t halfedges = 3 * mesh.faces.size();
  charts.turns.assign(halfedges, 0);
  charts.cut.assign(halfedges, 0);
  for (std::size_t h = 0; h < halfedges; ++h) {
    const int twin = mesh.twins[h];
    if (twin < 0 || crossed[h]) continue;
    charts.cut[h] = 1;
    // One side decides, so that the two halfedges are always inverse to each other.
    if (static_cast<int>(h) > twin) continue;
    const int turn = best_match(axes[h / 3], axes[at(face_of(twin))]);
    charts.turns[h] = static_cast<std::uint8_t>(turn);
    charts.turns[at(twin)] = static_cast<std::uint8_t>((4 - turn) & 3);
  }
  const std::vector<std::uint8_t> boundary = boundary_vertices(mesh);
  charts.singular = singular_vertices(mesh, charts.turns, boundary);
  for (const auto k : charts.singular) charts.singularities += k != 0;
  prune_open_cuts(mesh, boundary, charts);
  charts.s.reserve(axes.size());
  charts.t.reserve(axes.size());
  for (const auto& a : axes) {
    charts.s.push_back(a.s);
    charts.t.push_back(a.t);
  }
  return charts;
}

}  // namespace inkgrid
