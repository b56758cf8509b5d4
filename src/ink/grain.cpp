#include "ink/grain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/at.h"
#include "base/blur.h"
#include "ink/fills.h"
#include "ink/runs.h"
#include "ink/threshold.h"

namespace inkgrid {
namespace {

constexpr double kLeast = 1;          // px: the softening that is tried first
constexpr double kMost = 8;           // px
constexpr double kStep = 1.189;       // times that, the next: four of them are an octave
constexpr double kFinestTold = 2.5;   // softenings, the width of strokes at least by which crumbs are told
constexpr double kFinest = 3;         // softenings, the width of a stroke at least: grain is finer than the pen, dashes are not
constexpr double kBroken = 0.12;      // crumbs and pinholes a stroke width of length
constexpr double kWorthALook = 0.02;  // pieces and pinholes, a stroke width of length of what may be crumbs itself
constexpr int kFewest = 12;           // of them, and widths that the strokes are long
constexpr double kFilled = 0.25;      // of the ink: where more becomes solid, it was hatched or crossed
constexpr double kCoarsest = 0.25;  // of the length as it is: what is more than that in softened strokes are areas of fine lines
constexpr double kCrumb = 2;        // stroke widths squared
constexpr double kWhole = 6;        // stroke widths squared: what crumbs are part of
constexpr long kPinhole = 8;        // px
constexpr double kMostly = 0.6;     // of the holes that close
constexpr double kMended = 0.95;    // of the breaks that any softening mends

double square(double x) {
  return x * x;
}

// Connected ink, or paper in it.
struct Pieces {
  std::vector<Run> runs;
  std::vector<int> of_run;   // for each run its piece
  std::vector<long> pixels;  // for each piece
};

Pieces pieces_in(const Raster<std::uint8_t>& mask, std::uint8_t value) {
  Pieces pieces{runs_of(mask, value), {}, {}};
  UnionFind sets = pieces_of(pieces.runs, value != 0);
  std::vector<int> number(pieces.runs.size());
  for (int i = 0; i < static_cast<int>(pieces.runs.size()); ++i) {
    const int first = sets.find(i);
    if (first == i) {
      number[at(i)] = static_cast<int>(pieces.pixels.size());
      pieces.pixels.push_back(0);
    }
    pieces.of_run.push_back(number[at(first)]);
    pieces.pixels[at(pieces.of_run.back())] += pieces.runs[at(i)].pixels();
  }
  return pieces;
}

// Runs of paper that belong to the smallest holes; what touches the border is none.
std::vector<std::vector<Run>> pinholes_in(const Raster<std::uint8_t>& mask, const Pieces& paper) {
  std::vector<std::vector<Run>> holes(paper.pixels.size());
  std::vector<char> open(paper.pixels.size());
  for (std::size_t i = 0; i < paper.runs.size(); ++i) {
    const Run& run = paper.runs[i];
    const auto piece = at(paper.of_run[i]);
    if (paper.pixels[piece] > kPinhole) continue;
    holes[piece].push_back(run);
    open[piece] |= run.y == 0 || run.y + 1 == mask.height || run.first == 0 || run.last + 1 == mask.width;
  }
  std::vector<std::vector<Run>> pinholes;
  for (std::size_t i = 0; i < holes.size(); ++i)
    if (!holes[i].empty() && !open[i]) pinholes.push_back(std::move(holes[i]));
  return pinholes;
}

// For each piece of `inner` one of `outer` that it shares a pixel with, or -1.
std::vector<int> holders(const Pieces& inner, const Pieces& outer) {
  std::vector<int> holder(inner.pixels.size(), -1);
  std::size_t k = 0;
  for (std::size_t i = 0; i < inner.runs.size(); ++i) {
    const Run& run = inner.runs[i];
    while (k < outer.runs.size() && (outer.runs[k].y < run.y || (outer.runs[k].y == run.y && outer.runs[k].last < run.first)))
      ++k;
    if (k == outer.runs.size()) break;
    if (outer.runs[k].y == run.y && outer.runs[k].first <= run.last) holder[at(inner.of_run[i])] = outer.of_run[k];
  }
  return holder;
}

long count_of(const Pieces& pieces) {
  return static_cast<long>(pieces.pixels.size());
}

bool is_uneven(std::vector<long> sizes) {
  std::sort(sizes.begin(), sizes.end());
  return sizes[3 * sizes.size() / 4] >= 3 * sizes[sizes.size() / 4];
}

// What softening has mended.
struct Mended {
  double sigma = 0;    // px
  bool fine = false;   // finer strokes than are softened by so much
  bool solid = false;  // strokes became areas
  long breaks = 0;     // pieces of ink and paper that are left
  double a_width = 0;  // of crumbs that are part of a stroke now, and pinholes that are ink, a stroke width of length
};

class Search {
 public:
  Search(const Image& image, const Ink& ink, int threads, std::optional<double> faintest)
      : image_(image),
        ink_(ink),
        threads_(threads),
        faintest_(faintest),
        crumbs_(pieces_in(ink.mask, 1)),
        paper_(pieces_in(ink.mask, 0)),
        pinholes_(pinholes_in(ink.mask, paper_)),
        length_(static_cast<double>(ink.pixels) / square(ink.stroke_width)) {}

  bool is_worth_a_look() const {
    const auto found = crumbs_.pixels.size() + pinholes_.size();
    return found >= kFewest && static_cast<double>(found) > kWorthALook * length_;
  }

  long breaks() const { return count_of(crumbs_) + count_of(paper_); }

  // Nothing where strokes are too fine to tell crumbs by so much.
  std::optional<Mended> with(double sigma) const {
    Binarisation ink = binarise(softened(image_, sigma, threads_), std::nullopt, 1, faintest_);
    const double filled = share_in(find_fills(ink));
    const Ink soft = measure_ink(std::move(ink));
    if (soft.pixels == 0 || soft.stroke_width < kFinestTold * sigma) return std::nullopt;
    const double widths = static_cast<double>(soft.pixels) / square(soft.stroke_width);
    if (widths < kFewest) return std::nullopt;
    const bool fine = soft.stroke_width < kFinest * sigma;
    const Pieces strokes = pieces_in(soft.mask, 1), paper = pieces_in(soft.mask, 0);
    const long joined = joined_in(soft, strokes, !fine), closed = closed_in(soft, paper);
    if (filled > kFilled && 2 * joined < count_of(crumbs_)) return std::nullopt;
    const double length = std::max(widths, kCoarsest * length_);
    return Mended{sigma, fine, filled > kFilled, count_of(strokes) + count_of(paper),
                  static_cast<double>(joined) / length + static_cast<double>(closed) / length_};
  }

 private:
  // Of the strokes, the share that has become filled areas.
  double share_in(const Fills& fills) const {
    if (fills.count == 0) return 0;
    long filled = 0;
    for (std::size_t i = 0; i < ink_.mask.data.size(); ++i) filled += ink_.mask.data[i] && fills.region.data[i] >= 0;
    return static_cast<double>(filled) / static_cast<double>(ink_.pixels);
  }

  // `even`: those of one size count, too, which may be dashes.
  long joined_in(const Ink& soft, const Pieces& strokes, bool even) const {
    const std::vector<int> holder = holders(crumbs_, strokes);
    const double width = square(soft.stroke_width);
    std::vector<std::vector<long>> held(strokes.pixels.size());  // sizes
    for (std::size_t i = 0; i < holder.size(); ++i)
      if (holder[i] >= 0) held[at(holder[i])].push_back(crumbs_.pixels[i]);
    long joined = 0;
    for (std::size_t k = 0; k < held.size(); ++k)
      if (held[k].size() > 1 && static_cast<double>(strokes.pixels[k]) > kWhole * width && (even || is_uneven(held[k])))
        joined += std::count_if(held[k].begin(), held[k].end(),
                                [&](long pixels) { return static_cast<double>(pixels) < kCrumb * width; });
    return joined;
  }

  // None where most holes that close are larger: cells of fine nets.
  long closed_in(const Ink& soft, const Pieces& paper) const {
    const long fewer = count_of(paper_) - count_of(paper), closed = pinholes_closed_in(soft);
    return static_cast<double>(closed) < kMostly * static_cast<double>(fewer) ? 0 : closed;
  }

  long pinholes_closed_in(const Ink& soft) const {
    return std::count_if(pinholes_.begin(), pinholes_.end(), [&](const std::vector<Run>& hole) {
      return std::all_of(hole.begin(), hole.end(), [&](const Run& run) {
        for (int x = run.first; x <= run.last; ++x)
          if (!soft.mask(x, run.y)) return false;
        return true;
      });
    });
  }

  const Image& image_;
  const Ink& ink_;
  int threads_;
  std::optional<double> faintest_;
  Pieces crumbs_, paper_;
  std::vector<std::vector<Run>> pinholes_;
  double length_;  // of the ink, in stroke widths; in widths of crumbs where it is broken
};

}  // namespace

Image softened(const Image& image, double sigma, int threads) {
  Raster<float> darkness(image.width, image.height);
  for (std::size_t i = 0; i < image.grey.size(); ++i) darkness.data[i] = static_cast<float>(255 - image.grey[i]);
  const Raster<float> soft = blurred(darkness, sigma, threads);
  Image result = image;
  for (std::size_t i = 0; i < result.grey.size(); ++i)
    result.grey[i] = static_cast<std::uint8_t>(255 - std::lround(std::clamp(soft.data[i], 0.0F, 255.0F)));
  return result;
}

double grain_of(const Image& image, const Ink& ink, int threads, std::optional<double> faintest) {
  if (ink.pixels == 0) return 0;
  const Search search(image, ink, threads, faintest);
  if (!search.is_worth_a_look()) return 0;
  std::vector<Mended> tried;
  for (double sigma = kLeast; sigma <= kMost; sigma *= kStep) {
    const auto mended = search.with(sigma);
    if (!mended) break;
    tried.push_back(*mended);
  }
  const auto is_broken = [](const Mended& m) { return m.a_width > kBroken; };
  bool broken = std::any_of(tried.begin(), tried.end(), [&](const Mended& m) { return m.fine && !m.solid && is_broken(m); });
  std::erase_if(tried, [](const Mended& m) { return m.fine || m.solid; });
  broken |= !tried.empty() && is_broken(tried.back());  // what is mended stays mended, cells of a net open again
  if (!broken) return 0;
  const long before = search.breaks();
  long least = before;
  for (const Mended& m : tried) least = std::min(least, m.breaks);
  const auto enough = std::find_if(tried.begin(), tried.end(), [&](const Mended& m) {
    return static_cast<double>(before - m.breaks) >= kMended * static_cast<double>(before - least);
  });
  return enough == tried.end() ? 0 : enough->sigma;
}

}  // namespace inkgrid
