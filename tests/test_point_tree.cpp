// The k-d tree answers as a look at all points does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "compare/point_tree.h"

namespace inkgrid {
namespace {

std::vector<Vec2> scattered(int count, double spacing, std::mt19937& random) {
  // Multiples of the spacing: many points are equal or on one line.
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i)
    points.push_back({spacing * static_cast<double>(random() % 20), spacing * static_cast<double>(random() % 40)});
  return points;
}

TEST(PointTree, AgreesWithAllPoints) {
  std::mt19937 random(5);
  for (const int count : {0, 1, 2, 3, 10, 500}) {
    const auto points = scattered(count, 0.5, random);
    const PointTree tree(points);
    for (int k = 0; k < 200; ++k) {
      const Vec2 p = scattered(1, 0.25, random).front() + Vec2{1, 2};
      const double radius = static_cast<double>(random() % 9) / 4;
      std::vector<int> near;
      double nearest = std::numeric_limits<double>::infinity();
      bool odd_near = false;
      for (int i = 0; i < count; ++i) {
        const double distance = norm(p - points[static_cast<std::size_t>(i)]);
        nearest = std::min(nearest, distance);
        if (distance <= radius) near.push_back(i);
        odd_near = odd_near || (distance < radius && i % 2 == 1);
      }
      EXPECT_EQ(tree.within(p, radius), near);
      EXPECT_EQ(tree.any_within(p, radius, [](int i) { return i % 2 == 1; }), odd_near);
      EXPECT_DOUBLE_EQ(tree.distance(p), nearest);
      EXPECT_EQ(std::isfinite(tree.distance(p, radius)), nearest < radius);
    }
  }
}

}  // namespace
}  // namespace inkgrid
