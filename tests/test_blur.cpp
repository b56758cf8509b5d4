// A Gaussian, against its sum by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/blur.h"

namespace inkgrid {
namespace {

Raster<float> some_values() {
  Raster<float> values(23, 150);
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x)
      if (y % 50 > 10 && x > 3) values(x, y) = static_cast<float>((31 * x * x + 17 * y + x * y) % 101);
  return values;
}

double weighted_sum(const Raster<float>& values, int x, int y, double sigma) {
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  double sum = 0, weights = 0;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const double weight = std::exp(-0.5 * (dx * dx + dy * dy) / (sigma * sigma));
      sum +=
          weight * static_cast<double>(values(std::clamp(x + dx, 0, values.width - 1), std::clamp(y + dy, 0, values.height - 1)));
      weights += weight;
    }
  return sum / weights;
}

TEST(Blur, IsTheWeightedMeanAroundEachPixel) {
  const Raster<float> values = some_values();
  for (const double sigma : {0.6, 1.5, 4.0}) {
    const Raster<float> soft = blurred(values, sigma, 1);
    for (int y = 0; y < values.height; y += 7)
      for (int x = 0; x < values.width; ++x) EXPECT_NEAR(soft(x, y), weighted_sum(values, x, y, sigma), 1e-3) << x << ' ' << y;
  }
}

TEST(Blur, IsTheSameOnAnyNumberOfThreads) {
  const Raster<float> values = some_values();
  EXPECT_TRUE(std::ranges::equal(blurred(values, 2, 1).data, blurred(values, 2, 3).data));
}

}  // namespace
}  // namespace inkgrid
