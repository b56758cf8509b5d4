// Where the drawing is on the screen: screen = scale * drawing + offset, in CSS pixels.

const kLeast = 0.02;
const kMost = 64;
const kStep = 1.25;
const kMargin = { side: 24, top: 20, bottom: 68 }; // below is the dock

export class View {
  constructor(changed) {
    this.changed = changed;
    this.scale = 1;
    this.x = 0;
    this.y = 0;
    this.width = 1; // of the screen
    this.height = 1;
    this.drawing = { width: 0, height: 0 };
    this.fitted = true; // as long as nobody moved it
  }

  resize(width, height) {
    this.x += (width - this.width) / 2;
    this.y += (height - this.height) / 2;
    this.width = width;
    this.height = height;
    if (this.fitted) this.fit();
    this.changed();
  }

  fit(drawing = this.drawing) {
    this.drawing = drawing;
    this.fitted = true;
    if (!drawing.width) return;
    const { side, top, bottom } = kMargin;
    const scale = Math.min((this.width - 2 * side) / drawing.width, (this.height - top - bottom) / drawing.height);
    this.scale = Math.min(kMost, Math.max(kLeast, scale));
    this.x = (this.width - this.scale * drawing.width) / 2;
    this.y = (this.height - bottom + top - this.scale * drawing.height) / 2;
    this.changed();
  }

  // About a point of the screen that stays where it is.
  zoom(factor, x = this.width / 2, y = this.height / 2) {
    this.fitted = false;
    const scale = Math.min(kMost, Math.max(kLeast, this.scale * factor));
    this.x = x - ((x - this.x) * scale) / this.scale;
    this.y = y - ((y - this.y) * scale) / this.scale;
    this.scale = scale;
    this.changed();
  }

  zoomStep(direction) {
    this.zoom(kStep ** direction);
  }

  pan(dx, dy) {
    this.fitted = false;
    const keep = 40; // of the drawing stays in sight
    this.x = Math.min(this.width - keep, Math.max(keep - this.scale * this.drawing.width, this.x + dx));
    this.y = Math.min(this.height - keep, Math.max(keep - this.scale * this.drawing.height, this.y + dy));
    this.changed();
  }

  // Brings a point of the drawing into sight.
  reveal([x, y]) {
    const [sx, sy] = this.toScreen(x, y);
    if (sx > 0 && sy > 0 && sx < this.width && sy < this.height) return;
    this.pan(this.width / 2 - sx, this.height / 2 - sy);
  }

  toDrawing(x, y) {
    return [(x - this.x) / this.scale, (y - this.y) / this.scale];
  }
  toScreen(x, y) {
    return [x * this.scale + this.x, y * this.scale + this.y];
  }
}
