// What:   chains solved anew in one part of a drawing, put in the place of the old ones there.
// Source: ours (docs/METHOD.md, "Scribbles").
// Differs: nothing.
// Cost:   linear in the length of the chains in the part.
#pragma once

#include <optional>

#include "graph/chains.h"
#include "scribbles/touched.h"

namespace inkgrid {

// Distances from the scribbles, px: chains nearer than `inner` are replaced, those farther than `outer` stay; in between they are
// cut where old and new agree.
struct GraftZone {
  const TouchedPart& part;
  double inner;
  double outer;
};

struct GraftOptions {
  double tolerance = 0.2;  // px, between an old and a new chain that are taken for the same
  double stroke_width = 4;
};

// The old chains with what lies inside the zone taken from the new ones.  Old chains that stay whole are the same to the last
// digit, in the same order.  Nothing where some way through the zone has no place where old and new agree.
std::optional<Chains> graft(const Chains& old_chains, const Chains& new_chains, const GraftZone& zone,
                            const GraftOptions& options);

}  // namespace inkgrid
