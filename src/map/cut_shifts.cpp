#include "map/cut_shifts.h"

#include <algorithm>

#include "base/at.h"

namespace inkgrid {

namespace {

constexpr IVec2 conjugate(IVec2 a) {
  return {a.x, -a.y};
}

constexpr std::int64_t squared_norm(IVec2 a) {
  return a.x * a.x + a.y * a.y;
}

constexpr std::int64_t rounded_ratio(std::int64_t a, std::int64_t positive) {
  const std::int64_t doubled = 2 * a + positive, ratio = doubled / (2 * positive);
  return doubled % (2 * positive) < 0 ? ratio - 1 : ratio;
}

// The Gaussian integer nearest to a / b: the remainder is smaller than b.
constexpr IVec2 rounded_quotient(IVec2 a, IVec2 b) {
  const IVec2 numerator = product(a, conjugate(b));
  return {rounded_ratio(numerator.x, squared_norm(b)), rounded_ratio(numerator.y, squared_norm(b))};
}

// form += factor * shift
void add_term(ShiftForm& form, int shift, IVec2 factor) {
  auto place = std::lower_bound(form.begin(), form.end(), shift, [](const ShiftTerm& t, int s) { return t.shift < s; });
  if (place == form.end() || place->shift != shift) place = form.insert(place, {shift, {}});
  place->factor = place->factor + factor;
  if (place->factor == IVec2{}) form.erase(place);
}

IVec2 factor_of(const ShiftForm& form, int shift) {
  for (const ShiftTerm& term : form)
    if (term.shift == shift) return term.factor;
  return {};
}

void multiply(ShiftForm& form, IVec2 factor) {
  for (ShiftTerm& term : form) term.factor = product(factor, term.factor);
}

constexpr IVec2 unit_of(int turn) {
  return turned(IVec2{1, 0}, turn);
}

}  // namespace

IVec2 value_of(const ShiftForm& form, const std::vector<IVec2>& shifts) {
  IVec2 sum;
  for (const ShiftTerm& term : form) sum = sum + product(term.factor, shifts[at(term.shift)]);
  return sum;
}

ShiftLattice::ShiftLattice(int unknowns) : free_(at(unknowns), 1) {
  for (int i = 0; i < unknowns; ++i) forms_.push_back({{i, {1, 0}}});
}

ShiftForm ShiftLattice::resolve(const ShiftForm& sum) const {
  ShiftForm result;
  for (const ShiftTerm& term : sum)
    for (const ShiftTerm& inner : forms_[at(term.shift)]) add_term(result, inner.shift, product(term.factor, inner.factor));
  return result;
}

// Euclid's algorithm on the factors: replacing the free integer z of the smallest factor g by  z' = z + sum of q_k z_k  leaves
// the factors  g_k - q_k g, all smaller than g.  Once a single term is left, its integer must be zero.
void ShiftLattice::require_zero(const ShiftForm& sum) {
  ShiftForm rest = resolve(sum);
  while (!rest.empty()) {
    const ShiftTerm least = *std::min_element(rest.begin(), rest.end(), [](const ShiftTerm& a, const ShiftTerm& b) {
      return squared_norm(a.factor) < squared_norm(b.factor);
    });
    ShiftForm quotients;
    for (const ShiftTerm& term : rest)
      if (term.shift != least.shift) quotients.push_back({term.shift, rounded_quotient(term.factor, least.factor)});
    const bool last = quotients.empty();
    for (ShiftForm& form : forms_) {
      const IVec2 factor = factor_of(form, least.shift);
      if (factor == IVec2{}) continue;
      for (const ShiftTerm& q : quotients) add_term(form, q.shift, IVec2{} - product(q.factor, factor));
      if (last) add_term(form, least.shift, IVec2{} - factor);
    }
    for (const ShiftTerm& q : quotients) add_term(rest, q.shift, IVec2{} - product(q.factor, least.factor));
    if (!last) continue;
    free_[at(least.shift)] = 0;
    return;
  }
}

std::vector<int> ShiftLattice::free_shifts() const {
  std::vector<int> result;
  for (int i = 0; i < static_cast<int>(free_.size()); ++i)
    if (free_[at(i)]) result.push_back(i);
  return result;
}

namespace {

// The corners around a vertex: the next corner lies across the halfedge that ends here.
struct Fan {
  int first;
  bool closed;
};

Fan fan_from(const BandMesh& mesh, int corner) {
  int c = corner;
  while (mesh.twins[at(c)] >= 0) {
    c = next_halfedge(mesh.twins[at(c)]);
    if (c == corner) return {c, true};
  }
  return {c, false};
}

std::vector<int> first_corners(const BandMesh& mesh) {
  std::vector<int> first(mesh.points.size(), -1);
  for (int c = 3 * mesh.face_count() - 1; c >= 0; --c) first[at(mesh.vertex_of(c))] = c;
  return first;
}

// Calls cross(halfedge, next corner) for each step around the fan; the last step of a closed fan leads back to its first corner.
template <class Cross>
void walk(const BandMesh& mesh, const Fan& fan, const Cross& cross) {
  int c = fan.first;
  do {
    const int across = previous_halfedge(c);
    const int next = mesh.twins[at(across)];
    if (next < 0) return;
    cross(across, next);
    c = next;
  } while (c != fan.first);
}

// Halfedges on the cut by the vertex where they start.
struct CutGraph {
  std::vector<int> vertices;  // on the cut, ascending
  std::vector<Fan> fans;      // per such vertex
  std::vector<std::vector<int>> spokes;
  std::vector<int> index;  // per vertex of the mesh: its place in `vertices`, or -1
};

CutGraph cut_graph(const BandMesh& mesh, const Charts& charts) {
  CutGraph graph;
  graph.index.assign(mesh.points.size(), -1);
  std::vector<std::vector<int>> spokes(mesh.points.size());
  for (int h = 0; h < 3 * mesh.face_count(); ++h)
    if (charts.cut[at(h)] && mesh.twins[at(h)] >= 0) spokes[at(mesh.vertex_of(h))].push_back(h);
  const std::vector<int> first = first_corners(mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (spokes[at(v)].empty()) continue;
    graph.index[at(v)] = static_cast<int>(graph.vertices.size());
    graph.vertices.push_back(v);
    graph.fans.push_back(fan_from(mesh, first[at(v)]));
    graph.spokes.push_back(std::move(spokes[at(v)]));
  }
  return graph;
}

int turns_around(const BandMesh& mesh, const Charts& charts, const Fan& fan) {
  int turns = 0;
  walk(mesh, fan, [&](int across, int) { turns += charts.turns[at(across)]; });
  return turns & 3;
}

bool is_node(const BandMesh& mesh, const Charts& charts, const CutGraph& graph, int index) {
  const Fan& fan = graph.fans[at(index)];
  return !fan.closed || graph.spokes[at(index)].size() != 2 || turns_around(mesh, charts, fan) != 0;
}

// Per halfedge: the cut path it lies on, and whether it runs along or against it.
struct Paths {
  std::vector<int> of_halfedge;  // -1 off the cuts
  std::vector<char> along;
  std::vector<int> component;  // per path
};

void follow_path(const BandMesh& mesh, const CutGraph& graph, const std::vector<char>& node, int halfedge, Paths& paths) {
  const int path = static_cast<int>(paths.component.size());
  paths.component.push_back(mesh.component[at(face_of(halfedge))]);
  for (int h = halfedge; paths.of_halfedge[at(h)] < 0;) {
    const int back = mesh.twins[at(h)];
    paths.of_halfedge[at(h)] = paths.of_halfedge[at(back)] = path;
    paths.along[at(h)] = 1;
    const int end = graph.index[at(mesh.vertex_of(back))];
    if (node[at(end)]) return;
    const auto& spokes = graph.spokes[at(end)];
    h = spokes[0] == back ? spokes[1] : spokes[0];
  }
}

// Paths from each node; what is left over are closed cuts, which start at their smallest vertex.
Paths cut_paths(const BandMesh& mesh, const Charts& charts, const CutGraph& graph) {
  Paths paths{std::vector<int>(mesh.twins.size(), -1), std::vector<char>(mesh.twins.size(), 0), {}};
  std::vector<char> node(graph.vertices.size());
  for (int i = 0; i < static_cast<int>(node.size()); ++i) node[at(i)] = is_node(mesh, charts, graph, i);
  for (const bool from_nodes : {true, false})
    for (int i = 0; i < static_cast<int>(node.size()); ++i)
      for (int h : graph.spokes[at(i)])
        if (paths.of_halfedge[at(h)] < 0 && (node[at(i)] || !from_nodes)) follow_path(mesh, graph, node, h, paths);
  return paths;
}

// Across h, in the direction of its path:  uv' = i^turn uv + s;  against it:  uv' = i^turn (uv - s of the other side).
ShiftTerm translation(const Charts& charts, const Paths& paths, int h) {
  return {paths.of_halfedge[at(h)], paths.along[at(h)] ? IVec2{1, 0} : unit_of(charts.turns[at(h)] + 2)};
}

// Corner coordinates around one vertex while the walk goes on, in terms of its first corner.
struct Walker {
  int turn = 0;
  ShiftForm form;

  void cross(const Charts& charts, const Paths& paths, int halfedge) {
    if (paths.of_halfedge[at(halfedge)] < 0) return;
    const int turns = charts.turns[at(halfedge)];
    turn = (turn + turns) & 3;
    multiply(form, unit_of(turns));
    const ShiftTerm term = translation(charts, paths, halfedge);
    add_term(form, term.shift, term.factor);
  }
};

// Where the walk around a vertex ends: with turn 0 the form must vanish, otherwise it determines the vertex.
Walker around(const BandMesh& mesh, const Charts& charts, const Paths& paths, const Fan& fan) {
  Walker walker;
  walk(mesh, fan, [&](int across, int) { walker.cross(charts, paths, across); });
  return walker;
}

// 2 / (1 - i^turn) for turn = 1, 2, 3.
constexpr IVec2 twice_inverse(int turn) {
  return turn == 1 ? IVec2{1, 1} : turn == 2 ? IVec2{1, 0} : IVec2{1, -1};
}

// Resolves forms over paths to forms over the free shifts, numbered without gaps, and stores those that do not vanish.
class FormStore {
 public:
  FormStore(const ShiftLattice& lattice, const Paths& paths, CutShifts& cuts) : lattice_(lattice), cuts_(cuts) {
    number_.assign(paths.component.size(), -1);
    for (int z : lattice.free_shifts()) {
      number_[at(z)] = static_cast<int>(cuts.shift_component.size());
      cuts.shift_component.push_back(paths.component[at(z)]);
    }
  }

  int store(const ShiftForm& over_paths) {
    ShiftForm form = lattice_.resolve(over_paths);
    if (form.empty()) return -1;
    for (ShiftTerm& term : form) term.shift = number_[at(term.shift)];
    cuts_.forms.push_back(std::move(form));
    return static_cast<int>(cuts_.forms.size()) - 1;
  }

 private:
  const ShiftLattice& lattice_;
  CutShifts& cuts_;
  std::vector<int> number_;
};

void place_vertex(const BandMesh& mesh, const Charts& charts, const Paths& paths, int vertex, const Fan& fan, FormStore& store,
                  CutShifts& cuts) {
  Walker walker;
  walk(mesh, fan, [&](int across, int corner) {
    walker.cross(charts, paths, across);
    if (corner == fan.first) return;
    cuts.corner_turn[at(corner)] = static_cast<std::uint8_t>(walker.turn);
    cuts.corner_form[at(corner)] = store.store(walker.form);
  });
  if (!fan.closed || walker.turn == 0) return;
  multiply(walker.form, twice_inverse(walker.turn));
  cuts.fixed_point[at(vertex)] = 1;
  cuts.doubled_form[at(vertex)] = store.store(walker.form);
}

}  // namespace

CutShifts trace_cuts(const BandMesh& mesh, const Charts& charts) {
  const CutGraph graph = cut_graph(mesh, charts);
  const Paths paths = cut_paths(mesh, charts, graph);
  ShiftLattice lattice(static_cast<int>(paths.component.size()));
  for (const Fan& fan : graph.fans) {
    if (!fan.closed) continue;
    const Walker walker = around(mesh, charts, paths, fan);
    if (walker.turn == 0) lattice.require_zero(walker.form);
  }

  const std::size_t corners = mesh.twins.size(), vertices = mesh.points.size();
  CutShifts cuts{static_cast<int>(paths.component.size()),
                 {},
                 {},
                 std::vector<std::uint8_t>(corners, 0),
                 std::vector<int>(corners, -1),
                 std::vector<int>(corners, -1),
                 std::vector<std::uint8_t>(vertices, 0),
                 std::vector<int>(vertices, -1)};
  FormStore store(lattice, paths, cuts);
  for (std::size_t i = 0; i < graph.vertices.size(); ++i)
    place_vertex(mesh, charts, paths, graph.vertices[i], graph.fans[i], store, cuts);
  for (int h = 0; h < static_cast<int>(corners); ++h)
    if (paths.of_halfedge[at(h)] >= 0) cuts.halfedge_form[at(h)] = store.store({translation(charts, paths, h)});
  return cuts;
}

}  // namespace inkgrid
