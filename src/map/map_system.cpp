#include "map/map_system.h"

#include <algorithm>

#include "base/parallel.h"
#include "map/known.h"

namespace inkgrid {
namespace {

// The matrix of the multiplication by factor * i^turn.
Block rotation(double factor, int turn) {
  const Vec2 image = turned(Vec2{factor, 0}, turn);
  return {image.x, -image.y, image.y, image.x};
}

class ComponentProblem {
 public:
  ComponentProblem(const MapSetup& setup, const MapLayout& layout, int component, const EliminationPlan* plan)
      : setup_(setup), layout_(layout), reals_(2 * layout.nodes[at(component)]) {
    problem_.reals =
        plan ? PairMatrix(plan->matrix_starts, plan->matrix_rows) : PairMatrix(layout.nodes[at(component)], edges(component));
    problem_.real_b.resize(at(layout.nodes[at(component)]));
    problem_.coupling.resize(at(layout.integers[at(component)]));
    problem_.integral_b.assign(at(layout.integers[at(component)]), 0.0);
  }

  void add_faces(int component) {
    for (const int f : layout_.faces[at(component)]) is_plain(f) ? add_plain_face(f) : add_face(f);
  }

  const PairMatrix& reals() const { return problem_.reals; }

  MixedIntegerProblem take() { return std::move(problem_); }

 private:
  int vertex(int corner) const { return setup_.mesh.vertex_of(corner); }
  int node(int corner) const { return layout_.node[at(vertex(corner))]; }
  int turn(int corner) const { return setup_.cuts.corner_turn[at(corner)]; }

  std::vector<std::array<int, 2>> edges(int component) const {
    std::vector<std::array<int, 2>> result;
    result.reserve(2 * layout_.faces[at(component)].size());
    for (const int f : layout_.faces[at(component)])
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        if (setup_.mesh.twins[at(h)] > h) continue;
        const int i = node(h), j = node(next_halfedge(h));
        if (i >= 0 && j >= 0) result.push_back({i, j});
      }
    return result;
  }

  // Its corners are turned vertices, without translations.
  bool is_plain(int f) const {
    for (int c = 3 * f; c < 3 * f + 3; ++c)
      if (node(c) < 0 || setup_.cuts.corner_form[at(c)] >= 0) return false;
    return true;
  }

  // mu w_snap where this coordinate of the corner snaps, otherwise 0.
  double snapping_weight(int corner, int coordinate) const {
    if (setup_.snap.region[at(corner)] < 0 || coordinate != snapping_coordinate(setup_.labels[at(face_of(corner))])) return 0;
    return setup_.options.snap * setup_.snap.weight[at(corner)];
  }

  static double alignment(const FaceFrame& frame, int k, int l) {
    return frame.along_s[at(k)] * frame.along_s[at(l)] + frame.along_t[at(k)] * frame.along_t[at(l)];
  }

  void add_plain_face(int f) {
    const FaceFrame frame = face_frame(setup_, f);
    const std::array<int, 3> nodes{node(3 * f), node(3 * f + 1), node(3 * f + 2)};
    const std::array<int, 3> turns{turn(3 * f), turn(3 * f + 1), turn(3 * f + 2)};
    for (int k = 0; k < 3; ++k) {
      const int own_node = nodes[at(k)], own_turn = turns[at(k)];
      const double own = alignment(frame, k, k) + setup_.options.damping;
      problem_.reals.add(own_node, own_node, {own, 0, 0, own});
      for (int l = 0; l < k; ++l)
        problem_.reals.add(own_node, nodes[at(l)], rotation(alignment(frame, k, l), turns[at(l)] - own_turn));
      const Vec2 pull = turned(Vec2{frame.along_s[at(k)], frame.along_t[at(k)]}, -own_turn);
      problem_.real_b[at(own_node)].p += pull.x;
      problem_.real_b[at(own_node)].q += pull.y;
      add_plain_snapping(3 * f + k);
    }
  }

  void add_face(int f) {
    const FaceFrame frame = face_frame(setup_, f);
    for (int coordinate : {0, 1})
      for (int k = 0; k < 3; ++k) {
        const int corner = 3 * f + k;
        for (int l = 0; l < 3; ++l)
          add_product(corner, 3 * f + l, coordinate, alignment(frame, k, l) + (k == l ? setup_.options.damping : 0));
        for_each_term(corner, coordinate, [&](int place, double factor) {
          add_right(place, factor * (coordinate == 0 ? frame.along_s : frame.along_t)[at(k)]);
        });
        add_snapping(corner, coordinate, snapping_weight(corner, coordinate));
      }
  }

  // Calls visit(place, factor) for the terms of one coordinate (0: u, 1: v) of a corner.  Places are those of the reals, then
  // those of the integers.
  template <class Visit>
  void for_each_term(int corner, int coordinate, const Visit& visit) const {
    const auto complex_term = [&](int place, Vec2 factor) {
      const double first = coordinate == 0 ? factor.x : factor.y, second = coordinate == 0 ? -factor.y : factor.x;
      if (first != 0) visit(place, first);
      if (second != 0) visit(place + 1, second);
    };
    const auto form_terms = [&](int form, Vec2 factor) {
      if (form < 0) return;
      for (const ShiftTerm& term : setup_.cuts.forms[at(form)])
        complex_term(reals_ + layout_.shift[at(term.shift)], factor * real(term.factor));
    };
    const Vec2 unit_turn = turned(Vec2{1, 0}, turn(corner));
    if (node(corner) >= 0)
      complex_term(2 * node(corner), unit_turn);
    else if (!setup_.held.is_held[at(vertex(corner))])
      form_terms(setup_.cuts.doubled_form[at(vertex(corner))], 0.5 * unit_turn);
    form_terms(setup_.cuts.corner_form[at(corner)], {1, 0});
  }

  // What one coordinate of a corner has besides its terms.
  double constant(int corner, int coordinate) const {
    if (!setup_.held.is_held[at(vertex(corner))]) return 0;
    const Vec2 uv = turned(setup_.held.uv[at(vertex(corner))], turn(corner));
    return coordinate == 0 ? uv.x : uv.y;
  }

  // weight / 2 * (corner - integer)^2, of one coordinate.
  void add_snapping(int corner, int coordinate, double weight) {
    if (weight == 0) return;
    const int integer = reals_ + layout_.region[at(setup_.snap.region[at(corner)])];
    add_entry(integer, integer, weight);
    add_right(integer, weight * constant(corner, coordinate));
    add_product(corner, corner, coordinate, weight);
    for_each_term(corner, coordinate, [&](int place, double factor) {
      add_entry(integer, place, -weight * factor);
      add_entry(place, integer, -weight * factor);
    });
  }

  // The same where the corner is a turned vertex, without translations: one term.
  void add_plain_snapping(int corner) {
    if (setup_.snap.region[at(corner)] < 0) return;
    const int coordinate = snapping_coordinate(setup_.labels[at(face_of(corner))]);
    const double weight = snapping_weight(corner, coordinate);
    const Vec2 unit_turn = turned(Vec2{1, 0}, turn(corner));
    const double first = coordinate == 0 ? unit_turn.x : unit_turn.y;
    const bool second = first == 0;
    const double factor = second ? (coordinate == 0 ? -unit_turn.y : unit_turn.x) : first;
    const int integer = layout_.region[at(setup_.snap.region[at(corner)])];
    problem_.integral.push_back({integer, integer, weight});
    problem_.reals.add(node(corner), node(corner), {second ? 0 : weight, 0, 0, second ? weight : 0});
    problem_.coupling[at(integer)].push_back({2 * node(corner) + second, -weight * factor});
  }

  // factor / 2 * (corner a) * (corner b), of one coordinate.
  void add_product(int a, int b, int coordinate, double factor) {
    const double right = factor * constant(b, coordinate);
    for_each_term(a, coordinate, [&](int row, double fa) {
      if (right != 0) add_right(row, -fa * right);
      for_each_term(b, coordinate, [&](int column, double fb) { add_entry(row, column, factor * fa * fb); });
    });
  }

  void add_right(int place, double value) {
    if (place >= reals_)
      problem_.integral_b[at(place - reals_)] += value;
    else
      (place % 2 == 0 ? problem_.real_b[at(place / 2)].p : problem_.real_b[at(place / 2)].q) += value;
  }

  // Called for both (row, column) and (column, row); between different nodes and between integers the lower one counts.
  void add_entry(int row, int column, double value) {
    if (column >= reals_) {
      if (row >= column) problem_.integral.push_back({row - reals_, column - reals_, value});
      return;
    }
    if (row >= reals_) {
      problem_.coupling[at(row - reals_)].push_back({column, value});
      return;
    }
    if (row / 2 < column / 2) return;
    const bool second_row = row % 2 != 0, second_column = column % 2 != 0;
    problem_.reals.add(row / 2, column / 2,
                       {second_row || second_column ? 0 : value, !second_row && second_column ? value : 0,
                        second_row && !second_column ? value : 0, second_row && second_column ? value : 0});
  }

  const MapSetup& setup_;
  const MapLayout& layout_;
  int reals_;  // places before the integers
  MixedIntegerProblem problem_;
};

}  // namespace

// The coordinates of a vertex are those of a corner in its own chart.
HeldVertices held_vertices(const BandMesh& mesh, const CutShifts& cuts, const Known* known) {
  HeldVertices held{std::vector<std::uint8_t>(mesh.points.size(), 0), std::vector<Vec2>(mesh.points.size())};
  if (!known) return held;
  const auto vertex = [&](int corner) { return at(mesh.vertex_of(corner)); };
  for (int c = 0; c < 3 * mesh.face_count(); ++c) {
    if (!known->faces[at(face_of(c))] || cuts.corner_turn[at(c)] != 0 || cuts.corner_form[at(c)] >= 0) continue;
    held.is_held[vertex(c)] = !cuts.fixed_point[vertex(c)];
    held.uv[vertex(c)] = known->uv[at(c)];
  }
  for (int c = 0; c < 3 * mesh.face_count(); ++c)
    if (!known->faces[at(face_of(c))]) held.is_held[vertex(c)] = 0;
  return held;
}

MapLayout lay_out(const MapSetup& setup) {
  const BandMesh& mesh = setup.mesh;
  const std::size_t components = at(mesh.components);
  MapLayout layout;
  layout.node.assign(mesh.points.size(), -1);
  layout.nodes.assign(components, 0);
  layout.integers.assign(components, 0);
  layout.faces.resize(components);
  layout.vertices.resize(components);
  std::vector<int> component(mesh.points.size(), -1);
  for (int f = 0; f < mesh.face_count(); ++f) {
    layout.faces[at(mesh.component[at(f)])].push_back(f);
    for (int v : mesh.faces[at(f)]) component[at(v)] = mesh.component[at(f)];
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (component[at(v)] < 0) continue;
    layout.vertices[at(component[at(v)])].push_back(v);
    if (!setup.cuts.fixed_point[at(v)] && !setup.held.is_held[at(v)]) layout.node[at(v)] = layout.nodes[at(component[at(v)])]++;
  }
  const auto take_integers = [&](int owner, int count) {
    const int first = layout.integers[at(owner)];
    layout.integers[at(owner)] += count;
    return first;
  };
  for (int owner : setup.cuts.shift_component) layout.shift.push_back(take_integers(owner, 2));
  for (int owner : setup.snap.component) layout.region.push_back(take_integers(owner, 1));
  return layout;
}

FaceFrame face_frame(const MapSetup& setup, int f) {
  const auto& face = setup.mesh.faces[at(f)];
  const std::array<Vec2, 3> p = {setup.mesh.points[at(face[0])], setup.mesh.points[at(face[1])], setup.mesh.points[at(face[2])]};
  const double scale = grid_unit(setup.mesh, setup.ink, setup.options, f) / cross(p[1] - p[0], p[2] - p[0]);
  FaceFrame frame;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 gradient = scale * quarter_turn(p[(k + 2) % 3] - p[(k + 1) % 3]);
    frame.along_s[k] = dot(gradient, setup.charts.s[at(f)]);
    frame.along_t[k] = dot(gradient, setup.charts.t[at(f)]);
  }
  return frame;
}

MixedIntegerProblem map_problem(const MapSetup& setup, const MapLayout& layout, int component, EliminationPlan* plan,
                                int threads) {
  const bool planned = plan && !plan->starts.empty(), unplanned = plan && !planned;
  ComponentProblem problem(setup, layout, component, planned ? plan : nullptr);
  at_once(
      unplanned ? threads : 1, [&] { problem.add_faces(component); },
      [&] {
        if (unplanned) *plan = plan_elimination(problem.reals());
      });
  return problem.take();
}

}  // namespace inkgrid
