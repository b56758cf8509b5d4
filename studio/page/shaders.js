// One program a kind of mark.  u_view: scale and offset from the drawing to CSS pixels; u_screen: CSS pixels of the canvas; u_marks:
// how large marks are that do not grow with the drawing, 1 as they were recorded.

const kHead = `#version 300 es
precision highp float;
uniform vec3 u_view;
uniform vec2 u_screen;
uniform float u_marks;
vec2 seen(vec2 p) { return p * u_view.x + u_view.yz; }
vec4 placed(vec2 s) { return vec4(2.0 * s.x / u_screen.x - 1.0, 1.0 - 2.0 * s.y / u_screen.y, 0.0, 1.0); }
`;

const kPlain = `#version 300 es
precision highp float;
in vec4 v_colour;
out vec4 colour;
void main() { colour = vec4(v_colour.rgb * v_colour.a, v_colour.a); }
`;

export const kShaders = {
  triangles: {
    vertex: `${kHead}
in vec2 a_at;
in vec4 a_colour;
out vec4 v_colour;
void main() { v_colour = a_colour; gl_Position = placed(seen(a_at)); }
`,
    fragment: kPlain,
  },
  // A quad a line, its ends half a width further; thinner than a pixel becomes fainter.
  lines: {
    vertex: `${kHead}
in vec2 a_corner;
in vec2 a_from;
in vec2 a_to;
in float a_width;
in vec4 a_colour;
out vec4 v_colour;
void main() {
  vec2 p = seen(a_from), q = seen(a_to), along = q - p;
  float length_ = length(along);
  along = length_ > 0.0 ? along / length_ : vec2(1.0, 0.0);
  float thick = a_width * u_marks, width = max(thick, 1.0);
  vec2 s = mix(p, q, a_corner.x) + 0.5 * width * (sign(a_corner.x - 0.5) * 0.5 * along + a_corner.y * vec2(-along.y, along.x));
  v_colour = vec4(a_colour.rgb, a_colour.a * min(1.0, thick));
  gl_Position = placed(s);
}
`,
    fragment: kPlain,
  },
  // Flags: 1 white rim, 2 radii in px of the drawing, 4 square.
  discs: {
    vertex: `${kHead}
in vec2 a_corner;
in vec2 a_at;
in vec2 a_radii;
in float a_flags;
in vec4 a_colour;
out vec4 v_colour;
out vec2 v_at;
flat out vec2 v_radii;
flat out int v_flags;
void main() {
  v_flags = int(a_flags);
  v_radii = a_radii * ((v_flags & 2) != 0 ? u_view.x : u_marks);
  v_at = (vec2(a_corner.x * 2.0 - 1.0, a_corner.y)) * (v_radii.x + 2.0);
  v_colour = a_colour;
  gl_Position = placed(seen(a_at) + v_at);
}
`,
    fragment: `#version 300 es
precision highp float;
in vec4 v_colour;
in vec2 v_at;
flat in vec2 v_radii;
flat in int v_flags;
out vec4 colour;
void main() {
  float d = (v_flags & 4) != 0 ? max(abs(v_at.x), abs(v_at.y)) : length(v_at);
  float inside = clamp(v_radii.x - d + 0.5, 0.0, 1.0);
  float hole = v_radii.y > 0.0 ? clamp(d - v_radii.y + 0.5, 0.0, 1.0) : 1.0;
  float rim = (v_flags & 1) != 0 ? clamp(v_radii.x + 1.0 - d + 0.5, 0.0, 1.0) : 0.0;
  float a = v_colour.a * inside * hole;
  float white = v_colour.a * rim * (1.0 - inside);
  colour = vec4(v_colour.rgb * a + vec3(white), a + white);
}
`,
  },
  pixels: {
    vertex: `${kHead}
in vec2 a_corner;
uniform vec4 u_box;
out vec2 v_uv;
void main() {
  v_uv = vec2(a_corner.x, 0.5 * (a_corner.y + 1.0));
  gl_Position = placed(seen(u_box.xy + v_uv * u_box.zw));
}
`,
    fragment: `#version 300 es
precision highp float;
in vec2 v_uv;
uniform sampler2D u_mask;
uniform vec4 u_colour;
out vec4 colour;
void main() {
  float a = u_colour.a * step(0.5 / 255.0, texture(u_mask, v_uv).r);
  colour = vec4(u_colour.rgb * a, a);
}
`,
  },
};
