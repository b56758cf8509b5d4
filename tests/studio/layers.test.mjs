// What the layers show, and how fast.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cross, Sheet } from './drawings.mjs';
import { eventually, patience, startStudio } from './support.mjs';
import { freshTab, tabWithCross } from './tabs.mjs';

const kTriangles = 300_000;

test('every layer draws something', { timeout: 2 * patience }, async (t) => {
  const tab = await tabWithCross(t);
  const picture = async () => (await tab.page.locator('#stage').screenshot()).toString('base64');
  await tab.page.evaluate(() => document.activeElement.blur());
  for (const layer of ['input', 'ink', 'strokes', 'band', 'field', 'labels', 'grid', 'graph', 'widths', 'curves', 'handles']) {
    const before = await picture();
    await tab.page.click(`#layer-${layer}`);
    await eventually(async () => (await picture()) !== before, layer);
    assert.ok((await tab.page.textContent(`#layer-${layer}-help`)).length > 20);
    await tab.page.click(`#layer-${layer}`);
    await eventually(async () => (await picture()) === before, `without ${layer}`);
  }
  assert.deepEqual(tab.faults, []);
});

// Two lines, each drawn in two strokes that run side by side for a while.
const sketchy = () => [40, 120].reduce((sheet, y) => sheet.line([20, y], [190, y + 2], 4).line([120, y + 9], [300, y + 7], 4), new Sheet(320, 180)).png();

test('bundles are joined, shown among the strokes, and kept apart where that is asked', { timeout: patience }, async (t) => {
  const tab = await freshTab(t);
  await tab.opened('sketchy.png', sketchy());
  assert.equal(await tab.page.textContent('[data-option="bundles"] output'), 'chose keep', 'a clean drawing');
  const orange = () => tab.countOf([0xf0, 0x8a, 0x24]);
  for (const layer of ['strokes', 'curves', 'input']) await tab.page.click(`#layer-${layer}`);
  await tab.page.selectOption('#option-bundles', 'join');
  await tab.settled();
  assert.equal(await tab.count(), 2);
  assert.match(await tab.command(), /--bundles join/);
  await eventually(async () => (await orange()) > 500, 'slits are shown');
  await tab.page.selectOption('#option-bundles', 'keep');
  await tab.settled();
  assert.equal(await tab.count(), 4);
  await eventually(async () => (await orange()) === 0, 'no slits are shown');
  assert.deepEqual(tab.faults, []);
});

test('the layers of the method show what a scribble asked for', { timeout: patience }, async (t) => {
  const studio = await startStudio(t);
  const { id, project } = await (await studio.ask('/api/documents?name=cross.png', { method: 'POST', body: cross() })).json();
  const layersOf = async (revision, scribbles) => {
    await (await studio.ask(`/api/documents/${id}/solve?revision=${revision}`, { method: 'POST', body: JSON.stringify({ ...project, scribbles }) })).text();
    const layers = {};
    for (const name of ['ink', 'strokes', 'band', 'field', 'labels', 'grid', 'chains']) {
      const answer = await studio.ask(`/api/documents/${id}/layers/${name}?revision=${revision}`);
      assert.equal(answer.status, 200, name);
      layers[name] = Buffer.from(await answer.arrayBuffer()).toString('base64');
    }
    return layers;
  };
  const plain = await layersOf('a', []), painted = await layersOf('b', [{ kind: 'more', radius: 12, points: [[140, 106], [220, 146]] }]);
  for (const name of ['ink', 'strokes']) assert.equal(painted[name], plain[name], name);
  for (const name of ['band', 'field', 'labels', 'grid', 'chains']) assert.notEqual(painted[name], plain[name], name);
  assert.deepEqual(await layersOf('c', []), plain);
});

test('a filled area is told, shown and switched off', { timeout: patience }, async (t) => {
  const tab = await freshTab(t);
  await tab.opened('blot.png', new Sheet(240, 180).line([20, 30], [220, 30], 4).line([20, 150], [220, 150], 4).disc(120, 90, 34).png());
  assert.match(await tab.said(), /^2 curves and a filled area in/);
  const [x, y] = (await tab.placer(240, 180))([120, 90]);
  const colour = async () => (await tab.page.screenshot({ clip: { x, y, width: 2, height: 2 } })).toString('base64');
  const filled = await colour();
  await tab.page.click('#layer-fills');
  await eventually(async () => (await colour()) !== filled, 'without the fill');
  await tab.page.selectOption('#option-fills', 'drop');
  await tab.waitToSay(/^2 curves in/);
  assert.match(await tab.command(), /--fills drop/);
  assert.deepEqual(tab.faults, []);
});

// In the page: draws a recording of so many triangles from moving views; what each frame costs the page.
async function drawMany(count) {
  const { LayerCanvas } = await import('/page/layer_canvas.js');
  const canvas = Object.assign(document.createElement('canvas'), { width: 500, height: 400 });
  const recording = new ArrayBuffer(8 + 36 * count), words = new Uint32Array(recording), numbers = new Float32Array(recording);
  words.set([0, count]);
  for (let k = 0; k < 3 * count; ++k) {
    const triangle = Math.floor(k / 3), corner = k % 3;
    numbers[2 + 3 * k] = (triangle % 600) + 2 * (corner === 1);
    numbers[3 + 3 * k] = Math.floor(triangle / 600) + 2 * (corner === 2);
    words[4 + 3 * k] = 0xff000000 + triangle;
  }
  const layers = new LayerCanvas(canvas, () => {});
  layers.set('many', recording);
  const calls = { drawn: 0, uploaded: 0 };
  for (const [method, kind] of [['drawArrays', 'drawn'], ['drawArraysInstanced', 'drawn'], ['bufferData', 'uploaded']]) {
    const made = WebGL2RenderingContext.prototype[method];
    WebGL2RenderingContext.prototype[method] = function (...words) {
      ++calls[kind];
      return made.apply(this, words);
    };
  }
  const frame = (k) => layers.draw(['many'], { scale: 1 + k / 10, x: -k, y: -k, width: 500, height: 400 }, () => 1);
  frame(0);
  const uploads = calls.uploaded, times = [];
  calls.drawn = 0;
  for (let k = 1; k <= 6; ++k) {
    const since = performance.now();
    frame(k);
    times.push(performance.now() - since);
  }
  const pixel = new Uint8Array(4);
  layers.gl.readPixels(250, 200, 1, 1, layers.gl.RGBA, layers.gl.UNSIGNED_BYTE, pixel);
  return { drawn: calls.drawn, uploads: calls.uploaded - uploads, median: times.sort((a, b) => a - b)[3], seen: pixel[3] };
}

test('300,000 triangles are uploaded once and drawn at once', { timeout: patience }, async (t) => {
  const tab = await freshTab(t);
  const { drawn, uploads, median, seen } = await tab.page.evaluate(drawMany, kTriangles);
  assert.equal(seen, 255);
  assert.equal(drawn, 6, 'a call a frame');
  assert.equal(uploads, 0, 'nothing is uploaded again');
  assert.ok(median < 8, `${median} ms of the page's time a frame`);
});
