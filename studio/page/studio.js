// The page as a whole: one project with its history, one solver, and everything that shows them.

import { commandLine, baseName } from './command_line.js';
import { CompareBar } from './compare_bar.js';
import { CurvesPanel, measureText } from './curves_panel.js';
import { byId, download } from './dom.js';
import { DrawnCurves } from './drawn_curves.js';
import { EditTools } from './edit_tools.js';
import { ExportDialog } from './export_dialog.js';
import { helpDialog } from './help_dialog.js';
import { showHints } from './hints.js';
import { History } from './history.js';
import { Keyboard } from './keyboard.js';
import { keyTables } from './keys.js';
import { LayersPanel } from './layers_panel.js';
import { Opening } from './opening.js';
import { OptionsPanel } from './options_panel.js';
import { Painting } from './painting.js';
import { Paper } from './paper.js';
import { Pointer } from './pointer.js';
import * as Project from './project.js';
import { Renderer } from './renderer.js';
import { ScribblePicture } from './scribbles.js';
import { Solver } from './solver.js';
import { StatusBar } from './status_bar.js';
import { Tools } from './tools.js';
import { View } from './view.js';

const kHoverReach = 10; // px of the screen

export class Studio {
  constructor(api, about) {
    this.api = api;
    this.about = about;
    this.opening = null; // id, size and file of the drawing that is open
    this.history = null;
    this.result = null;
    this.dragging = false; // a slider
    this.cursor = null; // of the pointer or the keys, on the screen
    this.stage = byId('stage');
    this.view = new View(() => this.viewChanged());
    this.renderer = new Renderer({ paper: byId('paper'), layers: byId('layers'), curves: byId('curves') }, this.view);
    this.scene = this.renderer.scene;
    this.status = new StatusBar({ progress: byId('progress'), stage: byId('progress-stage'), bar: byId('progress-bar'), said: byId('said'), zoom: byId('zoom') });
    this.solver = new Solver(api, {
      started: () => this.solving(true),
      progress: (stage, fraction) => this.status.show(stage, fraction),
      solved: (result, milliseconds) => this.solved(result, milliseconds),
      failed: (problem) => this.solveFailed(problem),
      idle: () => this.solving(false),
    });
    this.painting = new Painting({ changed: () => this.strokeChanged(), rested: (stroke) => this.solver.request(Project.withScribble(this.project, stroke)) });
    this.edits = new EditTools(this);
    this.makePanels();
    this.wire();
  }

  makePanels() {
    this.tools = new Tools(byId('tools'), () => this.toolChanged());
    this.options = new OptionsPanel(byId('options'), this.about.options, {
      set: (name, value, how) => this.setOption(name, value, how),
      resetAll: () => this.history && this.commit(Project.withoutOptions(this.project)),
      refused: (sentence) => this.say(sentence, true),
      copyCommand: () => this.copyCommand(),
    });
    this.layers = new LayersPanel(byId('layer-list'), { recordedWork: this.renderer.layers.works, changed: () => this.layersChanged() });
    this.curvesPanel = new CurvesPanel(byId('curve-list'), byId('curve-count'), { select: (curve) => this.select(curve, true), hover: (curve) => this.hover(curve) });
    this.compare = new CompareBar((compare, split) => {
      Object.assign(this.renderer, { compare, split });
      this.renderer.invalidate();
    });
    this.exportDialog = new ExportDialog(byId('export-dialog'), this.about, (format, options) => this.exportAs(format, options));
    this.keyboard = new Keyboard(keyTables(this), this.stage);
    helpDialog(byId('help-dialog'), this.keyboard);
    this.ways = new Opening(this, this.about);
    showHints(byId('hint'));
  }

  wire() {
    this.pointer = new Pointer(this.stage, {
      isBrush: () => Boolean(this.tools.current.brush) && this.history !== null,
      pan: (dx, dy) => this.view.pan(dx, dy),
      zoom: (factor, x, y) => this.view.zoom(factor, x, y),
      begin: (at) => this.painting.begin(this.tools.current.key, this.tools.radius, this.view.toDrawing(at.x, at.y)),
      paint: (at) => this.painting.add(this.view.toDrawing(at.x, at.y)),
      end: () => this.endStroke(),
      abandon: () => this.abandonStroke(),
      click: (at) => this.clicked(this.view.toDrawing(at.x, at.y)),
      hover: (at) => this.pointedAt(at),
    });
    const actions = { undo: () => this.undo(), redo: () => this.redo(), save: () => this.save(), 'gone-save': () => this.save(), 'gone-retry': () => this.retry(), export: () => this.openExport(), help: () => this.openHelp(), cancel: () => this.solver.cancel(), 'clear-scribbles': () => this.clearScribbles(), 'zoom-in': () => this.view.zoomStep(1), 'zoom-out': () => this.view.zoomStep(-1), 'zoom-fit': () => this.view.fit() };
    for (const [id, act] of Object.entries(actions)) byId(id).onclick = act;
    new ResizeObserver(([entry]) => this.renderer.resize(entry.contentRect.width, entry.contentRect.height)).observe(this.stage);
  }

  async begin() {
    const before = Opening.remembered();
    if (before && (await this.openDocument(before.id, before.project))) return;
    if (this.about.opened) await this.openDocument(this.about.opened);
  }

  get project() {
    return this.history.value;
  }
  get drawn() {
    return this.scene.drawn;
  }

  // ---- opening

  openFile(file) {
    return this.opened(() => this.api.open(file.name, file));
  }
  openSample(name) {
    return this.opened(() => this.api.openSample(name));
  }
  openDocument(id, project) {
    return this.opened(async () => {
      const told = await this.api.document(id);
      return project ? { ...told, project } : told;
    }, Boolean(project));
  }

  async opened(ask, quiet = false) {
    try {
      await this.show(await ask());
      return true;
    } catch (problem) {
      if (!quiet) this.failed(problem);
      return false;
    }
  }

  async show({ id, width, height, project }) {
    this.opening = { id, width, height, file: this.api.file(id).then((bytes) => new Blob([bytes])) };
    this.opening.file.catch(() => {});
    this.history = new History(project);
    this.result = null;
    Object.assign(this.scene, { paper: new Paper(width, height), scribbles: new ScribblePicture(width, height), drawn: null, selected: null, hovered: null, recorded: [] });
    this.renderer.layers.dropAll();
    this.edits.reset();
    this.solver.use(id);
    for (const place of ['welcome', 'gone']) byId(place).hidden = true;
    delete document.body.dataset.empty;
    for (const button of ['save', 'export']) byId(button).disabled = false;
    byId('title').textContent = `${project.drawing.name.split('/').pop()} · ${width} × ${height}`;
    this.view.fit({ width, height });
    this.stage.focus({ preventScroll: true });
    this.stateChanged();
    await Promise.all([this.solver.request(project), this.showPixels(id, this.scene.paper)]);
  }

  async showPixels(id, paper) {
    paper.take(new Uint8Array(await this.api.pixels(id)));
    this.renderer.invalidate();
  }

  pickFile() {
    this.ways.pick();
  }

  // ---- state

  commit(project, group = null) {
    this.history.push(project, group);
    this.stateChanged();
    return this.solver.request(project, { dragging: this.dragging });
  }

  stateChanged() {
    this.scene.scribbles.show(this.project.scribbles);
    this.options.show(this.project.options, this.result?.report);
    this.options.showCommand(commandLine(this.project, this.about.options));
    byId('undo').disabled = !this.history.canUndo;
    byId('redo').disabled = !this.history.canRedo;
    byId('clear-scribbles').disabled = this.project.scribbles.length === 0;
    Opening.remember(this.opening.id, this.project);
    this.renderer.invalidate();
  }

  undo() {
    if (this.history?.undo()) this.travelled('Undone.');
  }
  redo() {
    if (this.history?.redo()) this.travelled('Redone.');
  }
  travelled(sentence) {
    this.edits.reset();
    this.scene.paper.showInk(null);
    this.stateChanged();
    this.say(sentence);
    this.solver.request(this.project);
  }

  // While a slider is dragged its steps are one for undo, and the threshold shows its ink.
  setOption(name, value, { dragging = false } = {}) {
    if (!this.history) return;
    this.dragging = dragging;
    if (value !== this.project.options[name]) {
      if (name === 'threshold' && dragging) this.scene.paper.showInk(value);
      this.commit(Project.withOption(this.project, name, value), name);
    }
    if (dragging) return;
    this.history.closeGroup();
    if (!this.solver.busy) this.scene.paper.showInk(null);
    this.renderer.invalidate();
  }

  clearScribbles() {
    if (this.history && this.project.scribbles.length > 0) this.commit(Project.withoutScribbles(this.project));
  }

  commitEdit(edit, sentence) {
    this.say(sentence);
    return this.commit(Project.withEdit(this.project, edit));
  }

  // ---- results

  solving(busy) {
    this.stage.setAttribute('aria-busy', String(busy));
    if (busy) this.status.started();
    else this.status.ended();
  }

  solved(result, milliseconds) {
    const before = this.drawn;
    this.result = result;
    this.scene.drawn = new DrawnCurves(result, before);
    this.scene.cell = result.report.spacing * result.report.stroke_width;
    this.scene.selected = this.scene.selected && this.drawn.find(this.scene.selected.id);
    this.scene.hovered = null;
    if (!this.dragging) this.scene.paper.showInk(null);
    this.options.show(this.project.options, result.report);
    this.curvesPanel.show(this.drawn, this.scene.selected);
    this.tellResult(result, milliseconds);
    this.layersChanged();
  }

  tellResult({ report, curves, fills }, milliseconds) {
    const ran = Object.keys(report.seconds);
    const stages = ran.length === 0 ? '' : ran.length === 1 ? `; ran ${ran[0]}` : `; ran ${ran[0]} to ${ran.at(-1)}`;
    const warnings = report.warnings.map((warning) => ` ${warning}.`).join('');
    const areas = fills.length === 0 ? '' : fills.length === 1 ? ' and a filled area' : ` and ${fills.length} filled areas`;
    this.say(`${curves.length} curves${areas} in ${milliseconds < 1000 ? `${Math.round(milliseconds)} ms` : `${(milliseconds / 1000).toFixed(1)} s`}${stages}.${warnings}`);
  }

  solveFailed(problem) {
    if (problem.kind === 'cancelled') return this.say('Cancelled: the curves are those of before the last change.');
    this.scene.paper.showInk(null);
    this.renderer.invalidate();
    this.failed(problem);
  }

  failed(problem) {
    if (problem.kind === 'gone') byId('gone').hidden = false;
    else this.say(`${problem.message.charAt(0).toUpperCase()}${problem.message.slice(1)}.`, true);
    if (!(problem instanceof Error) || problem.kind === undefined) throw problem;
  }

  // The server may hold the drawing no longer, or be another one on the same port.
  async retry() {
    byId('gone').hidden = true;
    if (!this.opening) return this.begin();
    const project = this.project;
    if (!(await this.openDocument(this.opening.id, project))) this.failed(await this.stillGone());
  }

  async stillGone() {
    return this.api.about().then(() => Object.assign(new Error('the drawing is no longer open'), { kind: 'refused' }), (problem) => problem);
  }

  say(sentence, isError = false) {
    this.status.say(sentence, isError);
  }

  // ---- layers and view

  layersChanged() {
    this.scene.shown = this.layers.shown;
    this.scene.recorded = this.layers.recorded;
    for (const name of this.layers.recorded) this.fetchLayer(name);
    this.renderer.invalidate();
  }

  async fetchLayer(name) {
    const { id } = this.opening ?? {}, revision = this.result?.revision;
    this.layerRevisions ??= new Map();
    if (!revision || this.layerRevisions.get(name) === revision) return;
    this.layerRevisions.set(name, revision);
    try {
      const marks = await this.api.layer(id, revision, name);
      if (this.result?.revision === revision) this.renderer.layers.set(name, marks);
      this.renderer.invalidate();
    } catch (problem) {
      this.layerRevisions.delete(name);
      if (problem.kind !== 'changed') this.failed(problem);
    }
  }

  viewChanged() {
    this.status?.showZoom(this.view.scale);
    this.renderer?.invalidate();
    this.showBrush();
  }

  toolChanged() {
    this.edits?.reset();
    if (this.scene) this.scene.target = null;
    this.stage.dataset.tool = this.tools?.current.key ?? '';
    this.showBrush();
    if (this.tools) this.say(this.tools.current.help);
  }

  showBrush() {
    if (!this.scene || !this.tools) return;
    const { brush, colour } = this.tools.current;
    this.scene.brush = brush && this.cursor && this.history ? { ...this.cursor, radius: this.tools.radius * this.view.scale, colour } : null;
    this.renderer.invalidate();
  }

  // ---- painting and pointing

  strokeChanged() {
    this.scene.stroke = this.painting.stroke;
    this.renderer.invalidate();
  }

  endStroke() {
    const stroke = this.painting.end();
    if (stroke) this.commit(Project.withScribble(this.project, stroke));
  }

  // The curves may have answered the stroke while it rested.
  abandonStroke() {
    if (this.painting.end()) this.solver.request(this.project);
  }

  pointedAt(at) {
    this.cursor = at;
    this.showBrush();
    if (!this.history || this.painting.stroke) return;
    const point = at && this.view.toDrawing(at.x, at.y);
    this.scene.target = point && this.edits.target(this.tools.current.key, point);
    this.hover(point && !this.tools.current.brush ? this.drawn?.at(point, kHoverReach / this.view.scale)?.curve : null, at);
    this.renderer.invalidate();
  }

  hover(curve, at = null) {
    this.scene.hovered = curve ?? null;
    const card = byId('card');
    card.hidden = !curve || !at;
    if (curve && at) {
      card.style.setProperty('--colour', curve.colour);
      card.textContent = measureText(curve, this.result.report.pixels_per_mm);
      card.style.left = `${Math.min(at.x + 16, this.view.width - 230)}px`;
      card.style.top = `${Math.min(at.y + 18, this.view.height - 70)}px`;
    }
    this.renderer.invalidate();
  }

  clicked(point) {
    if (!this.history) return;
    const tool = this.tools.current.key;
    if (tool === 'hand') this.select(this.drawn?.at(point, kHoverReach / this.view.scale)?.curve ?? null);
    else this.edits.click(tool, point).catch((problem) => this.failed(problem));
  }

  select(curve, reveal = false) {
    this.scene.selected = curve;
    if (curve && reveal) this.view.reveal(curve.middle);
    if (curve) this.say(`Curve ${curve.index + 1} of ${this.drawn.curves.length}: ${measureText(curve)}.`);
    this.curvesPanel.show(this.drawn, curve);
    this.renderer.invalidate();
  }

  anchors(curve) {
    return this.api.anchors(this.opening.id, this.result.revision, curve.index);
  }

  toggleLayer(index) {
    const layer = this.layers.toggle(index);
    if (layer) this.say(`${layer.title} ${this.layers.shown.has(layer.key) ? 'shown' : 'hidden'}. ${layer.help}`);
  }

  // ---- files

  async save() {
    if (!this.history) return;
    try {
      download(await Project.projectFile(this.project, await this.opening.file), `${baseName(this.project.drawing.name)}.inkgrid`);
      this.say('Project saved.');
    } catch (problem) {
      this.say(`The project could not be saved: ${problem.message}.`, true);
    }
  }

  openExport() {
    if (this.history) this.exportDialog.open();
  }

  async exportAs(format, options) {
    await this.solver.settled();
    if (!this.result) throw new Error('there are no curves yet');
    const file = await this.api.exported(this.opening.id, this.result.revision, format, options);
    download(file, `${baseName(this.project.drawing.name)}.${format}`);
    this.say(`Exported as ${format.toUpperCase()}.`);
  }

  async copyCommand() {
    if (!this.history) return;
    const text = commandLine(this.project, this.about.options);
    await navigator.clipboard.writeText(text).then(() => this.say('Command copied.'), () => this.say('The browser did not allow copying: select the command and copy it by hand.', true));
  }

  openHelp() {
    byId('help-dialog').showModal();
  }
}
