// After anything a person may do in a row, the curves are those of one fresh run of what they ended with.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { curvesOfProject, patience } from './support.mjs';
import { tabWithCross } from './tabs.mjs';

const kSteps = 200;

// Numbers of a fixed sequence, 0..1.
function sequence(seed) {
  return () => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return seed / 2 ** 32;
  };
}

test('200 scribbles, hand edits, slider moves, undos and cancels', { timeout: 6 * patience }, async (t) => {
  const tab = await tabWithCross(t);
  const place = await tab.placer(240, 180), random = sequence(7);
  const somewhere = () => place([240 * random(), 180 * random()]);
  const onCurve = [[40, 60], [150, 60], [90, 40], [90, 110], [160, 110], [200, 142]];
  const options = ['threshold', 'reach', 'spacing', 'tolerance'];
  const steps = [
    async () => {
      await tab.page.click(`#tools button:has(.glyph-${['less', 'more', 'erase'][Math.floor(3 * random())]})`);
      await tab.drag([somewhere(), somewhere(), somewhere()]);
    },
    async () => {
      await tab.page.click(`#tools button:has(.glyph-${random() < 0.5 ? 'delete' : 'split'})`);
      await tab.page.mouse.click(...place(onCurve[Math.floor(onCurve.length * random())]));
    },
    () => tab.slide(options[Math.floor(options.length * random())], Math.floor(250 + 500 * random())),
    () => tab.page.keyboard.press('Control+z'),
    () => tab.page.keyboard.press('Control+Shift+z'),
    () => tab.page.keyboard.press('Escape'),
    () => tab.page.click(`[data-option="${options[Math.floor(options.length * random())]}"] .reset:enabled`, { timeout: 50 }).catch(() => {}),
    () => tab.settled(),
  ];
  const chances = [0.3, 0.38, 0.58, 0.71, 0.77, 0.86, 0.93, 1];
  for (let k = 0; k < kSteps; ++k) {
    const chance = random();
    await steps[chances.findIndex((limit) => chance < limit)]();
  }
  // A cancel may have left the curves behind what is asked for: one more change and back asks again.
  await tab.slide('tolerance', 500);
  await tab.settled();
  await tab.page.click('#undo');
  await tab.settled();
  const project = await tab.project();
  assert.deepEqual(await curvesOfProject(t, project), (await tab.export('svg')).bytes);
  assert.deepEqual(tab.faults, []);
});
