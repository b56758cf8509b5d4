// Scribbles, sliders, undo, layers, and all of it without a mouse.
import assert from 'node:assert/strict';
import { writeFile } from 'node:fs/promises';
import { test } from 'node:test';
import { cross, Sheet } from './drawings.mjs';
import { eventually, patience, scratch } from './support.mjs';
import { freshTab, tabWithCross } from './tabs.mjs';

const pathsOf = (svg) => String(svg).match(/ d="[^"]*"/g).map((data) => data.match(/-?[\d.]+/g).map(Number));
const same = (a, b) => a.length === b.length && a.every((x, i) => Math.abs(x - b[i]) < 0.02);
const ids = (tab) => tab.page.$$eval('#curve-list button', (buttons) => buttons.map((button) => button.dataset.id));

test('each scribble changes what it touches and nothing else, and undo brings all back', { timeout: 2 * patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180);
  const first = (await tab.export('svg')).bytes, firstIds = await ids(tab);
  for (const tool of ['less', 'more']) {
    await tab.page.click(`#tools button:has(.glyph-${tool})`);
    await tab.drag([[140, 106], [180, 126], [220, 146]].map(place));
    await tab.settled();
    const [scribble] = JSON.parse(await tab.project()).scribbles;
    assert.equal(scribble.kind, tool);
    assert.ok(Math.hypot(scribble.points[0][0] - 140, scribble.points[0][1] - 106) < 1);
    const before = pathsOf(first), now = pathsOf((await tab.export('svg')).bytes);
    const still = now.filter((path) => before.some((old) => same(path, old)));
    assert.ok(still.length >= 4, 'the arms of the cross stay');
    assert.ok(still.length < now.length, 'what was painted over does not');
    assert.ok((await ids(tab)).filter((id) => firstIds.includes(id)).length >= 4, 'and keep their ids');
    await tab.page.click('#undo');
    await tab.settled();
    assert.deepEqual((await tab.export('svg')).bytes, first);
    assert.deepEqual(await ids(tab), firstIds);
  }
  assert.deepEqual(tab.faults, []);
});

test('the curves answer while the pen rests, before it is lifted', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180), before = await ids(tab);
  await tab.page.click('#tools button:has(.glyph-more)');
  await tab.page.mouse.move(...place([140, 106]));
  await tab.page.mouse.down();
  await tab.page.mouse.move(...place([200, 136]), { steps: 4 });
  await tab.page.waitForFunction((old) => [...document.querySelectorAll('#curve-list button')].some((button) => !old.includes(button.dataset.id)), before);
  assert.ok(await tab.page.isDisabled('#undo'), 'nothing is kept yet');
  await tab.page.mouse.up();
  await tab.settled();
  assert.ok(await tab.page.isEnabled('#undo'));
});

test('an edit of curves that were replaced a moment ago asks to try again, and nothing fails', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180), count = await tab.count();
  await tab.page.route('**/anchors/*', (route) => route.continue({ url: route.request().url().replace(/revision=.*/, 'revision=of-before') }));
  await tab.page.click('#tools button:has(.glyph-delete)');
  await tab.page.mouse.click(...place([60, 60]));
  await tab.waitToSay(/^The curves have just changed: try again\.$/);
  assert.equal(await tab.count(), count);
  assert.deepEqual(tab.faults, []);
});

test('a stroke that is given up leaves the curves as they were', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180), before = await ids(tab);
  await tab.page.click('#tools button:has(.glyph-more)');
  await tab.page.mouse.move(...place([140, 106]));
  await tab.page.mouse.down();
  await tab.page.mouse.move(...place([200, 136]), { steps: 4 });
  await eventually(async () => (await ids(tab)).some((id) => !before.includes(id)), 'the curves answer');
  await tab.page.keyboard.press('Escape');
  await eventually(async () => (await ids(tab)).join() === before.join(), 'the curves of before');
  await tab.page.mouse.up();
  await tab.settled();
  assert.ok(await tab.page.isDisabled('#undo'));
  assert.deepEqual(await ids(tab), before);
});

test('the eraser takes scribbles away, and the brush grows and shrinks', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180), first = (await tab.export('svg')).bytes;
  const stroke = [[140, 106], [220, 146]].map(place);
  await tab.page.keyboard.press('Escape');
  await tab.page.focus('#stage');
  await tab.page.keyboard.press('w');
  await tab.drag(stroke);
  await tab.page.keyboard.press('e');
  for (let k = 0; k < 4; ++k) await tab.page.keyboard.press(']');
  await tab.drag(stroke);
  await tab.settled();
  const { scribbles } = JSON.parse(await tab.project());
  assert.deepEqual(scribbles.map((scribble) => scribble.kind), ['more', 'erase']);
  assert.ok(scribbles[1].radius > 1.5 * scribbles[0].radius);
  assert.deepEqual((await tab.export('svg')).bytes, first);
});

const kRan = { threshold: '; ran threshold to fit\\.', reach: '; ran band to fit\\.', spacing: '; ran slim ink to fit\\.', gap: '; ran chains to fit\\.', tolerance: '; ran fit\\.' };

test('every slider changes the curves, says what runs, and is reset', { timeout: 2 * patience }, async (t) => {
  const tab = await tabWithCross(t), first = (await tab.export('svg')).bytes, plain = await tab.command();
  for (const option of ['threshold', 'reach', 'spacing', 'gap', 'tolerance']) {
    await tab.slide(option, option === 'threshold' ? 900 : 800);
    await tab.settled();
    assert.match(await tab.said(), new RegExp(kRan[option]), option);
    assert.match(await tab.command(), new RegExp(`--${option} [\\d.]+ -o`));
    await tab.page.click(`[data-option="${option}"] .reset`);
    await tab.settled();
    assert.equal(await tab.command(), plain);
  }
  await tab.page.selectOption('#option-preset', 'rough');
  await tab.settled();
  assert.match(await tab.command(), /--preset rough/);
  await tab.page.click('#reset-all');
  await tab.settled();
  assert.deepEqual((await tab.export('svg')).bytes, first);
  assert.deepEqual(tab.faults, []);
});

test('a number is typed, a wrong one is refused', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t);
  await tab.page.fill('#option-spacing', '1.5');
  await tab.page.press('#option-spacing', 'Enter');
  await tab.settled();
  assert.match(await tab.command(), /--spacing 1\.5/);
  await tab.page.fill('#option-spacing', '-3');
  await tab.page.press('#option-spacing', 'Enter');
  await tab.waitToSay(/Spacing must be a number from 0\.1 to 100/);
  assert.match(await tab.command(), /--spacing 1\.5/);
});

test('a slider that is dragged is one step to undo, and the threshold shows its ink meanwhile', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), plain = await tab.command();
  const ink = () => tab.page.evaluate(() => {
    const canvas = document.getElementById('paper');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) count += data[i] === 0x2b && data[i + 1] === 0x5f && data[i + 2] === 0xa8;
    return count;
  });
  assert.equal(await ink(), 0);
  await tab.page.locator('#option-threshold-slider').evaluate((slider) => {
    for (const value of [300, 400, 500, 600]) {
      slider.value = String(value);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    }
  });
  await eventually(async () => (await ink()) > 1000, 'the ink is shown');
  await tab.page.locator('#option-threshold-slider').evaluate((slider) => slider.dispatchEvent(new Event('change', { bubbles: true })));
  await tab.settled();
  await eventually(async () => (await ink()) === 0, 'the ink is hidden again');
  await tab.page.click('#undo');
  await tab.settled();
  assert.equal(await tab.command(), plain);
  assert.ok(await tab.page.isDisabled('#undo'));
});

test('gap bridging joins a broken stroke, and none keeps it broken', { timeout: patience }, async (t) => {
  const tab = await freshTab(t), broken = new Sheet(240, 180).line([20, 60], [105, 60]).line([115, 60], [220, 60]).line([20, 120], [220, 120]);
  await tab.opened('broken.png', broken.png());
  const set = async (value, count) => {
    await tab.page.fill('#option-gap', value);
    await tab.page.press('#option-gap', 'Enter');
    await eventually(async () => (await tab.count()) === count, `${count} curves with gap ${value}`);
    await tab.settled();
  };
  assert.equal(await tab.count(), 2, 'four px are bridged');
  assert.match(await tab.page.inputValue('#option-gap'), /^(1|0\.\d+)$/);
  await set('0', 3);
  assert.match(await tab.command(), /--gap 0 /);
  await set('1.5', 2);
  await tab.page.click('[data-option="gap"] .reset');
  await tab.settled();
  assert.doesNotMatch(await tab.command(), /gap/);
  assert.deepEqual(tab.faults, []);
});

test('held keys compare, and a curve tells its measures', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180);
  await tab.page.mouse.move(...place([60, 60]));
  await tab.page.waitForSelector('#card:not([hidden])');
  assert.match(await tab.page.textContent('#card'), /px long, [\d.]+ px wide, \d+ segments?, \d+ % on ink/);
  await tab.page.mouse.move(...place([200, 20]));
  await tab.page.waitForSelector('#card', { state: 'hidden' });
  await tab.page.click('#layer-handles');
  await tab.page.evaluate(() => document.activeElement.blur()); // keys go to the page
  const usual = await tab.drawn();
  for (const key of ['a', 's', 'd']) {
    await tab.page.keyboard.down(key);
    assert.notEqual(await tab.drawn(), usual, `holding ${key}`);
    await tab.page.keyboard.up(key);
    assert.equal(await tab.drawn(), usual, `letting go of ${key}`);
  }
});

test('a split slider has the drawing on one side and the curves on the other', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180);
  await tab.page.evaluate(() => document.activeElement.blur());
  await tab.page.keyboard.press('c');
  const black = async (x, y) => {
    const [left, top] = place([x, y]);
    return tab.countOf([0, 0, 0], { x: left - 2, y: top - 2, width: 4, height: 4 });
  };
  const at = async (share) => tab.page.locator('#split-at').evaluate((slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, 1000 * share);
  await at(0.99);
  await eventually(async () => (await black(60, 60)) === 16 && (await black(180, 60)) === 16, 'the drawing on both sides');
  await at(0.5);
  await eventually(async () => (await black(60, 60)) === 16 && (await black(180, 60)) < 16, 'curves on the right');
  await tab.page.focus('#split-at');
  await tab.page.keyboard.press('Home');
  await eventually(async () => (await black(60, 60)) < 16, 'curves alone');
  await tab.page.focus('#stage');
  await tab.page.keyboard.press('c');
  assert.ok(await tab.page.isHidden('#split-at'));
  assert.deepEqual(tab.faults, []);
});

test('a wheel zooms about the pointer and keys zoom, move and fit', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), zoom = () => tab.page.textContent('#zoom'), fitted = await zoom();
  const place = await tab.placer(240, 180);
  await tab.page.mouse.move(...place([60, 60]));
  await tab.page.mouse.wheel(0, -300);
  await eventually(async () => parseInt(await zoom()) > 1.5 * parseInt(fitted), 'zoomed in');
  assert.ok(await tab.page.isVisible('#card') || (await tab.page.mouse.move(...place([60.2, 60])), await tab.page.isVisible('#card')), 'what was under the pointer still is');
  await tab.page.focus('#stage');
  await tab.page.keyboard.press('0');
  assert.equal(await zoom(), fitted);
  await tab.page.keyboard.press('+');
  assert.notEqual(await zoom(), fitted);
  await tab.page.keyboard.press('0');
  await tab.page.keyboard.press('Shift+ArrowRight');
  const [x, y] = place([60, 60]);
  await tab.page.mouse.move(x - 144, y);
  await tab.page.waitForSelector('#card:not([hidden])');
});

test('a pen paints as a mouse does', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180), client = await tab.page.context().newCDPSession(tab.page);
  const pen = (type, [x, y]) => client.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount: 1, pointerType: 'pen' });
  await tab.page.click('#tools button:has(.glyph-less)');
  await pen('mousePressed', place([140, 106]));
  await pen('mouseMoved', place([220, 146]));
  await pen('mouseReleased', place([220, 146]));
  await tab.settled();
  const [{ kind, points }] = JSON.parse(await tab.project()).scribbles;
  assert.equal(kind, 'less');
  assert.ok(Math.hypot(points.at(-1)[0] - 220, points.at(-1)[1] - 146) < 2);
});

test('touch paints with one finger and zooms with two', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t), place = await tab.placer(240, 180), client = await tab.page.context().newCDPSession(tab.page);
  const touch = (type, ...points) => client.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  await tab.page.click('#tools button:has(.glyph-more)');
  await touch('touchStart', place([140, 106]));
  await touch('touchMove', place([180, 126]));
  await touch('touchMove', place([220, 146]));
  await touch('touchEnd');
  await tab.settled();
  assert.equal(JSON.parse(await tab.project()).scribbles.length, 1);
  const zoom = parseInt(await tab.page.textContent('#zoom'));
  await touch('touchStart', place([100, 90]), place([140, 90]));
  await touch('touchMove', place([60, 90]), place([180, 90]));
  await touch('touchEnd');
  await eventually(async () => parseInt(await tab.page.textContent('#zoom')) > 2 * zoom, 'zoomed in');
  assert.equal(JSON.parse(await tab.project()).scribbles.length, 1, 'two fingers paint nothing');
});

test('everything is done with the keyboard alone', { timeout: 2 * patience }, async (t) => {
  const path = await scratch(t);
  await writeFile(path('cross.png'), cross());
  const tab = await freshTab(t, path('cross.png')), { keyboard } = tab.page;
  const focusOn = async (selector) => {
    for (let k = 0; k < 80; ++k) {
      if (await tab.page.evaluate((s) => document.activeElement?.matches(s), selector)) return;
      await keyboard.press('Tab');
    }
    assert.fail(`Tab does not reach ${selector}`);
  };
  await tab.waitToSay(/curves in/);
  const count = await tab.count();
  assert.ok(await tab.page.evaluate(() => document.activeElement.id === 'stage'));
  await keyboard.press('w');
  for (const key of [' ', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Shift+ArrowDown', ' ']) await keyboard.press(key === ' ' ? 'Space' : key);
  await tab.settled();
  assert.equal(JSON.parse((await tab.download(() => keyboard.press('Control+s'))).bytes).scribbles.length, 1);
  await keyboard.press('Control+z');
  await tab.settled();
  assert.equal(await tab.count(), count);
  await keyboard.press('n');
  assert.match(await tab.said(), /^Curve 1 of/);
  await keyboard.press('Delete');
  await tab.page.waitForFunction((n) => Number(document.getElementById('curve-count').textContent) === n - 1, count);
  await keyboard.press('Control+Shift+z');
  await keyboard.press('Control+z');
  await tab.settled();
  assert.equal(await tab.count(), count);
  await focusOn('#option-tolerance-slider');
  for (let k = 0; k < 5; ++k) await keyboard.press('PageUp');
  await tab.settled();
  assert.match(await tab.command(), /--tolerance/);
  await keyboard.press('Control+e');
  await focusOn('[data-format="svg"]');
  const { name, bytes } = await tab.download(() => keyboard.press('Enter'));
  assert.match(name, /\.svg$/);
  assert.match(String(bytes), /<path/);
  assert.deepEqual(tab.faults, []);
});
