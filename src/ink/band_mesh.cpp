#include "ink/band_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

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
constexpr int kFacesOfTask = 4096;

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
    words_ = Pixels<std::uint64_t>(place({high_.i, high_.j}) / 64 + 1);
    for (const auto& t : triangles) insert(t);
  }

  void insert(const LatticeTriangle& t) {
    for (const auto p : t) words_[place(p) / 64] |= bit(p);
  }
  bool contains(LatticePoint p) const { return (words_[place(p) / 64] & bit(p)) != 0; }

  // All of them in lattice order.
  std::vector<LatticePoint> points() const {
    std::vector<LatticePoint> points;
    const auto width = at(high_.i - low_.i + 1);
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1) {
        const std::size_t at_bit = 64 * w + at(std::countr_zero(rest));
        points.push_back({low_.i + static_cast<int>(at_bit % width), low_.j + static_cast<int>(at_bit / width)});
      }
    return points;
  }

  // How many of them come before the points of each word, in lattice order.
  std::vector<int> counts_before() const {
    std::vector<int> counts(words_.size());
    int count = 0;
    for (std::size_t w = 0; w < words_.size(); ++w) {
      counts[w] = count;
      count += std::popcount(words_[w]);
    }
    return counts;
  }
  int number_of(LatticePoint p, const std::vector<int>& counts_before) const {
    const std::size_t w = place(p) / 64;
    return counts_before[w] + std::popcount(words_[w] & (bit(p) - 1));
  }

 private:
  std::size_t place(LatticePoint p) const { return at(p.j - low_.j) * at(high_.i - low_.i + 1) + at(p.i - low_.i); }
  std::uint64_t bit(LatticePoint p) const { return std::uint64_t{1} << (place(p) % 64); }

  LatticePoint low_{}, high_{};
  Pixels<std::uint64_t> words_;
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
    // The way from a pixel to those around a barycentre of its cell: half a pixel's diagonal, to the barycentre, and a diagonal.
    widest_near_ = kFilledHole * options.reach * ink.stroke_width + 0.5 + 1.2 * side_ + 1.5 * std::numbers::sqrt2 + 0.1;
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
    if (nearest(ink_.mask, p, std::uint8_t{0})) return true;
    const double reach = options_.reach * ink_.stroke_width * mask_factor(mask_, p), gap = bilinear(ink_.gap, p);
    if (gap < reach) return true;
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
    std::size_t count = 0;
    for (const auto& strip : strips) count += strip.size();
    leaves.reserve(count);
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
      const Vec2 p = lattice.at({i, j});
      const int clear = mask_ ? 0 : clear_cells(p);
      if (clear == 0) {
        visit({LatticePoint{i, j}, LatticePoint{i + step, j}, LatticePoint{i, j + step}});
        visit({LatticePoint{i + step, j}, LatticePoint{i + step, j + step}, LatticePoint{i, j + step}});
      }
      i += step * (mask_ ? clear_cells_after(p, step) : std::max(0, clear - 1));
    }
  }

  // Without a mask: how many cells of a row, from that of p on, are out of reach for sure.
  int clear_cells(Vec2 p) const {
    return std::max(0, static_cast<int>((static_cast<double>(nearest_inside(ink_.gap, p)) - widest_near_) / side_));
  }

  // With a mask: how many of the next cells are.  The interpolated distance to the ink changes by no more than sqrt 2 px a pixel.
  int clear_cells_after(Vec2 p, int step) const {
    const double cell = side_ * step,
                 clear = (bilinear(ink_.gap, p) - far_from_band(cell, finest_ * (1 << levels_))) / std::numbers::sqrt2;
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
  double widest_near_ = 0;  // px: where a pixel is farther from the ink, no triangle of its cell is in the band without a mask
};

// Numbers the lattice points that are used, in lattice order.
void number_points(const std::vector<LatticeTriangle>& triangles, const Lattice& lattice, BandMesh& mesh) {
  const PointSet used(triangles);
  const std::vector<int> counts = used.counts_before();
  mesh.faces.reserve(triangles.size());
  for (const auto& t : triangles)
    mesh.faces.push_back({used.number_of(t[0], counts), used.number_of(t[1], counts), used.number_of(t[2], counts)});
  mesh.lattice = used.points();
  mesh.points.reserve(mesh.lattice.size());
  for (const auto p : mesh.lattice) mesh.points.push_back(lattice.at(p));
}

void link_twins(BandMesh& mesh) {
  struct Entry {
    int high, halfedge;
  };
  const auto for_each_halfedge = [&](auto visit) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = mesh.faces[f][k], b = mesh.faces[f][k == 2 ? 0 : k + 1];
        visit(std::min(a, b), Entry{std::max(a, b), static_cast<int>(3 * f + k)});
      }
  };
  std::vector<int> starts(mesh.points.size() + 1, 0);  // of the entries by the lower end
  for_each_halfedge([&](int low, Entry) { ++starts[at(low) + 1]; });
  for (std::size_t v = 0; v + 1 < starts.size(); ++v) starts[v + 1] += starts[v];
  std::vector<Entry> entries(3 * mesh.faces.size());
  std::vector<int> next(starts.begin(), starts.end() - 1);
  for_each_halfedge([&](int low, Entry entry) { entries[at(next[at(low)]++)] = entry; });
  mesh.twins.assign(entries.size(), -1);
  // At most two halfedges join two points, and few start at one.
  for (std::size_t v = 0; v + 1 < starts.size(); ++v)
    for (int k = starts[v]; k < starts[v + 1]; ++k)
      for (int l = k + 1; l < starts[v + 1]; ++l) {
        if (entries[at(l)].high != entries[at(k)].high) continue;
        mesh.twins[at(entries[at(k)].halfedge)] = entries[at(l)].halfedge;
        mesh.twins[at(entries[at(l)].halfedge)] = entries[at(k)].halfedge;
        break;
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

// What the pixel at the barycentre of each face is.
void describe_faces(const Ink& ink, const ScaleMask* mask, const Raster<std::uint8_t>& strokes, int threads, BandMesh& mesh) {
  mesh.scale.resize(mesh.faces.size());
  mesh.on_ink.resize(mesh.faces.size());
  mesh.in_stroke.resize(mesh.faces.size());
  for_ranges(threads, mesh.face_count(), kFacesOfTask, [&](int first, int last) {
    for (int f = first; f < last; ++f) {
      const Vec2 p = mesh.barycentre(f);
      mesh.scale[at(f)] = static_cast<float>(mask_factor(mask, p));
      mesh.on_ink[at(f)] = nearest_inside(ink.mask, p);
      mesh.in_stroke[at(f)] = nearest_inside(strokes, p);
    }
  });
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
  mesh.side = refinement.side();
  Raster<std::uint8_t> strokes;
  const auto link_triangles = [&] {
    number_points(triangles, Lattice(refinement.side(), ink.origin), mesh);
    link_twins(mesh);
    split_touching_vertices(mesh);
    number_components(mesh);
  };
  at_once(options.threads, link_triangles, [&] { strokes = closed_ink(ink, options.reach * ink.stroke_width, options.threads); });
  describe_faces(ink, mask, strokes, options.threads, mesh);
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
