// The program, a browser, and what a person does with them.
import { execFile, spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';

const { chromium } = createRequire(join(process.env.INKGRID_NPM, 'package.json'))('playwright-core');
const program = process.env.INKGRID;

export const patience = 120_000; // ms; the machine may be busy
const often = { polling: 50 }; // a tab behind another one draws no frames

const flags = ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--disable-dev-shm-usage', '--disable-gpu', '--enable-unsafe-swiftshader'];

const browser = process.env.CHROMIUM ?? ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium'].find(existsSync);

export const launch = () => chromium.launch({ executablePath: browser, args: flags });

export const run = (...words) => promisify(execFile)(program, words, { maxBuffer: 1 << 28, timeout: patience });

// Waits until what is checked holds: a busy machine draws late.
export async function eventually(check, what) {
  for (const end = Date.now() + patience / 2; Date.now() < end; await new Promise((resolve) => setTimeout(resolve, 40))) if (await check()) return;
  throw new Error(`it never came about: ${what}`);
}

// A server of its own; ended with the test.
export async function startStudio(t, ...words) {
  const child = spawn(program, ['studio', '--no-browser', ...words], { stdio: ['ignore', 'pipe', 'inherit'] });
  t.after(() => child.kill());
  const address = await new Promise((resolve, reject) => {
    let text = '';
    child.stdout.on('data', (part) => {
      text += part;
      if (text.includes('\n')) resolve(text.split('\n')[0]);
    });
    child.on('exit', (code) => reject(new Error(`the studio ended with ${code}`)));
  });
  const { origin, hash, port } = new URL(address);
  const token = hash.slice(1);
  const ask = (path, { headers = {}, ...more } = {}) => fetch(origin + path, { ...more, headers: { 'X-Inkgrid-Token': token, ...headers } });
  return { address, origin, port: Number(port), token, ask, stop: () => new Promise((resolve) => child.once('exit', resolve) && child.kill('SIGKILL')) };
}

export async function scratch(t) {
  const directory = await mkdtemp(join(tmpdir(), 'inkgrid-studio-'));
  t.after(() => rm(directory, { recursive: true, force: true }));
  return (name) => join(directory, name);
}

// A tab that fails the test when the page does.
export async function openTab(t, browser, address) {
  const context = await browser.newContext({ viewport: { width: 1000, height: 640 }, acceptDownloads: true, permissions: ['clipboard-read', 'clipboard-write'] });
  t.after(() => context.close());
  const page = await context.newPage();
  page.setDefaultTimeout(patience);
  const faults = [];
  page.on('pageerror', (error) => faults.push(error.stack));
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  await page.goto(address);
  await page.waitForSelector('body:not([aria-busy])');
  return new Tab(page, faults);
}

export class Tab {
  constructor(page, faults) {
    this.page = page;
    this.faults = faults;
  }

  async open(name, bytes) {
    await this.page.setInputFiles('#file', { name, mimeType: 'application/octet-stream', buffer: bytes });
  }

  // Until the curves are those of the present state.
  async settled() {
    await this.page.waitForFunction(() => document.getElementById('stage').getAttribute('aria-busy') === 'false', null, often);
  }

  async opened(name, bytes) {
    await this.open(name, bytes);
    await this.page.waitForFunction((n) => document.getElementById('title').textContent.startsWith(n), name, often);
    await this.settled();
  }

  said() {
    return this.page.textContent('#said');
  }

  async waitToSay(pattern) {
    await this.page.waitForFunction((source) => new RegExp(source, 'i').test(document.getElementById('said').textContent), pattern.source, often);
  }

  async count() {
    return Number(await this.page.textContent('#curve-count'));
  }

  // Pixels of the colour [r, g, b] that are seen on the stage, or in a part of the page.
  async countOf(colour, clip) {
    const png = [...(await (clip ? this.page.screenshot({ clip }) : this.page.locator('#stage').screenshot()))];
    return this.page.evaluate(async ([bytes, [r, g, b]]) => {
      const picture = await createImageBitmap(new Blob([Uint8Array.from(bytes)]));
      const context = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
      context.drawImage(picture, 0, 0);
      const { data } = context.getImageData(0, 0, picture.width, picture.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += data[i] === r && data[i + 1] === g && data[i + 2] === b;
      return count;
    }, [png, colour]);
  }

  // The drawn stage without what lies over it, once all that was asked for is drawn.
  drawn() {
    return this.page.evaluate(async () => {
      for (let frame = 0; frame < 2; ++frame) await new Promise(requestAnimationFrame);
      return [...document.querySelectorAll('#stage canvas')].map((canvas) => canvas.toDataURL()).join();
    });
  }

  command() {
    return this.page.textContent('#command');
  }

  // Of the drawing to the page, for a drawing of this size that fits into the stage.
  async placer(width, height) {
    const box = await this.page.locator('#stage').boundingBox();
    const scale = Math.min(64, (box.width - 48) / width, (box.height - 88) / height);
    const left = box.x + (box.width - scale * width) / 2, top = box.y + (box.height - 48 - scale * height) / 2;
    return ([x, y]) => [left + scale * x, top + scale * y];
  }

  async drag(points) {
    const { mouse } = this.page;
    await mouse.move(...points[0]);
    await mouse.down();
    for (const point of points.slice(1)) await mouse.move(...point);
    await mouse.up();
  }

  async slide(option, place) {
    await this.page.locator(`#option-${option}-slider`).evaluate((slider, value) => {
      slider.value = String(value);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      slider.dispatchEvent(new Event('change', { bubbles: true }));
    }, place);
  }

  // The bytes of what `act` downloads, and its name.
  async download(act) {
    const [download] = await Promise.all([this.page.waitForEvent('download'), act()]);
    return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
  }

  async export(format) {
    await this.page.click('#export');
    return this.download(() => this.page.click(`[data-format="${format}"]`));
  }

  async project() {
    return (await this.download(() => this.page.click('#save'))).bytes;
  }
}

// What the command line makes of a project's bytes.
export async function curvesOfProject(t, bytes) {
  const path = await scratch(t);
  await writeFile(path('project.inkgrid'), bytes);
  await run('--quiet', '--project', path('project.inkgrid'), '-o', path('curves.svg'));
  return readFile(path('curves.svg'));
}
