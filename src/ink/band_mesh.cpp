#include "ink/band_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/at.h"
#include "base/parallel.h"
#include "base/sample.h"
#include "base/union_find.h"

namespace inkgrid {
namespace {

// The lattice is turned by this angle (radians), so that no drawing is aligned with it.
constexpr double kLatticeTurn = 0.2617 * std::numbers::sqrt2;

// Slits of paper narrower than this times twice the reach are no holes of the band: each would cost a cut.
constexpr double kFilledHole = 1.25;

constexpr int kRowsAtOnce = 32;  // of the lattice

using LatticeTriangle = std::array<LatticePoint, 3>;

// Equilateral; the triangle at level n has sides of 2^n units.
struct Lattice {
  Vec2 along;
  Vec2 across;
  Vec2 origin;  // px: of the raster in the drawing, where the lattice has its point (0, 0)

  Lattice(double side, Vec2 origin_of_raster)
      : along(side * Vec2{std::cos(kLatticeTurn), std::sin(kLatticeTurn)}),
        across(along * Vec2{std::cos(std::numbers::pi / 3), std::sin(std::numbers::pi / 3)}),
        origin(origin_of_raster) {}

  Vec2 at(LatticePoint p) const { return p.i * along + p.j * across - origin; }
  // Lattice coordinates of a point, not rounded.
  Vec2 coordinates(Vec2 p) const {
    const double d = cross(along, across);
    p += origin;
    return {cross(p, across) / d, cross(along, p) / d};
  }
  Vec2 barycentre(const LatticeTriangle& t) const { return (at(t[0]) + at(t[1]) + at(t[2])) / 3; }
};

LatticePoint midpoint(LatticePoint a, LatticePoint b) {
  return {(a.i + b.i) / 2, (a.j + b.j) / 2};
}

double mask_factor(const ScaleMask* mask, Vec2 p) {
  if (!mask) return 1;
  const int x = std::clamp(static_cast<int>(p.x), 0, mask->width - 1), y = std::clamp(static_cast<int>(p.y), 0, mask->height - 1);
  return static_cast<double>(
      mask->factor[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask->width) + static_cast<std::size_t>(x)]);
}

// The largest factor of a mask near a place.
class LargestFactor {
 public:
  LargestFactor() = default;
  LargestFactor(const ScaleMask& mask, double radius) : tile_(std::max(16, static_cast<int>(std::ceil(radius)))) {
    const auto count = [&](int size) { return (size + tile_ - 1) / tile_; };
    Raster<float> tiles(count(mask.width), count(mask.height));
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x) {
        float& tile = tiles(x / tile_, y / tile_);
        tile = std::max(
            tile, mask.factor[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(x)]);
      }
    largest_ = Raster<float>(tiles.width, tiles.height);
    for (int y = 0; y < tiles.height; ++y)
      for (int x = 0; x < tiles.width; ++x)
        for (int v = std::max(0, y - 1); v <= std::min(tiles.height - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(tiles.width - 1, x + 1); ++u)
            largest_(x, y) = std::max(largest_(x, y), tiles(u, v));
  }

  double around(Vec2 p) const {
    const auto tile = [&](double at, int count) { return std::clamp(static_cast<int>(at) / tile_, 0, count - 1); };
    return static_cast<double>(largest_(tile(p.x, largest_.width), tile(p.y, largest_.height)));
  }

 private:
  int tile_ = 1;  // px
  Raster<float> largest_;
};

// The corners of triangles: a bit for each lattice point around them.
class PointSet {
 public:
  explicit PointSet(const std::vector<LatticeTriangle>& triangles) {
    if (triangles.empty()) return;
    low_ = high_ = triangles[0][0];
    for (const auto& t : triangles)
      for (const auto p : t) {
        low_ = {std::min(low_.i, p.i), std::min(low_.j, p.j)};
        high_ = {std::max(high_.i, p.i), std::max(high_.j, p.j)};
      }
    bits_.assign(static_cast<std::size_t>(high_.i - low_.i + 1) * static_cast<std::size_t>(high_.j - low_.j + 1), false);
    for (const auto& t : triangles) insert(t);
  }

  void insert(const LatticeTriangle& t) {
    for (const auto p : t) bits_[place(p)] = true;
  }
  bool contains(LatticePoint p) const { return bits_[place(p)]; }

 private:
  std::size_t place(LatticePoint p) const {
    return static_cast<std::size_t>(p.j - low_.j) * static_cast<std::size_t>(high_.i - low_.i + 1) +
           static_cast<std::size_t>(p.i - low_.i);
  }

  LatticePoint low_{}, high_{};
  std::vector<bool> bits_;
};

// Which triangles the band needs, and how fine.
class Refinement {
 public:
  Refinement(const Ink& ink, const ScaleMask* mask, const BandOptions& options) : ink_(ink), mask_(mask), options_(options) {
    const auto [low, high] = mask ? std::minmax_element(mask->factor.begin(), mask->factor.end())
                                  : std::pair<std::vector<float>::const_iterator, std::vector<float>::const_iterator>{};
    // A power of two: every triangle of the drawing without a mask is one of this lattice too.
    const double finest = mask ? std::exp2(std::floor(std::log2(std::min(1.0, static_cast<double>(*low))))) : 1,
                 coarsest = mask ? std::max(1.0, static_cast<double>(*high)) : 1;
    levels_ = static_cast<int>(std::ceil(std::log2(coarsest / finest) - 1e-9));
    // Circumdiameter of an equilateral triangle: 2 / sqrt(3) sides.
    filled_ = closed_ink(ink, kFilledHole * options.reach * ink.stroke_width + 0.5, options.threads);
    side_ = finest * options.mesh_size * ink.stroke_width * std::numbers::sqrt3 / 2;
    finest_ = finest;
    if (levels_ > 0) largest_ = LargestFactor(*mask, 2 * side_ * (1 << levels_));
  }

  double side() const { return side_; }

  // The triangles of the lattice whose barycentre is within reach, with hanging points on their sides closed by bisection.
  std::vector<LatticeTriangle> triangles() const {
    const Lattice lattice(side_, ink_.origin);
    std::vector<LatticeTriangle> leaves = leaves_of(lattice);
    if (levels_ == 0) return leaves;
    leaves = conforming(leaves);
    std::erase_if(leaves, [&](const LatticeTriangle& t) { return !in_band(lattice.barycentre(t)); });
    return leaves;
  }

  bool in_band(Vec2 p) const {
    // Triangles that only reach into the image cover its last row of pixels.
    const Vec2 inside{std::clamp(p.x, 0.0, ink_.width() - 1e-6), std::clamp(p.y, 0.0, ink_.height() - 1e-6)};
    if (norm2(p - inside) > side_ * side_) return false;
    p = inside;
    const double reach = options_.reach * ink_.stroke_width * mask_factor(mask_, p), gap = bilinear(ink_.gap, p);
    if (gap < reach || nearest(ink_.mask, p, std::uint8_t{0})) return true;
    return nearest(filled_, p, std::uint8_t{0}) && gap < kFilledHole * reach + 0.5;
  }

 private:
  // The image in lattice coordinates.
  struct Extent {
    Vec2 low{1e30, 1e30}, high{-1e30, -1e30};
  };

  Extent extent_on(const Lattice& lattice) const {
    const double w = ink_.width(), h = ink_.height();
    Extent extent;
    for (const Vec2 corner : {Vec2{0, 0}, Vec2{w, 0}, Vec2{0, h}, Vec2{w, h}}) {
      const Vec2 c = lattice.coordinates(corner);
      extent.low = {std::min(extent.low.x, c.x), std::min(extent.low.y, c.y)};
      extent.high = {std::max(extent.high.x, c.x), std::max(extent.high.y, c.y)};
    }
    return extent;
  }

  // The largest multiple of the side of roots that is no more.
  int root_below(double v) const {
    const int step = 1 << levels_;
    return static_cast<int>(std::floor(v / step)) * step;
  }

  // Row by row, from the coarsest triangles down.
  std::vector<LatticeTriangle> leaves_of(const Lattice& lattice) const {
    const Extent extent = extent_on(lattice);
    const int step = 1 << levels_, first_row = root_below(extent.low.y) - step;
    const int rows = std::max(0, static_cast<int>(std::floor((extent.high.y - first_row) / step)) + 1);
    std::vector<std::vector<LatticeTriangle>> strips(at((rows + kRowsAtOnce - 1) / kRowsAtOnce));
    for_ranges(options_.threads, rows, kRowsAtOnce, [&](int first, int last) {
      auto& strip = strips[at(first / kRowsAtOnce)];
      for (int row = first; row < last; ++row)
        for_each_root(lattice, extent, first_row + row * step,
                      [&](const LatticeTriangle& t) { split_where_needed(lattice, t, levels_, strip); });
    });
    std::vector<LatticeTriangle> leaves;
    for (const auto& strip : strips) leaves.insert(leaves.end(), strip.begin(), strip.end());
    return leaves;
  }

  // Of row j, only the part that meets the image, with a margin of some cells.
  template <class Visit>
  void for_each_root(const Lattice& lattice, const Extent& extent, int j, Visit visit) const {
    const int step = 1 << levels_;
    double first = extent.high.x, last = extent.low.x;
    for (const int jj : {j, j + step})
      for (const double y : {0.0, static_cast<double>(ink_.height())}) {
        const double i = (y + lattice.origin.y - jj * lattice.across.y) / lattice.along.y;
        first = std::min(first, i);
        last = std::max(last, i);
      }
    const double margin = 3.0 * step, left = std::max(extent.low.x, first - margin),
                 right = std::min(extent.high.x, last + margin);
    for (int i = root_below(left) - step; i <= right; i += step) {
      visit({LatticePoint{i, j}, LatticePoint{i + step, j}, LatticePoint{i, j + step}});
      visit({LatticePoint{i + step, j}, LatticePoint{i + step, j + step}, LatticePoint{i, j + step}});
      i += step * clear_cells(lattice.at({i, j}), step);
    }
  }

  // How many of the next cells of a row are out of reach for sure: the interpolated distance to the ink changes by no more than
  // sqrt 2 px a pixel.
  int clear_cells(Vec2 p, int step) const {
    const double largest = mask_ ? finest_ * (1 << levels_) : 1, cell = side_ * step,
                 clear = (bilinear(ink_.gap, p) - far_from_band(cell, largest)) / std::numbers::sqrt2;
    return std::max(0, static_cast<int>(clear / cell) - 3);
  }

  // Largest mask factor allowed for a triangle of this level (its side is 2^level finest sides).
  bool fine_enough(const Lattice& lattice, const LatticeTriangle& t, int level) const {
    const double factor = finest_ * (1 << level) - 1e-9;
    double smallest = mask_factor(mask_, lattice.barycentre(t));
    for (const auto& p : t) smallest = std::min(smallest, mask_factor(mask_, lattice.at(p)));
    return factor <= smallest;
  }

  void split_where_needed(const Lattice& lattice, const LatticeTriangle& t, int level, std::vector<LatticeTriangle>& out) const {
    if (levels_ == 0) {
      if (in_band(lattice.barycentre(t))) out.push_back(t);
      return;
    }
    const Vec2 middle = lattice.barycentre(t);
    if (bilinear(ink_.gap, middle) > far_from_band(side_ * (1 << level), largest_.around(middle))) return;
    if (level == 0 || fine_enough(lattice, t, level)) {
      out.push_back(t);
      return;
    }
    for (const auto& child : quartered(t)) split_where_needed(lattice, child, level - 1, out);
  }

  // Distance to the ink beyond which a triangle with sides of this length, where factors are no larger, has nothing of the band.
  double far_from_band(double side, double largest) const { return options_.reach * ink_.stroke_width * largest + 4 * side; }

  static std::array<LatticeTriangle, 4> quartered(const LatticeTriangle& t) {
    const auto ab = midpoint(t[0], t[1]), bc = midpoint(t[1], t[2]), ca = midpoint(t[2], t[0]);
    return {LatticeTriangle{t[0], ab, ca}, LatticeTriangle{ab, t[1], bc}, LatticeTriangle{ca, bc, t[2]},
            LatticeTriangle{ab, bc, ca}};
  }

  // Splits triangles with hanging points: three, two quarters ("red"), one a bisection ("green").
  std::vector<LatticeTriangle> conforming(std::vector<LatticeTriangle> leaves) const {
    PointSet used(leaves);
    const auto hanging = [&](LatticePoint a, LatticePoint b) {
      return (a.i + b.i) % 2 == 0 && (a.j + b.j) % 2 == 0 && used.contains(midpoint(a, b));
    };
    for (;;) {
      // A side with points at its quarters too must come from a triangle that is split first.
      const auto deep = [&](LatticePoint a, LatticePoint b) {
        if (!hanging(a, b)) return false;
        const auto m = midpoint(a, b);
        return hanging(a, m) || hanging(m, b);
      };
      std::vector<LatticeTriangle> next, split;
      for (const auto& t : leaves) {
        const int sides = hanging(t[0], t[1]) + hanging(t[1], t[2]) + hanging(t[2], t[0]);
        if (sides >= 2 || deep(t[0], t[1]) || deep(t[1], t[2]) || deep(t[2], t[0])) {
          for (const auto& child : quartered(t)) next.push_back(child), split.push_back(child);
        } else {
          next.push_back(t);
        }
      }
      leaves = std::move(next);
      for (const auto& t : split) used.insert(t);
      if (!split.empty()) continue;
      next.clear();
      for (const auto& t : leaves) bisect_hanging(t, hanging, next);
      return next;
    }
  }

  template <class Hanging>
  static void bisect_hanging(const LatticeTriangle& t, const Hanging& hanging, std::vector<LatticeTriangle>& out) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (!hanging(a, b)) continue;
      const auto m = midpoint(a, b);
      out.push_back({a, m, c});
      out.push_back({m, b, c});
      return;
    }
    out.push_back(t);
  }

  const Ink& ink_;
  Raster<std::uint8_t> filled_;
  const ScaleMask* mask_;
  LargestFactor largest_;
  const BandOptions& options_;
  int levels_ = 0;
  double side_ = 1;
  double finest_ = 1;
};

// Sorts items by the integer key of each, stably.
std::vector<int> sorted_by(const std::vector<int>& keys, const std::vector<int>& items) {
  if (items.empty()) return {};
  const auto [low, high] = std::minmax_element(keys.begin(), keys.end());
  std::vector<int> next(at(*high - *low) + 2, 0);
  for (const int item : items) ++next[at(keys[at(item)] - *low) + 1];
  for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
  std::vector<int> sorted(items.size());
  for (const int item : items) sorted[at(next[at(keys[at(item)] - *low)]++)] = item;
  return sorted;
}

std::vector<int> numbers_below(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// Numbers the lattice points that are used, in lattice order.
void number_points(const std::vector<LatticeTriangle>& triangles, const Lattice& lattice, BandMesh& mesh) {
  std::vector<int> i, j;  // per corner
  i.reserve(3 * triangles.size());
  j.reserve(3 * triangles.size());
  for (const auto& triangle : triangles)
    for (const LatticePoint p : triangle) i.push_back(p.i), j.push_back(p.j);
  mesh.faces.resize(triangles.size());
  for (const int c : sorted_by(j, sorted_by(i, numbers_below(i.size())))) {
    const LatticePoint p{i[at(c)], j[at(c)]};
    if (mesh.lattice.empty() || !(mesh.lattice.back() == p)) mesh.lattice.push_back(p);
    mesh.faces[at(c / 3)][at(c % 3)] = static_cast<int>(mesh.lattice.size()) - 1;
  }
  mesh.points.reserve(mesh.lattice.size());
  for (const auto p : mesh.lattice) mesh.points.push_back(lattice.at(p));
}

void link_twins(BandMesh& mesh) {
  std::vector<int> low, high;  // ends of each halfedge
  low.reserve(3 * mesh.faces.size());
  high.reserve(3 * mesh.faces.size());
  for (const auto& t : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [first, second] = std::minmax(t[k], t[k == 2 ? 0 : k + 1]);
      low.push_back(first), high.push_back(second);
    }
  const std::vector<int> halfedges = sorted_by(low, numbers_below(low.size()));
  mesh.twins.assign(halfedges.size(), -1);
  // At most two halfedges join two points, and few start at one.
  for (std::size_t k = 0; k < halfedges.size(); ++k) {
    const int h = halfedges[k];
    for (std::size_t l = k + 1; l < halfedges.size() && low[at(halfedges[l])] == low[at(h)]; ++l) {
      if (high[at(halfedges[l])] != high[at(h)]) continue;
      mesh.twins[at(h)] = halfedges[l];
      mesh.twins[at(halfedges[l])] = h;
      break;
    }
  }
}

// Calls visit(corner) for the corners of a fan of faces around a point, from one of them on.
template <class Visit>
void for_each_of_fan(const std::vector<int>& twins, int corner, const Visit& visit) {
  int c = corner;
  do {
    visit(c);
    const int twin = twins[at(c)];
    c = twin < 0 ? -1 : next_halfedge(twin);
  } while (c >= 0 && c != corner);
  if (c == corner) return;
  // The other way round from where the first ended at the rim.
  for (int h = twins[at(previous_halfedge(corner))]; h >= 0; h = twins[at(previous_halfedge(h))]) visit(h);
}

// Gives each fan of faces around a point a vertex of its own.
void split_touching_vertices(BandMesh& mesh) {
  std::vector<std::uint8_t> has_fan(mesh.points.size(), 0), done(3 * mesh.faces.size(), 0);
  for (int corner = 0; corner < 3 * mesh.face_count(); ++corner) {
    if (done[at(corner)]) continue;
    int vertex = mesh.vertex_of(corner);
    if (has_fan[at(vertex)]) {
      mesh.points.push_back(mesh.points[at(vertex)]);
      mesh.lattice.push_back(mesh.lattice[at(vertex)]);
      vertex = mesh.vertex_count() - 1;
      has_fan.push_back(0);
    }
    has_fan[at(vertex)] = 1;
    for_each_of_fan(mesh.twins, corner, [&](int c) {
      done[at(c)] = 1;
      mesh.faces[at(face_of(c))][at(c % 3)] = vertex;
    });
  }
}

}  // namespace

void number_components(BandMesh& mesh) {
  UnionFind sets(mesh.face_count());
  for (int h = 0; h < 3 * mesh.face_count(); ++h)
    if (mesh.twins[at(h)] >= 0) sets.unite(face_of(h), face_of(mesh.twins[at(h)]));
  mesh.component.assign(mesh.faces.size(), -1);
  mesh.components = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const int root = sets.find(f);
    mesh.component[at(f)] = root == f ? mesh.components++ : mesh.component[at(root)];
  }
}

BandMesh build_band(const Ink& ink, const ScaleMask* mask, const BandOptions& options) {
  BandMesh mesh;
  if (ink.pixels == 0) return mesh;
  const Refinement refinement(ink, mask, options);
  const auto triangles = refinement.triangles();
  number_points(triangles, Lattice(refinement.side(), ink.origin), mesh);
  mesh.side = refinement.side();
  link_twins(mesh);
  split_touching_vertices(mesh);
  number_components(mesh);
  mesh.scale.reserve(mesh.faces.size());
  mesh.on_ink.reserve(mesh.faces.size());
  const auto strokes = closed_ink(ink, options.reach * ink.stroke_width, options.threads);
  for (int f = 0; f < mesh.face_count(); ++f) {
    mesh.scale.push_back(static_cast<float>(mask_factor(mask, mesh.barycentre(f))));
    mesh.on_ink.push_back(nearest_inside(ink.mask, mesh.barycentre(f)));
    mesh.in_stroke.push_back(nearest_inside(strokes, mesh.barycentre(f)));
  }
  return mesh;
}

std::vector<std::uint8_t> boundary_vertices(const BandMesh& mesh) {
  std::vector<std::uint8_t> boundary(mesh.points.size(), 0);
  for (int h = 0; h < 3 * mesh.face_count(); ++h) {
    if (mesh.twins[at(h)] >= 0) continue;
    const auto& t = mesh.faces[at(face_of(h))];
    boundary[at(t[at(h % 3)])] = 1;
    boundary[at(t[at((h + 1) % 3)])] = 1;
  }
  return boundary;
}

}  // namespace inkgrid
