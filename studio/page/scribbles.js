// The scribbles as a picture: later strokes cover earlier ones, the eraser uncovers the drawing.

export const kScribbleColours = { less: '#7b3fb5', more: '#e8790c' };
const kMostPixels = 4e6;

export class ScribblePicture {
  constructor(width, height) {
    this.scale = Math.min(1, Math.sqrt(kMostPixels / (width * height)));
    this.canvas = document.createElement('canvas');
    this.canvas.width = Math.max(1, Math.round(width * this.scale));
    this.canvas.height = Math.max(1, Math.round(height * this.scale));
    this.context = this.canvas.getContext('2d');
    this.shown = [];
  }

  show(scribbles) {
    if (scribbles === this.shown) return;
    const added = this.shown.every((scribble, i) => scribbles[i] === scribble);
    if (!added) this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    for (const scribble of scribbles.slice(added ? this.shown.length : 0)) this.paint(this.context, scribble, this.scale);
    this.shown = scribbles;
  }

  paint(context, { kind, radius, points }, scale) {
    const stroke = () => {
      context.beginPath();
      context.moveTo(points[0][0], points[0][1]);
      for (const [x, y] of points.length > 1 ? points : [points[0], points[0]]) context.lineTo(x, y);
      context.stroke();
    };
    context.save();
    context.scale(scale, scale);
    context.lineCap = context.lineJoin = 'round';
    context.lineWidth = 2 * radius;
    context.globalCompositeOperation = 'destination-out';
    stroke();
    context.globalCompositeOperation = 'source-over';
    context.strokeStyle = kScribbleColours[kind] ?? 'transparent';
    if (kind !== 'erase') stroke();
    context.restore();
  }

  // In the drawing's coordinates, with the stroke that is being painted.
  draw(context, current) {
    context.save();
    context.globalAlpha = 0.32;
    context.drawImage(this.canvas, 0, 0, this.canvas.width / this.scale, this.canvas.height / this.scale);
    context.restore();
    if (!current) return;
    context.save();
    context.globalAlpha = current.kind === 'erase' ? 0.7 : 0.32;
    context.lineCap = context.lineJoin = 'round';
    context.lineWidth = 2 * current.radius;
    context.strokeStyle = kScribbleColours[current.kind] ?? '#fff';
    context.beginPath();
    context.moveTo(current.points[0][0], current.points[0][1]);
    for (const [x, y] of current.points) context.lineTo(x, y);
    context.stroke();
    context.restore();
  }
}
