// Reads the marks of a layer as the server's Recording wrote them: batches of triangles, lines, discs, pixels.

export const kKinds = ['triangles', 'lines', 'discs', 'pixels'];
const kElementBytes = { triangles: 36, lines: 24, discs: 24 };

export function batchesOf(buffer) {
  const view = new DataView(buffer);
  const batches = [];
  for (let at = 0; at < buffer.byteLength; ) {
    const kind = kKinds[view.getUint32(at, true)];
    const count = view.getUint32(at + 4, true);
    at += 8;
    if (kind === 'pixels') {
      const width = view.getUint32(at, true), height = view.getUint32(at + 4, true);
      const side = view.getFloat32(at + 8, true);
      const colour = [...new Uint8Array(buffer, at + 12, 4)].map((c) => c / 255);
      batches.push({ kind, count, width, height, side, colour, bytes: new Uint8Array(buffer, at + 16, width * height) });
      at += 16 + 4 * Math.ceil((width * height) / 4);
    } else {
      const bytes = new Uint8Array(buffer, at, count * kElementBytes[kind]);
      batches.push({ kind, count, bytes });
      at += bytes.byteLength;
    }
  }
  return batches;
}
