// What:   the walk through triangles behind streamlines.h.
#include "pictures/streamlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/at.h"
#include "base/raster.h"

namespace inkgrid {

namespace {

// Which lines passed where: per direction, per square cell, the number of the last line.
class Occupancy {
 public:
  Occupancy(const BandMesh& mesh, double cell) : cell_(cell) {
    Vec2 high = mesh.points.front();
    low_ = high;
    for (const Vec2 p : mesh.points) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const int width = 1 + static_cast<int>((high.x - low_.x) / cell_), height = 1 + static_cast<int>((high.y - low_.y) / cell_);
    lines_.fill(Raster<int>(width, height, -1));
  }
  int& line_at(Vec2 p, bool along_s) {
    Raster<int>& lines = lines_[along_s ? 0 : 1];
    const int x = static_cast<int>((p.x - low_.x) / cell_), y = static_cast<int>((p.y - low_.y) / cell_);
    return lines(std::clamp(x, 0, lines.width - 1), std::clamp(y, 0, lines.height - 1));
  }

 private:
  double cell_;
  Vec2 low_;
  std::array<Raster<int>, 2> lines_;
};

struct Heading {
  Vec2 direction;
  bool along_s;
};

// The direction of the face's frame that turns least.
Heading straight_on(const Charts& charts, int face, Vec2 direction) {
  const Vec2 s = charts.s[at(face)], t = charts.t[at(face)];
  const double along_s = dot(s, direction), along_t = dot(t, direction);
  if (std::abs(along_s) >= std::abs(along_t)) return {along_s < 0 ? -s : s, true};
  return {along_t < 0 ? -t : t, false};
}

struct Exit {
  int halfedge = -1;
  double distance = std::numeric_limits<double>::infinity();
};

Exit exit_of(const BandMesh& mesh, int face, Vec2 from, Vec2 direction) {
  Exit exit;
  for (int k = 0; k < 3; ++k) {
    const Vec2 a = mesh.points[at(mesh.faces[at(face)][at(k)])], b = mesh.points[at(mesh.faces[at(face)][at((k + 1) % 3)])];
    const double approach = -cross(b - a, direction);
    if (approach <= 0) continue;
    const double distance = std::max(0.0, cross(b - a, from - a) / approach);
    if (distance < exit.distance) exit = {3 * face + k, distance};
  }
  return exit;
}

struct Walk {
  const BandMesh& mesh;
  const Charts& charts;
  Occupancy& occupancy;
  double length;
  int line;

  // One side of a line: the points after `start`.
  std::vector<Vec2> run(int face, Vec2 start, Vec2 direction) {
    std::vector<Vec2> points;
    Vec2 p = start;
    int entry = -1;
    for (double rest = length; rest > 0;) {
      const Heading heading = straight_on(charts, face, direction);
      int& occupied = occupancy.line_at(p, heading.along_s);
      if (occupied >= 0 && occupied != line) break;
      occupied = line;
      const Exit exit = exit_of(mesh, face, p, heading.direction);
      if (exit.halfedge < 0 || exit.halfedge == entry) break;
      p += std::min(exit.distance, rest) * heading.direction;
      points.push_back(p);
      rest -= std::max(exit.distance, 1e-3 * length);
      entry = mesh.twins[at(exit.halfedge)];
      if (entry < 0) break;
      face = face_of(entry);
      direction = heading.direction;
    }
    return points;
  }

  std::vector<Vec2> both_sides(int face, Vec2 start, Vec2 direction) {
    std::vector<Vec2> points = run(face, start, -direction);
    std::reverse(points.begin(), points.end());
    points.push_back(start);
    const std::vector<Vec2> ahead = run(face, start, direction);
    points.insert(points.end(), ahead.begin(), ahead.end());
    return points;
  }
};

}  // namespace

std::vector<Streamline> spread_streamlines(const BandMesh& mesh, const Charts& charts, const StreamlineOptions& options) {
  std::vector<Streamline> lines;
  if (mesh.faces.empty()) return lines;
  Occupancy occupancy(mesh, options.spacing);
  for (int f = 0; f < mesh.face_count(); ++f)
    for (const bool along_s : {true, false}) {
      const Vec2 start = mesh.barycentre(f);
      if (occupancy.line_at(start, along_s) >= 0) continue;
      Walk walk{mesh, charts, occupancy, options.length, static_cast<int>(lines.size())};
      lines.push_back({walk.both_sides(f, start, along_s ? charts.s[at(f)] : charts.t[at(f)]), along_s});
    }
  return lines;
}

}  // namespace inkgrid
