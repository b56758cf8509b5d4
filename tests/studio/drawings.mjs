// Small drawings as PNG bytes.
import { crc32 } from './crc32.mjs';
import { deflateSync } from 'node:zlib';

export class Sheet {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.grey = new Uint8Array(width * height).fill(255);
  }

  line([x0, y0], [x1, y1], width = 6) {
    const steps = Math.ceil(2 * Math.hypot(x1 - x0, y1 - y0)) + 1;
    for (let k = 0; k <= steps; ++k) this.disc(x0 + ((x1 - x0) * k) / steps, y0 + ((y1 - y0) * k) / steps, width / 2);
    return this;
  }

  disc(x, y, radius) {
    for (let j = Math.max(0, Math.floor(y - radius)); j <= Math.min(this.height - 1, y + radius); ++j)
      for (let i = Math.max(0, Math.floor(x - radius)); i <= Math.min(this.width - 1, x + radius); ++i)
        if ((i + 0.5 - x) ** 2 + (j + 0.5 - y) ** 2 <= radius * radius) this.grey[j * this.width + i] = 0;
    return this;
  }

  png() {
    const header = Buffer.alloc(13);
    header.writeUInt32BE(this.width, 0);
    header.writeUInt32BE(this.height, 4);
    header[8] = 8; // bits, grey
    const rows = Buffer.alloc((this.width + 1) * this.height);
    for (let y = 0; y < this.height; ++y) rows.set(this.grey.subarray(y * this.width, (y + 1) * this.width), y * (this.width + 1) + 1);
    return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', header), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
  }
}

function chunk(kind, data) {
  const body = Buffer.concat([Buffer.from(kind, 'latin1'), data]);
  const length = Buffer.alloc(4), check = Buffer.alloc(4);
  length.writeUInt32BE(data.length);
  check.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, check]);
}

// Two strokes that cross, and two that run side by side.
export const cross = () => new Sheet(240, 180).line([30, 60], [210, 60]).line([90, 20], [90, 160]).line([140, 100], [220, 140]).line([140, 112], [220, 152]).png();

// Enough work for some seconds.
export function lattice() {
  const sheet = new Sheet(1400, 1100);
  for (let k = 0; k < 14; ++k) sheet.line([20, 30 + 74 * k], [1380, 60 + 72 * k], 4).line([40 + 95 * k, 10], [70 + 94 * k, 1090], 4);
  return sheet.png();
}
