// What:   where the two sides of a corner meet: its tip.
// Source: ours; section 7 names sharp turns among the paper's limitations (Fig. 17).
// Differs: docs/METHOD.md, "Corners".
// Cost:   the ink around the tip.
#pragma once

#include <optional>
#include <vector>

#include "base/raster.h"
#include "refine/arrival.h"

namespace inkgrid {

struct CornerOptions {
  double longest = 15;  // from where its sides are confirmed to the tip of a corner, px
  double miss = 3.6;    // how far sides may meet from the end of the ink, px; more where they meet at less than 60 degrees
  double hidden = 0;    // what acute corners, whose blots are longer and hold chains of their own, add to `longest`, px; 0: none
  double pen = 0;       // width of the strokes as they were drawn, px; 0: ends of ink move no tip
};

// The strokes, which may be slimmed, and as they were drawn.
struct CornerInk {
  const Raster<std::uint8_t>& slim;
  const Raster<std::uint8_t>& drawn;
};

// Whether two sides, seen as arrivals at their tip, make an angle of less than 35 degrees.
bool is_acute(const Arrival& a, const Arrival& b);

// How far beside the true tip the lines of two sides of that width may meet, px.
double miss_of(const Arrival& a, const Arrival& b, double width, const CornerOptions& options);

// Of half the angle between them.
double half_sine(const Arrival& a, const Arrival& b);

// Where two sides may meet that both lead there, or that passed it by no more than `passed` px: those of a point bent as they
// are, where acute corners count, and then as straight lines.
std::vector<Vec2> meetings_of_sides(const Arrival& a, const Arrival& b, double passed, const CornerOptions& options);

// The first of them that is a sharp turn over ink, within `longest` px.
std::optional<Vec2> corner_of(const Arrival& a, const Arrival& b, double width, const Raster<std::uint8_t>& ink,
                              const CornerOptions& options, double longest);

// Whether the ink ends behind the tip: at a round cap, or at a mitre.
bool ends_behind(Vec2 tip, const Arrival& a, const Arrival& b, double width, const Raster<std::uint8_t>& ink,
                 const CornerOptions& options);

// The tip of a point at an end of the ink that is round: half a pen before that end, whatever the lines say.  Others stay.
Vec2 settled_tip(Vec2 tip, const Arrival& a, const Arrival& b, double width, const CornerInk& ink, const CornerOptions& options);

}  // namespace inkgrid
