#include "refine/details.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/at.h"
#include "base/pixel_box.h"
#include "base/sample.h"
#include "ink/enlarge.h"
#include "ink/pen_strokes.h"
#include "ink/preset.h"
#include "ink/runs.h"

namespace inkgrid {
namespace {

constexpr double kDot = 1;        // strokes: what is no longer has no shape
constexpr double kSmall = 6;      // strokes: what is no longer is not judged, since so little ink tells nothing
constexpr double kFar = 0.7;      // strokes, from a chain
constexpr double kMissed = 0.12;  // of the ink of a piece: where less is far from chains, the coarse grid did
constexpr int kMargin = 8;        // px around a piece, for what is measured of it

Raster<std::uint8_t> band_of(const Ink& ink, double reach) {
  Raster<std::uint8_t> band(ink.width(), ink.height());
  for (std::size_t i = 0; i < band.data.size(); ++i) band.data[i] = ink.gap.data[i] < static_cast<float>(reach);
  return band;
}

// Row by row, those of each connected piece.
std::vector<std::vector<Run>> pieces_in(const Raster<std::uint8_t>& band) {
  const std::vector<Run> runs = runs_of(band, 1);
  UnionFind pieces = pieces_of(runs, true);
  std::vector<std::vector<Run>> found(runs.size());
  for (int i = 0; i < static_cast<int>(runs.size()); ++i) found[at(pieces.find(i))].push_back(runs[at(i)]);
  std::erase_if(found, [](const std::vector<Run>& piece) { return piece.empty(); });
  return found;
}

PixelBox box_of(const std::vector<Run>& piece) {
  PixelBox box{piece[0].first, piece[0].y, piece[0].last + 1, piece.back().y + 1};
  for (const Run& run : piece) {
    box.x0 = std::min(box.x0, run.first);
    box.x1 = std::max(box.x1, run.last + 1);
  }
  return box;
}

// The ink on the runs, over a box of pixels.
Binarisation cut_out(const Ink& ink, const std::vector<Run>& runs, const PixelBox& box) {
  Binarisation cut{Raster<std::uint8_t>(box.width(), box.height()), Raster<float>(box.width(), box.height()), ink.threshold,
                   ink.inverted};
  for (const Run& run : runs)
    for (int x = run.first; x <= run.last; ++x) {
      cut.ink(x - box.x0, run.y - box.y0) = ink.mask(x, run.y);
      cut.darkness(x - box.x0, run.y - box.y0) = ink.darkness(x, run.y);
    }
  return cut;
}

// Half way between the ink and the paper that lie side by side along the rim, 0..1.
float darkness_at_rim(const Binarisation& piece) {
  float sum = 0, count = 0;
  const auto add = [&](int x, int y, int u, int v) {
    if (piece.ink(x, y) == piece.ink(u, v)) return;
    sum += piece.darkness(x, y) + piece.darkness(u, v);
    count += 2;
  };
  for (int y = 1; y < piece.ink.height; ++y)
    for (int x = 1; x < piece.ink.width; ++x) {
      add(x - 1, y, x, y);
      add(x, y - 1, x, y);
    }
  return count > 0 ? sum / count : 0.5F;
}

Image picture_of(const Raster<float>& darkness) {
  Image picture;
  picture.width = darkness.width;
  picture.height = darkness.height;
  for (const float d : darkness.data)
    picture.grey.push_back(static_cast<std::uint8_t>(std::lround(255 * (1 - std::clamp(d, 0.0F, 1.0F)))));
  return picture;
}

Binarisation enlarged(const Binarisation& piece) {
  const Image large = enlarged(picture_of(piece.darkness));
  Binarisation result{Raster<std::uint8_t>(large.width, large.height), Raster<float>(large.width, large.height), piece.threshold,
                      piece.inverted};
  const float rim = darkness_at_rim(piece);
  for (std::size_t i = 0; i < large.grey.size(); ++i) {
    result.darkness.data[i] = 1 - static_cast<float>(large.grey[i]) / 255;
    result.ink.data[i] = result.darkness.data[i] > rim;
  }
  return result;
}

bool looks_clean(const Ink& piece) {
  return choose_preset(piece, find_pen_strokes(piece.mask, piece.darkness).width) == Preset::clean;
}

// Whether paper on the runs was taken for part of a line.
bool is_bundled(const Ink& ink, const Raster<std::uint8_t>& joined, const std::vector<Run>& runs) {
  return std::any_of(runs.begin(), runs.end(), [&](const Run& run) {
    const auto first = static_cast<std::ptrdiff_t>(ink.mask.index(run.first, run.y));
    return !std::equal(ink.mask.data.begin() + first, ink.mask.data.begin() + first + run.pixels(), joined.data.begin() + first);
  });
}

// Per pixel: whether a chain goes through it.
Raster<std::uint8_t> pixels_of(const std::vector<Chain>& chains, int width, int height) {
  Raster<std::uint8_t> pixels(width, height);
  for (const Chain& chain : chains)
    for (const Vec2 p : chain.points)
      if (pixels.contains(floor_of(p.x), floor_of(p.y))) pixels(floor_of(p.x), floor_of(p.y)) = 1;
  return pixels;
}

// How much of the ink on the runs lies further than `far` px from the chains in their box, 0..1.
double missed_share(const Ink& ink, const std::vector<Run>& runs, const PixelBox& box, const Raster<std::uint8_t>& chained,
                    double far) {
  const Raster<float> distance = distance_to(cropped(chained, box));
  double all = 0, missed = 0;
  for (const Run& run : runs)
    for (int x = run.first; x <= run.last; ++x) {
      all += ink.mask(x, run.y);
      missed += ink.mask(x, run.y) && static_cast<double>(distance(x - box.x0, run.y - box.y0)) > far;
    }
  return all > 0 ? missed / all : 0;
}

// Whether most of the chain's points lie on the mask.
bool lies_on(const Raster<std::uint8_t>& mask, const Chain& chain) {
  const auto on = std::count_if(chain.points.begin(), chain.points.end(), [&](Vec2 p) {
    return mask.contains(floor_of(p.x), floor_of(p.y)) && mask(floor_of(p.x), floor_of(p.y));
  });
  return 2 * on > static_cast<std::ptrdiff_t>(chain.points.size());
}

void append(Chains& chains, const Chains& more) {
  const int before = static_cast<int>(chains.junctions.size());
  chains.junctions.insert(chains.junctions.end(), more.junctions.begin(), more.junctions.end());
  for (Chain chain : more.chains) {
    for (int* const junction : {&chain.start_junction, &chain.end_junction})
      if (*junction >= 0) *junction += before;
    chains.chains.push_back(std::move(chain));
  }
}

}  // namespace

Details find_details(const Ink& ink, const Raster<std::uint8_t>& joined, const std::vector<Chain>& chains, double reach,
                     double size) {
  Details details;
  const Raster<std::uint8_t> chained = pixels_of(chains, ink.width(), ink.height());
  for (const std::vector<Run>& runs : pieces_in(band_of(ink, reach))) {
    const PixelBox box = box_of(runs);
    const double length = (std::max(box.width(), box.height()) - 2 * reach) / ink.stroke_width;
    if (length < kDot || length > size) continue;
    const PixelBox around = with_margin(box, kMargin, ink.width(), ink.height());
    Ink piece = measure_ink(enlarged(cut_out(ink, runs, around)), kEnlargement * ink.enlargement);
    if (piece.pixels == 0) continue;  // as dark as the paper around it
    if (missed_share(ink, runs, around, chained, kFar * piece.stroke_width / kEnlargement) < kMissed) continue;
    if (length > kSmall && (is_bundled(ink, joined, runs) || !looks_clean(piece))) continue;
    piece.origin = Vec2{static_cast<double>(around.x0), static_cast<double>(around.y0)};
    details.pieces.push_back(std::move(piece));
    if (details.around.data.empty()) details.around = Raster<std::uint8_t>(ink.width(), ink.height());
    for (const Run& run : runs)
      std::fill_n(&details.around.data[details.around.index(run.first, run.y)], run.pixels(), std::uint8_t{1});
  }
  return details;
}

Chains with_details(Chains chains, const Details& details, const std::vector<Chains>& solved) {
  if (details.pieces.empty()) return chains;
  std::vector<std::uint8_t> kept;
  for (const Chain& chain : chains.chains) kept.push_back(!lies_on(details.around, chain));
  keep_chains(chains, kept);
  drop_unused_junctions(chains);
  for (const Chains& detail : solved) append(chains, detail);
  return chains;
}

}  // namespace inkgrid
