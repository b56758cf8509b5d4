#include "graph/arrangement.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/at.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

// A triangle wider than this in u or v is the trace of a failed solve: it is left out as if the band had a hole there.  The bound
// also keeps every product of two coordinate differences far inside 64 bits.
constexpr std::int64_t kWidestTriangle = 16 * kFixedOne;

constexpr std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0));
}
// The largest grid coordinate that is no more, and the smallest that is no less.
constexpr std::int64_t floor_grid(std::int64_t a) {
  return a >> kFixedBits;
}
constexpr std::int64_t ceil_grid(std::int64_t a) {
  return -floor_grid(-a);
}
constexpr int sign(std::int64_t a) {
  return (a > 0) - (a < 0);
}
constexpr std::int64_t cross(IVec2 a, IVec2 b) {
  return a.x * b.y - a.y * b.x;
}

constexpr std::int64_t across(IVec2 a, int family) {
  return family == 0 ? a.x : a.y;
}
constexpr std::int64_t along(IVec2 a, int family) {
  return family == 0 ? a.y : a.x;
}

Isoline transported(Isoline isoline, const Transition& t) {
  const IVec2 on_axis = isoline.family == 0 ? IVec2{isoline.value, 0} : IVec2{0, isoline.value};
  const int family = isoline.family ^ (t.turn & 1);
  return {family, across(turned(on_axis, t.turn) + t.shift, family)};
}

// The integers first, first + 1, ..., last; none where last < first.
struct Range {
  std::int64_t first = 0;
  std::int64_t last = -1;

  std::int64_t size() const { return std::max<std::int64_t>(last - first + 1, 0); }
};

Range strictly_between(std::int64_t a, std::int64_t b) {
  return {floor_grid(std::min(a, b)) + 1, ceil_grid(std::max(a, b)) - 1};
}

void place_grid_points(IsolineSegment& s) {
  const auto& [a, b] = s.ends;
  s.step = b.below < a.at_or_below ? -1 : 1;
  s.first_grid = (s.step > 0 ? a : b).at_or_below + 1;
  s.last_grid = (s.step > 0 ? b : a).below;
}

bool passes(const IsolineSegment& s, std::int64_t grid) {
  return s.first_grid <= grid && grid <= s.last_grid;
}

class Cutter {
 public:
  Cutter(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components);
  Arrangement take() { return std::move(result_); }

 private:
  const BandMesh& mesh_;
  const ExactMap& map_;
  Arrangement result_;
  std::vector<std::uint8_t> used_;   // per face
  std::vector<int> first_crossing_;  // per owner halfedge: u isolines first, each family in the order of its values
  std::vector<int> singular_node_;   // per vertex
  std::vector<int> node_table_;      // of one face: u segments x v segments

  IVec2 uv(int corner) const { return map_.uv[at(corner)]; }
  int vertex(int corner) const { return mesh_.vertex_of(corner); }
  Vec2 point(int corner) const { return mesh_.points[at(vertex(corner))]; }
  bool canonical(int halfedge) const { return vertex(halfedge) < vertex(next_halfedge(halfedge)); }
  std::pair<int, int> canonical_corners(int halfedge) const {
    const int next = next_halfedge(halfedge);
    return canonical(halfedge) ? std::pair{halfedge, next} : std::pair{next, halfedge};
  }
  Range crossed(int halfedge, int family) const {
    return strictly_between(across(uv(halfedge), family), across(uv(next_halfedge(halfedge)), family));
  }
  std::int64_t orientation(int face) const;
  std::pair<std::int64_t, std::int64_t> extent(int face, int family) const;  // least and largest coordinate across the family

  void choose_faces(const std::vector<int>& skipped_components);
  void link_faces();
  bool narrow(int face) const;
  bool transition_holds(int halfedge) const;
  void number_crossings();
  int crossing_index(int halfedge, Isoline isoline) const;
  Vec2 crossing_point(int halfedge, Isoline isoline) const;

  void cut_face(int face);
  std::optional<IsolineSegment> cut(int face, Isoline isoline);
  bool runs_inside(int halfedge) const;
  SegmentEnd end_on_edge(int halfedge, Isoline isoline);
  SegmentEnd end_at_corner(int corner, int family);
  std::int64_t cell(int halfedge, Isoline isoline) const;
  void add_segment(const IsolineSegment& segment);
  void add_grid_nodes(int first_segment, int first_v_segment);
  void collect_nodes(IsolineSegment& segment, int first, int stride, int count);
  Vec2 grid_node_position(const IsolineSegment& u_segment, IVec2 grid_point) const;
};

Cutter::Cutter(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components)
    : mesh_(mesh), map_(map), singular_node_(mesh.points.size(), -1) {
  choose_faces(skipped_components);
  link_faces();
  number_crossings();
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (used_[at(f)]) cut_face(f);
  }
}

std::pair<std::int64_t, std::int64_t> Cutter::extent(int face, int family) const {
  return std::minmax({across(uv(3 * face), family), across(uv(3 * face + 1), family), across(uv(3 * face + 2), family)});
}

bool Cutter::narrow(int face) const {
  for (int family = 0; family < 2; ++family) {
    const auto [low, high] = extent(face, family);
    if (high - low > kWidestTriangle) return false;
  }
  return true;
}

void Cutter::choose_faces(const std::vector<int>& skipped_components) {
  std::vector<std::uint8_t> skipped(static_cast<std::size_t>(mesh_.components), 0);
  for (const int c : skipped_components) skipped[at(c)] = 1;
  used_.resize(mesh_.faces.size());
  for (int f = 0; f < mesh_.face_count(); ++f) used_[at(f)] = !skipped[at(mesh_.component[at(f)])] && narrow(f);
}

bool Cutter::transition_holds(int halfedge) const {
  const Transition& t = map_.transitions[at(halfedge)];
  const int other = mesh_.twins[at(halfedge)];
  const IVec2 shift = kFixedOne * t.shift;
  return turned(uv(halfedge), t.turn) + shift == uv(next_halfedge(other)) &&
         turned(uv(next_halfedge(halfedge)), t.turn) + shift == uv(other);
}

void Cutter::link_faces() {
  result_.twins = mesh_.twins;
  for (int h = 0; h < static_cast<int>(result_.twins.size()); ++h) {
    int& other = result_.twins[at(h)];
    if (other < 0) continue;
    if (!used_[at(face_of(h))] || !used_[at(face_of(other))]) {
      other = -1;
    } else if (!transition_holds(h)) {
      throw Error(ErrorCode::numerics, "The grid map does not hold its transition functions.");
    }
  }
}

void Cutter::number_crossings() {
  first_crossing_.assign(result_.twins.size(), 0);
  std::int64_t count = 0;
  for (int h = 0; h < static_cast<int>(result_.twins.size()); ++h) {
    if (!used_[at(face_of(h))] || !result_.owns_edge(h)) continue;
    first_crossing_[at(h)] = static_cast<int>(count);
    count += crossed(h, 0).size() + crossed(h, 1).size();
  }
  result_.crossings.resize(static_cast<std::size_t>(count));
}

int Cutter::crossing_index(int halfedge, Isoline isoline) const {
  if (!result_.owns_edge(halfedge)) {
    isoline = transported(isoline, map_.transitions[at(halfedge)]);
    halfedge = result_.twins[at(halfedge)];
  }
  const std::int64_t before = isoline.family == 0 ? 0 : crossed(halfedge, 0).size();
  return first_crossing_[at(halfedge)] + static_cast<int>(before + isoline.value - crossed(halfedge, isoline.family).first);
}

// The same in every chart to the last bit: numerator and denominator are exact, and at most both change their sign.
Vec2 Cutter::crossing_point(int halfedge, Isoline isoline) const {
  const auto [p, q] = canonical_corners(halfedge);
  const std::int64_t from = across(uv(p), isoline.family);
  const std::int64_t to = across(uv(q), isoline.family);
  return lerp(point(p), point(q), static_cast<double>(isoline.value * kFixedOne - from) / static_cast<double>(to - from));
}

std::int64_t Cutter::orientation(int face) const {
  const IVec2 a = uv(3 * face);
  return cross(uv(3 * face + 1) - a, uv(3 * face + 2) - a);
}

// The largest grid coordinate below the point where the isoline crosses the edge.  A grid point exactly on the edge counts as
// lying to the left of it, seen from the smaller vertex to the larger: quarter turns and shifts keep that, so all charts agree.
std::int64_t Cutter::cell(int halfedge, Isoline isoline) const {
  const auto [p, q] = canonical_corners(halfedge);
  const std::int64_t rise = across(uv(q), isoline.family) - across(uv(p), isoline.family);
  const std::int64_t reach = isoline.value * kFixedOne - across(uv(p), isoline.family);
  const std::int64_t start = along(uv(p), isoline.family);
  const std::int64_t start_cell = floor_grid(start);
  const std::int64_t offset = (start - start_cell * kFixedOne) * rise + (along(uv(q), isoline.family) - start) * reach;
  const std::int64_t grid_unit = kFixedOne * rise;
  const std::int64_t found = start_cell + floor_div(offset, grid_unit);
  const bool grid_point_above = offset % grid_unit == 0 && (isoline.family == 0) == (rise > 0);
  return grid_point_above ? found - 1 : found;
}

SegmentEnd Cutter::end_on_edge(int halfedge, Isoline isoline) {
  SegmentEnd end;
  end.halfedge = halfedge;
  end.crossing = crossing_index(halfedge, isoline);
  // The owner has the smaller face, so it comes first.
  if (result_.owns_edge(halfedge)) result_.crossings[at(end.crossing)].position = crossing_point(halfedge, isoline);
  end.at_or_below = end.below = cell(halfedge, isoline);
  if (result_.twins[at(halfedge)] < 0) {
    end.node = static_cast<int>(result_.nodes.size());
    result_.nodes.push_back({result_.crossings[at(end.crossing)].position, NodeKind::boundary, face_of(halfedge)});
  }
  return end;
}

SegmentEnd Cutter::end_at_corner(int corner, int family) {
  int& node = singular_node_[at(vertex(corner))];
  if (node < 0) {
    node = static_cast<int>(result_.nodes.size());
    result_.nodes.push_back({point(corner), NodeKind::singular, face_of(corner)});
  }
  SegmentEnd end;
  end.node = node;
  end.at_or_below = floor_grid(along(uv(corner), family));
  end.below = ceil_grid(along(uv(corner), family)) - 1;
  return end;
}

// An isoline along a whole mesh edge between two singular vertices runs in the triangles that hold the grid points of the edge
// (`cell`).
bool Cutter::runs_inside(int halfedge) const {
  return sign(orientation(face_of(halfedge))) == (canonical(halfedge) ? 1 : -1);
}

std::optional<IsolineSegment> Cutter::cut(int face, Isoline isoline) {
  std::array<int, 3> side;
  for (int k = 0; k < 3; ++k) side[at(k)] = sign(across(uv(3 * face + k), isoline.family) - isoline.value * kFixedOne);
  IsolineSegment segment;
  segment.face = face;
  segment.isoline = isoline;
  int ends = 0;
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * face + k;
    const int here = side[at(k)];
    const int next = side[at((k + 1) % 3)];
    const int previous = side[at((k + 2) % 3)];
    if (here * next < 0) segment.ends[at(ends++)] = end_on_edge(h, isoline);
    if (here == 0 && next * previous < 0) segment.ends[at(ends++)] = end_at_corner(h, isoline.family);
    if (here == 0 && next == 0 && runs_inside(h)) {
      segment.ends[at(ends++)] = end_at_corner(h, isoline.family);
      segment.ends[at(ends++)] = end_at_corner(next_halfedge(h), isoline.family);
    }
  }
  if (ends == 0) return std::nullopt;
  place_grid_points(segment);
  return segment;
}

void Cutter::cut_face(int face) {
  const int first_segment = static_cast<int>(result_.segments.size());
  int first_v_segment = first_segment;
  for (int family = 0; family < 2; ++family) {
    if (family == 1) first_v_segment = static_cast<int>(result_.segments.size());
    const auto [low, high] = extent(face, family);
    for (std::int64_t k = ceil_grid(low); k <= floor_grid(high); ++k) {
      if (const auto segment = cut(face, {family, k})) add_segment(*segment);
    }
  }
  add_grid_nodes(first_segment, first_v_segment);
}

void Cutter::add_segment(const IsolineSegment& segment) {
  for (const SegmentEnd& end : segment.ends) {
    if (end.crossing < 0) continue;
    result_.crossings[at(end.crossing)].segments[result_.owns_edge(end.halfedge) ? 0 : 1] =
        static_cast<int>(result_.segments.size());
  }
  result_.segments.push_back(segment);
}

// The grid points that a u and a v isoline of the triangle both pass.  Outside of triangles that are a line between singular
// vertices they always agree, also on ties: both say that the grid point is on the same side of all three edges.
void Cutter::add_grid_nodes(int first_segment, int first_v_segment) {
  const int end = static_cast<int>(result_.segments.size());
  if (first_segment == end) return;
  const int columns = end - first_v_segment;
  node_table_.assign(at(first_v_segment - first_segment) * at(columns), -1);
  for (int i = first_segment; i < first_v_segment; ++i) {
    for (int j = first_v_segment; j < end; ++j) {
      const IsolineSegment& u = result_.segments[at(i)];
      const IsolineSegment& v = result_.segments[at(j)];
      if (!passes(u, v.isoline.value) || !passes(v, u.isoline.value)) continue;
      node_table_[at((i - first_segment) * columns + j - first_v_segment)] = static_cast<int>(result_.nodes.size());
      result_.nodes.push_back({grid_node_position(u, {u.isoline.value, v.isoline.value}), NodeKind::grid, u.face});
    }
  }
  for (int i = first_segment; i < first_v_segment; ++i)
    collect_nodes(result_.segments[at(i)], (i - first_segment) * columns, 1, columns);
  for (int j = first_v_segment; j < end; ++j)
    collect_nodes(result_.segments[at(j)], j - first_v_segment, columns, first_v_segment - first_segment);
}

void Cutter::collect_nodes(IsolineSegment& segment, int first, int stride, int count) {
  segment.first_node = static_cast<int>(result_.segment_nodes.size());
  for (int k = 0; k < count; ++k) {
    const int node = node_table_[at(first + stride * (segment.step > 0 ? k : count - 1 - k))];
    if (node >= 0) result_.segment_nodes.push_back(node);
  }
  segment.node_count = static_cast<int>(result_.segment_nodes.size()) - segment.first_node;
}

// Barycentric with exact weights, so the same in every chart; in a triangle without area both isolines cross the same two edges.
Vec2 Cutter::grid_node_position(const IsolineSegment& u_segment, IVec2 grid_point) const {
  const auto area = static_cast<double>(orientation(u_segment.face));
  const auto& [a, b] = u_segment.ends;
  if (area == 0) return (result_.crossings[at(a.crossing)].position + result_.crossings[at(b.crossing)].position) / 2;
  Vec2 position;
  for (int k = 0; k < 3; ++k) {
    const int h = next_halfedge(3 * u_segment.face + k);
    const IVec2 from = uv(h);
    const std::int64_t part = cross(uv(next_halfedge(h)) - from, kFixedOne * grid_point - from);
    position += static_cast<double>(part) / area * point(3 * u_segment.face + k);
  }
  return position;
}

}  // namespace

Arrangement arrange_isolines(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components) {
  return Cutter(mesh, map, skipped_components).take();
}

}  // namespace inkgrid
