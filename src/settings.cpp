#include "settings.h"

#include "ink/enlarge.h"
#include "ink/preset.h"

namespace inkgrid {
namespace {

constexpr double kGapInGrain = 2;  // strokes: where the paper took no ink

Preset preset_of(const Look& look, Preset given) {
  return given == Preset::automatic ? look.preset : given;
}

}  // namespace

// Strokes of a rough drawing are wider than its pen, and slits that are joined need not be resolved.
int enlargement_for(const Look& look, const Options& given) {
  const bool fine = look.fine_pen || (look.fine_paper && given.bundles != BundleMode::join);
  return fine && preset_of(look, given.preset) == Preset::clean ? kEnlargement : 1;
}

void settle(Inputs& inputs, const Stages& measured) {
  Options& settled = inputs.settled = inputs.options;
  settled.preset = preset_of(measured.look, inputs.options.preset);
  const PresetValues values = preset_values(settled.preset, measured.ink.stroke_width, measured.ink.enlargement);
  settled.soften = measured.look.softening;
  settled.reach = inputs.options.reach.value_or(values.reach);
  settled.spacing = inputs.options.spacing.value_or(values.spacing);
  settled.gap = inputs.options.gap.value_or(settled.soften > 0 ? kGapInGrain : values.gap);
  // Who gives a reach or a spacing has said which strokes are one line.
  const bool told = inputs.options.reach || inputs.options.spacing;
  if (settled.bundles == BundleMode::automatic)
    settled.bundles = settled.preset == Preset::rough && !told ? BundleMode::join : BundleMode::keep;
}

}  // namespace inkgrid
