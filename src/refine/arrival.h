// What:   the line along which a chain arrives at a junction or a corner.
// Source: ours; docs/METHOD.md, "Junctions".
// Cost:   a few points a chain end.
#pragma once

#include <optional>

#include "refine/ridge.h"

namespace inkgrid {

// From the chain's last points that the ink confirms.
struct Arrival {
  bool known = false;
  Vec2 point;
  Vec2 direction;  // towards the junction
  int last = 0;    // index of that point, counted from the junction's end
};

// From the first point of `first` and those after it, or before it, that paper on both sides confirms (else on one side), over up
// to four strokes: straight where the points are, else the tangent of the parabola through them.
Arrival arrival_from(const RidgeChain& ridge, int first, bool forward);

Arrival arrival_at(const RidgeChain& ridge, bool at_start);

// Where two lines meet that both lead there, or that passed it by no more than `passed` px.
std::optional<Vec2> meeting_of(const Arrival& a, const Arrival& b, double passed);

}  // namespace inkgrid
