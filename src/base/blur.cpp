#include "base/blur.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/at.h"
#include "base/parallel.h"

namespace inkgrid {
namespace {

constexpr int kBlurredRows = 128;  // at a time

std::vector<float> gaussian_kernel(double sigma) {
  const int r = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> kernel;
  float sum = 0;
  for (int i = -r; i <= r; ++i) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
    sum += kernel.back();
  }
  for (float& k : kernel) k /= sum;
  return kernel;
}

// A row of a raster blurred along itself.
struct BlurredRow {
  int first = 0, end = 0;  // what is not zero of it
  std::vector<float> values;

  // Beyond the border a row goes on as it ends.
  void blur(const Raster<float>& in, int y, const std::vector<float>& kernel) {
    const int r = static_cast<int>(kernel.size() / 2);
    const float* const row = &in.data[in.index(0, y)];
    first = static_cast<int>(std::find_if(row, row + in.width, [](float value) { return value != 0; }) - row);
    end = in.width;
    while (end > 0 && row[end - 1] == 0) --end;
    if (first >= end) return;
    first = std::max(0, first - r);
    end = std::min(in.width, end + r);
    if (first >= end) return;
    std::vector<float> line;
    for (int x = first - r; x < end + r; ++x) line.push_back(row[std::clamp(x, 0, in.width - 1)]);
    values.assign(at(in.width), 0.0F);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (int x = first; x < end; ++x) values[at(x)] += kernel[k] * line[at(x - first) + k];
  }
};

// Rows top .. bottom - 1.
void blur_rows(const Raster<float>& in, const std::vector<float>& kernel, int top, int bottom, Raster<float>& out) {
  const int r = static_cast<int>(kernel.size() / 2);
  std::vector<BlurredRow> rows(kernel.size());  // of each in turn
  for (int y = std::max(0, top - r); y < std::min(top + r, in.height); ++y) rows[at(y) % rows.size()].blur(in, y, kernel);
  for (int y = top; y < bottom; ++y) {
    if (y + r < in.height) rows[at(y + r) % rows.size()].blur(in, y + r, kernel);
    for (int k = -r; k <= r; ++k) {
      const BlurredRow& from = rows[at(std::clamp(y + k, 0, in.height - 1)) % rows.size()];
      const float weight = kernel[at(k + r)];
      for (int x = from.first; x < from.end; ++x) out(x, y) += weight * from.values[at(x)];
    }
  }
}

}  // namespace

Raster<float> blurred(const Raster<float>& in, double sigma, int threads) {
  const auto kernel = gaussian_kernel(sigma);
  Raster<float> out(in.width, in.height);
  for_ranges(threads, in.height, kBlurredRows, [&](int top, int bottom) { blur_rows(in, kernel, top, bottom, out); });
  return out;
}

}  // namespace inkgrid
