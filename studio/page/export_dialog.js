// Formats and how they are written, from the server's tables.

import { element } from './dom.js';

const kTitles = { svg: 'SVG', pdf: 'PDF', eps: 'EPS', dxf: 'DXF', png: 'PNG', json: 'JSON graph' };
const kNames = { unit: 'Unit', resolution: 'Pixels an inch', 'stroke-width': 'Stroke width', 'dxf-curves': 'Curves in DXF', flatness: 'Flatness of polylines', 'png-scale': 'PNG scale' };

function field(option) {
  const id = `export-${option.name}`;
  const control = option.choices?.length > 0
    ? element('select', { id, name: option.name }, ...option.choices.map((choice) => element('option', { value: choice, selected: choice === option.default }, choice)))
    : element('input', { id, name: option.name, type: 'text', inputMode: 'decimal', value: option.default, size: 9 });
  control.setAttribute('aria-describedby', `${id}-help`);
  return element('div', { className: 'field' }, element('label', { for: id }, kNames[option.name] ?? option.name), control,
    element('p', { id: `${id}-help`, className: 'help' }, `${option.help.charAt(0).toUpperCase()}${option.help.slice(1)}: ${option.accepted}.`));
}

export class ExportDialog {
  // exportAs(format, options) resolves when the file was handed over, or throws a Problem.
  constructor(dialog, about, exportAs) {
    this.dialog = dialog;
    this.exportAs = exportAs;
    this.problem = element('p', { className: 'error', role: 'alert' });
    this.form = element('form', { method: 'dialog', className: 'export' },
      element('h2', { id: 'export-title' }, 'Export the curves'),
      element('div', { className: 'formats' }, ...about.formats.map((format) => this.formatButton(format))),
      element('details', {}, element('summary', {}, 'How it is written'), ...about.export_options.map(field)),
      this.problem,
      element('div', { className: 'end' }, element('button', { type: 'button', onclick: () => dialog.close() }, 'Close')));
    dialog.replaceChildren(this.form);
  }

  formatButton(format) {
    return element('button', { type: 'button', 'data-format': format.name, onclick: () => this.export(format.name) },
      element('strong', {}, kTitles[format.name] ?? format.name.toUpperCase()), element('span', {}, format.help));
  }

  get options() {
    return Object.fromEntries([...this.form.elements].filter((control) => control.name).map((control) => [control.name, control.value.trim()]));
  }

  async export(format) {
    this.problem.textContent = '';
    try {
      await this.exportAs(format, this.options);
      this.dialog.close();
    } catch (problem) {
      this.problem.textContent = problem.message;
    }
  }

  open() {
    this.problem.textContent = '';
    this.dialog.showModal();
  }
}
