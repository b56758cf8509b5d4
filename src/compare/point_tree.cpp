#include "compare/point_tree.h"

#include <algorithm>
#include <cmath>

#include "base/at.h"

namespace inkgrid {

PointTree::PointTree(const std::vector<Vec2>& points) {
  for (const Vec2 point : points) nodes_.push_back({point, size(), false});
  build(0, size());
}

void PointTree::build(int begin, int end) {
  if (end - begin < 2) return;
  const auto first = nodes_.begin() + begin, last = nodes_.begin() + end;
  const auto [left, right] = std::minmax_element(first, last, [](const Node& a, const Node& b) { return a.point.x < b.point.x; });
  const auto [top, bottom] = std::minmax_element(first, last, [](const Node& a, const Node& b) { return a.point.y < b.point.y; });
  const bool by_y = bottom->point.y - top->point.y > right->point.x - left->point.x;
  const int middle = begin + (end - begin) / 2;
  std::nth_element(first, nodes_.begin() + middle, last, [&](const Node& a, const Node& b) {
    const double u = by_y ? a.point.y : a.point.x, v = by_y ? b.point.y : b.point.x;
    return u != v ? u < v : a.index < b.index;
  });
  nodes_[at(middle)].by_y = by_y;
  build(begin, middle);
  build(middle + 1, end);
}

void PointTree::nearest(Vec2 p, int begin, int end, double& squared) const {
  if (begin >= end) return;
  const int middle = begin + (end - begin) / 2;
  const Node& n = node(middle);
  squared = std::min(squared, norm2(p - n.point));
  const double beyond = n.by_y ? p.y - n.point.y : p.x - n.point.x;
  const auto left = [&] { nearest(p, begin, middle, squared); };
  const auto right = [&] { nearest(p, middle + 1, end, squared); };
  beyond < 0 ? left() : right();
  if (beyond * beyond < squared) beyond < 0 ? right() : left();
}

double PointTree::distance(Vec2 p, double bound) const {
  const double limit = bound * bound;
  double squared = limit;
  nearest(p, 0, size(), squared);
  return squared < limit ? std::sqrt(squared) : std::numeric_limits<double>::infinity();
}

std::vector<int> PointTree::within(Vec2 p, double radius) const {
  std::vector<int> indices;
  search(p, radius * radius, 0, size(), [&](int index, double) {
    indices.push_back(index);
    return false;
  });
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace inkgrid
