// Draws a line, five pixels thick, and finds its curve.
#include <inkgrid/inkgrid.h>

#include <cstdio>

int main() {
  inkgrid::Image image{200, 100, std::vector<std::uint8_t>(200 * 100, 255)};
  for (std::size_t y = 48; y < 53; ++y)
    for (std::size_t x = 20; x < 180; ++x) image.grey[200 * y + x] = 0;
  for (const inkgrid::Curve& curve : inkgrid::vectorize(image).drawing.curves) {
    const inkgrid::Vec2 a = curve.segments.front().p0, b = curve.segments.back().p3;
    std::printf("a curve %.1f px wide from (%.1f, %.1f) to (%.1f, %.1f)\n", curve.width, a.x, a.y, b.x, b.y);
  }
}
