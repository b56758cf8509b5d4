#include "compare/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "base/at.h"
#include "base/polyline.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr double kStep = 1.5;                            // px
constexpr double kCorner = 15 * std::numbers::pi / 180;  // a turn above this is kept
constexpr double kCell = 8;                              // px
constexpr double kSlack = 1e-6;                          // of a piece's length, and px around a piece's box
constexpr double kParallel = 1e-12;                      // px^2
constexpr std::size_t kMostPairs = 4000000;
constexpr double kSeam = 1e-3;  // px

struct Piece {
  Vec2 a, b;
  int line = 0;
  int place = 0;   // in its polyline
  int pieces = 0;  // of its polyline
  bool closed = false;
};

struct InCell {
  std::int64_t x, y;
  int piece;

  friend auto operator<=>(const InCell&, const InCell&) = default;
};

double turn(Vec2 before, Vec2 after) {
  return std::abs(std::atan2(cross(before, after), dot(before, after)));
}

std::vector<Piece> all_pieces(const std::vector<std::vector<Vec2>>& polylines) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < polylines.size(); ++k) {
    const auto& line = polylines[k];
    const int n = static_cast<int>(line.size()) - 1;
    const bool closed = is_closed(line);
    for (int i = 0; i < n; ++i) pieces.push_back({line[at(i)], line[at(i + 1)], static_cast<int>(k), i, n, closed});
  }
  return pieces;
}

// Long pieces are cut, so that each part covers four cells at most.
void append_cells(std::vector<InCell>& cells, const Piece& piece, int index) {
  const int parts = std::max(1, static_cast<int>(std::ceil(norm(piece.b - piece.a) / kCell)));
  for (int part = 0; part < parts; ++part) {
    const Vec2 a = lerp(piece.a, piece.b, static_cast<double>(part) / parts);
    const Vec2 b = lerp(piece.a, piece.b, static_cast<double>(part + 1) / parts);
    const auto low = [](double u, double v) { return static_cast<std::int64_t>(std::floor((std::min(u, v) - kSlack) / kCell)); };
    const auto high = [](double u, double v) { return static_cast<std::int64_t>(std::floor((std::max(u, v) + kSlack) / kCell)); };
    for (std::int64_t x = low(a.x, b.x); x <= high(a.x, b.x); ++x)
      for (std::int64_t y = low(a.y, b.y); y <= high(a.y, b.y); ++y) cells.push_back({x, y, index});
  }
}

bool are_neighbours(const Piece& a, const Piece& b) {
  if (a.line != b.line) return false;
  const int gap = std::abs(a.place - b.place);
  return gap <= 1 || (a.closed && a.pieces - gap <= 1);
}

std::optional<Vec2> crossing(const Piece& p, const Piece& q) {
  const Vec2 r = p.b - p.a, s = q.b - q.a, between = q.a - p.a;
  const double area = cross(r, s);
  if (std::abs(area) <= kParallel) return std::nullopt;
  const double t = cross(between, s) / area, u = cross(between, r) / area;
  const auto inside = [](double v) { return v >= -kSlack && v <= 1 + kSlack; };
  return inside(t) && inside(u) ? std::optional(p.a + t * r) : std::nullopt;
}

std::vector<InCell> cells_of(const std::vector<Piece>& pieces) {
  std::vector<InCell> cells;
  for (std::size_t i = 0; i < pieces.size(); ++i) append_cells(cells, pieces[i], static_cast<int>(i));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

// Pairs of pieces that cross, in ascending order.
std::vector<std::pair<int, int>> crossing_pairs(const std::vector<Piece>& pieces) {
  const std::vector<InCell> cells = cells_of(pieces);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = i + 1; j < cells.size() && cells[j].x == cells[i].x && cells[j].y == cells[i].y; ++j) {
      const Piece &p = pieces[at(cells[i].piece)], &q = pieces[at(cells[j].piece)];
      if (!are_neighbours(p, q) && crossing(p, q)) pairs.emplace_back(cells[i].piece, cells[j].piece);
      if (pairs.size() > kMostPairs) throw Error(ErrorCode::file, "the curves cross each other too often to be compared");
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

bool is_closed(const std::vector<Vec2>& polyline) {
  return norm(polyline.front() - polyline.back()) < kSeam;
}

std::vector<Vec2> thinned(const std::vector<Vec2>& polyline) {
  const std::vector<double> lengths = lengths_along(polyline);
  const double length = lengths.back();
  if (length < 2 * kStep) return polyline;
  const int n = static_cast<int>(std::ceil(length / kStep));
  std::vector<double> places;
  for (int k = 0; k <= n; ++k) places.push_back(length * k / n);
  for (std::size_t i = 1; i + 1 < polyline.size(); ++i)
    if (turn(polyline[i] - polyline[i - 1], polyline[i + 1] - polyline[i]) > kCorner) places.push_back(lengths[i]);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<Vec2> points;
  points.reserve(places.size());
  for (const double place : places) points.push_back(point_at(polyline, lengths, place));
  return points;
}

std::vector<Vec2> crossings(const std::vector<std::vector<Vec2>>& polylines) {
  const std::vector<Piece> pieces = all_pieces(polylines);
  std::vector<Vec2> points;
  for (const auto& [p, q] : crossing_pairs(pieces)) points.push_back(*crossing(pieces[at(p)], pieces[at(q)]));
  return points;
}

}  // namespace inkgrid
