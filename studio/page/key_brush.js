// The brush, or the view where there is none, moved with keys.

const kStep = 8; // px of the screen
const kLongStep = 48;
const kViewSteps = 3;

export class KeyBrush {
  constructor(studio) {
    this.studio = studio;
  }

  get cursor() {
    const { studio } = this;
    studio.cursor ??= { x: studio.view.width / 2, y: studio.view.height / 2 };
    return studio.cursor;
  }

  get point() {
    return this.studio.view.toDrawing(this.cursor.x, this.cursor.y);
  }

  move(x, y, far) {
    const { studio } = this, step = far ? kLongStep : kStep;
    if (!studio.tools.current.brush) return studio.view.pan(-kViewSteps * step * x, -kViewSteps * step * y);
    studio.cursor = { x: this.cursor.x + step * x, y: this.cursor.y + step * y };
    studio.painting.add(this.point);
    studio.showBrush();
  }

  // Puts it down, and lifts it.
  toggle() {
    const { studio } = this, { current, radius } = studio.tools;
    if (!studio.history || !current.brush) return;
    if (studio.painting.stroke) {
      studio.endStroke();
      return studio.say('Brush lifted.');
    }
    studio.painting.begin(current.key, radius, this.point);
    studio.say('Brush down: move it with the arrow keys, lift it with Space.');
    studio.showBrush();
  }
}
