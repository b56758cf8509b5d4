// Keys.  Single letters act only while nobody types, and can be switched off.

import { isTyping } from './dom.js';
import { kTools } from './tools.js';

const kMoves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
export const kHeld = { a: 'input', s: 'curves', d: 'both' };

export class Keyboard {
  // `studio` holds what the keys do; `stage` is the element where arrows and Space act.
  constructor(studio, stage) {
    this.studio = studio;
    this.stage = stage;
    this.letters = true;
    document.addEventListener('keydown', (event) => this.pressed(event));
    document.addEventListener('keyup', (event) => this.lifted(event));
    window.addEventListener('blur', () => studio.hold(null));
  }

  pressed(event) {
    if (document.querySelector('dialog[open]')) return;
    const handled = event.ctrlKey || event.metaKey ? this.command(event) : !isTyping(event.target) && (this.onStage(event) || this.letter(event));
    if (handled) event.preventDefault();
  }

  lifted(event) {
    if (kHeld[event.key.toLowerCase()]) this.studio.hold(null);
  }

  command(event) {
    const { studio } = this, key = event.key.toLowerCase();
    if (isTyping(event.target) && key !== 's' && key !== 'o') return false;
    const act = { z: () => (event.shiftKey ? studio.redo() : studio.undo()), y: () => studio.redo(), s: () => studio.save(), o: () => studio.pickFile(), e: () => studio.openExport() }[key];
    act?.();
    return Boolean(act);
  }

  onStage(event) {
    if (event.key === 'Escape') return this.studio.escape(), true;
    if (document.activeElement !== this.stage || event.altKey) return false;
    const move = kMoves[event.key];
    if (move) return this.studio.arrow(move, event.shiftKey), true;
    if (event.key === ' ') return this.studio.space(), true;
    if (event.key === 'Enter') return this.studio.enter(), true;
    if (event.key === 'Delete' || event.key === 'Backspace') return this.studio.deleteSelected(), true;
    return false;
  }

  letter(event) {
    const onStage = document.activeElement === this.stage || document.activeElement === document.body;
    if (!this.letters || event.altKey || (!onStage && event.target instanceof HTMLInputElement && event.target.type === 'range')) return false;
    const { studio } = this, key = event.key.toLowerCase();
    if (kHeld[key]) return studio.hold(kHeld[key]), true;
    const tool = kTools.find((t) => t.letter === key);
    if (tool) return studio.chooseTool(tool.key), true;
    if (/^[1-9]$/.test(key)) return studio.toggleLayer(Number(key) - 1), true;
    const act = {
      '+': () => studio.zoomStep(1), '=': () => studio.zoomStep(1), '-': () => studio.zoomStep(-1), 0: () => studio.fit(),
      '[': () => studio.brushStep(-1), ']': () => studio.brushStep(1), c: () => studio.toggleSplit(),
      n: () => studio.nextCurve(event.shiftKey ? -1 : 1), '?': () => studio.openHelp(),
    }[event.key === '?' ? '?' : key];
    act?.();
    return Boolean(act);
  }
}
