#include "ink/shade.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/filters.h"
#include "base/histogram.h"

namespace inkgrid {
namespace {

constexpr double kWindow = 1.5;    // pens, the half-width: what is narrower is no area
constexpr float kDarker = 0.06f;   // of the light: areas are by so much, against the paper
constexpr float kFaintest = 0.1f;  // darkness of the strokes that are looked for
constexpr float kEven = 0.06f;     // darkness against its surroundings of what is flat,
constexpr double kFlat = 0.6;      // and how much of a shade is, but for strokes
constexpr float kSlope = 0.04f;    // of white a px: where light changes by more, a shade ends
constexpr double kLarge = 20;      // pens squared: a shade that strokes tell is larger,
constexpr double kPart = 0.01;     // or than so much of the picture
constexpr double kSmall = 4;       // pens squared: one that is like those is
constexpr double kAlike = 0.1;     // of the light: it may be darker by so much
constexpr double kStrokes = 4;     // pens squared, of strokes in a shade

// The length of the middle one, given how many there are of each.
int middle_length(const std::vector<long>& lengths) {
  const long total = std::accumulate(lengths.begin(), lengths.end(), 0L);
  long seen = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (2 * (seen += lengths[i]) > total) return static_cast<int>(i);
  return 0;
}

// About the width of the pen, px: the usual length of runs of ink, along rows or columns; 0 without ink.
int usual_run(const Raster<std::uint8_t>& ink) {
  const auto counts = at(std::max(ink.width, ink.height)) + 1;
  std::vector<long> in_rows(counts), in_columns(counts);
  std::vector<int> column(at(ink.width));
  const auto end = [](int& run, std::vector<long>& lengths) {
    if (run > 0) ++lengths[at(run)];
    run = 0;
  };
  for (int y = 0; y < ink.height; ++y) {
    int row = 0;
    for (int x = 0; x < ink.width; ++x) {
      if (ink(x, y)) {
        ++row;
        ++column[at(x)];
      } else {
        end(row, in_rows);
        end(column[at(x)], in_columns);
      }
    }
    end(row, in_rows);
  }
  for (int& run : column) end(run, in_columns);
  return std::min(middle_length(in_rows), middle_length(in_columns));
}

// What is dark and narrower than the window, a square, filled in.
Raster<float> closed(Raster<float> light, int radius) {
  return window_extreme(window_extreme(std::move(light), radius, std::greater<>()), radius, std::less<>());
}

// The extreme of a square that stands on its corner.
template <class Before>
Raster<float> standing_extreme(Raster<float> light, int radius, Before before) {
  const int reach = static_cast<int>(std::lround(radius / std::numbers::sqrt2));
  filter_diagonals(light, [&](std::vector<float>& line) { slide_extreme(line, reach, before); });
  return window_extreme(std::move(light), 1, before);  // diagonals alone reach every second pixel
}

// What neither square fits into: together they come near to the edges of what is round or has a corner.
Raster<float> closed_both_ways(const Raster<float>& light, int radius) {
  Raster<float> closed_light = closed(light, radius);
  const Raster<float> standing = standing_extreme(standing_extreme(light, radius, std::greater<>()), radius, std::less<>());
  for (std::size_t i = 0; i < standing.data.size(); ++i) closed_light.data[i] = std::min(closed_light.data[i], standing.data[i]);
  return closed_light;
}

// Areas are darker than the paper that are wider than the window.
bool has_wide_areas(const View& view, const Paper& paper, int radius) {
  const int reach = (radius + paper.block - 1) / paper.block + 1;
  const Raster<float> level = closed(lightest_of_blocks(view, paper.block), reach);
  for (std::size_t i = 0; i < level.data.size(); ++i)
    if (level.data[i] < (1 - kDarker) * paper.level.data[i]) return true;
  return false;
}

Raster<float> light_of(const View& view) {
  Raster<float> light(view.width(), view.height());
  for (std::size_t i = 0; i < light.data.size(); ++i) light.data[i] = static_cast<float>(view[i]) / 255.0f;
  return light;
}

// Parts of the picture that are darker than the paper around them and wider than the window.
class Areas {
 public:
  Areas(const View& view, const Raster<float>& darkness, int pen, int radius)
      : pen_(pen),
        radius_(radius),
        view_(view),
        paper_(closed_both_ways(light_of(view), radius)),
        part_(view.width(), view.height()),
        joined_(view.width(), view.height()) {
    Histogram contrasts(1024, 0, 1);
    for (std::size_t i = 0; i < paper_.data.size(); ++i) {
      contrasts.add(contrast(i));
      if (paper_.data[i] * (1 - darkness.data[i]) < (1 - kDarker) * light(i)) part_.data[i] = kDark;
    }
    full_ = static_cast<float>(contrasts.quantile(0.9, kFaintest, 1));
  }

  // Tells shades from patches of ink: strokes run through them, or they are no darker than those that strokes run through.
  bool has_shades(const Raster<float>& darkness) {
    std::vector<Area> areas;
    double darkest = 2;
    for (std::size_t i = 0; i < part_.data.size(); ++i) {
      if (part_.data[i] != kDark) continue;
      part_.data[i] = kEdge;
      std::vector<int> pixels = joined_to({static_cast<int>(i)}, [&](int p) {
        if (part_.data[at(p)] != kDark) return false;
        part_.data[at(p)] = kEdge;
        return true;
      });
      if (pixels.size() < at(pen_ * pen_)) continue;
      areas.push_back(measured(std::move(pixels), darkness));
      areas.back().struck = is_flat(areas.back()) && is_large(areas.back()) && has_strokes(areas.back());
      if (areas.back().struck) darkest = std::min(darkest, areas.back().inside / areas.back().outside);
    }
    for (const Area& area : areas) {
      const Part part = part_of(area, darkest);
      for (const int p : area.pixels) part_.data[at(p)] = part;
    }
    return darkest <= 1;
  }

  void lighten_shades(Raster<float>& darkness) const {
    Raster<float> near(part_.width, part_.height);
    for (std::size_t i = 0; i < near.data.size(); ++i) near.data[i] = part_.data[i] == kShade ? 1 : 0;
    near = window_extreme(std::move(near), radius_, std::greater<>());
    Histogram unevenness(1024, 0, 1);
    for (std::size_t i = 0; i < near.data.size(); ++i)
      if (near.data[i] > 0 && contrast(i) < full_ / 2) unevenness.add(contrast(i));
    const auto grain = static_cast<float>(unevenness.quantile(0.5, 0, 1));
    for (std::size_t i = 0; i < near.data.size(); ++i)
      if (near.data[i] > 0 && part_.data[i] != kPatch) darkness.data[i] = 1 - (1 - contrast(i)) / (1 - grain);
  }

 private:
  enum Part : std::uint8_t { kPaper, kDark, kEdge, kPatch, kShade };
  enum Joined : std::uint8_t { kToNone, kToBare, kToStruck };

  struct Area {
    std::vector<int> pixels;
    long flat, uneven;    // px, strokes neither
    double inside;        // light
    double outside;       // of the paper around it
    bool struck = false;  // strokes run through it
  };

  float light(std::size_t i) const { return static_cast<float>(view_[i]) / 255.0f; }

  // Darkness against what the window saw.
  float contrast(std::size_t i) const { return 1 - light(i) / std::max(1.0f / 255, paper_.data[i]); }

  // The pixels given and all that are joined to them without an edge, as far as take(pixel) takes them.
  template <class Take>
  std::vector<int> joined_to(std::vector<int> pixels, Take take) const {
    const int width = paper_.width, height = paper_.height;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const int p = pixels[i], x = p % width, y = p / width;
      const auto step = [&](bool inside, int q) {
        if (inside && std::abs(paper_.data[at(q)] - paper_.data[at(p)]) < kSlope && take(q)) pixels.push_back(q);
      };
      step(x > 0, p - 1);
      step(x + 1 < width, p + 1);
      step(y > 0, p - width);
      step(y + 1 < height, p + width);
    }
    return pixels;
  }

  Area measured(std::vector<int> pixels, const Raster<float>& darkness) const {
    Histogram inside(256, 0, 1), outside(256, 0, 1);
    long flat = 0, uneven = 0;
    for (const int p : pixels) {
      const auto i = at(p);
      inside.add(paper_.data[i]);
      outside.add(light(i) / std::max(0.01f, 1 - darkness.data[i]));
      (contrast(i) < kEven ? flat : uneven) += contrast(i) < full_ / 2;
    }
    return {std::move(pixels), flat, uneven, inside.quantile(0.5, 0, 1), outside.quantile(0.5, 0, 1)};
  }

  Part part_of(const Area& area, double darkest) const {
    const auto size = static_cast<double>(area.pixels.size());
    if (area.struck) return kShade;
    if (!is_flat(area)) return kPatch;
    if (size <= kSmall * pen_ * pen_) return static_cast<double>(area.flat) > kFlat * size ? kEdge : kPatch;
    return area.inside > (darkest - kAlike) * area.outside ? kShade : kPatch;
  }

  static bool is_flat(const Area& area) {
    return static_cast<double>(area.flat) > kFlat * static_cast<double>(area.flat + area.uneven);
  }

  bool is_large(const Area& area) const {
    const auto size = static_cast<double>(area.pixels.size());
    return size > kLarge * pen_ * pen_ || size > kPart * static_cast<double>(part_.data.size());
  }

  // Strokes run through what is joined to the area; whatever is joined to several is looked at once.
  bool has_strokes(const Area& area) {
    if (const auto known = joined_.data[at(area.pixels.front())]) return known == kToStruck;
    for (const int p : area.pixels) joined_.data[at(p)] = kToBare;
    const std::vector<int> whole = joined_to(area.pixels, [&](int p) {
      if (joined_.data[at(p)] || 2 * static_cast<double>(paper_.data[at(p)]) > area.inside + area.outside) return false;
      joined_.data[at(p)] = kToBare;
      return true;
    });
    const double faintest = 0.5 * std::max(static_cast<double>(full_), 1 - area.inside / area.outside);
    const auto strokes = std::count_if(whole.begin(), whole.end(), [&](int p) {
      const double fall = static_cast<double>(paper_.data[at(p)] - light(at(p)));
      return static_cast<double>(contrast(at(p))) > faintest && 2 * fall > faintest * area.outside;
    });
    const bool struck = static_cast<double>(strokes) > kStrokes * pen_ * pen_;
    if (struck)
      for (const int p : whole) joined_.data[at(p)] = kToStruck;
    return struck;
  }

  int pen_, radius_;  // px
  const View& view_;
  Raster<float> paper_;          // what of the light is wider than the window; 1: white
  Raster<std::uint8_t> part_;    // Part
  Raster<std::uint8_t> joined_;  // Joined: to an area that was looked at
  float full_ = 1;               // contrast of full ink
};

}  // namespace

bool lighten_shades(const View& view, const Paper& paper, const Raster<std::uint8_t>& ink, Raster<float>& darkness) {
  const int pen = usual_run(ink), radius = static_cast<int>(std::ceil(kWindow * pen));
  if (pen == 0 || !has_wide_areas(view, paper, radius)) return false;
  Areas areas(view, darkness, pen, radius);
  if (!areas.has_shades(darkness)) return false;
  areas.lighten_shades(darkness);
  return true;
}

}  // namespace inkgrid
