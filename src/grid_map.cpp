#include "grid_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "cut_shifts.h"
#include "numerics/mixed_integer.h"
#include "snap_regions.h"

namespace inkgrid {

namespace {

constexpr std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Vec2 real(IVec2 a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y)};
}

// What stands before the solver.
struct Setup {
  const BandMesh& mesh;
  const Charts& charts;
  const std::vector<Label>& labels;
  const Ink& ink;
  const GridMapOptions& options;
  const CutShifts& cuts;
  const SnapRegions& snap;
};

// Where each unknown stands in the system of its component: first (u, v) of the vertices, then the integers.
struct Layout {
  std::vector<int> vertex;                 // place of u, that of v follows; -1 at fixed points
  std::vector<int> shift;                  // per free shift: place of its first coordinate, the second follows
  std::vector<int> region;                 // per snapping region
  std::vector<int> reals;                  // per component
  std::vector<int> size;                   // per component
  std::vector<std::vector<int>> faces;     // per component
  std::vector<std::vector<int>> vertices;  // per component
};

Layout lay_out(const Setup& setup) {
  const BandMesh& mesh = setup.mesh;
  Layout layout;
  layout.vertex.assign(mesh.points.size(), -1);
  layout.size.assign(at(mesh.components), 0);
  layout.faces.resize(at(mesh.components));
  layout.vertices.resize(at(mesh.components));
  std::vector<int> component(mesh.points.size(), -1);
  for (int f = 0; f < mesh.face_count(); ++f) {
    layout.faces[at(mesh.component[at(f)])].push_back(f);
    for (int v : mesh.faces[at(f)]) component[at(v)] = mesh.component[at(f)];
  }
  const auto take = [&](int owner, int count) {
    const int place = layout.size[at(owner)];
    layout.size[at(owner)] += count;
    return place;
  };
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (component[at(v)] < 0) continue;
    layout.vertices[at(component[at(v)])].push_back(v);
    if (!setup.cuts.fixed_point[at(v)]) layout.vertex[at(v)] = take(component[at(v)], 2);
  }
  layout.reals = layout.size;
  for (int owner : setup.cuts.shift_component) layout.shift.push_back(take(owner, 2));
  for (int owner : setup.snap.component) layout.region.push_back(take(owner, 1));
  return layout;
}

// Calls visit(place, factor) for the terms of one coordinate (0: u, 1: v) of a corner.
template <class Visit>
void for_each_term(const Setup& setup, const Layout& layout, int corner, int coordinate, const Visit& visit) {
  const auto complex_term = [&](int place, Vec2 factor) {
    const double first = coordinate == 0 ? factor.x : factor.y, second = coordinate == 0 ? -factor.y : factor.x;
    if (first != 0) visit(place, first);
    if (second != 0) visit(place + 1, second);
  };
  const auto form_terms = [&](int form, Vec2 factor) {
    if (form < 0) return;
    for (const ShiftTerm& term : setup.cuts.forms[at(form)])
      complex_term(layout.shift[at(term.shift)], factor * real(term.factor));
  };
  const int vertex = setup.mesh.faces[at(face_of(corner))][at(corner % 3)];
  const Vec2 turn = turned(Vec2{1, 0}, setup.cuts.corner_turn[at(corner)]);
  if (layout.vertex[at(vertex)] >= 0)
    complex_term(layout.vertex[at(vertex)], turn);
  else
    form_terms(setup.cuts.doubled_form[at(vertex)], 0.5 * turn);
  form_terms(setup.cuts.corner_form[at(corner)], {1, 0});
}

// J (s phi) = sum over corners of uv (along_s, along_t)', with the derivatives of the corners' hat functions along the scaled
// frame.
struct FaceFrame {
  std::array<double, 3> along_s;
  std::array<double, 3> along_t;
};

FaceFrame face_frame(const Setup& setup, int f) {
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

class System {
 public:
  System(const Setup& setup, const Layout& layout, int component) : setup_(setup), layout_(layout) {
    problem_.size = layout.size[at(component)];
    problem_.b.assign(at(problem_.size), 0.0);
    for (int i = layout.reals[at(component)]; i < problem_.size; ++i) problem_.integers.push_back(i);
    problem_.lower.reserve(layout.faces[at(component)].size() * 14);
    for (int f : layout.faces[at(component)]) add_face(f);
  }

  const MixedIntegerProblem& problem() const { return problem_; }

 private:
  // factor / 2 * (corner a) * (corner b), of one coordinate.
  void add_product(int a, int b, int coordinate, double factor) {
    for_each_term(setup_, layout_, a, coordinate, [&](int row, double fa) {
      for_each_term(setup_, layout_, b, coordinate, [&](int column, double fb) {
        if (row >= column) problem_.lower.push_back({row, column, factor * fa * fb});
      });
    });
  }

  // weight / 2 * (corner - integer)^2
  void add_snapping(int corner, int coordinate, double weight) {
    const int integer = layout_.region[at(setup_.snap.region[at(corner)])];
    problem_.lower.push_back({integer, integer, weight});
    for_each_term(setup_, layout_, corner, coordinate, [&](int place, double factor) {
      problem_.lower.push_back({std::max(integer, place), std::min(integer, place), -weight * factor});
    });
  }

  // Half of this face's part of equation (4).
  void add_face(int f) {
    const FaceFrame frame = face_frame(setup_, f);
    for (int coordinate : {0, 1}) {
      const auto& target = coordinate == 0 ? frame.along_s : frame.along_t;
      for (int k = 0; k < 3; ++k) {
        const int corner = 3 * f + k;
        double own = setup_.options.damping;
        if (setup_.snap.region[at(corner)] >= 0 && coordinate == snapping_coordinate(setup_.labels[at(f)])) {
          const double weight = setup_.options.snap * setup_.snap.weight[at(corner)];
          own += weight;
          add_snapping(corner, coordinate, weight);
        }
        for (int l = 0; l < 3; ++l) {
          const double alignment = frame.along_s[at(k)] * frame.along_s[at(l)] + frame.along_t[at(k)] * frame.along_t[at(l)];
          add_product(corner, 3 * f + l, coordinate, alignment + (k == l ? own : 0));
        }
        for_each_term(setup_, layout_, corner, coordinate,
                      [&](int place, double factor) { problem_.b[at(place)] += factor * target[at(k)]; });
      }
    }
  }

  const Setup& setup_;
  const Layout& layout_;
  MixedIntegerProblem problem_;
};

struct Unknowns {
  std::vector<Vec2> vertex;          // (u, v)
  std::vector<IVec2> shift;          // per free shift
  std::vector<std::int64_t> region;  // per snapping region
};

// Writes only what belongs to the component, so components may be solved at the same time.
void solve_component(const Setup& setup, const Layout& layout, int component, Unknowns& unknowns) {
  const std::vector<double> x = solve_mixed_integer(System(setup, layout, component).problem()).x;
  const auto integer = [&](int place) { return static_cast<std::int64_t>(x[at(place)]); };
  for (std::size_t i = 0; i < layout.shift.size(); ++i)
    if (setup.cuts.shift_component[i] == component) unknowns.shift[i] = {integer(layout.shift[i]), integer(layout.shift[i] + 1)};
  for (std::size_t i = 0; i < layout.region.size(); ++i)
    if (setup.snap.component[i] == component) unknowns.region[i] = integer(layout.region[i]);
  for (int v : layout.vertices[at(component)]) {
    const int place = layout.vertex[at(v)], form = setup.cuts.doubled_form[at(v)];
    if (place >= 0)
      unknowns.vertex[at(v)] = {x[at(place)], x[at(place + 1)]};
    else if (form >= 0)
      unknowns.vertex[at(v)] = 0.5 * real(value_of(setup.cuts.forms[at(form)], unknowns.shift));
  }
}

// Solves the components, the largest first, on all processors; the calling thread takes part and reports.
class ComponentSolver {
 public:
  ComponentSolver(const Setup& setup, const Layout& layout, const Control& control, Unknowns& unknowns)
      : setup_(setup),
        layout_(layout),
        control_(control),
        unknowns_(unknowns),
        order_(layout.size.size()),
        failed_(layout.size.size(), 0) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return layout.size[at(a)] > layout.size[at(b)]; });
  }

  // Components whose solve failed.
  std::vector<int> run() {
    {
      std::vector<std::jthread> helpers;
      const int asked = setup_.options.threads;
      const std::size_t processors =
          asked > 0 ? static_cast<std::size_t>(asked) : std::max(1U, std::thread::hardware_concurrency());
      while (helpers.size() + 1 < std::min(processors, order_.size())) helpers.emplace_back([this] { work(nullptr); });
      work(control_.progress);
    }
    if (error_) std::rethrow_exception(error_);
    if (control_.stop.stop_requested()) throw Error(ErrorCode::cancelled, "The run was cancelled while the grid map was solved.");
    if (control_.progress) control_.progress("grid map", 1);
    std::vector<int> result;
    for (int c = 0; c < static_cast<int>(failed_.size()); ++c)
      if (failed_[at(c)]) result.push_back(c);
    return result;
  }

 private:
  void work(const std::function<void(const char*, double)>& progress) {
    for (std::size_t i; (i = next_++) < order_.size() && !control_.stop.stop_requested();) {
      try {
        attempt(order_[i]);
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
      const std::size_t done = ++done_;
      if (progress) progress("grid map", static_cast<double>(done) / static_cast<double>(order_.size()));
    }
  }

  void attempt(int component) {
    try {
      solve_component(setup_, layout_, component, unknowns_);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::numerics) throw;
      failed_[at(component)] = 1;
    }
  }

  const Setup& setup_;
  const Layout& layout_;
  const Control& control_;
  Unknowns& unknowns_;
  std::vector<int> order_;
  std::vector<char> failed_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
};

GridMap assemble_map(const Setup& setup, const Unknowns& unknowns) {
  const CutShifts& cuts = setup.cuts;
  const auto translation = [&](int form) { return form < 0 ? IVec2{} : value_of(cuts.forms[at(form)], unknowns.shift); };
  GridMap map;
  map.base = unknowns.vertex;
  map.corner_turn = cuts.corner_turn;
  map.half_integer = cuts.fixed_point;
  for (int c = 0; c < 3 * setup.mesh.face_count(); ++c) {
    map.corner_base.push_back(setup.mesh.faces[at(face_of(c))][at(c % 3)]);
    map.corner_shift.push_back(translation(cuts.corner_form[at(c)]));
    map.transitions.push_back(
        {setup.mesh.twins[at(c)] < 0 ? 0 : setup.charts.turns[at(c)], translation(cuts.halfedge_form[at(c)])});
  }
  map.cut_integers = 2 * static_cast<int>(cuts.shift_component.size());
  map.snapping_integers = static_cast<int>(setup.snap.component.size());
  map.cuts = cuts.paths;
  return map;
}

// Equation (2) in one face.
double alignment_energy(const Setup& setup, const GridMap& map, int f) {
  const FaceFrame frame = face_frame(setup, f);
  Vec2 along_s{-1, 0}, along_t{0, -1};
  for (int k = 0; k < 3; ++k) {
    along_s += frame.along_s[at(k)] * map.uv(3 * f + k);
    along_t += frame.along_t[at(k)] * map.uv(3 * f + k);
  }
  return norm2(along_s) + norm2(along_t);
}

// Equation (3) at one corner.
double snapping_energy(const Setup& setup, const GridMap& map, const Unknowns& unknowns, int corner) {
  const int region = setup.snap.region[at(corner)];
  if (region < 0) return 0;
  const Vec2 uv = map.uv(corner);
  const double value = snapping_coordinate(setup.labels[at(face_of(corner))]) == 0 ? uv.x : uv.y;
  const double difference = value - static_cast<double>(unknowns.region[at(region)]);
  return setup.snap.weight[at(corner)] * difference * difference;
}

void measure_energies(const Setup& setup, const Unknowns& unknowns, GridMap& map) {
  const auto& failed = map.failed_components;
  for (int f = 0; f < setup.mesh.face_count(); ++f) {
    if (std::binary_search(failed.begin(), failed.end(), setup.mesh.component[at(f)])) continue;
    map.alignment_energy += alignment_energy(setup, map, f);
    for (int k = 0; k < 3; ++k) map.snapping_energy += snapping_energy(setup, map, unknowns, 3 * f + k);
  }
}

}  // namespace

GridMap solve_grid_map(const BandMesh& mesh, const Charts& charts, const std::vector<Label>& labels, const Ink& ink,
                       const GridMapOptions& options, const Control& control) {
  const CutShifts cuts = trace_cuts(mesh, charts);
  const SnapRegions snap = merge_snapping(mesh, charts, labels, ink, options);
  const Setup setup{mesh, charts, labels, ink, options, cuts, snap};
  const Layout layout = lay_out(setup);
  Unknowns unknowns{std::vector<Vec2>(mesh.points.size()), std::vector<IVec2>(cuts.shift_component.size()),
                    std::vector<std::int64_t>(snap.component.size())};
  const std::vector<int> failed = ComponentSolver(setup, layout, control, unknowns).run();
  GridMap map = assemble_map(setup, unknowns);
  map.failed_components = failed;
  measure_energies(setup, unknowns, map);
  return map;
}

}  // namespace inkgrid
