// What leaves the studio: exports, projects, hand edits; the command line makes the same of them.
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { test } from 'node:test';
import { cross } from './drawings.mjs';
import { curvesOfProject, eventually, patience, run, scratch, startStudio } from './support.mjs';
import { tabOf } from './tabs.mjs';

async function withCross(t) {
  const studio = await startStudio(t), tab = await tabOf(t, studio);
  await tab.opened('cross.png', cross());
  return { studio, tab, place: await tab.placer(240, 180) };
}

const kBeginnings = { svg: /^<\?xml/, pdf: /^%PDF-/, eps: /^%!PS/, dxf: /^\s*(999|0)\r?\n/, png: /^\x89PNG/, json: /^\{/ };

test('every format is exported under the name of the drawing', { timeout: 2 * patience }, async (t) => {
  const { tab } = await withCross(t);
  const formats = await tab.page.$$eval('[data-format]', (buttons) => buttons.map((button) => button.dataset.format));
  assert.ok(formats.length >= 2 && formats.includes('svg'));
  for (const format of formats) {
    const { name, bytes } = await tab.export(format);
    assert.equal(name, `cross.${format}`);
    assert.match(bytes.toString('latin1'), kBeginnings[format]);
  }
  assert.deepEqual(tab.faults, []);
});

test('what is asked of a format reaches it, and what is wrong is said', { timeout: patience }, async (t) => {
  const { tab } = await withCross(t);
  await tab.page.click('#export');
  await tab.page.click('#export-dialog summary');
  await tab.page.fill('#export-stroke-width', '-1');
  await tab.page.click('[data-format="svg"]');
  await tab.page.waitForFunction(() => /stroke-width/.test(document.querySelector('#export-dialog .error').textContent));
  await tab.page.fill('#export-stroke-width', '2.5');
  const { bytes } = await tab.download(() => tab.page.click('[data-format="svg"]'));
  assert.match(String(bytes), /stroke-width="2\.5"/);
  const dxf = async (curves, unit) => {
    await tab.page.click('#export');
    await tab.page.selectOption('#export-dxf-curves', curves);
    await tab.page.selectOption('#export-unit', unit);
    return String((await tab.download(() => tab.page.click('[data-format="dxf"]'))).bytes);
  };
  const polylines = await dxf('polylines', 'mm'), splines = await dxf('splines', 'inch');
  assert.match(polylines, /AC1009[^]*POLYLINE/);
  assert.doesNotMatch(polylines, /SPLINE\r?\n/);
  assert.match(splines, /SPLINE\r?\n/);
  const unitOf = (file) => file.match(/\$INSUNITS\s+70\s+(\d)/)?.[1];
  assert.equal(unitOf(splines), '1');
  assert.notEqual(unitOf(polylines), '1');
});

test('a copied command makes the same bytes', { timeout: patience }, async (t) => {
  const { tab } = await withCross(t), path = await scratch(t);
  await tab.slide('spacing', 500);
  await tab.slide('tolerance', 600);
  await tab.settled();
  const exported = (await tab.export('svg')).bytes;
  await tab.page.click('#copy');
  await tab.waitToSay(/Command copied/);
  const words = (await tab.page.evaluate(() => navigator.clipboard.readText())).split(' ').slice(1);
  await writeFile(path('cross.png'), cross());
  words[words.indexOf('cross.png')] = path('cross.png');
  await run(...words.slice(0, -1), path('cross.svg'));
  assert.deepEqual(await readFile(path('cross.svg')), exported);
});

test('curves are deleted, split and joined by hand, each with its undo', { timeout: 2 * patience }, async (t) => {
  const { tab, place } = await withCross(t), first = (await tab.export('svg')).bytes;
  const choose = (tool) => tab.page.click(`#tools button:has(.glyph-${tool})`);
  const click = async (point, count) => {
    await tab.page.mouse.click(...place(point));
    await eventually(async () => (await tab.count()) === count, `${count} curves`);
    await tab.settled();
  };
  await choose('delete');
  await click([60, 60], 5);
  await choose('split');
  await click([180, 120], 6);
  const ids = await tab.page.$$eval('#curve-list button', (buttons) => buttons.map((button) => button.dataset.id));
  assert.equal(new Set(ids).size, ids.length);
  await choose('join');
  await click([218, 139], 6);
  await click([218, 151], 5);
  const edited = (await tab.export('svg')).bytes, project = await tab.project();
  assert.deepEqual(JSON.parse(project).edits.map((edit) => edit.kind), ['delete', 'split', 'join']);
  assert.deepEqual(await curvesOfProject(t, project), edited);
  for (const count of [6, 5, 6]) {
    await tab.page.click('#undo');
    await tab.settled();
    assert.equal(await tab.count(), count);
  }
  assert.deepEqual((await tab.export('svg')).bytes, first);
  assert.deepEqual(tab.faults, []);
});

test('a project goes out and comes in, here and on the command line', { timeout: 2 * patience }, async (t) => {
  const { studio, tab, place } = await withCross(t);
  await tab.slide('spacing', 450);
  for (const tool of ['more', 'less', 'erase']) {
    await tab.page.click(`#tools button:has(.glyph-${tool})`);
    await tab.drag([[150 + 10 * tool.length, 90], [200, 150]].map(place));
  }
  await tab.settled();
  await tab.page.click('#tools button:has(.glyph-delete)');
  const count = await tab.count();
  await tab.page.mouse.click(...place([60, 60]));
  await eventually(async () => (await tab.count()) === count - 1, 'a curve less');
  await tab.settled();
  const exported = (await tab.export('svg')).bytes, project = await tab.project(), command = await tab.command();
  assert.equal(command, 'inkgrid --project cross.inkgrid -o cross.svg');
  assert.deepEqual(await curvesOfProject(t, project), exported);
  const other = await tabOf(t, studio);
  await other.open('work.inkgrid', project);
  await other.waitToSay(/curves in/);
  await other.settled();
  assert.deepEqual((await other.export('svg')).bytes, exported);
  const told = (bytes) => (({ edits, ...rest }) => ({ ...rest, edits: edits.map(({ kind, at }) => [kind, at]) }))(JSON.parse(bytes));
  assert.deepEqual(told(await other.project()), told(project));
  assert.equal(await other.command(), command);
  assert.deepEqual([...tab.faults, ...other.faults], []);
});
