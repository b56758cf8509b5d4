// What:   the line along which a chain arrives at a junction or a corner.
// Source: ours; docs/METHOD.md, "Junctions".
// Cost:   a few points a chain end.
#pragma once

#include <optional>

#include "refine/ridge.h"

namespace inkgrid {

// Of a stroke that is bent evenly over many strokes: its osculating parabola.
struct Bend {
  Vec2 point;
  Vec2 direction;        // towards the junction
  double curvature = 0;  // towards quarter_turn(direction), 1/px
};

// From the chain's last points that the ink confirms.
struct Arrival {
  bool known = false;
  Vec2 point;
  Vec2 direction;  // towards the junction
  int last = 0;    // index of that point, counted from the junction's end
  std::optional<Bend> bend;
};

// From the first point of `first` and those after it, or before it, that paper on both sides confirms (else on one side), over up
// to four strokes: straight where the points are, else the tangent of the parabola through them.
Arrival arrival_from(const RidgeChain& ridge, int first, bool forward);

Arrival arrival_at(const RidgeChain& ridge, bool at_start);

// Where two lines meet that both lead there, or that passed it by no more than `passed` px.
std::optional<Vec2> meeting_of(const Arrival& a, const Arrival& b, double passed);

// Where the strokes meet, bent as they are, if they do within `longest` px.
std::optional<Vec2> bent_meeting_of(const Arrival& a, const Arrival& b, double longest);

}  // namespace inkgrid
