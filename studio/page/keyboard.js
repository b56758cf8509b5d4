// Keys.  Single letters act only while nobody types, and can be switched off.

import { isTyping } from './dom.js';

const movesSlider = (element) => element instanceof HTMLInputElement && element.type === 'range';

export class Keyboard {
  // `tables` is of keys.js; `stage` is the element where arrows and Space act.
  constructor(tables, stage) {
    this.tables = tables;
    this.stage = stage;
    this.letters = true;
    document.addEventListener('keydown', (event) => this.pressed(event));
    document.addEventListener('keyup', (event) => tables.lifted[event.key.toLowerCase()]?.());
    window.addEventListener('blur', tables.lost);
  }

  pressed(event) {
    if (document.querySelector('dialog[open]')) return;
    const act = this.actOf(event);
    if (!act) return;
    act(event);
    event.preventDefault();
  }

  actOf(event) {
    const { command, anywhere, stage, letter } = this.tables, key = event.key.toLowerCase();
    const typing = isTyping(event.target), focus = document.activeElement;
    if (event.ctrlKey || event.metaKey) return typing && key !== 's' && key !== 'o' ? undefined : command[key];
    if (typing) return undefined;
    if (anywhere[event.key] || event.altKey) return anywhere[event.key];
    const onStage = focus === this.stage, free = onStage || focus === document.body || !movesSlider(event.target);
    return (onStage && stage[event.key]) || (this.letters && free ? letter[key] : undefined);
  }
}
