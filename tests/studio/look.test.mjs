// What everyone must be able to see, reach and hear: contrast, size of targets, names, what is said (WCAG 2.2, level AA).
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cross } from './drawings.mjs';
import { patience } from './support.mjs';
import { freshTab, tabWithCross } from './tabs.mjs';

// In the page: every text and edge of a control that is too faint, as "what: ratio".
function faint() {
  const channels = (colour) => (colour.match(/[\d.]+/g) ?? []).map(Number);
  const linear = (c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const ratio = (a, b) => {
    const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
    return (high + 0.05) / (low + 0.05);
  };
  const over = ([r, g, b, a = 1], under) => [r, g, b].map((c, i) => a * c + (1 - a) * under[i]);
  const groundOf = (element) => {
    const colour = channels(getComputedStyle(element).backgroundColor);
    const [, , , alpha = 1] = colour;
    if (alpha === 1) return colour;
    return over(colour, element.parentElement ? groundOf(element.parentElement) : [255, 255, 255]);
  };
  const seen = (element) => element.checkVisibility({ visibilityProperty: true }) && !element.closest('.unseen, .skip, :disabled');
  const found = [];
  const check = (element, what, colour, ground, least) => {
    const is = ratio(over(channels(colour), ground), ground);
    if (is < least) found.push(`${what} of ${element.tagName}#${element.id}.${element.className} "${element.textContent.trim().slice(0, 20)}": ${is.toFixed(2)}`);
  };
  for (const element of document.querySelectorAll('body *')) {
    if (!seen(element)) continue;
    const style = getComputedStyle(element);
    if ([...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim())) check(element, 'text', style.color, groundOf(element), 4.5);
    if (element.matches('input[type="text"], select')) check(element, 'edge', style.borderTopColor, groundOf(element.parentElement), 3);
    if (element.matches('svg')) check(element, 'picture', style.stroke, groundOf(element.parentElement), 3);
  }
  return found;
}

// In the page: controls that a finger misses, or that have no name.
function small() {
  const controls = [...document.querySelectorAll('button, input, select, summary')].filter((control) => control.checkVisibility() && !control.closest('.unseen'));
  const area = (control) => (control.type === 'checkbox' ? control.parentElement : control).getBoundingClientRect();
  return controls.filter((control) => Math.min(area(control).width, area(control).height) < 24).map((control) => control.id || control.outerHTML);
}

test('text and controls stand out, in the light and in the dark', { timeout: patience }, async (t) => {
  const tab = await freshTab(t);
  const everywhere = async (where) => {
    for (const colorScheme of ['light', 'dark']) {
      await tab.page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
      assert.deepEqual(await tab.page.evaluate(faint), [], `${where}, ${colorScheme}`);
      assert.deepEqual(await tab.page.evaluate(small), [], where);
    }
  };
  await everywhere('at the beginning');
  await tab.opened('cross.png', cross());
  await tab.page.click('.more summary');
  await tab.page.click('#curve-details summary');
  await tab.page.click('#tools button:has(.glyph-more)');
  await everywhere('with a drawing');
  await tab.page.fill('#option-spacing', '-3');
  await tab.page.press('#option-spacing', 'Enter');
  await tab.waitToSay(/must be/);
  await everywhere('with a mistake');
  await tab.page.click('#export');
  await tab.page.click('#export-dialog summary');
  await everywhere('exporting');
  await tab.page.keyboard.press('Escape');
  await tab.page.click('#help');
  assert.equal(await tab.page.locator('#help-dialog').evaluate((dialog) => dialog.scrollTop), 0, 'its beginning is shown');
  await everywhere('helping');
});

test('every control has a name, every layer and setting a sentence', { timeout: patience }, async (t) => {
  const tab = await tabWithCross(t);
  const unnamed = await tab.page.evaluate(() => {
    const nameOf = (control) => control.getAttribute('aria-label') || [...(control.labels ?? [])].map((label) => label.textContent).join('').trim() || control.textContent.trim();
    return [...document.querySelectorAll('button, input:not([hidden]), select, progress')].filter((control) => !nameOf(control) && !control.getAttribute('aria-labelledby')).map((control) => control.outerHTML);
  });
  assert.deepEqual(unnamed, []);
  const undescribed = await tab.page.evaluate(() =>
    [...document.querySelectorAll('.layer input, .option input[type="range"], .option select')].filter((control) => !/^[A-Z].{15,}\.$/.test(document.getElementById(control.getAttribute('aria-describedby'))?.textContent)).map((control) => control.id));
  assert.deepEqual(undescribed, []);
  await tab.page.hover('#option-reach-slider');
  assert.equal(await tab.page.textContent('#hint'), await tab.page.textContent('#option-reach-help'));
  await tab.page.focus('#layer-band');
  assert.equal(await tab.page.textContent('#hint'), await tab.page.textContent('#layer-band-help'));
});

test('on a phone the drawing is above the tools, and all of them are within reach', { timeout: patience }, async (t) => {
  const tab = await freshTab(t);
  await tab.page.setViewportSize({ width: 390, height: 844 });
  const last = await tab.page.locator('#samples li').last().boundingBox();
  assert.ok(last.y + last.height < 844, 'all samples are seen at the beginning');
  await tab.opened('cross.png', cross());
  const place = await tab.placer(240, 180), [left, top] = place([0, 0]), [right, bottom] = place([240, 180]);
  assert.ok(right - left > 240 && bottom - top > 150, `${right - left} x ${bottom - top} px`);
  const [dock, stage] = [await tab.page.locator('.dock').boundingBox(), await tab.page.locator('#stage').boundingBox()];
  assert.ok(bottom <= dock.y && top >= stage.y, 'the drawing is not covered');
  assert.equal(await tab.page.evaluate(() => document.documentElement.scrollWidth), 390);
  assert.deepEqual(await tab.page.evaluate(small), []);
  for (const button of await tab.page.locator('.dock button:visible, .bar button:visible').all()) {
    const box = await button.boundingBox();
    assert.ok(box.x >= 0 && box.x + box.width <= 390, await button.textContent());
  }
});

test('what happens is told in live regions', { timeout: patience }, async (t) => {
  const tab = await freshTab(t);
  assert.equal(await tab.page.getAttribute('#said', 'aria-live'), 'polite');
  assert.equal(await tab.page.getAttribute('#gone', 'role'), 'alert');
  await tab.opened('cross.png', cross());
  await tab.waitToSay(/^6 curves in/);
  await tab.page.keyboard.press('w');
  await tab.waitToSay(/^Paint where strokes should merge/);
  await tab.page.keyboard.press('n');
  await tab.waitToSay(/^Curve 1 of 6: \d+ px long/);
  await tab.page.keyboard.press('5');
  await tab.waitToSay(/^Band shown\. A narrow mesh/);
});
