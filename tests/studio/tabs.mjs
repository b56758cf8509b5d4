// Tabs of one browser for each file of tests.
import { after, before } from 'node:test';
import { cross } from './drawings.mjs';
import { launch, openTab, startStudio } from './support.mjs';

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

export const tabOf = (t, studio) => openTab(t, browser, studio.address);

// With a studio of its own.
export const freshTab = async (t, ...words) => tabOf(t, await startStudio(t, ...words));

export async function tabWithCross(t) {
  const tab = await freshTab(t);
  await tab.opened('cross.png', cross());
  return tab;
}
