// What:   changes made by hand to the curves of a drawing: delete, split, join.
// Source: ours; docs/FORMATS.md, "Project".
// Differs: an edit names its curve by a point near it, so that it means the same curve after the drawing was solved again.
// Cost:   linear in the number of segments, per edit.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "inkgrid/drawing.h"

namespace inkgrid {

enum class EditKind { remove, split, join };

struct Edit {
  EditKind kind = EditKind::remove;
  Vec2 at;               // px; the curve nearest to it is meant, and of a join the end that is nearer along that curve
  Vec2 to;               // join: the same for the other end, which may be that of the same curve
  double tolerance = 8;  // px; a curve that is further away is not meant
};

// A point of a curve.
struct CurvePlace {
  int curve = 0;
  int segment = 0;
  double t = 0;         // in the segment
  Vec2 point;           // px
  double distance = 0;  // px, to what was asked for
};

// The point of a drawing that is nearest to `near`; of equally near curves the first.  None within the tolerance: nothing.
std::optional<CurvePlace> nearest_place(const Drawing& drawing, Vec2 near, double tolerance);

// The point of a curve that is furthest from all others: the best `at` of an edit that means this curve.
Vec2 anchor_of(const Drawing& drawing, int curve);

// The same in the half next to the start or the end of an open curve: the best `at` or `to` of a join.
Vec2 anchor_of_end(const Drawing& drawing, int curve, bool at_end);

struct Edited {
  Drawing drawing;
  std::vector<int> missed;  // index of each edit that found no curve, or had nothing to do
};

// One edit after the other, each on what the one before left.  Curves keep their order: a split puts the new part behind the
// old one, a join keeps the place of the curve at `at`.  The parts of a split share a new junction; a gap that is joined is
// bridged along the tangents of both ends; junctions where fewer than two curves are left are dropped.  A curve that was changed
// has another id, which is the same wherever it runs the same.
Edited apply_edits(Drawing drawing, std::span<const Edit> edits);

}  // namespace inkgrid
