// What the keys do on the stage.

const kStep = 8; // px of the screen
const kLongStep = 48;

export class KeyActions {
  constructor(studio) {
    this.studio = studio;
  }

  chooseTool(key) {
    this.studio.tools.choose(key);
  }
  toggleLayer(index) {
    this.studio.toggleLayer(index);
  }
  hold(way) {
    this.studio.compare.hold(way);
  }
  toggleSplit() {
    this.studio.compare.toggleSplit();
  }
  zoomStep(direction) {
    this.studio.view.zoomStep(direction);
  }
  fit() {
    this.studio.view.fit();
  }
  undo() {
    this.studio.undo();
  }
  redo() {
    this.studio.redo();
  }
  save() {
    this.studio.save();
  }
  pickFile() {
    this.studio.pickFile();
  }
  openExport() {
    this.studio.openExport();
  }
  openHelp() {
    this.studio.openHelp();
  }

  brushStep(direction) {
    const { tools } = this.studio;
    tools.setRadius(Math.round(tools.radius * (direction > 0 ? 1.2 : 1 / 1.2) + 0.5 * direction));
  }

  get cursor() {
    const { studio } = this;
    studio.cursor ??= { x: studio.view.width / 2, y: studio.view.height / 2 };
    return studio.cursor;
  }

  // Moves the view, or the brush and what it paints.
  arrow([x, y], far) {
    const { studio } = this, step = far ? kLongStep : kStep;
    if (!studio.tools.current.brush) return studio.view.pan(-3 * step * x, -3 * step * y);
    studio.cursor = { x: this.cursor.x + step * x, y: this.cursor.y + step * y };
    studio.painting.add(studio.view.toDrawing(studio.cursor.x, studio.cursor.y));
    studio.showBrush();
  }

  // Puts the brush down, and lifts it.
  space() {
    const { studio } = this, { current, radius } = studio.tools;
    if (!studio.history || !current.brush) return;
    if (studio.painting.stroke) {
      studio.endStroke();
      return studio.say('Brush lifted.');
    }
    studio.painting.begin(current.key, radius, studio.view.toDrawing(this.cursor.x, this.cursor.y));
    studio.say('Brush down: move it with the arrow keys, lift it with Space.');
    studio.showBrush();
  }

  // Uses the tool on the selected curve.
  enter() {
    const { studio } = this, { selected } = studio.scene;
    if (!selected) return;
    const act = { delete: () => studio.edits.remove(selected), split: () => studio.edits.click('split', selected.middle), join: () => studio.edits.joinNearest(selected) }[studio.tools.current.key];
    act?.().catch((problem) => studio.failed(problem));
  }

  deleteSelected() {
    const { selected } = this.studio.scene;
    if (selected) this.studio.edits.remove(selected).catch((problem) => this.studio.failed(problem));
  }

  nextCurve(step) {
    const curves = this.studio.drawn?.curves ?? [], { selected } = this.studio.scene;
    if (curves.length === 0) return;
    const now = selected ? selected.index : step > 0 ? -1 : 0;
    this.studio.select(curves[(now + step + curves.length) % curves.length], true);
  }

  // The innermost thing that is going on.
  escape() {
    const { studio } = this;
    if (studio.painting.stroke) return studio.abandonStroke();
    if (studio.solver.busy) return studio.solver.cancel();
    studio.edits.reset();
    studio.scene.target = null;
    studio.select(null);
  }
}
