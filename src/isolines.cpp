#include "isolines.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

// A triangle wider than this in u or v is the trace of a failed solve: it is left out as if the band had a hole there.  The bound
// also keeps every product of two coordinate differences far inside 64 bits.
constexpr std::int64_t kWidestTriangle = 16 * kFixedOne;

template <class T>
auto& at(T& values, int i) {
  return values[static_cast<std::size_t>(i)];
}

constexpr std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0));
}
constexpr std::int64_t ceil_div(std::int64_t a, std::int64_t b) {
  return -floor_div(-a, b);
}
constexpr int sign(std::int64_t a) {
  return (a > 0) - (a < 0);
}
constexpr std::int64_t cross(IVec2 a, IVec2 b) {
  return a.x * b.y - a.y * b.x;
}

// The isoline u = value (family 0) or v = value (family 1) of one chart.
struct Line {
  int family = 0;
  std::int64_t value = 0;  // grid units
};

constexpr std::int64_t across(IVec2 a, int family) {
  return family == 0 ? a.x : a.y;
}
constexpr std::int64_t along(IVec2 a, int family) {
  return family == 0 ? a.y : a.x;
}

Line transported(Line line, const Transition& t) {
  const IVec2 on_axis = line.family == 0 ? IVec2{line.value, 0} : IVec2{0, line.value};
  const int family = line.family ^ (t.turn & 1);
  return {family, across(turned(on_axis, t.turn) + t.shift, family)};
}

// The integers first, first + 1, ..., last; none where last < first.
struct Range {
  std::int64_t first = 0;
  std::int64_t last = -1;

  std::int64_t size() const { return std::max<std::int64_t>(last - first + 1, 0); }
  bool contains(std::int64_t i) const { return first <= i && i <= last; }
};

Range strictly_between(std::int64_t a, std::int64_t b) {
  return {floor_div(std::min(a, b), kFixedOne) + 1, ceil_div(std::max(a, b), kFixedOne) - 1};
}

// One end of a segment: on a crossed halfedge, at a singular corner, or (halfedge and node) on the boundary.
struct End {
  int halfedge = -1;
  int crossing = -1;  // shared with the segment on the other side
  int node = -1;      // where the isoline ends here: singular or boundary
  // The grid coordinates at or below the end and those strictly below it, along the isoline; they differ only at a singular
  // corner on a grid point, which is no grid node of its isolines.
  std::int64_t at_or_below = 0;
  std::int64_t below = 0;
};

// An isoline inside one triangle, from ends[0] to ends[1].
struct Segment {
  int face = -1;
  Line line;
  std::array<End, 2> ends;
  Range grid;          // coordinates along the isoline of the grid points on the segment
  int step = 1;        // +1 where that coordinate grows from ends[0] to ends[1], else -1
  int first_node = 0;  // its nodes, in the direction of the segment: segment_nodes[first_node] ...
  int node_count = 0;
};

void place_grid_points(Segment& s) {
  const auto& [a, b] = s.ends;
  s.step = b.below < a.at_or_below ? -1 : 1;
  s.grid = s.step > 0 ? Range{a.at_or_below + 1, b.below} : Range{b.at_or_below + 1, a.below};
}

// All segments and nodes of the isolines, linked through the crossed edges.
class Arrangement {
 public:
  Arrangement(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components);

  std::vector<GraphNode> nodes;
  std::vector<Segment> segments;
  std::vector<int> segment_nodes;
  std::vector<std::array<int, 2>> crossings;  // the segments on both sides: of the edge's smaller halfedge, of its larger

  int twin(int halfedge) const { return at(twins_, halfedge); }
  bool owner(int halfedge) const { return twin(halfedge) < 0 || halfedge < twin(halfedge); }
  Vec2 crossing_point(int halfedge, Line line) const;

 private:
  const BandMesh& mesh_;
  const ExactMap& map_;
  std::vector<int> twins_;           // -1 also where the neighbour is left out
  std::vector<std::uint8_t> used_;   // per face
  std::vector<int> first_crossing_;  // per owner halfedge: u isolines first, each family in the order of its values
  std::vector<int> singular_node_;   // per vertex
  std::vector<int> node_table_;      // of one face: u segments x v segments

  IVec2 uv(int corner) const { return at(map_.uv, corner); }
  int vertex(int corner) const { return at(mesh_.faces, face_of(corner))[static_cast<std::size_t>(corner % 3)]; }
  Vec2 point(int corner) const { return at(mesh_.points, vertex(corner)); }
  bool canonical(int halfedge) const { return vertex(halfedge) < vertex(next_halfedge(halfedge)); }
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
  int crossing_index(int halfedge, Line line) const;

  void cut_face(int face);
  std::optional<Segment> cut(int face, Line line);
  bool runs_inside(int halfedge) const;
  End end_on_edge(int halfedge, Line line);
  End end_at_corner(int corner, int family);
  std::int64_t cell(int halfedge, Line line) const;
  void add_segment(const Segment& segment);
  void add_grid_nodes(int first_segment, int first_v_segment);
  void collect_nodes(Segment& segment, int first, int stride, int count);
  Vec2 end_position(const End& end, Line line) const;
  Vec2 grid_node_position(const Segment& u_segment, IVec2 grid_point) const;
};

Arrangement::Arrangement(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components)
    : mesh_(mesh), map_(map), singular_node_(mesh.points.size(), -1) {
  choose_faces(skipped_components);
  link_faces();
  number_crossings();
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (at(used_, f)) cut_face(f);
  }
}

std::pair<std::int64_t, std::int64_t> Arrangement::extent(int face, int family) const {
  return std::minmax({across(uv(3 * face), family), across(uv(3 * face + 1), family), across(uv(3 * face + 2), family)});
}

bool Arrangement::narrow(int face) const {
  for (int family = 0; family < 2; ++family) {
    const auto [low, high] = extent(face, family);
    if (high - low > kWidestTriangle) return false;
  }
  return true;
}

void Arrangement::choose_faces(const std::vector<int>& skipped_components) {
  std::vector<std::uint8_t> skipped(static_cast<std::size_t>(mesh_.components), 0);
  for (const int c : skipped_components) at(skipped, c) = 1;
  used_.resize(mesh_.faces.size());
  for (int f = 0; f < mesh_.face_count(); ++f) at(used_, f) = !at(skipped, at(mesh_.component, f)) && narrow(f);
}

bool Arrangement::transition_holds(int halfedge) const {
  const Transition& t = at(map_.transitions, halfedge);
  const int other = at(mesh_.twins, halfedge);
  const IVec2 shift = kFixedOne * t.shift;
  return turned(uv(halfedge), t.turn) + shift == uv(next_halfedge(other)) &&
         turned(uv(next_halfedge(halfedge)), t.turn) + shift == uv(other);
}

void Arrangement::link_faces() {
  twins_ = mesh_.twins;
  for (int h = 0; h < static_cast<int>(twins_.size()); ++h) {
    int& other = at(twins_, h);
    if (other < 0) continue;
    if (!at(used_, face_of(h)) || !at(used_, face_of(other))) {
      other = -1;
    } else if (!transition_holds(h)) {
      throw Error(ErrorCode::numerics, "The grid map does not hold its transition functions.");
    }
  }
}

void Arrangement::number_crossings() {
  first_crossing_.assign(twins_.size(), 0);
  std::int64_t count = 0;
  for (int h = 0; h < static_cast<int>(twins_.size()); ++h) {
    if (!at(used_, face_of(h)) || !owner(h)) continue;
    at(first_crossing_, h) = static_cast<int>(count);
    count += crossed(h, 0).size() + crossed(h, 1).size();
  }
  crossings.assign(static_cast<std::size_t>(count), {-1, -1});
}

int Arrangement::crossing_index(int halfedge, Line line) const {
  if (!owner(halfedge)) {
    line = transported(line, at(map_.transitions, halfedge));
    halfedge = twin(halfedge);
  }
  const std::int64_t before = line.family == 0 ? 0 : crossed(halfedge, 0).size();
  return at(first_crossing_, halfedge) + static_cast<int>(before + line.value - crossed(halfedge, line.family).first);
}

// The same in every chart to the last bit: numerator and denominator are exact, and at most both change their sign.
Vec2 Arrangement::crossing_point(int halfedge, Line line) const {
  int p = halfedge;
  int q = next_halfedge(halfedge);
  if (!canonical(halfedge)) std::swap(p, q);
  const std::int64_t from = across(uv(p), line.family);
  const std::int64_t to = across(uv(q), line.family);
  return lerp(point(p), point(q), static_cast<double>(line.value * kFixedOne - from) / static_cast<double>(to - from));
}

std::int64_t Arrangement::orientation(int face) const {
  const IVec2 a = uv(3 * face);
  return cross(uv(3 * face + 1) - a, uv(3 * face + 2) - a);
}

// The largest grid coordinate below the point where the line crosses the edge.  A grid point exactly on the edge counts as lying
// to the left of it, seen from the smaller vertex to the larger: quarter turns and shifts keep that, so all charts agree.
std::int64_t Arrangement::cell(int halfedge, Line line) const {
  int p = halfedge;
  int q = next_halfedge(halfedge);
  if (!canonical(halfedge)) std::swap(p, q);
  const std::int64_t rise = across(uv(q), line.family) - across(uv(p), line.family);
  const std::int64_t reach = line.value * kFixedOne - across(uv(p), line.family);
  const std::int64_t start = along(uv(p), line.family);
  const std::int64_t start_cell = floor_div(start, kFixedOne);
  const std::int64_t offset = (start - start_cell * kFixedOne) * rise + (along(uv(q), line.family) - start) * reach;
  const std::int64_t grid_unit = kFixedOne * rise;
  const std::int64_t found = start_cell + floor_div(offset, grid_unit);
  const bool grid_point_above = offset % grid_unit == 0 && (line.family == 0) == (rise > 0);
  return grid_point_above ? found - 1 : found;
}

End Arrangement::end_on_edge(int halfedge, Line line) {
  End end;
  end.halfedge = halfedge;
  end.crossing = crossing_index(halfedge, line);
  end.at_or_below = end.below = cell(halfedge, line);
  if (twin(halfedge) < 0) {
    end.node = static_cast<int>(nodes.size());
    nodes.push_back({crossing_point(halfedge, line), NodeKind::boundary, face_of(halfedge)});
  }
  return end;
}

End Arrangement::end_at_corner(int corner, int family) {
  int& node = at(singular_node_, vertex(corner));
  if (node < 0) {
    node = static_cast<int>(nodes.size());
    nodes.push_back({point(corner), NodeKind::singular, face_of(corner)});
  }
  End end;
  end.node = node;
  end.at_or_below = floor_div(along(uv(corner), family), kFixedOne);
  end.below = ceil_div(along(uv(corner), family), kFixedOne) - 1;
  return end;
}

// An isoline along a whole mesh edge between two singular vertices runs in the triangles that hold the grid points of the edge
// (`cell`).
bool Arrangement::runs_inside(int halfedge) const {
  return sign(orientation(face_of(halfedge))) == (canonical(halfedge) ? 1 : -1);
}

std::optional<Segment> Arrangement::cut(int face, Line line) {
  std::array<int, 3> side;
  for (int k = 0; k < 3; ++k) at(side, k) = sign(across(uv(3 * face + k), line.family) - line.value * kFixedOne);
  Segment segment;
  segment.face = face;
  segment.line = line;
  int ends = 0;
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * face + k;
    const int here = at(side, k);
    const int next = at(side, (k + 1) % 3);
    const int previous = at(side, (k + 2) % 3);
    if (here * next < 0) at(segment.ends, ends++) = end_on_edge(h, line);
    if (here == 0 && next * previous < 0) at(segment.ends, ends++) = end_at_corner(h, line.family);
    if (here == 0 && next == 0 && previous != 0 && runs_inside(h)) {
      at(segment.ends, ends++) = end_at_corner(h, line.family);
      at(segment.ends, ends++) = end_at_corner(next_halfedge(h), line.family);
    }
  }
  if (ends == 0) return std::nullopt;
  place_grid_points(segment);
  return segment;
}

void Arrangement::cut_face(int face) {
  const int first_segment = static_cast<int>(segments.size());
  int first_v_segment = first_segment;
  for (int family = 0; family < 2; ++family) {
    if (family == 1) first_v_segment = static_cast<int>(segments.size());
    const auto [low, high] = extent(face, family);
    for (std::int64_t k = ceil_div(low, kFixedOne); k <= floor_div(high, kFixedOne); ++k) {
      if (const auto segment = cut(face, {family, k})) add_segment(*segment);
    }
  }
  add_grid_nodes(first_segment, first_v_segment);
}

void Arrangement::add_segment(const Segment& segment) {
  for (const End& end : segment.ends) {
    if (end.crossing < 0) continue;
    at(crossings, end.crossing)[owner(end.halfedge) ? 0 : 1] = static_cast<int>(segments.size());
  }
  segments.push_back(segment);
}

// The grid points that a u and a v isoline of the triangle both pass.  Outside of triangles that are a line between singular
// vertices they always agree, also on ties: both say that the grid point is on the same side of all three edges.
void Arrangement::add_grid_nodes(int first_segment, int first_v_segment) {
  const int end = static_cast<int>(segments.size());
  const int columns = end - first_v_segment;
  node_table_.assign(static_cast<std::size_t>((first_v_segment - first_segment) * columns), -1);
  for (int i = first_segment; i < first_v_segment; ++i) {
    for (int j = first_v_segment; j < end; ++j) {
      const Segment& u = at(segments, i);
      const Segment& v = at(segments, j);
      if (!u.grid.contains(v.line.value) || !v.grid.contains(u.line.value)) continue;
      at(node_table_, (i - first_segment) * columns + j - first_v_segment) = static_cast<int>(nodes.size());
      nodes.push_back({grid_node_position(u, {u.line.value, v.line.value}), NodeKind::grid, u.face});
    }
  }
  for (int i = first_segment; i < first_v_segment; ++i) collect_nodes(at(segments, i), (i - first_segment) * columns, 1, columns);
  for (int j = first_v_segment; j < end; ++j)
    collect_nodes(at(segments, j), j - first_v_segment, columns, first_v_segment - first_segment);
}

void Arrangement::collect_nodes(Segment& segment, int first, int stride, int count) {
  segment.first_node = static_cast<int>(segment_nodes.size());
  for (int k = 0; k < count; ++k) {
    const int node = at(node_table_, first + stride * (segment.step > 0 ? k : count - 1 - k));
    if (node >= 0) segment_nodes.push_back(node);
  }
  segment.node_count = static_cast<int>(segment_nodes.size()) - segment.first_node;
}

Vec2 Arrangement::end_position(const End& end, Line line) const {
  return end.halfedge >= 0 ? crossing_point(end.halfedge, line) : at(nodes, end.node).position;
}

// Barycentric with exact weights, so the same in every chart; in a triangle without area both isolines cross the same two edges.
Vec2 Arrangement::grid_node_position(const Segment& u_segment, IVec2 grid_point) const {
  const auto area = static_cast<double>(orientation(u_segment.face));
  if (area == 0) return (end_position(u_segment.ends[0], u_segment.line) + end_position(u_segment.ends[1], u_segment.line)) / 2;
  Vec2 position;
  for (int k = 0; k < 3; ++k) {
    const int h = next_halfedge(3 * u_segment.face + k);
    const IVec2 from = uv(h);
    const std::int64_t part = cross(uv(next_halfedge(h)) - from, kFixedOne * grid_point - from);
    position += static_cast<double>(part) / area * point(3 * u_segment.face + k);
  }
  return position;
}

// A place between two nodes on a segment and a direction along it: +1 towards ends[1], -1 towards ends[0].
struct Cursor {
  int segment = 0;
  int piece = 0;  // 0 .. node_count
  int direction = 1;
};

class Tracer {
 public:
  explicit Tracer(const Arrangement& arrangement) : arrangement_(arrangement) {
    traced_.resize(arrangement.segments.size() + arrangement.segment_nodes.size(), 0);
  }

  std::vector<GraphEdge> trace();

 private:
  const Arrangement& arrangement_;
  std::vector<std::uint8_t> traced_;  // per piece, segment by segment

  const Segment& segment(Cursor c) const { return at(arrangement_.segments, c.segment); }
  // Each segment has one piece more than it has nodes.
  int piece_index(Cursor c) const { return segment(c).first_node + c.segment + c.piece; }
  int node(Cursor c) const;
  int port(Cursor c, int node) const;
  const End& end(Cursor c) const { return segment(c).ends[c.direction > 0 ? 1 : 0]; }
  Vec2 crossing_point(Cursor c) const { return arrangement_.crossing_point(end(c).halfedge, segment(c).line); }
  Cursor next(Cursor c) const;
  GraphEdge follow(Cursor start);
  void trace_pieces(bool closed, std::vector<GraphEdge>& edges);
};

constexpr Cursor reversed(Cursor c) {
  return {c.segment, c.piece, -c.direction};
}

// The node in which the piece ends in the direction of the cursor, or -1 where the isoline goes on into the next triangle.
int Tracer::node(Cursor c) const {
  const Segment& s = segment(c);
  const int i = c.direction > 0 ? c.piece : c.piece - 1;
  return i < 0 || i == s.node_count ? end(c).node : at(arrangement_.segment_nodes, s.first_node + i);
}

// Of the node in which the piece ends: the direction from the node back into the piece.
int Tracer::port(Cursor c, int node) const {
  if (at(arrangement_.nodes, node).kind != NodeKind::grid) return -1;
  const bool grows_backwards = segment(c).step * c.direction < 0;
  return (segment(c).line.family == 0 ? 1 : 0) + (grows_backwards ? 0 : 2);
}

Cursor Tracer::next(Cursor c) const {
  const int entered = arrangement_.twin(end(c).halfedge);
  const int next_segment = at(arrangement_.crossings, end(c).crossing)[arrangement_.owner(entered) ? 0 : 1];
  const Segment& s = at(arrangement_.segments, next_segment);
  return s.ends[0].halfedge == entered ? Cursor{next_segment, 0, 1} : Cursor{next_segment, s.node_count, -1};
}

GraphEdge Tracer::follow(Cursor start) {
  GraphEdge edge;
  edge.from = node(reversed(start));
  edge.from_port = edge.from < 0 ? -1 : port(reversed(start), edge.from);
  edge.path = {edge.from < 0 ? crossing_point(reversed(start)) : at(arrangement_.nodes, edge.from).position};
  for (Cursor c = start; !at(traced_, piece_index(c)); c = next(c)) {
    at(traced_, piece_index(c)) = 1;
    edge.faces.push_back(segment(c).face);
    edge.family.push_back(static_cast<std::uint8_t>(segment(c).line.family));
    edge.to = node(c);
    edge.path.push_back(edge.to < 0 ? crossing_point(c) : at(arrangement_.nodes, edge.to).position);
    if (edge.to < 0) continue;
    edge.to_port = port(c, edge.to);
    break;
  }
  return edge;
}

void Tracer::trace_pieces(bool closed, std::vector<GraphEdge>& edges) {
  for (int s = 0; s < static_cast<int>(arrangement_.segments.size()); ++s) {
    for (int piece = 0; piece <= at(arrangement_.segments, s).node_count; ++piece) {
      const Cursor forward{s, piece, 1};
      if (at(traced_, piece_index(forward))) continue;
      if (closed || node(reversed(forward)) >= 0) {
        edges.push_back(follow(forward));
      } else if (node(forward) >= 0) {
        edges.push_back(follow(reversed(forward)));
      }
    }
  }
}

// What is left when every node has been left through all its ports is closed.
std::vector<GraphEdge> Tracer::trace() {
  std::vector<GraphEdge> edges;
  trace_pieces(false, edges);
  trace_pieces(true, edges);
  return edges;
}

}  // namespace

IsolineGraph trace_isolines(const BandMesh& mesh, const ExactMap& map, const std::vector<int>& skipped_components) {
  Arrangement arrangement(mesh, map, skipped_components);
  std::vector<GraphEdge> edges = Tracer(arrangement).trace();
  return {std::move(arrangement.nodes), std::move(edges)};
}

}  // namespace inkgrid
