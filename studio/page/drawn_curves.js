// The curves of a result, ready to be drawn, measured and found under the pointer.

const kSteps = 12; // points a segment, for lengths and distances
const kTurns = ['#1f77b4', '#d9480f', '#2b8a3e', '#7b3fb5', '#8c4a3c', '#c2257f', '#0c8599', '#6b6b00', '#3949ab', '#c62828'];

function flattened(points) {
  const flat = [points[0], points[1]];
  for (let i = 2; i + 5 < points.length; i += 6) {
    const x0 = points[i - 2], y0 = points[i - 1];
    for (let k = 1; k <= kSteps; ++k) {
      const t = k / kSteps, s = 1 - t;
      const a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
      flat.push(a * x0 + b * points[i] + c * points[i + 2] + d * points[i + 4], a * y0 + b * points[i + 1] + c * points[i + 3] + d * points[i + 5]);
    }
  }
  return Float64Array.from(flat);
}

function pathOf(points, closed) {
  const path = new Path2D();
  path.moveTo(points[0], points[1]);
  for (let i = 2; i + 5 < points.length; i += 6)
    path.bezierCurveTo(points[i], points[i + 1], points[i + 2], points[i + 3], points[i + 4], points[i + 5]);
  if (closed) path.closePath();
  return path;
}

// Outlines with holes: all of one fill in one path.
function pathOfFill(outlines) {
  const path = new Path2D();
  for (const points of outlines) path.addPath(pathOf(points, true));
  return path;
}

function lengthOf(flat) {
  let length = 0;
  for (let i = 2; i < flat.length; i += 2) length += Math.hypot(flat[i] - flat[i - 2], flat[i + 1] - flat[i - 1]);
  return length;
}

function boxOf(flat) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < flat.length; i += 2) {
    box[0] = Math.min(box[0], flat[i]);
    box[1] = Math.min(box[1], flat[i + 1]);
    box[2] = Math.max(box[2], flat[i]);
    box[3] = Math.max(box[3], flat[i + 1]);
  }
  return box;
}

// A curve keeps its colour as long as it keeps its id.
function colourOf(id) {
  let sum = 0;
  for (const c of id) sum = (sum * 31 + c.charCodeAt(0)) >>> 0;
  return kTurns[sum % kTurns.length];
}

function nearestOf(flat, x, y) {
  let best = { distance: Infinity, point: null };
  for (let i = 2; i < flat.length; i += 2) {
    const ax = flat[i - 2], ay = flat[i - 1], dx = flat[i] - ax, dy = flat[i + 1] - ay;
    const t = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
    const px = ax + t * dx, py = ay + t * dy, distance = Math.hypot(x - px, y - py);
    if (distance < best.distance) best = { distance, point: [px, py] };
  }
  return best;
}

export class DrawnCurve {
  constructor(told, index) {
    this.id = told.id;
    this.closed = told.closed;
    this.points = told.points;
    this.take(told, index);
    this.flat = flattened(told.points);
    this.path = pathOf(told.points, told.closed);
    this.length = lengthOf(this.flat);
    this.box = boxOf(this.flat);
    this.segments = (told.points.length - 2) / 6;
    this.colour = colourOf(told.id);
  }

  // What may differ though the curve runs the same.
  take(told, index) {
    this.index = index;
    this.width = told.width;
    this.coverage = told.coverage;
    this.startJunction = told.start;
    this.endJunction = told.end;
    return this;
  }

  get start() {
    return [this.points[0], this.points[1]];
  }
  get finish() {
    return this.points.slice(-2);
  }
  get middle() {
    const half = 2 * Math.floor(this.flat.length / 4);
    return [this.flat[half], this.flat[half + 1]];
  }
}

const sameShape = (a, b) => a.closed === b.closed && a.points.length === b.points.length && a.points.every((x, i) => x === b.points[i]);

export class DrawnCurves {
  // Curves that `before` holds unchanged are not measured again.
  constructor(result, before = null) {
    const known = new Map((before?.curves ?? []).map((curve) => [curve.id, curve]));
    this.result = result;
    this.junctions = result.junctions;
    this.fills = result.fills.map(pathOfFill);
    this.curves = result.curves.map((told, index) => {
      const old = known.get(told.id);
      return old && sameShape(old, told) ? old.take(told, index) : new DrawnCurve(told, index);
    });
  }

  // The curve under a point, and where; none further than `reach`.
  at([x, y], reach) {
    let best = { distance: reach, curve: null, point: null };
    for (const curve of this.curves) {
      const [left, top, right, bottom] = curve.box;
      if (x < left - reach || x > right + reach || y < top - reach || y > bottom + reach) continue;
      const near = nearestOf(curve.flat, x, y);
      if (near.distance <= best.distance) best = { ...near, curve };
    }
    return best.curve ? best : null;
  }

  // The end of an open curve near a point: { curve, end: 'start' | 'end', point }.
  endAt([x, y], reach) {
    let best = null;
    for (const curve of this.curves) {
      if (curve.closed) continue;
      for (const [end, point] of [['start', curve.start], ['end', curve.finish]]) {
        const distance = Math.hypot(point[0] - x, point[1] - y);
        if (distance <= reach && (!best || distance < best.distance)) best = { curve, end, point, distance };
      }
    }
    return best;
  }

  // An end of the curve and the end nearest to it, of another curve or its own other one.
  nearestEnds(curve) {
    const ends = this.curves.filter((c) => !c.closed).flatMap((c) => [{ curve: c, end: 'start', point: c.start }, { curve: c, end: 'end', point: c.finish }]);
    let best = null;
    for (const from of ends.filter((e) => e.curve === curve))
      for (const to of ends) {
        const distance = Math.hypot(from.point[0] - to.point[0], from.point[1] - to.point[1]);
        if (!(to.curve === curve && to.end === from.end) && (!best || distance < best.distance)) best = { from, to, distance };
      }
    return best;
  }

  find(id) {
    return this.curves.find((curve) => curve.id === id) ?? null;
  }
}
