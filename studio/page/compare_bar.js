// Hold to compare, and the split slider.

import { byId, element } from './dom.js';

const kWays = [
  ['input', 'Drawing', 'A'],
  ['curves', 'Curves', 'S'],
  ['both', 'Both', 'D'],
];

export class CompareBar {
  // changed(compare, split): compare 'input', 'curves', 'both' or null; split 0..1 or null.
  constructor(changed) {
    this.changed = changed;
    this.held = null;
    this.split = null;
    this.buttons = kWays.map(([way, title, key]) => this.holdButton(way, title, key));
    this.splitButton = element('button', { type: 'button', id: 'split-toggle', title: 'Split slider (C)', 'aria-pressed': 'false', onclick: () => this.toggleSplit() }, 'Split');
    byId('compare').replaceChildren(...this.buttons, this.splitButton);
    this.slider = byId('split-at');
    this.slider.oninput = () => this.moveSplit();
  }

  holdButton(way, title, key) {
    const button = element('button', { type: 'button', title: `Hold to see ${title.toLowerCase()} only (${key})`, 'aria-pressed': 'false' }, title);
    button.onpointerdown = (event) => {
      button.setPointerCapture(event.pointerId);
      this.hold(way);
    };
    button.onpointerup = button.onpointercancel = () => this.hold(null);
    // A keyboard's click, and a screen reader's, has no button to hold: it switches.
    button.onclick = (event) => event.detail === 0 && this.hold(this.held === way ? null : way);
    return button;
  }

  hold(way) {
    if (way === this.held) return;
    this.held = way;
    kWays.forEach(([name], i) => this.buttons[i].setAttribute('aria-pressed', String(name === way)));
    this.tell();
  }

  toggleSplit() {
    this.split = this.split === null ? this.slider.valueAsNumber / 1000 : null;
    byId('split').hidden = this.split === null;
    this.splitButton.setAttribute('aria-pressed', String(this.split !== null));
    this.tell();
  }

  moveSplit() {
    this.split = this.slider.valueAsNumber / 1000;
    this.tell();
  }

  tell() {
    this.changed(this.held, this.held ? null : this.split);
  }
}
