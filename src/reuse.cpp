#include "reuse.h"

#include <algorithm>
#include <utility>

#include "settings.h"

namespace inkgrid {
namespace {

bool same_pixels(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.grey == b.grey;
}

bool same_mask(const std::optional<ScaleMask>& a, const std::optional<ScaleMask>& b) {
  if (!a || !b) return !a && !b;
  return a->width == b->width && a->height == b->height && a->factor == b->factor;
}

// An image that was released is that of no other run.
bool same_ink(const Inputs& a, const Inputs& b) {
  return !a.image.grey.empty() && same_pixels(a.image, b.image) && a.options.threshold == b.options.threshold &&
         a.options.faintest == b.options.faintest && a.options.soften == b.options.soften && a.options.fills == b.options.fills;
}

// Whether the grid is to work on the same ink with another spacing.
bool same_ground(const Stages& before, double spacing) {
  return same_slimming(before.ink, *before.inputs.settled.spacing, spacing) ||
         (before.slim.mask.data.empty() && !is_slimmed(before.ink, spacing));
}

}  // namespace

bool is_ink_of(const Stages& before, const Inputs& now) {
  return same_ink(before.inputs, now) && enlargement_for(before.look, now.options) == before.ink.enlargement;
}

Stage first_stage_changed(const Stages& before, const Inputs& now) {
  if (!is_ink_of(before, now)) return Stage::ink;
  Options known = before.inputs.settled;
  known.preset = now.settled.preset;  // it has done its work
  Stage changed = first_stage_changed(known, now.settled);
  if (changed > Stage::slim && !same_ground(before, *now.settled.spacing)) changed = Stage::slim;
  return same_mask(before.inputs.mask, now.mask) ? changed : std::min(changed, Stage::scribbles);
}

void move_kept(Stage first, Stages& from, Stages& to) {
  const auto move = [&](Stage stage, auto... members) {
    if (stage < first) ((to.*members = std::move(from.*members)), ...);
  };
  move(Stage::ink, &Stages::fills, &Stages::ink, &Stages::look);
  move(Stage::bundles, &Stages::bundles);
  move(Stage::slim, &Stages::slim, &Stages::bundle_scale);
  move(Stage::band, &Stages::mesh);
  move(Stage::field, &Stages::field);
  move(Stage::charts, &Stages::charts);
  move(Stage::labels, &Stages::labels);
  move(Stage::map, &Stages::map);
  move(Stage::isolines, &Stages::exact, &Stages::graph);
  move(Stage::chains, &Stages::plain);
  move(Stage::scribbles, &Stages::chains);
  move(Stage::fit, &Stages::drawing);
}

}  // namespace inkgrid
