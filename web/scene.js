// The scene before anything is rendered: a picture by rays from the server, coarse and then fine, with the sensor and what it sees.
import {app, ask, complain} from "/api.js";
import {$, brief, fit, make} from "/tools.js";

const canvas = $("view"), sheet = make("canvas");
const FOV = 50, STEPS = [8, 2, 1], RAYS = 40000, WALKER = 1.7, RAD = Math.PI / 180;
const state = {info: null, asking: false, eye: null, fov: FOV, pivot: [0, 0, 0], radius: 5, mode: "orbit", up: WALKER, buffer: null, picked: null, job: null};

const add = (a, b, s = 1) => a.map((v, i) => v + s * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const between = (a, b) => Math.hypot(...add(b, a, -1));
const triples = flat => Array.from({length: flat.length / 3}, (_, i) => flat.slice(3 * i, 3 * i + 3)).map(p => p.every(Number.isFinite) ? p : null);

// The eye's axes: right, up, forward. Azimuth is clockwise from north.
function axes({azimuth, elevation}) {
  const [sa, ca, se, ce] = [Math.sin(azimuth * RAD), Math.cos(azimuth * RAD), Math.sin(elevation * RAD), Math.cos(elevation * RAD)];
  return {right: [ca, -sa, 0], up: [-sa * se, -ca * se, ce], forward: [sa * ce, ca * ce, se]};
}

async function load() {
  if (state.asking || state.info || $("screen-scene").hidden) return;
  state.asking = true;
  try {
    const said = await ask("scene");
    const loading = said.state === "loading";
    $("scene-progress").hidden = !loading;
    $("scene-progress").value = said.of ? said.done / said.of : 0;
    $("scene-text").textContent = loading ? `Loading: ${said.phase}${said.of ? `, ${said.done} of ${said.of} objects` : ""}, ${said.elapsed.toFixed(0)} s` : said.statement || "";
    tellFaults(said);
    if (loading || said.version < app.version) setTimeout(load, 250);
    if (said.state !== "ready" || said.version < app.version) return;
    const before = state.version;
    state.info = said;
    state.version = said.version;
    $("paint-scene").value = said.paint;
    $("through").disabled = !said.sensor || said.sensor.kind !== "image" || said.sensor.parallel;
    tellSensor();
    // A document that was changed is looked at from where the last one was.
    if (before && state.eye) look(); else frame();
  } catch (error) { complain(error); } finally { state.asking = false; }
}

function tellFaults({state: now, failure, faults}) {
  const all = failure ? [...faults, {text: failure, instead: "nothing is left to be shown"}] : faults;
  $("scene-faults").replaceChildren(...all.map(f => make("li", {class: "error"}, make("b", {}, f.instead), make("pre", {}, f.text))));
  $("scene-wrong").hidden = !all.length;
  $("scene-wrong").textContent = now === "failed" ? "This scene cannot be shown." : `${all.length === 1 ? "A mistake is" : `${all.length} mistakes are`} left out of the picture:`;
}

function tellSensor() {
  const s = state.info.sensor;
  let text = "No sensor is shown.";
  if (s && s.kind === "image") {
    text = `Sensor: ${s.width} \u00d7 ${s.height} pixels, ${s.parallel ? "parallel rays" : s.duration ? "moving" : "standing still"}`;
    if (s.duration) text += `, ${brief(Math.abs(s.duration))} s from the first line to the last`;
    if (!s.parallel && s.axis[0].to) text += `, ${brief(between(s.axis[0].from, s.axis[0].to))} m from what its middle sees`;
    if (triples(s.outline).includes(null)) text += "; a part of its edge sees nothing";
    text += ".";
  } else if (s) text = `No camera: ${s.count} ${s.kind === "points" ? "points, each with its plane's normal" : s.kind === "rays" ? "rays" : "directions towards which an area is seen"}${s.count > s.views.length ? `, of which ${s.views.length} are drawn` : ""}.`;
  $("scene-sensor").textContent = text;
}

// All that is of interest from obliquely above: what the sensor sees, else what stands there.
function frame() {
  const {sensor, low, high} = state.info;
  let points = [];
  if (sensor) points = [...triples(sensor.outline), ...sensor.views.flatMap(v => sensor.kind === "points" ? [v.from] : sensor.kind === "rays" ? [v.from, v.to] : [])].filter(Boolean);
  const box = list => [0, 1, 2].map(k => [Math.min(...list.map(p => p[k])), Math.max(...list.map(p => p[k]))]);
  let sides = points.length ? box(points) : null;
  if (!sides || Math.hypot(...sides.map(s => s[1] - s[0])) < 1e-6) sides = low ? box([low, high, ...points]) : box([[-5, -5, 0], [5, 5, 0]]);
  state.pivot = sides.map(s => (s[0] + s[1]) / 2);
  state.radius = Math.max(1e-3, Math.hypot(...sides.map(s => s[1] - s[0])) / 2);
  state.fov = FOV;
  setMode("orbit");
  orbitTo(20, -38, 1.15 * state.radius / Math.sin(FOV / 2 * RAD));
}

function orbitTo(azimuth, elevation, distance) {
  const eye = {azimuth: ((azimuth % 360) + 360) % 360, elevation: Math.max(-90, Math.min(89, elevation))};
  eye.at = add(state.pivot, axes(eye).forward, -distance);
  state.eye = eye;
  look();
}
const turn = (da, de) => {
  const {azimuth, elevation, at} = state.eye;
  if (state.mode === "orbit") return orbitTo(azimuth + da, elevation + de, between(at, state.pivot));
  Object.assign(state.eye, {azimuth: (((azimuth - da) % 360) + 360) % 360, elevation: Math.max(-89, Math.min(89, elevation - de))});
  look();
};
const zoom = factor => orbitTo(state.eye.azimuth, state.eye.elevation, Math.max(1e-3 * state.radius, factor * between(state.eye.at, state.pivot)));
function shift(right, up) {
  const a = axes(state.eye), by = add(a.right.map(v => v * right), a.up, up);
  state.pivot = add(state.pivot, by);
  state.eye = {...state.eye, at: add(state.eye.at, by)};
  look();
}

// On foot: so far above what lies below, curbs are climbed, walls are not.
async function walk(ahead, aside) {
  const {azimuth, at} = state.eye, s = Math.sin(azimuth * RAD), c = Math.cos(azimuth * RAD), stride = Math.max(0.2, Math.min(2, state.radius / 40));
  state.eye = {...state.eye, at: add(at, [ahead * s + aside * c, ahead * c - aside * s, 0], stride)};
  look();
  await stand();
}
async function stand() {
  const from = state.eye.at;
  const below = await ask("pick", {...query({at: add(from, [0, 0, 0.6]), azimuth: 0, elevation: -90}, 1, 1), u: 0.5, v: 0.5}).catch(complain);
  if (!below || !below.hit || state.mode !== "walk" || state.eye.at[0] !== from[0] || state.eye.at[1] !== from[1]) return;
  state.eye = {...state.eye, at: [from[0], from[1], below.scene[2] + state.up]};
  look();
}

function setMode(mode) {
  state.mode = mode;
  for (const m of ["orbit", "walk"]) $(`mode-${m}`).setAttribute("aria-pressed", String(m === mode));
}
function toWalk() {
  if (!state.info || state.mode === "walk") return;
  setMode("walk");
  state.fov = FOV;
  state.up = WALKER;
  const on = state.picked && state.picked.hit ? state.picked.scene : state.pivot;
  state.eye = {...state.eye, elevation: -4, at: add(on, [0, 0, WALKER])};
  look();
  stand();
}
function toOrbit() {
  if (!state.info || state.mode === "orbit") return;
  if (state.mode === "sensor") return frame();
  setMode("orbit");
  const {azimuth} = state.eye;
  state.pivot = state.eye.at.slice();
  orbitTo(azimuth, -30, Math.max(state.radius / 2, 5));
}
// Where the sensor is, with its field of view.
function through() {
  const s = state.info.sensor, f = s.axis[0].direction, half = Math.max(...s.corners.map(c => Math.acos(Math.min(1, dot(c.direction, f)))));
  setMode("sensor");
  state.fov = Math.max(0.01, Math.min(120, 2.2 * half / RAD));
  state.eye = {at: s.axis[0].from, azimuth: (Math.atan2(f[0], f[1]) / RAD + 360) % 360, elevation: Math.asin(Math.max(-1, Math.min(1, f[2]))) / RAD};
  look();
}

const query = (eye, width, height) => ({x: eye.at[0], y: eye.at[1], z: eye.at[2], azimuth: eye.azimuth, elevation: eye.elevation, fov: state.fov, width, height});

// Asks for the picture from here; what is under way for an earlier place is given up.
async function look() {
  const w = canvas.clientWidth, h = canvas.clientHeight;
  if (!state.info || !w || !h) return;
  if (state.job) state.job.abort();
  const job = state.job = new AbortController(), eye = state.eye;
  canvas.dataset.eye = JSON.stringify({...eye, pivot: state.pivot, fov: state.fov});
  canvas.dataset.step = "0";
  try {
    for (const step of STEPS) {
      const rows = Math.max(1, Math.floor(RAYS / Math.ceil(w / step))) * step;
      for (let y = 0; y < h; y += rows) {
        const end = Math.min(h, y + rows);
        const {about, values} = await ask("look", {...query(eye, w, h), paint: $("paint-scene").value, x0: 0, y0: y, x1: w, y1: end, step}, job.signal);
        if (state.job !== job) return;
        if (!state.buffer || state.buffer.eye !== eye || state.buffer.w !== w || state.buffer.h !== h || state.buffer.fov !== state.fov) state.buffer = {eye, w, h, fov: state.fov, far: new Float32Array(w * h).fill(NaN), colour: new Float32Array(w * h), object: new Int32Array(w * h).fill(-2)};
        for (let j = 0; j < about.rows; ++j) for (let v = y + j * step; v < Math.min(end, y + (j + 1) * step); ++v)
          for (let i = 0; i < about.columns; ++i) {
            const k = 3 * (j * about.columns + i);
            for (let u = i * step; u < Math.min(w, (i + 1) * step); ++u) {
              const to = v * w + u;
              state.buffer.far[to] = values[k]; state.buffer.colour[to] = values[k + 1]; state.buffer.object[to] = values[k + 2];
            }
          }
        paint();
      }
      canvas.dataset.step = String(step);
    }
  } catch (error) { if (state.job === job) complain(error); }
}

function paint() {
  const b = state.buffer, {context, w, h} = fit(canvas);
  if (!b || !w) return;
  const css = getComputedStyle(document.documentElement), ground = css.getPropertyValue("--stage"), ink = css.getPropertyValue("--ink");
  sheet.width = b.w; sheet.height = b.h;
  const inner = sheet.getContext("2d"), picture = inner.createImageData(b.w, b.h), out = picture.data;
  const chosen = state.picked && state.picked.hit ? state.picked.object : -3;
  for (let k = 0; k < b.far.length; ++k) {
    if (!Number.isFinite(b.far[k])) continue;
    const edge = b.object[k] === chosen && ((k % b.w && b.object[k - 1] !== chosen) || (k >= b.w && b.object[k - b.w] !== chosen) || b.object[k + 1] !== chosen || b.object[k + b.w] !== chosen);
    const c = edge ? 0xffd34d : b.colour[k];
    out[4 * k] = c >> 16; out[4 * k + 1] = c >> 8 & 255; out[4 * k + 2] = c & 255; out[4 * k + 3] = 255;
  }
  inner.putImageData(picture, 0, 0);
  context.fillStyle = ground;
  context.fillRect(0, 0, w, h);
  context.drawImage(sheet, 0, 0, w, h);
  if ($("overlay").checked) drawSensor(context, b);
  if (state.picked && state.picked.hit) drawDot(context, b, state.picked.scene, "#ffd34d");
  drawCompass(context, w, ink, ground);
  canvas.dataset.drawn = String(+(canvas.dataset.drawn || 0) + 1);
}

// Where a point is in the picture, and how far; null behind the eye.
function project(b, p) {
  const a = axes(b.eye), d = add(p, b.eye.at, -1), z = dot(d, a.forward);
  if (z < 1e-6 * Math.hypot(...d) || z <= 0) return null;
  const s = b.h / (2 * Math.tan(b.fov / 2 * RAD) * z);
  return [b.w / 2 + s * dot(d, a.right), b.h / 2 - s * dot(d, a.up), Math.hypot(...d)];
}
// What lies behind something is drawn faintly.
function isHidden(b, [x, y, far]) {
  const u = Math.floor(x), v = Math.floor(y);
  return u >= 0 && v >= 0 && u < b.w && v < b.h && b.far[v * b.w + u] < far * 0.985 - 0.02;
}
function drawLine(context, b, from, to, colour, width = 2) {
  // In pieces: what is hidden changes along it.
  const pieces = 48, runs = [];
  let last = null, was = null;
  for (let k = 0; k <= pieces; ++k) {
    const p = project(b, add(from, add(to, from, -1), k / pieces));
    if (p && last) {
      const hidden = isHidden(b, p.map((v, i) => (v + last[i]) / 2));
      if (hidden === was) runs[runs.length - 1].points.push(p);
      else runs.push({hidden, points: [last, p]});
      was = hidden;
    } else was = null;
    last = p;
  }
  for (const [style, wide] of [["#0009", width + 1.8], [colour, width]])
    for (const {hidden, points} of runs) {
      context.globalAlpha = hidden ? 0.25 : 1;
      context.strokeStyle = style; context.lineWidth = wide;
      context.beginPath();
      points.forEach(([x, y], k) => k ? context.lineTo(x, y) : context.moveTo(x, y));
      context.stroke();
    }
  context.globalAlpha = 1;
}
function drawDot(context, b, at, colour, size = 4) {
  const p = project(b, at);
  if (!p) return;
  context.globalAlpha = isHidden(b, p) ? 0.35 : 1;
  context.beginPath(); context.arc(p[0], p[1], size, 0, 7);
  context.fillStyle = colour; context.strokeStyle = "#000b"; context.lineWidth = 1.2;
  context.fill(); context.stroke();
  context.globalAlpha = 1;
}

function drawSensor(context, b) {
  const s = state.info.sensor;
  if (!s) return;
  const seen = "#ff9d2e", rays = "#5ec8ff", r = state.radius;
  const points = triples(s.outline);
  for (let k = 0; k < points.length; ++k) {
    const p = points[k], q = points[(k + 1) % points.length];
    if (p && q) drawLine(context, b, p, q, seen, 2.6);
  }
  // Parallel rays begin nowhere: a piece of each.
  const start = (ray, length) => ray.to && s.parallel ? add(ray.to, ray.direction, -length) : ray.from;
  const end = ray => ray.to || add(ray.from, ray.direction, 3 * r);
  for (const ray of [...s.corners, ...(s.kind === "image" ? s.axis : [])]) drawLine(context, b, start(ray, r), end(ray), rays, 1.3);
  const track = triples(s.track);
  for (let k = 0; k + 1 < track.length; ++k) drawLine(context, b, track[k], track[k + 1], "#7ce38b", 2.4);
  if (track.length) drawDot(context, b, track[track.length - 1], "#7ce38b");
  if (s.kind === "image") { if (!s.parallel) drawDot(context, b, s.corners[0].from, rays, 5); return; }
  for (const ray of s.views) {
    if (s.kind === "points") { drawLine(context, b, ray.from, add(ray.from, ray.direction, 0.15 * r), rays); drawDot(context, b, ray.from, seen); continue; }
    drawLine(context, b, start(ray, r), end(ray), rays, 1.1);
    drawDot(context, b, start(ray, r), rays, 3);
  }
}

function drawCompass(context, w, ink, ground) {
  const x = w - 40, y = 40, a = -state.eye.azimuth * RAD;
  context.fillStyle = ground; context.strokeStyle = ink; context.lineWidth = 1;
  context.beginPath(); context.arc(x, y, 26, 0, 7); context.globalAlpha = 0.8; context.fill(); context.globalAlpha = 1; context.stroke();
  const to = (angle, length) => [x + length * Math.sin(angle), y - length * Math.cos(angle)];
  context.beginPath(); context.moveTo(...to(a + Math.PI, 9)); context.lineTo(...to(a, 12)); context.stroke();
  context.fillStyle = ink; context.font = "600 12px sans-serif"; context.textAlign = "center"; context.textBaseline = "middle";
  context.fillText("N", ...to(a, 18));
  const {sun} = state.info;
  if (!sun) return;
  const at = to(a + Math.atan2(sun[0], sun[1]), 26 * Math.hypot(sun[0], sun[1]));
  context.beginPath(); context.arc(...at, 4, 0, 7); context.fillStyle = "#ffc400"; context.fill(); context.stroke();
}

async function pick(u, v) {
  const b = state.buffer;
  if (!b) return;
  try {
    const hit = state.picked = await ask("pick", {...query(b.eye, b.w, b.h), fov: b.fov, u, v});
    const rows = [];
    if (!hit.hit) rows.push(["object", "nothing is met there"]);
    else {
      const where = make("span", {}, hit.name + " ");
      if (hit.line && hit.file === state.info.file) {
        const to = make("button", {class: "plain"}, `line ${hit.line}`);
        to.addEventListener("click", () => { app.line = hit.line; $("tab-document").click(); app.tell("line"); });
        where.append(to);
      } else if (hit.line) where.append(`(${hit.file}, line ${hit.line})`);
      rows.push(["object", where]);
      rows.push([hit.materials.length > 1 ? "materials" : "material", hit.materials.map(m => hit.materials.length > 1 ? `${m.name} ${(100 * m.share).toFixed(0)} %` : m.name).join(", ")]);
      rows.push(["position, m", hit.position.map(p => p.toFixed(3)).join(", ")]);
      rows.push(["distance", `${brief(hit.distance)} m`]);
      rows.push(["slope", `${(Math.acos(Math.max(-1, Math.min(1, hit.normal[2]))) / RAD).toFixed(1)}\u00b0`]);
    }
    $("picked").replaceChildren(...rows.map(([name, value]) => make("tr", {}, make("th", {scope: "row"}, name), make("td", {}, value))));
    paint();
  } catch (error) { complain(error); }
}

let drag = null;
canvas.addEventListener("pointerdown", e => { drag = {x: e.clientX, y: e.clientY, moved: 0, shift: e.shiftKey || e.button > 0}; canvas.setPointerCapture(e.pointerId); });
canvas.addEventListener("pointermove", e => {
  if (!drag || !state.eye) return;
  const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
  drag.moved += Math.abs(dx) + Math.abs(dy);
  if (drag.moved < 4) return;
  [drag.x, drag.y] = [e.clientX, e.clientY];
  if (drag.shift && state.mode === "orbit") {
    const scale = 2 * Math.tan(state.fov / 2 * RAD) * between(state.eye.at, state.pivot) / canvas.clientHeight;
    shift(-dx * scale, dy * scale);
  } else turn(dx * 0.3, -dy * 0.3);
});
canvas.addEventListener("pointerup", e => {
  if (drag && drag.moved < 4) { const r = canvas.getBoundingClientRect(); pick(e.clientX - r.left, e.clientY - r.top); }
  drag = null;
});
canvas.addEventListener("pointercancel", () => { drag = null; });
canvas.addEventListener("contextmenu", e => e.preventDefault());
canvas.addEventListener("wheel", e => {
  if (!state.eye) return;
  e.preventDefault();
  if (state.mode === "orbit") zoom(Math.exp(Math.max(-0.5, Math.min(0.5, e.deltaY * 0.0015))));
  else walk(e.deltaY < 0 ? 1 : -1, 0);
}, {passive: false});
canvas.addEventListener("keydown", e => {
  if (!state.eye || e.ctrlKey || e.metaKey || e.altKey) return;
  const key = e.key.length === 1 ? e.key.toLowerCase() : e.key, span = 0.1 * between(state.eye.at, state.pivot);
  const arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[key];
  const step = {w: [1, 0], s: [-1, 0], a: [0, -1], d: [0, 1]}[key];
  if (arrow && e.shiftKey && state.mode === "orbit") shift(arrow[0] * span, arrow[1] * span);
  else if (arrow) turn(-5 * arrow[0], -5 * arrow[1]);
  else if (step && state.mode === "walk") walk(...step);
  else if ((key === "q" || key === "e") && state.mode === "walk") { state.up = Math.max(0.2, state.up + (key === "e" ? 0.5 : -0.5)); stand(); }
  else if (key === "+" || key === "=") state.mode === "orbit" && zoom(0.8);
  else if (key === "-") state.mode === "orbit" && zoom(1.25);
  else if (key === "0") frame();
  else if (key === "m") state.mode === "orbit" ? toWalk() : toOrbit();
  else if (key === "Enter") pick(canvas.clientWidth / 2, canvas.clientHeight / 2);
  else return;
  e.preventDefault();
});
$("mode-orbit").addEventListener("click", toOrbit);
$("mode-walk").addEventListener("click", toWalk);
$("frame").addEventListener("click", () => state.info && frame());
$("through").addEventListener("click", through);
$("paint-scene").addEventListener("change", look);
$("overlay").addEventListener("change", paint);
app.on("screen-scene", () => { load(); if (state.buffer) paint(); });
app.on("document", () => { state.info = null; if (state.job) state.job.abort(); load(); });
app.on("screen-left", () => { if (state.job) state.job.abort(); });
app.on("theme", () => { if (state.buffer && !$("screen-scene").hidden) paint(); });
new ResizeObserver(() => { if (!$("screen-scene").hidden) look(); }).observe($("view-stage"));
