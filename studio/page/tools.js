// The tools, their keys, and the bar that shows them.

import { element } from './dom.js';
import { icon } from './icons.js';
import { kScribbleColours } from './scribbles.js';

export const kTools = [
  { key: 'hand', letter: 'v', title: 'Look', help: 'Drag to move the view, point at a curve to see its measures, click to select it.' },
  { key: 'less', letter: 'q', title: 'Less', brush: true, colour: kScribbleColours.less, help: 'Paint where strokes should stay apart: half the grid spacing and reach.' },
  { key: 'more', letter: 'w', title: 'More', brush: true, colour: kScribbleColours.more, help: 'Paint where strokes should merge: twice the grid spacing and reach.' },
  { key: 'erase', letter: 'e', title: 'Erase', brush: true, colour: '#555', help: 'Take scribbles away.' },
  { key: 'delete', letter: 'x', title: 'Delete', help: 'Click a curve to delete it.' },
  { key: 'split', letter: 'k', title: 'Split', help: 'Click a curve to cut it in two there.' },
  { key: 'join', letter: 'j', title: 'Join', help: 'Click the end of a curve, then the end that it goes on with.' },
];

const kLeastRadius = 1;
const kMostRadius = 400;

export class Tools {
  constructor(place, changed) {
    this.changed = changed;
    this.current = kTools[0];
    this.radius = 20; // px of the drawing
    this.buttons = kTools.map((tool) => element('button', { type: 'button', 'data-hint': `${tool.help} (${tool.letter.toUpperCase()})`, 'aria-keyshortcuts': tool.letter, onclick: () => this.choose(tool.key) },
      element('span', { className: `glyph glyph-${tool.key}`, 'aria-hidden': 'true' }, icon(tool.key)), tool.title, element('kbd', { 'aria-hidden': 'true' }, tool.letter.toUpperCase())));
    this.size = element('input', { type: 'range', id: 'brush-size', min: kLeastRadius, max: 150, 'aria-label': 'Brush radius, pixels' });
    this.size.oninput = () => this.setRadius(this.size.valueAsNumber);
    this.clear = element('button', { type: 'button', id: 'clear-scribbles', 'data-hint': 'Take all scribbles away.' }, 'Clear');
    place.replaceChildren(...this.buttons, element('div', { className: 'size', 'data-hint': 'How wide the brush is ([ and ]).' }, element('label', { for: 'brush-size' }, 'Size'), this.size, element('kbd', { 'aria-hidden': 'true' }, '[ ]'), this.clear));
    this.show();
  }

  choose(key) {
    this.current = kTools.find((tool) => tool.key === key);
    this.show();
    this.changed();
  }

  setRadius(radius) {
    this.radius = Math.min(kMostRadius, Math.max(kLeastRadius, radius));
    this.show();
    this.changed();
  }

  stepRadius(direction) {
    this.setRadius(Math.round(this.radius * 1.2 ** direction + 0.5 * direction));
  }

  show() {
    kTools.forEach((tool, i) => this.buttons[i].setAttribute('aria-pressed', String(tool === this.current)));
    this.size.value = String(this.radius);
  }
}
