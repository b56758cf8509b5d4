// What:   nearest points, and points within a distance, of a fixed set.
// Source: k-d tree, each node split at the median of its wider side.
// Cost:   n log n to build; about log n a question.
#pragma once

#include <limits>
#include <vector>

#include "base/at.h"
#include "inkgrid/vec2.h"

namespace inkgrid {

class PointTree {
 public:
  PointTree() = default;
  explicit PointTree(const std::vector<Vec2>& points);

  // To the nearest point; infinite where there is none nearer than `bound`.
  double distance(Vec2 p, double bound = std::numeric_limits<double>::infinity()) const;

  // Indices of all points at most `radius` away, in ascending order.
  std::vector<int> within(Vec2 p, double radius) const;

  // Whether `accept(index)` holds for a point nearer than `radius`.
  template <class Accept>
  bool any_within(Vec2 p, double radius, Accept accept) const {
    return search(p, radius * radius, 0, size(),
                  [&](int index, double squared) { return squared < radius * radius && accept(index); });
  }

 private:
  struct Node {
    Vec2 point;
    int index = 0;
    bool by_y = false;  // the side that this node splits
  };

  int size() const { return static_cast<int>(nodes_.size()); }
  const Node& node(int i) const { return nodes_[at(i)]; }
  void build(int begin, int end);
  void nearest(Vec2 p, int begin, int end, double& squared) const;

  // Calls `visit(index, squared distance)` for the points at most sqrt(squared_radius) away, until it returns true.
  template <class Visit>
  bool search(Vec2 p, double squared_radius, int begin, int end, const Visit& visit) const {
    if (begin >= end) return false;
    const int middle = begin + (end - begin) / 2;
    const Node& n = node(middle);
    const double squared = norm2(p - n.point);
    if (squared <= squared_radius && visit(n.index, squared)) return true;
    const double beyond = n.by_y ? p.y - n.point.y : p.x - n.point.x;
    const bool both = beyond * beyond <= squared_radius;
    return ((beyond <= 0 || both) && search(p, squared_radius, begin, middle, visit)) ||
           ((beyond >= 0 || both) && search(p, squared_radius, middle + 1, end, visit));
  }

  std::vector<Node> nodes_;  // the root of a range is in its middle
};

}  // namespace inkgrid
