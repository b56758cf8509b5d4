#include "scribbles/assembled.h"

#include <algorithm>
#include <utility>

#include "base/at.h"
#include "graph/folds.h"

namespace inkgrid {
namespace {

// Strokes: faces on the margin reach over it, in a bundle by some strokes, and the rim of a window is at ten or more.
constexpr double kBeyondMargin = 5;

// Something of a source: 0 is the drawing without its mask, the others are the windows of its parts.
struct Place {
  int source = 0;
  int index = -1;
};

// Which vertices of a window have the coordinates of the drawing around it, to the last digit.
std::vector<std::uint8_t> held_vertices(const Window& window) {
  const BandMesh& mesh = window.stages.mesh;
  std::vector<std::uint8_t> held(mesh.points.size(), 1);
  for (int f = 0; f < mesh.face_count(); ++f)
    for (const int v : mesh.faces[at(f)])
      if (!window.known.faces[at(f)] || window.stages.charts.singular[at(v)]) held[at(v)] = 0;
  return held;
}

// Which faces come from where, and how they are numbered in the whole.
class Assembly {
 private:
  const Stages& stages_;
  std::vector<std::vector<int>> numbers_;                // per source and face: in the whole, -1 where it is left out
  std::vector<int> replaced_by_;                         // per face without the mask: the source that replaces it
  std::vector<std::vector<std::uint8_t>> held_;          // per part and vertex of its window
  std::vector<std::vector<std::pair<int, int>>> seams_;  // per part: corners of kept faces, and those of its window there
  std::vector<Place> faces_, vertices_, sides_;          // of the whole; a side: the halfedge that knows the way across
  std::vector<std::array<int, 3>> corners_;              // per face of the whole
  std::vector<int> twins_;

  const Window& window(int s) const { return stages_.parts[at(s - 1)]->window; }
  const Stages& source(const Place& place) const { return place.source == 0 ? stages_ : window(place.source).stages; }

  // The values that `values` finds in the source of each place.
  template <class Values>
  auto of(const std::vector<Place>& places, Values values) const {
    std::remove_cvref_t<decltype(values(stages_))> result;
    result.reserve(places.size());
    for (const Place& p : places) result.push_back(values(source(p))[at(p.index)]);
    return result;
  }
  template <class Values>
  auto of_faces(Values values) const {
    return of(faces_, values);
  }
  template <class Values>
  auto of_vertices(Values values) const {
    return of(vertices_, values);
  }
  template <class Values>
  auto of_sides(Values values) const {
    return of(sides_, values);
  }

 public:
  explicit Assembly(const Stages& stages) : stages_(stages) {
    numbers_.emplace_back(stages.mesh.faces.size(), 0);
    for (const auto& part : stages.parts) place(*part);
    for (int s = 0; s < static_cast<int>(numbers_.size()); ++s)
      for (int f = 0; f < static_cast<int>(numbers_[at(s)].size()); ++f) {
        int& number = numbers_[at(s)][at(f)];
        if (number < 0) continue;
        number = static_cast<int>(faces_.size());
        faces_.push_back({s, f});
      }
    number_vertices();
    link();
  }

  BandMesh mesh() const {
    BandMesh mesh;
    for (const Place& v : vertices_) mesh.points.push_back(source(v).mesh.points[at(v.index)]);
    mesh.faces = corners_;
    mesh.twins = twins_;
    number_components(mesh);
    mesh.scale = of_faces([](const Stages& s) -> auto& { return s.mesh.scale; });
    mesh.on_ink = of_faces([](const Stages& s) -> auto& { return s.mesh.on_ink; });
    mesh.in_stroke = of_faces([](const Stages& s) -> auto& { return s.mesh.in_stroke; });
    return mesh;
  }

  void fill(Stages& whole) const {
    whole.mesh = mesh();
    whole.field.c0 = of_vertices([](const Stages& s) -> auto& { return s.field.c0; });
    whole.field.c2 = of_vertices([](const Stages& s) -> auto& { return s.field.c2; });
    whole.charts.s = of_faces([](const Stages& s) -> auto& { return s.charts.s; });
    whole.charts.t = of_faces([](const Stages& s) -> auto& { return s.charts.t; });
    whole.charts.turns = of_sides([](const Stages& s) -> auto& { return s.charts.turns; });
    whole.charts.cut = of_sides([](const Stages& s) -> auto& { return s.charts.cut; });
    whole.charts.singular = of_vertices([](const Stages& s) -> auto& { return s.charts.singular; });
    whole.labels = of_faces([](const Stages& s) -> auto& { return s.labels; });
    whole.exact.transitions = of_sides([](const Stages& s) -> auto& { return s.exact.transitions; });
    whole.exact.uv.clear();
    for (const Place& f : faces_)
      for (int k = 0; k < 3; ++k) whole.exact.uv.push_back(source(f).exact.uv[at(3 * f.index + k)]);
    whole.map.failed_components = failed_components(whole.mesh);
    whole.graph = remove_folds(trace_isolines(whole.mesh, whole.exact, whole.map.failed_components), whole.mesh, whole.exact);
  }

 private:
  // Leaves out the faces that the part replaces, and those of its window that replace none.
  void place(const SolvedPart& part) {
    const Window& window = part.window;
    const BandMesh& mesh = window.stages.mesh;
    const double reach = part.margin + kBeyondMargin * stages_.ink.stroke_width;
    const auto near = [&](Vec2 p) { return static_cast<double>(distance_at(part.touched, p)) <= reach; };
    held_.push_back(held_vertices(window));
    std::vector<int> numbers(mesh.faces.size(), -1);
    std::vector<std::uint8_t> stays(stages_.mesh.faces.size(), 0);
    seams_.emplace_back();
    for (int f = 0; f < mesh.face_count(); ++f) {
      const auto& face = mesh.faces[at(f)];
      const bool same = held_.back()[at(face[0])] && held_.back()[at(face[1])] && held_.back()[at(face[2])];
      if (!same && near(mesh.barycentre(f))) numbers[at(f)] = 0;
      if (!same) continue;
      stays[at(face_of(window.known.corners[at(3 * f)]))] = 1;
      for (int c = 3 * f; c < 3 * f + 3; ++c) seams_.back().emplace_back(window.known.corners[at(c)], c);
    }
    std::sort(seams_.back().begin(), seams_.back().end());
    for (int f = 0; f < stages_.mesh.face_count(); ++f)
      if (!stays[at(f)] && near(stages_.mesh.barycentre(f))) {
        numbers_[0][at(f)] = -1;
        replaced_by_.resize(stages_.mesh.faces.size(), 0);
        replaced_by_[at(f)] = static_cast<int>(numbers_.size());
      }
    numbers_.push_back(std::move(numbers));
  }

  int vertex_of(const Place& corner) const { return source(corner).mesh.vertex_of(corner.index); }

  void number_vertices() {
    std::vector<std::vector<int>> number;
    number.reserve(numbers_.size());
    for (int s = 0; s < static_cast<int>(numbers_.size()); ++s) number.emplace_back(source({s, 0}).mesh.points.size(), -1);
    const auto take = [&](int s, int v) -> int {
      int& n = number[at(s)][at(v)];
      if (n < 0) {
        n = static_cast<int>(vertices_.size());
        vertices_.push_back({s, v});
      }
      return n;
    };
    for (const Place& f : faces_)
      if (f.source == 0)
        for (const int v : stages_.mesh.faces[at(f.index)]) take(0, v);
    for (int s = 1; s < static_cast<int>(numbers_.size()); ++s) {
      const Known& known = window(s).known;
      for (int c = 0; c < static_cast<int>(known.corners.size()); ++c) {
        const int v = vertex_of({s, c});
        if (known.corners[at(c)] >= 0 && held_[at(s - 1)][at(v)])
          number[at(s)][at(v)] = number[0][at(vertex_of({0, known.corners[at(c)]}))];
      }
    }
    for (const Place& f : faces_) {
      std::array<int, 3> corners;
      for (int k = 0; k < 3; ++k) corners[at(k)] = take(f.source, vertex_of({f.source, 3 * f.index + k}));
      corners_.push_back(corners);
    }
  }

  // The halfedge in the whole, or -1.
  int number_of(int s, int halfedge) const {
    const int face = numbers_[at(s)][at(face_of(halfedge))];
    return face < 0 ? -1 : 3 * face + halfedge % 3;
  }

  // The halfedge of the window that replaces the other side of this one.
  Place beside(int halfedge) const {
    const int twin = stages_.mesh.twins[at(halfedge)];
    if (twin < 0 || numbers_[0][at(face_of(twin))] >= 0) return {0, halfedge};
    const int s = replaced_by_[at(face_of(twin))];
    const auto& seam = seams_[at(s - 1)];
    const auto found = std::lower_bound(seam.begin(), seam.end(), std::pair(halfedge, -1));
    return found != seam.end() && found->first == halfedge ? Place{s, found->second} : Place{0, halfedge};
  }

  int twin_of(const Place& side) const {
    const int twin = source(side).mesh.twins[at(side.index)];
    if (twin < 0) return -1;
    const int here = number_of(side.source, twin);
    if (here >= 0 || side.source == 0) return here;
    const int around = window(side.source).known.corners[at(twin)];
    return around < 0 ? -1 : number_of(0, around);
  }

  void link() {
    for (const Place& f : faces_)
      for (int h = 3 * f.index; h < 3 * f.index + 3; ++h) {
        sides_.push_back(f.source == 0 ? beside(h) : Place{f.source, h});
        twins_.push_back(twin_of(sides_.back()));
      }
  }

  std::vector<int> failed_components(const BandMesh& whole) const {
    std::vector<int> failed;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Stages& from = source(faces_[f]);
      const auto& failed_there = from.map.failed_components;
      if (std::binary_search(failed_there.begin(), failed_there.end(), from.mesh.component[at(faces_[f].index)]))
        failed.push_back(whole.component[f]);
    }
    std::sort(failed.begin(), failed.end());
    failed.erase(std::unique(failed.begin(), failed.end()), failed.end());
    return failed;
  }
};

}  // namespace

BandMesh assembled_mesh(const Stages& stages) {
  return Assembly(stages).mesh();
}

Stages assembled(const Stages& stages) {
  Stages whole = stages;
  if (!stages.parts.empty()) Assembly(stages).fill(whole);
  return whole;
}

}  // namespace inkgrid
