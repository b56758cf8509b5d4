// What:   small pieces of a coarse drawing that stand alone, as drawings of their own.
// Source: ours; in the paper the user's scribbles say where the grid is to be finer (section 7).
// Differs: docs/METHOD.md, "Details".
// Cost:   linear in the pixels.
#pragma once

#include <vector>

#include "graph/chains.h"

namespace inkgrid {

struct Details {
  std::vector<Ink> pieces;      // enlarged by kEnlargement; Ink::origin is in px of the whole ink
  Raster<std::uint8_t> around;  // of the whole, 1: nearer than the reach to one of them; empty where there is none
};

// Where the `chains` of a coarse grid miss the shape of a piece of ink that is at most `size` strokes long and that no other ink
// comes nearer to than 2 `reach` (px).  Dots are no details, nor are pieces longer than 6 strokes that were drawn over, by their
// look or as they hold paper that is ink in `joined`, the mask with bundles joined.
Details find_details(const Ink& ink, const Raster<std::uint8_t>& joined, const std::vector<Chain>& chains, double reach,
                     double size);

// The chains with those of details, `solved` in px of the whole, in the place of what was found around them.
Chains with_details(Chains chains, const Details& details, const std::vector<Chains>& solved);

}  // namespace inkgrid
