#!/usr/bin/env node
// How long a person waits in the studio: for the first curves of a drawing, and from pen-up to new curves.
//   bench/studio.mjs PROGRAM NPM_DIRECTORY DRAWING...     (build/inkgrid build/npm fish.png)
// Times are those of the page, in ms, the drawing of the curves included.  Behind each, in brackets, the part of it that the stages
// of the method took in the same run: the rest is the studio's, whatever else the machine has to do.  The load is that of the system.
import { readFile } from 'node:fs/promises';
import { cpus, loadavg } from 'node:os';
import { basename, resolve } from 'node:path';

const kScribbles = 20, kEdits = 10;
const [program, npm, ...drawings] = process.argv.slice(2);
if (drawings.length === 0) {
  console.error('usage: bench/studio.mjs PROGRAM NPM_DIRECTORY DRAWING...');
  process.exit(1);
}
process.env.INKGRID = resolve(program);
process.env.INKGRID_NPM = resolve(npm);
const { launch, openTab, startStudio } = await import('../tests/studio/support.mjs');

const endings = [];
const run = { after: (end) => endings.push(end) };

// In the page: the time from the last event of a kind to the picture of the curves that answer it.
function watch() {
  const ask = window.fetch;
  window.fetch = async (path, options) => {
    const answer = await ask(path, options);
    if (options?.method === 'POST' && /\/solve\?/.test(path)) window.answered = answer.clone();
    return answer;
  };
  let since = 0;
  for (const kind of ['pointerup', 'keydown', 'change']) document.addEventListener(kind, () => ((since = performance.now()), (window.waited = 0)), true);
  new MutationObserver(() => {
    if (document.getElementById('stage').getAttribute('aria-busy') === 'false')
      requestAnimationFrame(() => setTimeout(() => (window.waited = performance.now() - since)));
  }).observe(document.getElementById('stage'), { attributeFilter: ['aria-busy'] });
}

const lastRun = (text) => JSON.parse(text.slice(text.lastIndexOf('data: ') + 6).split('\n')[0]);

// How long it took to the curves, and how much of that the stages did, ms.
async function waited(tab, act) {
  await tab.page.evaluate(() => (window.waited = 0));
  await act();
  await tab.page.waitForFunction(() => window.waited > 0, null, { polling: 20 });
  const { report } = lastRun(await tab.page.evaluate(() => window.answered.text()));
  const stages = Object.values(report.seconds).reduce((sum, seconds) => sum + 1000 * seconds, 0);
  return { time: await tab.page.evaluate(() => window.waited), stages };
}

const at = (runs, share) => [...runs].sort((a, b) => a.time - b.time)[Math.floor(share * (runs.length - 1))];
const told = ({ time, stages }) => `${time.toFixed(0).padStart(6)} ${`(${stages.toFixed(0)})`.padEnd(8)}`;

function sequence(seed) {
  return () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}

// A place on ink.
function inkPlace(grey, width, random) {
  for (;;) {
    const i = Math.floor(random() * grey.length);
    if (grey[i] < 128) return [i % width, Math.floor(i / width)];
  }
}

async function measure(browser, path) {
  const studio = await startStudio(run), tab = await openTab(run, browser, studio.address), random = sequence(1);
  await tab.page.evaluate(watch);
  const bytes = await readFile(path);
  const first = await waited(tab, () => tab.open(basename(path), bytes));
  const [, width, height] = (await tab.page.textContent('#title')).match(/(\d+) × (\d+)$/).map(Number);
  const id = await tab.page.evaluate(() => JSON.parse(sessionStorage.getItem('inkgrid-document')).id);
  const grey = new Uint8Array(await (await studio.ask(`/api/documents/${id}/pixels`)).arrayBuffer());
  const place = await tab.placer(width, height), times = [], edits = [];
  for (let k = 0; k < kScribbles; ++k) {
    await tab.page.click(`#tools button:has(.glyph-${k % 2 ? 'less' : 'more'})`);
    const [x, y] = inkPlace(grey, width, random);
    times.push(await waited(tab, () => tab.drag([[x, y], [x + 15, y + 10], [x + 30, y + 15]].map(place))));
    await waited(tab, () => tab.page.click('#undo'));
  }
  await tab.page.click('#tools button:has(.glyph-hand)');
  await tab.page.focus('#stage');
  for (let k = 0; k < kEdits; ++k) {
    await tab.page.keyboard.press('n');
    edits.push(await waited(tab, () => tab.page.keyboard.press('Delete')));
    await waited(tab, () => tab.page.keyboard.press('Control+z'));
  }
  await studio.stop();
  console.log(basename(path).padEnd(28), ...[first, at(times, 0.5), at(times, 0.9), at(edits, 0.5)].map(told));
}

console.log(`ms to the curves (of it the method's stages); load ${loadavg()[0].toFixed(1)} on ${cpus().length} cores; ${kScribbles} scribbles, ${kEdits} curves deleted`);
console.log('drawing'.padEnd(28), ...['first curves', 'pen-up', 'its 90th', 'a deletion'].map((name) => name.padStart(12).padEnd(15)));
const browser = await launch();
try {
  for (const path of drawings) await measure(browser, path);
} finally {
  for (const end of endings) await end();
  await browser.close();
}
