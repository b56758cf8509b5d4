// What each key does, by its name: with Ctrl, anywhere, on the stage, and single letters where nobody types.

import { KeyBrush } from './key_brush.js';
import { kLayers } from './layers.js';
import { kTools } from './tools.js';

const kHeld = { a: 'input', s: 'curves', d: 'both' };

const tableOf = (rows, key, act) => Object.fromEntries(rows.map((row, i) => [key(row, i), () => act(row, i)]));

export function keyTables(studio) {
  const { compare, tools, view, edits } = studio;
  const brush = new KeyBrush(studio);
  const edit = (tool) => () => useOnSelected(studio, { delete: (curve) => edits.remove(curve), split: (curve) => edits.click('split', curve.middle), join: (curve) => edits.joinNearest(curve) }[tool()]);
  const remove = edit(() => 'delete');
  const zoom = (direction) => () => view.zoomStep(direction);
  return {
    command: {
      z: (event) => (event.shiftKey ? studio.redo() : studio.undo()), y: () => studio.redo(),
      s: () => studio.save(), o: () => studio.pickFile(), e: () => studio.openExport(),
    },
    anywhere: { Escape: () => escape(studio) },
    stage: {
      ArrowLeft: (event) => brush.move(-1, 0, event.shiftKey), ArrowRight: (event) => brush.move(1, 0, event.shiftKey),
      ArrowUp: (event) => brush.move(0, -1, event.shiftKey), ArrowDown: (event) => brush.move(0, 1, event.shiftKey),
      ' ': () => brush.toggle(), Enter: edit(() => tools.current.key), Delete: remove, Backspace: remove,
    },
    letter: {
      ...tableOf(Object.entries(kHeld), ([key]) => key, ([, way]) => compare.hold(way)),
      ...tableOf(kTools, (tool) => tool.letter, (tool) => tools.choose(tool.key)),
      ...tableOf(kLayers.slice(0, 9), (_, i) => String(i + 1), (_, i) => studio.toggleLayer(i)),
      '+': zoom(1), '=': zoom(1), '-': zoom(-1), 0: () => view.fit(),
      '[': () => tools.stepRadius(-1), ']': () => tools.stepRadius(1),
      c: () => compare.toggleSplit(), n: (event) => nextCurve(studio, event.shiftKey ? -1 : 1), '?': () => studio.openHelp(),
    },
    lifted: tableOf(Object.keys(kHeld), (key) => key, () => compare.hold(null)),
    lost: () => compare.hold(null),
  };
}

function useOnSelected(studio, act) {
  const { selected } = studio.scene;
  if (selected) act?.(selected).catch((problem) => studio.failed(problem));
}

function nextCurve(studio, step) {
  const curves = studio.drawn?.curves ?? [], { selected } = studio.scene;
  if (curves.length === 0) return;
  const now = selected ? selected.index : step > 0 ? -1 : 0;
  studio.select(curves[(now + step + curves.length) % curves.length], true);
}

// The innermost thing that is going on.
function escape(studio) {
  if (studio.painting.stroke) return studio.abandonStroke();
  if (studio.solver.busy) return studio.solver.cancel();
  studio.edits.reset();
  studio.scene.target = null;
  studio.select(null);
}
