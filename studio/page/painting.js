// The stroke of a brush that is being painted: points in the drawing, and a pause after which its effect is wanted.

const kRest = 140; // ms
const tenth = (x) => Math.round(x * 10) / 10;

export class Painting {
  constructor({ changed, rested }) {
    this.changed = changed;
    this.rested = rested;
    this.stroke = null;
  }

  begin(kind, radius, point) {
    this.stroke = { kind, radius: tenth(radius), points: [point.map(tenth)] };
    this.waitForRest();
    this.changed();
  }

  // Points nearer than an eighth of the brush say nothing new.
  add(point) {
    if (!this.stroke) return;
    const [x, y] = this.stroke.points.at(-1);
    if (Math.hypot(point[0] - x, point[1] - y) < Math.max(1, this.stroke.radius / 8)) return;
    this.stroke = { ...this.stroke, points: [...this.stroke.points, point.map(tenth)] };
    this.waitForRest();
    this.changed();
  }

  waitForRest() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.stroke && this.rested(this.stroke), kRest);
  }

  // The whole stroke, or null where none was begun.
  end() {
    clearTimeout(this.timer);
    const stroke = this.stroke;
    this.stroke = null;
    this.changed();
    return stroke;
  }
}
