// Curves and what lies over them, on a 2-D canvas in the drawing's coordinates.

const kFree = '#d81b60', kJunction = '#e02020', kHandle = '#777', kControl = '#0a7d5c';

function eachBezier(points, visit) {
  for (let i = 2; i + 5 < points.length; i += 6) visit(i);
}

function drawHandles(context, drawn, px) {
  const lines = new Path2D(), controls = new Path2D(), joints = new Path2D();
  for (const { points } of drawn.curves)
    eachBezier(points, (i) => {
      lines.moveTo(points[i - 2], points[i - 1]);
      lines.lineTo(points[i], points[i + 1]);
      lines.moveTo(points[i + 4], points[i + 5]);
      lines.lineTo(points[i + 2], points[i + 3]);
      for (const k of [i, i + 2]) controls.rect(points[k] - 2 * px, points[k + 1] - 2 * px, 4 * px, 4 * px);
      joints.moveTo(points[i + 4] + 2.5 * px, points[i + 5]);
      joints.arc(points[i + 4], points[i + 5], 2.5 * px, 0, 2 * Math.PI);
    });
  context.lineWidth = 0.9 * px;
  context.strokeStyle = kHandle;
  context.stroke(lines);
  context.fillStyle = kControl;
  context.fill(controls);
  context.fillStyle = '#111';
  context.fill(joints);
}

function drawEnds(context, drawn, px) {
  const rings = new Path2D(), discs = new Path2D();
  const circle = (path, [x, y], radius) => {
    path.moveTo(x + radius, y);
    path.arc(x, y, radius, 0, 2 * Math.PI);
  };
  for (const curve of drawn.curves) {
    if (curve.closed) continue;
    if (curve.startJunction < 0) circle(rings, curve.start, 5 * px);
    if (curve.endJunction < 0) circle(rings, curve.finish, 5 * px);
  }
  for (const junction of drawn.junctions) circle(discs, junction, 4.5 * px);
  context.lineWidth = 2 * px;
  context.strokeStyle = kFree;
  context.stroke(rings);
  context.fillStyle = kJunction;
  context.fill(discs);
  context.lineWidth = px;
  context.strokeStyle = '#fff';
  context.stroke(discs);
}

function drawWidths(context, drawn, plain) {
  context.globalAlpha = plain ? 1 : 0.45;
  context.strokeStyle = '#111';
  for (const curve of drawn.curves) {
    context.lineWidth = Math.max(curve.width, 0.5);
    context.stroke(curve.path);
  }
  context.globalAlpha = 1;
}

function drawFills(context, drawn) {
  context.fillStyle = 'rgb(38 50 74 / 75%)';
  for (const path of drawn.fills) context.fill(path, 'evenodd');
}

function drawCurves(context, drawn, px) {
  for (const curve of drawn.curves) {
    context.lineWidth = 2.2 * px;
    context.strokeStyle = curve.colour;
    context.stroke(curve.path);
  }
}

function highlight(context, curve, px, width, halo) {
  if (!curve) return;
  context.lineWidth = (width + 4) * px;
  context.strokeStyle = halo;
  context.stroke(curve.path);
  context.lineWidth = width * px;
  context.strokeStyle = curve.colour;
  context.stroke(curve.path);
}

function drawTarget(context, target, px) {
  if (!target) return;
  const { from, to } = target;
  context.strokeStyle = kFree;
  context.fillStyle = '#fff';
  context.lineWidth = 2 * px;
  if (from && to) {
    context.setLineDash([6 * px, 4 * px]);
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
    context.setLineDash([]);
  }
  for (const point of [from, to]) {
    if (!point) continue;
    context.beginPath();
    context.arc(...point, 6 * px, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}

// scene: { drawn, hovered, selected, target, plain }; shown: the keys of the layers.
export function drawOverlay(context, scene, shown, scale) {
  const px = 1 / scale;
  context.lineCap = context.lineJoin = 'round';
  const { drawn } = scene;
  if (!drawn) return;
  if (shown.has('fills')) drawFills(context, drawn);
  if (shown.has('widths')) drawWidths(context, drawn, scene.plain);
  if (shown.has('curves')) drawCurves(context, drawn, px);
  highlight(context, scene.selected, px, 3.2, 'rgb(255 196 0 / 90%)');
  if (scene.hovered !== scene.selected) highlight(context, scene.hovered, px, 3.2, 'rgb(255 255 255 / 90%)');
  if (shown.has('handles')) {
    drawHandles(context, drawn, px);
    drawEnds(context, drawn, px);
  }
  drawTarget(context, scene.target, px);
}

// The brush where it would paint, in screen pixels.
export function drawBrush(context, brush) {
  if (!brush) return;
  context.beginPath();
  context.arc(brush.x, brush.y, Math.max(2, brush.radius), 0, 2 * Math.PI);
  context.lineWidth = 3;
  context.strokeStyle = 'rgb(255 255 255 / 90%)';
  context.stroke();
  context.lineWidth = 1.5;
  context.strokeStyle = brush.colour;
  context.stroke();
}
