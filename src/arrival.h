// What:   the line along which a chain arrives at a junction.
// Source: ours; docs/METHOD.md, "Junctions".
// Cost:   a few points a chain end.
#pragma once

#include "ridge.h"

namespace inkgrid {

// From the chain's last points that the ink confirms.
struct Arrival {
  bool known = false;
  Vec2 point;
  Vec2 direction;  // towards the junction
  int last = 0;    // index of that point, counted from the junction's end
};

Arrival arrival_at(const RidgeChain& ridge, bool at_start);

}  // namespace inkgrid
