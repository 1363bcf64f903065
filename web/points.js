// Clouds of points, drawn by the graphics processor (WebGL2) or, where there is none or one that is mere software, which takes ten
// times as long, by hand: the same picture.
// Each point is two pixels by two. What a point has of colour is its tint: red, green, blue and how much of them; 0: as much as
// points lie on top of each other; 255: it was selected, and lies in front of all that were not.
import {make, ticks, tickTexts} from "/tools.js";

const share = count => Math.min(1, 0.35 + 0.13 * Math.log2(count));

const POINTS = `#version 300 es
precision highp float;
layout(location = 0) in vec4 a;
layout(location = 1) in vec4 b;
layout(location = 2) in vec4 c;
layout(location = 3) in vec4 tint;
uniform vec4 right[3], up[3], eye[3];
uniform vec2 size;
uniform float scale;
flat out vec4 colour;
void main() {
  float x = dot(right[0], a) + dot(right[1], b) + dot(right[2], c), y = dot(up[0], a) + dot(up[1], b) + dot(up[2], c),
        z = dot(eye[0], a) + dot(eye[1], b) + dot(eye[2], c);
  vec2 at = floor(vec2(0.5 * size.x + scale * x, 0.5 * size.y - scale * y)) + 1.0;
  float far = -z / (1.0 + abs(z));
  gl_Position = vec4(2.0 * at.x / size.x - 1.0, 1.0 - 2.0 * at.y / size.y, tint.a == 1.0 ? 0.2 * far - 0.75 : 0.7 * far + 0.25, 1.0);
  gl_PointSize = 2.0;
  colour = tint;
}`;
const NEAREST = `#version 300 es
precision highp float;
flat in vec4 colour;
out vec4 to;
void main() { to = colour; }`;
const COUNT = `#version 300 es
precision highp float;
flat in vec4 colour;
out vec4 to;
void main() { to = vec4(1.0 / 255.0); }`;
const WHOLE = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
// Sums of a byte end at 255, long after the share is 1.
const PICTURE = `#version 300 es
precision highp float;
uniform sampler2D nearest, count;
uniform vec3 ground;
out vec4 to;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float n = 255.0 * texelFetch(count, at, 0).r;
  vec4 colour = texelFetch(nearest, at, 0);
  float s = n < 0.5 ? 0.0 : colour.a > 0.0 ? colour.a : min(1.0, 0.35 + 0.13 * log2(n));
  to = vec4(mix(ground, colour.rgb, s), 1.0);
}`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(`the graphics processor does not take the points: ${gl.getProgramInfoLog(made)}`);
  const places = {};
  for (let k = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); k-- > 0;) { const {name} = gl.getActiveUniform(made, k); places[name.replace("[0]", "")] = gl.getUniformLocation(made, name); }
  return {made, places};
}

class ByGraphics {
  constructor(canvas) {
    this.canvas = canvas;
    const gl = this.gl = canvas.getContext("webgl2", {alpha: false, antialias: false, depth: false});
    if (!gl) throw new Error("no WebGL2");
    this.nearest = program(gl, POINTS, NEAREST);
    this.count = program(gl, POINTS, COUNT);
    this.picture = program(gl, WHOLE, PICTURE);
    [this.places, this.colours, this.whole] = [0, 1, 2].map(() => gl.createBuffer());
    this.sheets = [0, 1].map(() => ({frame: gl.createFramebuffer(), texture: gl.createTexture()}));
    this.depth = gl.createRenderbuffer();
  }

  // Whether 20,000 points take longer than by hand: software says of itself that it is a graphics processor.
  isSlow() {
    const n = 20000, size = 400;
    this.take(Float32Array.from({length: 3 * n}, (_, i) => i * 0.618034 % 2 - 1), n, 3);
    this.tint(new Uint8Array(4 * n));
    let begun = 0;
    for (let k = 0; k < 2; ++k) {  // the first gets things ready
      begun = performance.now();
      this.draw({basis: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], scale: 200, W: size, H: size, ground: [0, 0, 0]});
      this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));  // waits for it
    }
    return performance.now() - begun > 20;
  }

  take(values, n, axes) {
    const gl = this.gl, whole = new Uint32Array(n);
    // What is no number is not drawn.
    this.n = 0;
    for (let i = 0; i < n; ++i) if (Number.isFinite(values[i * axes])) whole[this.n++] = i;
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.whole);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, whole.subarray(0, this.n), gl.STATIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    for (let k = 0; k < 3; ++k) {
      gl.vertexAttrib4f(k, 0, 0, 0, 0);
      if (4 * k >= axes) { gl.disableVertexAttribArray(k); continue; }
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, Math.min(4, axes - 4 * k), gl.FLOAT, false, 4 * axes, 16 * k);
    }
  }

  tint(colours) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
    gl.bufferData(gl.ARRAY_BUFFER, colours, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(3);
    gl.vertexAttribPointer(3, 4, gl.UNSIGNED_BYTE, true, 0, 0);
  }

  fit(W, H) {
    const gl = this.gl;
    if (this.canvas.width === W && this.canvas.height === H && this.ready) return;
    [this.canvas.width, this.canvas.height, this.ready] = [W, H, true];
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, W, H);
    this.sheets.forEach(({frame, texture}, k) => {
      gl.activeTexture(gl.TEXTURE0 + k);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, W, H, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      if (k === 0) gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
    });
  }

  draw({basis, scale, W, H, ground}) {
    const gl = this.gl;
    this.fit(W, H);
    gl.viewport(0, 0, W, H);
    gl.clearColor(0, 0, 0, 0);
    const rows = basis.map(row => Float32Array.from({length: 12}, (_, k) => row[k] || 0));
    [this.nearest, this.count].forEach(({made, places}, k) => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.sheets[k].frame);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      for (const [what, on] of [[gl.DEPTH_TEST, k === 0], [gl.BLEND, k === 1]]) on ? gl.enable(what) : gl.disable(what);
      gl.blendFunc(gl.ONE, gl.ONE);
      gl.useProgram(made);
      ["right", "up", "eye"].forEach((name, row) => gl.uniform4fv(places[name], rows[row]));
      gl.uniform2f(places.size, W, H);
      gl.uniform1f(places.scale, scale);
      gl.drawElements(gl.POINTS, this.n, gl.UNSIGNED_INT, 0);
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.BLEND);
    const {made, places} = this.picture;
    gl.useProgram(made);
    gl.uniform1i(places.nearest, 0);
    gl.uniform1i(places.count, 1);
    gl.uniform3f(places.ground, ...ground.map(c => c / 255));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

class ByHand {
  constructor(canvas) { this.canvas = canvas; }
  take(values, n, axes) { Object.assign(this, {values, n, axes}); }
  tint(colours) { this.colours = colours; }

  // While things move every some-th point will do.
  draw({basis, scale, W, H, ground, moving}) {
    const {values, n, axes, colours, canvas} = this, [r, u, e] = basis, size = r.length, stride = moving ? Math.ceil(n / 60000) : 1;
    if (canvas.width !== W || canvas.height !== H || !this.count) {
      [canvas.width, canvas.height] = [W, H];
      this.context = canvas.getContext("2d");
      this.picture = this.context.createImageData(W, H);
      [this.count, this.depth, this.last] = [new Uint16Array(W * H), new Float32Array(W * H), new Int32Array(W * H)];
    }
    const {count, depth, last, picture} = this, out = picture.data;
    count.fill(0);
    for (let i = 0; i < n; i += stride) {
      let x = 0, y = 0, z = 0;
      for (let k = 0, at = i * axes; k < size; ++k) { const v = values[at + k]; x += r[k] * v; y += u[k] * v; z += e[k] * v; }
      const column = Math.floor(W / 2 + scale * x), row = Math.floor(H / 2 - scale * y);
      if (!(column >= 0 && row >= 0 && column < W - 1 && row < H - 1)) continue;
      if (colours[4 * i + 3] === 255) z += 1e6;
      for (let k = 0, to = row * W + column; k < 4; to += k++ === 1 ? W - 1 : 1) {
        if (!count[to] || z > depth[to]) { depth[to] = z; last[to] = i; }
        if (count[to] < 65535) ++count[to];
      }
    }
    for (let k = 0; k < count.length; ++k) {
      const i = 4 * last[k], s = !count[k] ? 0 : colours[i + 3] ? colours[i + 3] / 255 : share(count[k] * stride);
      for (let c = 0; c < 3; ++c) out[4 * k + c] = ground[c] + s * (colours[i + c] - ground[c]);
      out[4 * k + 3] = 255;
    }
    this.context.putImageData(picture, 0, 0);
  }
}

// Draws below the picture of `canvas`; `kind`: "graphics" or "hand". `by`: one of them, whether it is fast or not. `lost` is called where
// the graphics processor is taken away: another is to be made.
export function pointsBelow(canvas, lost, by) {
  let drawn;
  try {
    if (by === "hand") throw new Error("not wanted");
    drawn = new ByGraphics(make("canvas", {"aria-hidden": "true"}));
    if (by !== "graphics" && drawn.isSlow()) throw new Error("slow");
    drawn.kind = "graphics";
    drawn.canvas.addEventListener("webglcontextlost", lost);
  } catch (error) {
    if (by === "graphics") throw error;
    drawn = new ByHand(make("canvas", {"aria-hidden": "true"}));
    drawn.kind = "hand";
  }
  canvas.before(drawn.canvas);
  canvas.dataset.by = drawn.kind;
  return drawn;
}

// Ticks where two axes lie in the picture, arrows else.
export function drawAxes(context, w, h, {basis, middle, spread, zoom, name, colour}) {
  const scale = 0.4 * Math.min(w, h) * zoom, flat = row => row.findIndex(v => Math.abs(v) > 0.9999);
  const [a, b] = [flat(basis[0]), flat(basis[1])];
  context.strokeStyle = context.fillStyle = colour;
  context.font = "12px sans-serif";
  context.lineWidth = 1;
  if (a >= 0 && b >= 0) {
    const low = (k, s) => middle[k] - s / scale / 2 * spread[k], high = (k, s) => middle[k] + s / scale / 2 * spread[k];
    context.textAlign = "center";
    const across = ticks(low(a, w), high(a, w), 6), upwards = ticks(low(b, h), high(b, h), 6), names = [tickTexts(across), tickTexts(upwards)];
    for (const [k, t] of across.entries()) {
      const x = w / 2 + scale * (t - middle[a]) / spread[a];
      if (x < 50 || x > w - 30) continue;
      context.fillRect(x, h - 24, 1, 5); context.fillText(names[0][k], x, h - 7);
    }
    context.textAlign = "left";
    for (const [k, t] of upwards.entries()) {
      const y = h / 2 - scale * (t - middle[b]) / spread[b];
      if (y < 34 || y > h - 30) continue;
      context.fillRect(4, y, 5, 1); context.fillText(names[1][k], 12, y + 4);
    }
    context.fillText(`\u2191 ${name(b)}`, 12, 18);
    context.textAlign = "right";
    context.fillText(`${name(a)} \u2192`, w - 10, h - 28);
    context.textAlign = "left";
    return;
  }
  for (let k = 0; k < basis[0].length; ++k) {
    const x = basis[0][k], y = basis[1][k], l = 0.42 * Math.min(w, h);
    if (Math.hypot(x, y) < 0.02) continue;
    context.beginPath(); context.moveTo(w / 2, h / 2); context.lineTo(w / 2 + l * x, h / 2 - l * y); context.stroke();
    if (Math.hypot(x, y) > 0.12) context.fillText(name(k), w / 2 + l * x - 10, h / 2 - l * y - 4);
  }
}

export function outline(context, points) {
  for (const [colour, width] of [["#000", 3.4], ["#fff", 1.5]]) {
    context.strokeStyle = colour; context.lineWidth = width;
    context.beginPath();
    points.forEach(([x, y], i) => i ? context.lineTo(x, y) : context.moveTo(x, y));
    context.closePath(); context.stroke();
  }
}
