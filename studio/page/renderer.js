// Draws the stage: paper below, recorded layers, then scribbles, curves and the brush.

import { LayerCanvas } from './layer_canvas.js';
import { drawBrush, drawOverlay } from './overlay.js';

const kRoomOfNode = 14; // px of the screen between two nodes
const kDimmed = 0.38; // of the drawing's darkness, under curves and layers

const kOnlyInput = new Set(['input']);
const kOnlyCurves = new Set(['widths', 'fills']); // as they are exported
const kBoth = new Set(['input', 'curves', 'fills']);

export class Renderer {
  constructor({ paper, layers, curves }, view) {
    this.canvases = [paper, layers, curves];
    this.paper = paper.getContext('2d');
    this.over = curves.getContext('2d');
    this.layers = new LayerCanvas(layers, () => this.invalidate());
    this.view = view;
    this.scene = { drawn: null, paper: null, scribbles: null, shown: new Set(), recorded: [] };
    this.compare = null; // 'input', 'curves', 'both'
    this.split = null; // where, 0..1
    this.pending = false;
  }

  invalidate() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  resize(width, height) {
    this.ratio = Math.min(3, window.devicePixelRatio || 1);
    for (const canvas of this.canvases) {
      canvas.width = Math.max(1, Math.round(width * this.ratio));
      canvas.height = Math.max(1, Math.round(height * this.ratio));
    }
    this.view.resize(width, height);
    this.draw();
  }

  // What is shown now, whatever is held.
  get shown() {
    return { input: kOnlyInput, curves: kOnlyCurves, both: kBoth }[this.compare] ?? this.scene.shown;
  }

  draw() {
    for (const context of [this.paper, this.over]) {
      context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
      context.clearRect(0, 0, this.view.width, this.view.height);
    }
    const { paper } = this.scene;
    const layered = paper && this.split === null && this.compare === null;
    this.layers.draw(layered ? this.scene.recorded : [], this.view, (name) => this.marks(name));
    if (!paper) return;
    if (this.split === null) this.drawSide(this.shown);
    else this.drawSplit();
    drawBrush(this.over, this.scene.brush);
  }

  // Nodes of a grid that is seen from far stay apart.
  marks(name) {
    const { cell } = this.scene; // px of the drawing
    return name === 'grid' && cell ? Math.min(1, Math.max(0.3, (cell * this.view.scale) / kRoomOfNode)) : 1;
  }

  drawSplit() {
    const { width, height } = this.view, at = this.split * width;
    this.clipped(0, at, () => this.drawSide(kOnlyInput));
    this.clipped(at, width - at, () => this.drawSide(kOnlyCurves));
    this.over.fillStyle = '#d81b60';
    this.over.fillRect(at - 1, 0, 2, height);
  }

  clipped(left, width, draw) {
    for (const context of [this.paper, this.over]) {
      context.save();
      context.beginPath();
      context.rect(left, 0, width, this.view.height);
      context.clip();
    }
    draw();
    for (const context of [this.paper, this.over]) context.restore();
  }

  drawSide(shown) {
    const { scene, view } = this;
    const alone = shown === kOnlyInput || (shown.size === 1 && shown.has('input'));
    for (const context of [this.paper, this.over]) {
      context.save();
      context.translate(view.x, view.y);
      context.scale(view.scale, view.scale);
    }
    scene.paper.draw(this.paper, { opacity: !shown.has('input') ? 0 : alone || !scene.drawn ? 1 : kDimmed, scale: view.scale * this.ratio });
    if (shown.has('scribbles')) scene.scribbles.draw(this.over, scene.stroke);
    const plain = shown === kOnlyCurves;
    drawOverlay(this.over, { ...scene, plain, selected: plain ? null : scene.selected, hovered: plain ? null : scene.hovered }, shown, view.scale);
    for (const context of [this.paper, this.over]) context.restore();
  }
}
