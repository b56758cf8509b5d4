#include "map/grid_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "base/parallel.h"
#include "map/map_system.h"

namespace inkgrid {

namespace {

constexpr int kCornersOfTask = 1 << 15;

struct Unknowns {
  std::vector<Vec2> vertex;            // (u, v)
  std::vector<IVec2> shift;            // per free shift
  std::vector<std::int64_t> region;    // per snapping region
  std::vector<EliminationPlan> plans;  // per component
};

// Writes only what belongs to the component, so components may be solved at the same time.
void solve_component(const MapSetup& setup, const MapLayout& layout, int component, const MixedIntegerLimits& limits,
                     Unknowns& unknowns) {
  EliminationPlan& plan = unknowns.plans[at(component)];
  const MixedIntegerProblem problem = map_problem(setup, layout, component, &plan, limits.threads);
  MixedIntegerSolution solution = solve_mixed_integer(problem, std::move(plan), limits);
  plan = std::move(solution.plan);
  const auto integer = [&](int place) { return static_cast<std::int64_t>(solution.integers[at(place)]); };
  for (std::size_t i = 0; i < layout.shift.size(); ++i)
    if (setup.cuts.shift_component[i] == component) unknowns.shift[i] = {integer(layout.shift[i]), integer(layout.shift[i] + 1)};
  for (std::size_t i = 0; i < layout.region.size(); ++i)
    if (setup.snap.component[i] == component) unknowns.region[i] = integer(layout.region[i]);
  for (int v : layout.vertices[at(component)]) {
    const int node = layout.node[at(v)], form = setup.cuts.doubled_form[at(v)];
    if (setup.held.is_held[at(v)])
      unknowns.vertex[at(v)] = setup.held.uv[at(v)];
    else if (node >= 0)
      unknowns.vertex[at(v)] = {solution.reals[at(node)].p, solution.reals[at(node)].q};
    else if (form >= 0)
      unknowns.vertex[at(v)] = 0.5 * real(value_of(setup.cuts.forms[at(form)], unknowns.shift));
  }
}

// Solves the components, the largest first, on all processors; the calling thread takes part and reports.
class ComponentSolver {
 public:
  ComponentSolver(const MapSetup& setup, const MapLayout& layout, const Control& control, Unknowns& unknowns)
      : setup_(setup),
        layout_(layout),
        control_(control),
        unknowns_(unknowns),
        order_(layout.nodes.size()),
        failed_(layout.nodes.size(), 0) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return layout.nodes[at(a)] > layout.nodes[at(b)]; });
  }

  // Components whose solve failed.
  std::vector<int> run() {
    {
      std::vector<std::jthread> helpers;
      const auto threads = static_cast<std::size_t>(thread_count(setup_.options.threads));
      while (helpers.size() + 1 < std::min(threads, order_.size())) helpers.emplace_back([this] { work(nullptr); });
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

  // All of them for one that is more than the share of a thread: it would keep the others waiting.
  int threads_for(int component) const {
    const auto own = static_cast<std::int64_t>(layout_.nodes[at(component)]);
    const auto all = std::reduce(layout_.nodes.begin(), layout_.nodes.end(), std::int64_t{0});
    const int threads = thread_count(setup_.options.threads);
    return own * threads > all ? threads : 1;
  }

  void attempt(int component) {
    try {
      solve_component(setup_, layout_, component, {threads_for(component), control_.stop}, unknowns_);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::numerics) throw;
      failed_[at(component)] = 1;
    }
  }

  const MapSetup& setup_;
  const MapLayout& layout_;
  const Control& control_;
  Unknowns& unknowns_;
  std::vector<int> order_;
  std::vector<char> failed_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
};

GridMap assemble_map(const MapSetup& setup, const Unknowns& unknowns) {
  const CutShifts& cuts = setup.cuts;
  const auto translation = [&](int form) { return form < 0 ? IVec2{} : value_of(cuts.forms[at(form)], unknowns.shift); };
  GridMap map;
  map.base = unknowns.vertex;
  map.corner_turn = cuts.corner_turn;
  map.half_integer = cuts.fixed_point;
  const std::size_t corners = 3 * setup.mesh.faces.size();
  map.corner_base.resize(corners);
  map.corner_shift.resize(corners);
  map.transitions.resize(corners);
  for_ranges(setup.options.threads, static_cast<int>(corners), kCornersOfTask, [&](int first, int last) {
    for (int c = first; c < last; ++c) {
      map.corner_base[at(c)] = setup.mesh.vertex_of(c);
      map.corner_shift[at(c)] = translation(cuts.corner_form[at(c)]);
      map.transitions[at(c)] = {setup.mesh.twins[at(c)] < 0 ? 0 : setup.charts.turns[at(c)],
                                translation(cuts.halfedge_form[at(c)])};
    }
  });
  map.cut_integers = 2 * static_cast<int>(cuts.shift_component.size());
  map.snapping_integers = static_cast<int>(setup.snap.component.size());
  map.cuts = cuts.paths;
  return map;
}

// Equation (2) in one face.
double alignment_energy(const MapSetup& setup, const GridMap& map, int f) {
  const FaceFrame frame = face_frame(setup, f);
  Vec2 along_s{-1, 0}, along_t{0, -1};
  for (int k = 0; k < 3; ++k) {
    along_s += frame.along_s[at(k)] * map.uv(3 * f + k);
    along_t += frame.along_t[at(k)] * map.uv(3 * f + k);
  }
  return norm2(along_s) + norm2(along_t);
}

// Equation (3) at one corner.
double snapping_energy(const MapSetup& setup, const GridMap& map, const Unknowns& unknowns, int corner) {
  const int region = setup.snap.region[at(corner)];
  if (region < 0) return 0;
  const Vec2 uv = map.uv(corner);
  const double value = snapping_coordinate(setup.labels[at(face_of(corner))]) == 0 ? uv.x : uv.y;
  const double difference = value - static_cast<double>(unknowns.region[at(region)]);
  return setup.snap.weight[at(corner)] * difference * difference;
}

// Each in the order of the faces.
void measure_energies(const MapSetup& setup, const Unknowns& unknowns, GridMap& map) {
  const auto sum = [&](const auto& energy) {
    const auto& failed = map.failed_components;
    double total = 0;
    for (int f = 0; f < setup.mesh.face_count(); ++f)
      if (!std::binary_search(failed.begin(), failed.end(), setup.mesh.component[at(f)])) energy(f, total);
    return total;
  };
  at_once(
      setup.options.threads,
      [&] { map.alignment_energy = sum([&](int f, double& total) { total += alignment_energy(setup, map, f); }); },
      [&] {
        map.snapping_energy = sum([&](int f, double& total) {
          for (int k = 0; k < 3; ++k) total += snapping_energy(setup, map, unknowns, 3 * f + k);
        });
      });
}

}  // namespace

GridMap solve_grid_map(const BandMesh& mesh, const Charts& charts, const std::vector<Label>& labels, const Ink& ink,
                       const GridMapOptions& options, const Control& control, const Known* known,
                       std::vector<EliminationPlan> plans) {
  CutShifts cuts;
  SnapRegions snap;
  at_once(
      options.threads, [&] { cuts = trace_cuts(mesh, charts); },
      [&] { snap = merge_snapping(mesh, charts, labels, ink, options); });
  const HeldVertices held = held_vertices(mesh, cuts, known);
  const MapSetup setup{mesh, charts, labels, ink, options, cuts, snap, held};
  const MapLayout layout = lay_out(setup);
  Unknowns unknowns{std::vector<Vec2>(mesh.points.size()), std::vector<IVec2>(cuts.shift_component.size()),
                    std::vector<std::int64_t>(snap.component.size()), std::move(plans)};
  unknowns.plans.resize(at(mesh.components));
  const std::vector<int> failed = ComponentSolver(setup, layout, control, unknowns).run();
  GridMap map = assemble_map(setup, unknowns);
  map.failed_components = failed;
  map.plans = std::move(unknowns.plans);
  measure_energies(setup, unknowns, map);
  return map;
}

}  // namespace inkgrid
