// The input: grey pixels on a canvas, in tiles, and the ink that a threshold would give.

const kTile = 2048;
const kPreviewPixels = 2e6;

function tileOf(grey, width, height, left, top, paint) {
  const w = Math.min(kTile, width - left), h = Math.min(kTile, height - top);
  const canvas = document.createElement('canvas');
  canvas.width = w;
  canvas.height = h;
  const context = canvas.getContext('2d');
  const image = context.createImageData(w, h);
  const pixels = new Uint32Array(image.data.buffer);
  for (let y = 0; y < h; ++y)
    for (let x = 0; x < w; ++x) pixels[y * w + x] = paint(grey[(top + y) * width + left + x]);
  context.putImageData(image, 0, 0);
  return { left, top, canvas };
}

const opaque = (grey) => (0xff000000 | (grey << 16) | (grey << 8) | grey) >>> 0;

export class Paper {
  // White until its pixels are there.
  constructor(width, height) {
    this.grey = null;
    this.width = width;
    this.height = height;
    this.preview = null;
    this.tiles = [];
  }

  take(grey) {
    const { width, height } = this;
    this.grey = grey;
    for (let top = 0; top < height; top += kTile)
      for (let left = 0; left < width; left += kTile) this.tiles.push(tileOf(grey, width, height, left, top, opaque));
  }

  // Pixels darker than the threshold, as the method takes them for ink; null ends it.
  showInk(threshold) {
    this.preview = threshold === null || !this.grey ? null : this.inkOf(threshold);
  }

  inkOf(threshold) {
    const step = Math.max(1, Math.ceil(Math.sqrt((this.width * this.height) / kPreviewPixels)));
    const canvas = document.createElement('canvas');
    canvas.width = Math.ceil(this.width / step);
    canvas.height = Math.ceil(this.height / step);
    const context = canvas.getContext('2d');
    const image = context.createImageData(canvas.width, canvas.height);
    const pixels = new Uint32Array(image.data.buffer);
    for (let y = 0, i = 0; y < canvas.height; ++y)
      for (let x = 0; x < canvas.width; ++x, ++i) pixels[i] = this.grey[y * step * this.width + x * step] < threshold ? 0xffa85f2b : 0;
    context.putImageData(image, 0, 0);
    return { canvas, step };
  }

  // In the drawing's coordinates.
  draw(context, { opacity, scale }) {
    context.fillStyle = '#fff';
    context.fillRect(0, 0, this.width, this.height);
    context.globalAlpha = opacity;
    context.imageSmoothingEnabled = scale < 4;
    context.imageSmoothingQuality = 'high';
    for (const { left, top, canvas } of this.tiles) context.drawImage(canvas, left, top);
    context.globalAlpha = 1;
    if (!this.preview) return;
    const { canvas, step } = this.preview;
    context.imageSmoothingEnabled = false;
    context.drawImage(canvas, 0, 0, canvas.width * step, canvas.height * step);
  }
}
