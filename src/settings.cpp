#include "settings.h"

#include "ink/enlarge.h"
#include "ink/preset.h"

namespace inkgrid {
namespace {

Preset preset_of(const Stages& measured, Preset given) {
  return given == Preset::automatic && measured.of_fine_pen ? *measured.of_fine_pen : choose_preset(given, measured.ink);
}

}  // namespace

// Strokes of a rough drawing are wider than its pen.
int enlargement_for(const std::optional<Preset>& of_fine_pen, Preset given) {
  if (!of_fine_pen) return 1;
  return (given == Preset::automatic ? *of_fine_pen : given) == Preset::clean ? kEnlargement : 1;
}

void settle(Inputs& inputs, const Stages& measured) {
  const Inputs& before = measured.inputs;
  const bool known = &before != &inputs && inputs.options.preset == before.options.preset;
  Options& settled = inputs.settled = inputs.options;
  settled.preset = known ? before.settled.preset : preset_of(measured, inputs.options.preset);
  const PresetValues values = preset_values(settled.preset, measured.ink.stroke_width, measured.ink.enlargement);
  settled.reach = inputs.options.reach.value_or(values.reach);
  settled.spacing = inputs.options.spacing.value_or(values.spacing);
  settled.gap = inputs.options.gap.value_or(values.gap);
  // Who gives a reach or a spacing has said which strokes are one line.
  const bool told = inputs.options.reach || inputs.options.spacing;
  if (settled.bundles == BundleMode::automatic)
    settled.bundles = settled.preset == Preset::rough && !told ? BundleMode::join : BundleMode::keep;
}

}  // namespace inkgrid
