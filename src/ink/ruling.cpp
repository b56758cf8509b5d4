#include "ink/ruling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/at.h"
#include "base/histogram.h"

namespace inkgrid {
namespace {

constexpr int kStrips = 32;        // the page is cut into so many across the lines, which need not be quite straight then
constexpr double kCovered = 0.7;   // of a strip's breadth, by a line
constexpr double kAlike = 0.15;    // of the distance of lines: they differ by no more
constexpr int kFewest = 6;         // lines of a strip that have another one at that distance
constexpr double kPage = 0.5;      // of the page, that lines rule, along it and across
constexpr double kUneven = 1.5;    // times the usual darkness: what was not drawn over is no darker
constexpr double kDarkest = 0.95;  // of the pixels of lines that nothing was drawn over

// A strip of the page, lines across it.
struct Strip {
  std::vector<double> lines;  // px along the page
  double distance = 0;        // px, of most lines from the next; 0 where they are not regular
};

// The page, turned where columns are looked for.
struct Page {
  const Raster<float>& darkness;
  bool turned;

  int length() const { return turned ? darkness.width : darkness.height; }
  int breadth() const { return turned ? darkness.height : darkness.width; }
  float operator()(int along, int across) const { return turned ? darkness(along, across) : darkness(across, along); }
  int first(int strip) const { return static_cast<int>(static_cast<long>(strip) * breadth() / kStrips); }
};

// How many pixels across each strip are darker than paper there or a pixel further, for each place along the page.
std::vector<std::vector<int>> covered(const Page& page, float weak) {
  std::vector<std::vector<int>> cover(kStrips, std::vector<int>(at(page.length())));
  const Raster<float>& d = page.darkness;
  for (int y = 0, strip = 0; y < d.height; ++y) {
    const float* const here = &d(0, y);
    const float* const above = &d(0, std::max(0, y - 1));
    const float* const below = &d(0, std::min(d.height - 1, y + 1));
    while (page.turned && y >= page.first(strip + 1)) ++strip;
    if (page.turned) {
      std::vector<int>& counts = cover[at(strip)];
      for (int x = 1; x + 1 < d.width; ++x) counts[at(x)] += std::max(std::max(here[x - 1], here[x]), here[x + 1]) > weak;
      continue;
    }
    for (int k = 0; k < kStrips; ++k) {
      int count = 0;
      for (int x = page.first(k); x < page.first(k + 1); ++x) count += std::max(std::max(above[x], here[x]), below[x]) > weak;
      cover[at(k)][at(y)] = count;
    }
  }
  return cover;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool alike(double a, double b) {
  return std::abs(a - b) <= kAlike * b;
}

Strip strip_of(const std::vector<int>& cover, double enough) {
  Strip strip;
  const auto length = static_cast<int>(cover.size());
  for (int along = 0; along < length; ++along) {
    const int first = along;
    while (along < length && cover[at(along)] >= enough) ++along;
    if (along > first) strip.lines.push_back((first + along) / 2.0);
  }
  if (strip.lines.size() < kFewest) return strip;
  std::vector<double> distances;
  for (std::size_t i = 1; i < strip.lines.size(); ++i) distances.push_back(strip.lines[i] - strip.lines[i - 1]);
  const double usual = median(distances);
  const auto has_line_at = [&](double place) {
    const auto next = std::lower_bound(strip.lines.begin(), strip.lines.end(), place - kAlike * usual);
    return next != strip.lines.end() && *next <= place + kAlike * usual;
  };
  const auto regular = std::count_if(strip.lines.begin(), strip.lines.end(),
                                     [&](double line) { return has_line_at(line - usual) || has_line_at(line + usual); });
  if (regular >= kFewest && static_cast<double>(regular) * usual > kPage * length) strip.distance = usual;
  return strip;
}

// Strips that lines rule at one distance, where they are most of the page; else none.
std::vector<int> ruled(const std::vector<Strip>& strips) {
  std::vector<double> distances;
  for (const Strip& strip : strips)
    if (strip.distance > 0) distances.push_back(strip.distance);
  if (distances.empty()) return {};
  const double usual = median(distances);
  std::vector<int> found;
  for (int k = 0; k < kStrips; ++k)
    if (strips[at(k)].distance > 0 && alike(strips[at(k)].distance, usual)) found.push_back(k);
  return static_cast<double>(found.size()) > kPage * kStrips ? found : std::vector<int>{};
}

// Of the lines, most of which nothing was drawn over.
Ruling darkness_of_lines(const Page& page, const std::vector<Strip>& strips, const std::vector<int>& ruled) {
  Histogram darkness(1024, 0, 1);
  for (const int k : ruled)
    for (const double line : strips[at(k)].lines) {
      const int middle = static_cast<int>(line), first = std::max(0, middle - 2), last = std::min(page.length() - 1, middle + 2);
      for (int across = page.first(k); across < page.first(k + 1); ++across) {
        float most = 0;
        for (int along = first; along <= last; ++along) most = std::max(most, page(along, across));
        darkness.add(most);
      }
    }
  const double usual = darkness.quantile(0.5, 0, 1);
  return {usual, darkness.quantile(kDarkest, 0, kUneven * usual)};
}

Ruling ruling_of(const Page& page, double weak) {
  if (page.breadth() < 2 * kStrips) return {};
  const auto cover = covered(page, static_cast<float>(weak));
  std::vector<Strip> strips;
  for (int k = 0; k < kStrips; ++k) strips.push_back(strip_of(cover[at(k)], kCovered * (page.first(k + 1) - page.first(k))));
  const std::vector<int> found = ruled(strips);
  return found.empty() ? Ruling{} : darkness_of_lines(page, strips, found);
}

}  // namespace

Ruling ruling_of(const Raster<float>& darkness, double weak) {
  const Ruling rows = ruling_of(Page{darkness, false}, weak), columns = ruling_of(Page{darkness, true}, weak);
  return {std::max(rows.usual, columns.usual), std::max(rows.most, columns.most)};
}

}  // namespace inkgrid
