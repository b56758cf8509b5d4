#include "refine/refinement.h"

#include <algorithm>
#include <limits>

#include "refine/blots.h"
#include "refine/corners.h"
#include "refine/crossings.h"
#include "refine/ends.h"
#include "refine/follow.h"
#include "refine/junctions.h"
#include "refine/needles.h"
#include "refine/simplify.h"
#include "refine/zigzags.h"

namespace inkgrid {
namespace {

constexpr double kSeenOfPen = 0.35;   // of the pen: chains nearer to each other share their ink
constexpr double kBlunt = 1.7;        // of the slimmed stroke: from here on a pen's width hides nothing more
constexpr double kLongestRung = 3;    // of the slimmed stroke
constexpr double kShortStroke = 1.5;  // of the slimmed stroke
constexpr double kLongestBlot = 7;    // of the pen: that of the blot in a corner of 10 degrees
constexpr double kShortBlot = 1.5;    // of the pen: where strokes that run side by side are one
constexpr double kTrimmed = 2.5;      // of the pen
constexpr double kLongestHook = 2;    // of the pen
constexpr double kOneBlot = 3;        // px: where two blots have met so near to each other, they are of one crossing
constexpr double kOnePlace = 0.25;    // of the pen: junctions nearer to each other than this are one
constexpr double kHidden = 16;        // px over which the sides of a corner of 10 degrees hide the paper between them
constexpr double kTipMiss = 0.6;      // of the pen
constexpr double kOvershoot = 2;      // strokes
constexpr double kStraight = 2;       // strokes: chains that are in line over this are one

constexpr double kPassed = 0.7;           // strokes: by so much chains of bundles pass their junctions
constexpr double kLongestBundleHook = 3;  // strokes

constexpr double kNever = std::numeric_limits<double>::infinity();

// What is not resolved: doubles within half a grid cell; spurs and junctions within half a cell, or what a pen can show if that
// is more. Junctions further apart are one only where the chain between them lies inside a blot.
struct Resolution {
  double cell;       // half the grid spacing, px
  double raw_spur;   // half the grid spacing, strokes, for an isoline that goes on to the rim of the ink, half a stroke further
  double spur;       // strokes
  double link;       // px
  double bare_link;  // px
};

// `spacing` in strokes of `width`, which the pen was slimmed to.
Resolution resolution_of(double spacing, double width, double pen) {
  const double half = 0.5 * spacing, blunt = std::min(pen, kBlunt * width);
  const double seen = std::max(half * width, kSeenOfPen * blunt);
  const double link = seen + 0.45 * blunt;
  return {half * width, half + 0.5, seen / width, link, 2.5 * link};
}

// How far strokes share their ink, and what chains may do there, px.  A grid finer than the strokes keeps those apart that run
// side by side, so that what is left between them is a blot; a coarser one is asked for where they are one line.
struct BlotLengths {
  double arms;        // from where they are confirmed to where they meet
  double free_arms;   // the same of free ends
  double paper;       // that a chain may run over
  double trimmed;     // of a free end that is not confirmed
  double overshoots;  // strokes that were drawn too far
};

BlotLengths blot_lengths(double spacing, double width, double pen) {
  const double overshoots = spacing > 1 ? kOvershoot * width : 0;
  if (spacing < 1) return {kLongestBlot * pen, kLongestBlot * pen, width, kTrimmed * pen, overshoots};
  return {kShortBlot * pen, 0, kNever, 0, overshoots};
}

RidgeOptions ridge_options(double width, double reach, double spacing, int threads) {
  return {std::max(0.75, 0.15 * width),
          std::max(1.0, reach * width),
          0.5 * spacing * width,
          nullptr,
          0,
          spacing < 1 ? 0 : kStraight * width,
          threads};
}

// A grid finer than the strokes keeps the slits between them open.
EndOptions end_options(double blot, double bridge, double width, const RefinementOptions& options) {
  const double narrow = std::max(1.0, 0.5 * options.reach * width);
  return {1.5 * width, blot, narrow, options.spacing < 1 ? narrow : bridge, options.gap * options.pen};
}

class Refinement {
 public:
  Refinement(const Ink& ink, const Raster<std::uint8_t>& drawn, const RefinementOptions& options)
      : ink_(ink),
        bands_(ink),
        drawn_(drawn),
        options_(options),
        width_(ink.stroke_width),
        bridge_(std::max(1.0, options.reach * width_)),
        resolution_(resolution_of(options.spacing, width_, options.pen)),
        blot_(blot_lengths(options.spacing, width_, options.pen)),
        ridge_(ridge_options(width_, options.reach, options.spacing, options.threads)),
        ends_(end_options(blot_.arms, bridge_, width_, options)) {
    if (width_ < options.pen) ridge_.drawn = &drawn, ridge_.taken = options.pen - width_;
  }

  // Chains that stand for ink of their own.
  Chains supported(const Chains& chains) const {
    // Slimming takes the ends of strokes, too.
    const RungOptions rungs{kLongestRung * width_, bridge_, is_slimmed() ? kShortStroke * width_ : kNever};
    Chains kept = drop_rungs(drop_uncovered(chains, bands_, options_.coverage_bins, bridge_), ink_, rungs);
    kept = cut_on_paper(drop_blot_loops(std::move(kept), ink_), ink_, blot_.paper);
    kept = drop_spurs(std::move(kept), resolution_.raw_spur);
    return merge_junctions(std::move(kept), resolution_.link, resolution_.link);
  }

  // Arms go to where they meet, and free ends to what they lead to.
  Chains joined(Chains chains) const {
    const BlotOptions lengths{longest_blot() + hidden(), options_.pen, bridge_};
    Blots blots{follow_ridges(chains.chains, bands_, ridge_), chains.junctions};
    if (is_fine()) blots = turn_in_blots(std::move(blots.ridges), std::move(blots.junctions), bands_, drawn_, lengths);
    blots = meet_in_blots(std::move(blots.ridges), std::move(blots.junctions), bands_, drawn_, lengths);
    ArmsJoined arms = join_arms(std::move(blots.ridges), std::move(blots.junctions), corner_ink(), corners(blot_.free_arms));
    chains = straightened_ends(arms.ridges, std::move(arms.junctions), blot_.trimmed);
    if (is_slimmed()) {
      const double near = std::min(kOneBlot, 0.5 * options_.pen);
      chains = merge_junctions(std::move(chains), near, near);
    }
    chains = follow_strokes(std::move(chains), ink_, bridge_, 2 * width_);
    chains = drop_blot_loops(attach_ends(std::move(chains), bands_, ends_), ink_);
    chains = drop_spurs(drop_doubles(std::move(chains), resolution_.cell), resolution_.spur);
    chains = drop_spurs(join_crossings(std::move(chains), width_), resolution_.spur);
    return merge_junctions(std::move(chains), resolution_.link, resolution_.bare_link);
  }

  // Corners, junctions and ends where the pen was.
  Chains located(Chains chains) const {
    RidgeOptions middle = ridge_;
    middle.slit = options_.slit * width_;
    middle.corners = is_fine();
    auto ridges =
        open_corners(follow_ridges(chains.chains, bands_, middle), chains.junctions, corner_ink(), corners(longest_blot()));
    chains = locate_junctions(std::move(ridges), chains.junctions, corner_ink(), {kShortBlot * options_.pen, blot_.arms});
    chains = join_facing_ends(reach_ends(std::move(chains), ink_, ends_), ink_, ends_);
    if (is_slimmed()) chains = drop_knots(std::move(chains), options_.pen - width_);
    chains = drop_needles(std::move(chains), kSeenOfPen * options_.pen, 2 * longest_blot());
    chains = drop_hooks(std::move(chains), kSeenOfPen * options_.pen, kLongestHook * options_.pen);
    if (is_slimmed()) chains = merge_junctions(std::move(chains), kOnePlace * options_.pen, kOnePlace * options_.pen);
    chains = drop_spurs(std::move(chains), resolution_.spur);
    return drop_overshoots(std::move(chains), blot_.overshoots);
  }

 private:
  bool is_fine() const { return options_.spacing < 1; }  // a grid that keeps strokes apart which run side by side
  bool is_slimmed() const { return width_ < options_.pen; }
  double longest_blot() const { return kLongestBlot * options_.pen; }
  double hidden() const { return is_fine() ? kHidden : 0; }
  CornerInk corner_ink() const { return {ink_.mask, drawn_}; }

  CornerOptions corners(double longest) const {
    return {longest, kTipMiss * options_.pen, hidden(), is_fine() ? options_.pen : 0};
  }

  const Ink& ink_;
  InkBands bands_;
  const Raster<std::uint8_t>& drawn_;
  const RefinementOptions& options_;
  double width_;   // of the strokes of the ink, px
  double bridge_;  // paper narrower than this is part of a stroke, px
  Resolution resolution_;
  BlotLengths blot_;
  RidgeOptions ridge_;
  EndOptions ends_;
};

}  // namespace

Chains refine_on_ink(const Chains& chains, const Ink& ink, const Raster<std::uint8_t>& drawn, const RefinementOptions& options) {
  const Refinement refinement(ink, drawn, options);
  return refinement.located(refinement.joined(refinement.supported(chains)));
}

Chains refine_bundles(Chains chains, const FlankingOptions& options) {
  const double width = options.stroke_width;
  chains = join_touching_corners(join_flanking(std::move(chains), options), width);
  return drop_hooks(drop_zigzags(std::move(chains), width), kPassed * width, kLongestBundleHook * width);
}

Chains with_widths_on(Chains chains, const Ink& ink, double reach, double spacing, int threads) {
  const auto ridges = follow_ridges(chains.chains, ink, ridge_options(ink.stroke_width, reach, spacing, threads));
  for (std::size_t c = 0; c < ridges.size(); ++c) chains.chains[c].width = ridges[c].chain.width;
  return chains;
}

}  // namespace inkgrid
