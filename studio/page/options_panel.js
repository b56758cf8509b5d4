// One row an option of the server's table: slider, number, what it re-runs, reset.

import { element } from './dom.js';
import { rounded, scaleOf } from './scale.js';

const kMain = ['preset', 'threshold', 'reach', 'spacing', 'gap', 'tolerance', 'bundles', 'fills'];
const kSteps = 1000;
const kTitles = { reach: 'Reach', spacing: 'Spacing', tolerance: 'Tolerance', threshold: 'Threshold', preset: 'Preset', gap: 'Gap bridging', bundles: 'Bundles', fills: 'Filled areas' };

const titleOf = (name) => kTitles[name] ?? name.charAt(0).toUpperCase() + name.slice(1).replaceAll('-', ' ');

// "a, b or c" of the table, where those are the only values.
const choicesOf = (option) => option.choices ?? [];

class Row {
  constructor(option, tell) {
    this.option = option;
    this.tell = tell;
    this.id = `option-${option.name}`;
    this.reset = element('button', { type: 'button', className: 'reset', 'data-hint': `Back to ${option.default}.`, 'aria-label': `Reset ${titleOf(option.name)}`,
      onclick: () => tell.set(option.name, undefined) }, '↺');
    this.note = element('p', { id: `${this.id}-help`, className: 'help unseen' }, this.helpText());
    this.element = element('div', { className: this.shape }, ...this.parts(), this.note);
    this.element.dataset.option = option.name;
  }

  helpText() {
    const { help, section, stage } = this.option;
    const text = help.charAt(0).toUpperCase() + help.slice(1);
    return `${text}.${stage ? ` A change runs ${stage} and what follows again.` : ''}${section ? ` Paper, section ${section}.` : ''}`;
  }

  // The first stage that a change runs again.
  stageTag() {
    return this.option.stage ? element('span', { className: 'stage-tag', 'aria-hidden': 'true' }, `↻ ${this.option.stage}`) : null;
  }

  label(control) {
    return element('label', { for: control.id }, titleOf(this.option.name));
  }
}

class ChoiceRow extends Row {
  get shape() {
    return 'option choice';
  }

  parts() {
    const { option, tell } = this;
    this.select = element('select', { id: this.id, 'aria-describedby': `${this.id}-help` },
      ...option.choices.map((choice) => element('option', { value: choice }, choice)));
    this.select.onchange = () => tell.set(option.name, this.select.value === option.default ? undefined : this.select.value);
    this.chosen = element('output', { className: 'unit' });
    return [this.label(this.select), this.reset, this.select, this.stageTag(), this.chosen];
  }

  show(value, found) {
    this.select.value = value ?? this.option.default;
    this.reset.disabled = value === undefined;
    this.chosen.textContent = value === undefined && found ? `chose ${found}` : '';
  }
}

class NumberRow extends Row {
  get shape() {
    return 'option number';
  }

  parts() {
    const { option } = this;
    this.scale = scaleOf(option);
    this.slider = element('input', { type: 'range', min: 0, max: kSteps, id: `${this.id}-slider`, 'aria-describedby': `${this.id}-help` });
    this.number = element('input', { type: 'text', inputMode: 'decimal', id: this.id, 'aria-label': `${titleOf(option.name)}, value`, size: 7 });
    this.slider.oninput = () => this.slid(false);
    this.slider.onchange = () => this.slid(true);
    this.number.onchange = () => this.typed();
    this.state = element('span', { className: 'unit' }, option.unit);
    return [this.label(this.slider), this.reset, this.number, this.state, this.slider, this.stageTag()];
  }

  slid(ended) {
    const value = rounded(this.option, this.scale.value(this.slider.valueAsNumber / kSteps));
    this.tell.set(this.option.name, value, { dragging: !ended });
  }

  typed() {
    const text = this.number.value.trim().replace(',', '.');
    if (text === '' || text === 'auto' || text === this.option.default) return this.tell.set(this.option.name, undefined);
    const value = Number(text), { least, most, kind } = this.option;
    const fits = Number.isFinite(value) && value >= least && value <= most && (kind !== 'whole' || Number.isInteger(value));
    this.number.setAttribute('aria-invalid', String(!fits));
    if (fits) this.tell.set(this.option.name, value);
    else this.tell.refused(`${titleOf(this.option.name)} must be ${this.option.accepted}`);
  }

  // `found`: what the drawing decided where the option is left alone.
  show(value, found) {
    const { option } = this;
    const shown = value ?? (option.default === 'auto' ? found : Number(option.default));
    this.number.removeAttribute('aria-invalid');
    this.number.value = shown === undefined ? 'auto' : String(rounded(option, shown));
    this.state.textContent = `${option.unit}${value === undefined && option.default === 'auto' ? ' auto' : ''}`.trim();
    if (shown !== undefined) this.slider.value = String(Math.round(kSteps * this.scale.place(shown)));
    this.slider.setAttribute('aria-valuetext', `${this.number.value} ${this.state.textContent}`);
    this.reset.disabled = value === undefined;
  }
}

export class OptionsPanel {
  // tell: { set(name, value | undefined, { dragging }), resetAll(), refused(sentence), copyCommand() }
  constructor(form, options, tell) {
    this.rows = options.map((option) => (choicesOf(option).length > 0 ? new ChoiceRow(option, tell) : new NumberRow(option, tell)));
    const isMain = (row) => kMain.includes(row.option.name);
    const main = kMain.map((name) => this.rows.find((row) => row.option.name === name)).filter(Boolean);
    const others = this.rows.filter((row) => !isMain(row) && row.option.name !== 'threads');
    this.command = element('code', { id: 'command', tabIndex: 0, 'aria-label': 'The same on the command line' });
    form.onsubmit = (event) => event.preventDefault();
    form.replaceChildren(
      ...main.map((row) => row.element),
      element('details', { className: 'more' }, element('summary', {}, 'All parameters of the method'), ...others.map((row) => row.element)),
      element('div', { className: 'command' }, this.command,
        element('button', { type: 'button', id: 'copy', onclick: tell.copyCommand }, 'Copy'),
        element('button', { type: 'button', id: 'reset-all', onclick: tell.resetAll }, 'Reset all')));
  }

  show(options, report) {
    const found = { preset: report?.preset, bundles: report && (report.bundles > 0 ? 'join' : 'keep'), threshold: report?.threshold, faintest: report?.faintest, soften: report?.softening, reach: report?.reach, spacing: report?.spacing, gap: report?.gap };
    for (const row of this.rows) row.show(options[row.option.name], found[row.option.name]);
  }

  showCommand(text) {
    this.command.textContent = text;
  }
}
