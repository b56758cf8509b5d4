// Drawings come in, curves come out; what goes wrong is said.
import assert from 'node:assert/strict';
import { writeFile } from 'node:fs/promises';
import { test } from 'node:test';
import { cross, lattice } from './drawings.mjs';
import { patience, scratch, startStudio } from './support.mjs';
import { freshTab, tabOf, tabWithCross } from './tabs.mjs';

test('a file is shown with its curves', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t);
  assert.equal(await tab.count(), 6);
  assert.match(await tab.page.textContent('#title'), /cross\.png · 240 × 180/);
  assert.match(await tab.said(), /^6 curves in .*ran threshold to fit\./);
  assert.deepEqual(tab.faults, []);
});

test('a drawing named on the command line is open from the start', { timeout: patience }, async (t) => {
  const path = await scratch(t);
  await writeFile(path('given.png'), cross());
  const tab = await freshTab(t, path('given.png'));
  await tab.waitToSay(/6 curves/);
  assert.match(await tab.page.textContent('#title'), /^given\.png/);
});

test('a sample is opened with a key, and a dropped file takes its place', { timeout: patience }, async (t) => {
  const tab = await freshTab(t);
  await tab.page.focus('#samples button >> nth=0');
  await tab.page.keyboard.press('Enter');
  await tab.waitToSay(/curves in/);
  const data = await tab.page.evaluateHandle((bytes) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([Uint8Array.from(bytes)], 'dropped.png'));
    return transfer;
  }, [...cross()]);
  await tab.page.dispatchEvent('#stage', 'dragover', { dataTransfer: data });
  assert.ok(await tab.page.isVisible('#drop'));
  await tab.page.dispatchEvent('#stage', 'drop', { dataTransfer: data });
  await tab.page.waitForFunction(() => document.getElementById('title').textContent.startsWith('dropped.png'));
  await tab.settled();
  assert.equal(await tab.count(), 6);
  assert.deepEqual(tab.faults, []);
});

test('a wrong file is refused in one sentence and changes nothing', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t);
  const wrong = { 'notes.txt': Buffer.from('no drawing'), 'cut.png': cross().subarray(0, 60), 'broken.inkgrid': Buffer.from('{"format":"inkgrid-project"'), 'other.json': Buffer.from('{"a":1}') };
  for (const [name, bytes] of Object.entries(wrong)) {
    await tab.open(name, bytes);
    await tab.waitToSay(new RegExp(name.replace('.', '\\.')));
    assert.match(await tab.page.getAttribute('#said', 'class'), /error/);
    assert.match(await tab.page.textContent('#title'), /^cross\.png/);
    assert.equal(await tab.count(), 6);
    await tab.page.evaluate(() => (document.getElementById('said').textContent = ''));
  }
});

test('a long job shows its stage and is cancelled', { timeout: 2 * patience }, async (t) => {
  const tab = await freshTab(t);
  await tab.open('lattice.png', lattice());
  await tab.page.waitForSelector('#progress:not([hidden])');
  await tab.page.waitForFunction(() => ['band', 'frame field', 'labels'].includes(document.getElementById('progress-stage').textContent));
  const asked = Date.now();
  await tab.page.click('#cancel');
  await tab.waitToSay(/cancelled/);
  assert.ok(Date.now() - asked < 20_000);
  assert.ok(await tab.page.isHidden('#progress'));
  assert.equal(await tab.page.textContent('#curve-count'), '');
  await tab.opened('cross.png', cross());
  assert.equal(await tab.count(), 6);
});

test('two tabs have a drawing each', { timeout: patience }, async (t) => {
  const studio = await startStudio(t);
  const [a, b] = [await tabOf(t, studio), await tabOf(t, studio)];
  await Promise.all([a.opened('a.png', cross()), b.opened('b.png', cross())]);
  await a.slide('spacing', 900);
  await b.slide('tolerance', 900);
  await Promise.all([a.settled(), b.settled()]);
  assert.match(await a.command(), /^inkgrid a\.png --spacing [\d.]+ -o a\.svg$/);
  assert.match(await b.command(), /^inkgrid b\.png --tolerance [\d.]+ -o b\.svg$/);
  assert.notEqual(await a.count(), 0);
  assert.deepEqual([...a.faults, ...b.faults], []);
});

test('a reload comes back to the drawing and what was asked of it', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t);
  await tab.slide('tolerance', 700);
  await tab.settled();
  const command = await tab.command();
  await tab.page.reload();
  await tab.waitToSay(/curves in/);
  assert.equal(await tab.command(), command);
});

test('when the server stops the page says so and the project is saved', { timeout: patience }, async (t) => {
  const studio = await startStudio(t);
  const tab = await tabOf(t, studio);
  await tab.opened('cross.png', cross());
  await tab.slide('tolerance', 700);
  await tab.settled();
  await studio.stop();
  await tab.slide('tolerance', 300);
  await tab.page.waitForSelector('#gone:not([hidden])');
  const { bytes } = await tab.download(() => tab.page.click('#gone-save'));
  const project = JSON.parse(bytes);
  assert.deepEqual(Buffer.from(project.drawing.data, 'base64'), cross());
  assert.ok(project.options.tolerance > 0);
});

test('a stop in the middle of a job is noticed', { timeout: patience }, async (t) => {
  const studio = await startStudio(t);
  const tab = await tabOf(t, studio);
  await tab.open('lattice.png', lattice());
  await tab.page.waitForSelector('#progress:not([hidden])');
  await studio.stop();
  await tab.page.waitForSelector('#gone:not([hidden])');
  assert.ok(await tab.page.isHidden('#progress'));
});
