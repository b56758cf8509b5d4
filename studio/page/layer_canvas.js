// The layers that the server records, drawn with WebGL: a batch is uploaded once and drawn at any zoom.

import { batchesOf } from './recording.js';
import { kShaders } from './shaders.js';

const kTextureSide = 2048;

// Attributes of each kind: name, numbers, normalised bytes or floats, byte offset; `stride` bytes an element.
const kLayouts = {
  triangles: { stride: 12, vertices: 3, fields: [['a_at', 2, false, 0], ['a_colour', 4, true, 8]] },
  lines: { stride: 24, fields: [['a_from', 2, false, 0], ['a_to', 2, false, 8], ['a_width', 1, false, 16], ['a_colour', 4, true, 20]] },
  discs: { stride: 24, fields: [['a_at', 2, false, 0], ['a_radii', 2, false, 8], ['a_flags', 1, false, 16], ['a_colour', 4, true, 20]] },
};

function compiled(gl, { vertex, fragment }) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

export class LayerCanvas {
  constructor(canvas, redraw) {
    this.canvas = canvas;
    this.redraw = redraw;
    this.recordings = new Map(); // name -> its batches, kept for a context that was lost
    this.uploads = new Map();
    this.gl = null;
  }

  get works() {
    return typeof WebGL2RenderingContext === 'function';
  }

  // A context only once there is something to draw.
  begin() {
    this.gl = this.canvas.getContext('webgl2', { alpha: true, antialias: true, premultipliedAlpha: true });
    if (!this.gl) return;
    this.prepare();
    this.canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.prepare();
      this.uploads.clear();
      this.redraw();
    });
  }

  prepare() {
    const { gl } = this;
    this.programs = Object.fromEntries(Object.entries(kShaders).map(([kind, source]) => [kind, compiled(gl, source)]));
    this.quad = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]), gl.STATIC_DRAW);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  set(name, buffer) {
    this.drop(name);
    this.recordings.set(name, batchesOf(buffer));
  }

  drop(name) {
    for (const { buffer, vertexArray, tiles } of this.uploads.get(name) ?? []) {
      this.gl.deleteBuffer(buffer ?? null);
      this.gl.deleteVertexArray(vertexArray);
      for (const { texture } of tiles ?? []) this.gl.deleteTexture(texture);
    }
    this.uploads.delete(name);
    this.recordings.delete(name);
  }

  dropAll() {
    for (const name of [...this.recordings.keys()]) this.drop(name);
  }

  field(program, [name, size, bytes, offset], stride, divisor) {
    const { gl } = this;
    const place = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, bytes ? gl.UNSIGNED_BYTE : gl.FLOAT, bytes, stride, offset);
    gl.vertexAttribDivisor(place, divisor);
  }

  corners(program) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.quad);
    this.field(program, ['a_corner', 2, false, 0], 8, 0);
  }

  uploaded(batch) {
    const { gl } = this;
    const program = this.programs[batch.kind];
    const vertexArray = gl.createVertexArray();
    gl.bindVertexArray(vertexArray);
    if (batch.kind === 'pixels') {
      this.corners(program);
      return { batch, vertexArray, tiles: this.tilesOf(batch) };
    }
    const { stride, fields, vertices } = kLayouts[batch.kind];
    if (!vertices) this.corners(program);
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, batch.bytes, gl.STATIC_DRAW);
    for (const field of fields) this.field(program, field, stride, vertices ? 0 : 1);
    return { batch, vertexArray, buffer };
  }

  tilesOf({ width, height, side, bytes }) {
    const { gl } = this;
    const tiles = [];
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, width);
    for (let y = 0; y < height; y += kTextureSide)
      for (let x = 0; x < width; x += kTextureSide) {
        const w = Math.min(kTextureSide, width - x), h = Math.min(kTextureSide, height - y);
        const texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, w, h, 0, gl.RED, gl.UNSIGNED_BYTE, bytes, y * width + x);
        for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
        for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
        tiles.push({ texture, box: [x, y, w, h].map((v) => side * v) });
      }
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
    return tiles;
  }

  // `marks` tells how large the marks of a layer are.
  draw(names, view, marks) {
    const drawn = names.filter((name) => this.recordings.has(name));
    this.canvas.hidden = drawn.length === 0;
    if (drawn.length === 0) return;
    if (!this.gl) this.begin();
    const { gl } = this;
    if (!gl || gl.isContextLost()) return;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    for (const name of drawn) {
      if (!this.uploads.has(name)) this.uploads.set(name, this.recordings.get(name).map((batch) => this.uploaded(batch)));
      for (const upload of this.uploads.get(name)) this.drawUpload(upload, view, marks(name));
    }
  }

  drawUpload({ batch, vertexArray, tiles }, view, marks) {
    const { gl } = this;
    const program = this.programs[batch.kind];
    gl.useProgram(program);
    gl.bindVertexArray(vertexArray);
    gl.uniform3f(gl.getUniformLocation(program, 'u_view'), view.scale, view.x, view.y);
    gl.uniform2f(gl.getUniformLocation(program, 'u_screen'), view.width, view.height);
    gl.uniform1f(gl.getUniformLocation(program, 'u_marks'), marks);
    if (batch.kind === 'triangles') return gl.drawArrays(gl.TRIANGLES, 0, 3 * batch.count);
    if (batch.kind !== 'pixels') return gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, batch.count);
    gl.uniform4fv(gl.getUniformLocation(program, 'u_colour'), batch.colour);
    for (const { texture, box } of tiles) {
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform4fv(gl.getUniformLocation(program, 'u_box'), box);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
  }
}
