// What the keys do.

import { element } from './dom.js';
import { kTools } from './tools.js';

const kKeys = [
  ['A, S, D (hold)', 'only the drawing, only the curves, both'],
  ['C', 'split slider between drawing and curves'],
  ['+  −  0', 'zoom in, out, fit'],
  ['Arrows', 'move the view, or the brush; with Shift further'],
  ['[  ]', 'smaller, larger brush'],
  ['Space', 'put the brush down, lift it'],
  ['N, Shift+N', 'next, previous curve'],
  ['Enter', 'use the tool on the selected curve: delete it, split it in the middle, join its end with the nearest one'],
  ['Delete', 'delete the selected curve'],
  ['1 … 9', 'switch a layer'],
  ['Ctrl+Z, Ctrl+Shift+Z', 'undo, redo'],
  ['Ctrl+O, Ctrl+S, Ctrl+E', 'open, save the project, export'],
  ['Esc', 'cancel'],
];

export function helpDialog(dialog, keyboard) {
  const letters = element('input', { type: 'checkbox', id: 'letters', checked: true, onchange: () => (keyboard.letters = letters.checked) });
  const rows = [...kTools.map((tool) => [tool.letter.toUpperCase(), `${tool.title}: ${tool.help}`]), ...kKeys];
  dialog.replaceChildren(
    element('form', { method: 'dialog' },
      element('h2', { id: 'help-title', tabIndex: -1, autofocus: true }, 'Tools and keys'),
      element('table', {}, ...rows.map(([key, what]) => element('tr', {}, element('th', { scope: 'row' }, key), element('td', {}, what)))),
      element('p', {}, 'A wheel zooms; drag with Look, with two fingers or with the right button to move. Everything stays on this machine.'),
      element('p', { className: 'switch' }, letters, element('label', { for: 'letters' }, ' Single letters are keys')),
      element('div', { className: 'end' }, element('button', {}, 'Close'))));
}
