// Keys.  Single letters act only while nobody types, and can be switched off.

import { isTyping } from './dom.js';
import { kTools } from './tools.js';

const kMoves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
export const kHeld = { a: 'input', s: 'curves', d: 'both' };

export class Keyboard {
  // `actions` is what the keys do; `stage` is the element where arrows and Space act.
  constructor(actions, stage) {
    this.actions = actions;
    this.stage = stage;
    this.letters = true;
    document.addEventListener('keydown', (event) => this.pressed(event));
    document.addEventListener('keyup', (event) => this.lifted(event));
    window.addEventListener('blur', () => actions.hold(null));
  }

  pressed(event) {
    if (document.querySelector('dialog[open]')) return;
    const handled = event.ctrlKey || event.metaKey ? this.command(event) : !isTyping(event.target) && (this.onStage(event) || this.letter(event));
    if (handled) event.preventDefault();
  }

  lifted(event) {
    if (kHeld[event.key.toLowerCase()]) this.actions.hold(null);
  }

  command(event) {
    const { actions } = this, key = event.key.toLowerCase();
    if (isTyping(event.target) && key !== 's' && key !== 'o') return false;
    const act = { z: () => (event.shiftKey ? actions.redo() : actions.undo()), y: () => actions.redo(), s: () => actions.save(), o: () => actions.pickFile(), e: () => actions.openExport() }[key];
    act?.();
    return Boolean(act);
  }

  onStage(event) {
    if (event.key === 'Escape') return this.actions.escape(), true;
    if (document.activeElement !== this.stage || event.altKey) return false;
    const move = kMoves[event.key];
    if (move) return this.actions.arrow(move, event.shiftKey), true;
    if (event.key === ' ') return this.actions.space(), true;
    if (event.key === 'Enter') return this.actions.enter(), true;
    if (event.key === 'Delete' || event.key === 'Backspace') return this.actions.deleteSelected(), true;
    return false;
  }

  letter(event) {
    const onStage = document.activeElement === this.stage || document.activeElement === document.body;
    if (!this.letters || event.altKey || (!onStage && event.target instanceof HTMLInputElement && event.target.type === 'range')) return false;
    const { actions } = this, key = event.key.toLowerCase();
    if (kHeld[key]) return actions.hold(kHeld[key]), true;
    const tool = kTools.find((t) => t.letter === key);
    if (tool) return actions.chooseTool(tool.key), true;
    if (/^[1-9]$/.test(key)) return actions.toggleLayer(Number(key) - 1), true;
    const act = {
      '+': () => actions.zoomStep(1), '=': () => actions.zoomStep(1), '-': () => actions.zoomStep(-1), 0: () => actions.fit(),
      '[': () => actions.brushStep(-1), ']': () => actions.brushStep(1), c: () => actions.toggleSplit(),
      n: () => actions.nextCurve(event.shiftKey ? -1 : 1), '?': () => actions.openHelp(),
    }[event.key === '?' ? '?' : key];
    act?.();
    return Boolean(act);
  }
}
