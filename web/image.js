// The image: layers, stretch, zoom and pan, comparison of two runs, and where pixels and regions are chosen.
import {app, ask, complain} from "/api.js";
import {$, brief, colourBar, fill, fit, hasKelvin, kelvin, later, make, percentiles, swatch} from "/tools.js";

const canvas = $("image");
const most = 1 << 20;  // values of a raster: what is sent at a time
const state = {layer: "", layerKey: "", rgb: [0, 0, 0], compare: "a", blink: false, view: null, polygon: null, corners: []};
const cache = new Map();
let wanted = 0, controller = new AbortController();

// Every step-th pixel of a window, from the server or as it came before.
async function fetchBand(k, cube, band, window) {
  const run = app.run(k), query = {...app.query(k), cube, band, ...window};
  const key = JSON.stringify(query);
  if (!cache.has(key)) {
    if (cache.size > 24) cache.delete(cache.keys().next().value);
    const sent = ask("band", query, controller.signal);
    cache.set(key, sent);
    sent.catch(() => cache.delete(key));
  }
  const {about, values} = await cache.get(key);
  return {...window, columns: about.columns, rows: about.rows, values, run};
}

const whole = run => {
  let step = 1;
  while (Math.ceil(run.width / step) * Math.ceil(run.height / step) > most) ++step;
  return {x0: 0, y0: 0, x1: run.width, y1: run.height, step};
};

// The part that is seen, finer than the whole image was sent; null where that is fine enough.
function detail(run) {
  const base = whole(run), v = state.view;
  if (!v || base.step === 1 || v.scale * base.step < 1.5) return null;
  const w = canvas.clientWidth / v.scale, h = canvas.clientHeight / v.scale;
  const x0 = Math.max(0, Math.floor(v.x - 0.6 * w)), y0 = Math.max(0, Math.floor(v.y - 0.6 * h));
  const x1 = Math.min(run.width, Math.ceil(v.x + 0.6 * w)), y1 = Math.min(run.height, Math.ceil(v.y + 0.6 * h));
  let step = Math.max(1, Math.floor(1 / v.scale));
  while (Math.ceil((x1 - x0) / step) * Math.ceil((y1 - y0) / step) > most) ++step;
  return step < base.step && x1 > x0 && y1 > y0 ? {x0, y0, x1, y1, step} : null;
}

const spectral = () => state.layer === "channel" || state.layer === "kelvin" || state.layer === "relative";

// What a layer shows in one window: values, or three of them for colours.
async function layerIn(k, window, take = (cube, b) => fetchBand(k, cube, b, window)) {
  const main = app.main(k).name, band = app.band, channel = app.run(k).channels[band];
  if (state.layer === "colour") {
    const [r, g, b] = await Promise.all(state.rgb.map(c => take(main, c)));
    return {...r, rgb: [r.values, g.values, b.values]};
  }
  if (state.layer === "channel") return {...await take(main, band), label: `radiance, ${app.run(k).unit || "as stored"}`, map: "sequential"};
  if (state.layer === "kelvin") {
    const raster = await take(main, band);
    return {...raster, values: raster.values.map(l => kelvin(channel.um, l)), label: "brightness temperature at the channel's centre, K", map: "heat"};
  }
  if (state.layer === "relative") {
    const [value, half] = await Promise.all([take(main, band), take("half_width", band)]);
    return {...value, values: half.values.map((e, i) => 100 * e / Math.abs(value.values[i])), label: "half-width over value, %", map: "heat"};
  }
  const cube = app.cube(state.layer, k);
  const raster = await take(cube.name, Math.min(band, cube.bands - 1));
  if (cube.classes.length) return {...raster, cube};
  return {...raster, label: cube.what + (cube.unit && cube.unit !== "1" ? `, ${cube.unit}` : ""), map: cube.role === "error" ? "heat" : "sequential"};
}

function paint(raster, ranges) {
  const {columns, rows, values} = raster, n = columns * rows;
  const sheet = make("canvas");
  sheet.width = columns; sheet.height = rows;
  const context = sheet.getContext("2d"), picture = context.createImageData(columns, rows), out = new Uint32Array(picture.data.buffer);
  const grey = 0xff808080;
  if (raster.rgb) {
    const codes = new Uint8Array(1025).map((_, i) => { const v = i / 1024; return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055)); });
    const code = (c, i) => codes[Math.round(1024 * Math.min(1, Math.max(0, (raster.rgb[c][i] - ranges[c][0]) / (ranges[c][1] - ranges[c][0]))))];
    for (let i = 0; i < n; ++i)
      out[i] = Number.isFinite(raster.rgb[0][i]) ? (255 << 24 | code(2, i) << 16 | code(1, i) << 8 | code(0, i)) >>> 0 : grey;
  } else if (raster.cube) {
    const l = raster.cube.lookup;
    for (let i = 0; i < n; ++i) {
      const c = 3 * values[i];
      out[i] = c >= 0 && c + 2 < l.length ? (255 << 24 | l[c + 2] << 16 | l[c + 1] << 8 | l[c]) >>> 0 : grey;
    }
  } else {
    const map = app.colours[raster.map], [low, high] = ranges[0], table = new Uint32Array(256);
    for (let k = 0; k < 256; ++k) table[k] = (255 << 24 | map[3 * k + 2] << 16 | map[3 * k + 1] << 8 | map[3 * k]) >>> 0;
    for (let i = 0; i < n; ++i) {
      const v = values[i];
      out[i] = Number.isFinite(v) ? table[Math.round(255 * Math.min(1, Math.max(0, (v - low) / (high - low))))] : grey;
    }
  }
  context.putImageData(picture, 0, 0);
  return {...raster, sheet};
}

// Runs that are seen: one, or both while they are compared. Both are stretched as the first.
const seen = () => state.compare === "a" ? [0] : state.compare === "b" ? [1] : [0, 1];
let sheets = [];  // by run: [whole, detail]
let ranges = [];

const stretched = (raster, from, to) => (raster.rgb || [raster.values]).map(v => percentiles(v, from, to));

// What the layer shows at times spread over a series.
const overTimes = () => layerIn(0, null, async (cube, band) => {
  const key = `spread ${cube} ${band} ${app.made}`;
  if (!cache.has(key)) cache.set(key, ask("spread", {cube, band}));
  return {values: (await cache.get(key)).values};
});

async function load() {
  if (!app.run() || !state.layer || !app.colours) return;
  const turn = ++wanted;
  controller.abort();
  controller = new AbortController();
  try {
    const bases = await Promise.all(seen().map(k => layerIn(k, whole(app.run(k)))));
    if (turn !== wanted) return;
    const from = +$("low").value, to = +$("high").value;
    ranges = stretched(app.hold && !bases[0].cube ? await overTimes() : bases[0], from, to);
    if (turn !== wanted) return;
    sheets = [];
    bases.forEach((raster, i) => { sheets[seen()[i]] = [paint(raster, ranges)]; });
    drawLegend(bases[0]);
    show();
    for (const k of seen()) {
      const window = detail(app.run(k));
      if (!window) continue;
      const raster = await layerIn(k, window);
      if (turn !== wanted) return;
      sheets[k][1] = paint(raster, ranges);
      show();
    }
  } catch (error) { complain(error); }
}
const refine = later(140, async () => {
  const turn = wanted;
  try {
    for (const k of seen()) {
      const window = app.run(k) && sheets[k] && detail(app.run(k));
      if (!window) continue;
      const raster = await layerIn(k, window);
      if (turn !== wanted || !sheets[k]) return;
      sheets[k][1] = paint(raster, ranges);
      show();
    }
  } catch (error) { complain(error); }
});

function drawLegend(raster) {
  const bar = $("bar"), legend = $("legend");
  bar.replaceChildren();
  legend.replaceChildren();
  if (raster.cube) {
    const used = new Set(raster.values);
    raster.cube.classes.forEach((name, c) => used.has(c) && legend.append(make("li", {}, swatch(`rgb(${raster.cube.lookup.slice(3 * c, 3 * c + 3)})`), name)));
  } else if (!raster.rgb) colourBar(bar, ranges[0], app.colours[raster.map], raster.label);
  const run = app.run();
  canvas.dataset.layer = state.layer;
  $("band-name").textContent = bandName();
  $("rgb").hidden = state.layer !== "colour";
  $("stretch").hidden = Boolean(raster.cube);
  if (run) state.rgb.forEach((c, i) => { const um = run.channels[c].um; if (document.activeElement !== $(["red", "green", "blue"][i])) $(["red", "green", "blue"][i]).value = +um.toFixed(3); });
}

function bandName() {
  const run = app.run();
  if (state.layer === "colour") return "";
  if (spectral()) { const c = run.channels[app.band]; return c.um ? `${c.name} \u00b7 ${brief(c.um)} \u00b5m` : c.name; }
  const cube = app.cube(state.layer), b = Math.min(app.band, cube.bands - 1);
  if (cube.bands === 1) return "";
  return cube.names[b] || (cube.spectral && run.channels[b] ? run.channels[b].name : `band ${b + 1}`);
}

const toScreen = (x, y) => {
  const v = state.view;
  return [(x - v.x) * v.scale + canvas.clientWidth / 2, (y - v.y) * v.scale + canvas.clientHeight / 2];
};
const toImage = event => {
  const r = canvas.getBoundingClientRect(), v = state.view;
  return [(event.clientX - r.left - r.width / 2) / v.scale + v.x, (event.clientY - r.top - r.height / 2) / v.scale + v.y];
};

function show() {
  const run = app.run();
  if (!run || !canvas.clientWidth) return;
  if (!state.view) fitAll();
  const {context, w, h} = fit(canvas), split = state.compare === "swipe" ? w * $("swipe").value / 100 : 0;
  const put = k => {
    for (const raster of sheets[k] || []) {
      if (!raster) continue;
      const [x, y] = toScreen(raster.x0, raster.y0), s = raster.step * state.view.scale;
      context.drawImage(raster.sheet, x, y, raster.columns * s, raster.rows * s);
    }
  };
  const clip = (x, width, k) => { context.save(); context.beginPath(); context.rect(x, 0, width, h); context.clip(); put(k); context.restore(); };
  if (state.compare === "swipe") {
    clip(0, split, 0);
    clip(split, w - split, 1);
    context.fillStyle = "#fff";
    context.fillRect(split - 1, 0, 2, h);
  } else put(state.compare === "blink" ? +state.blink : +(state.compare === "b"));
  $("which").textContent = app.sources.length < 2 ? "" : state.compare === "swipe" ? "A | B" : state.compare === "blink" ? "AB"[+state.blink] : state.compare.toUpperCase();

  if (app.selection && app.selection.source === app.shown) {
    const s = app.selection, [x, y] = toScreen(0, 0), f = s.step * state.view.scale;
    context.drawImage(s.sheet, x, y, s.columns * f, s.rows * f);
  }
  const outline = (colour, width, path) => { context.strokeStyle = colour; context.lineWidth = width; context.beginPath(); path(); context.stroke(); };
  const both = (colour, path) => { outline("#000", 3.4, path); outline(colour, 1.5, path); };
  const ring = corners => corners.forEach(([x, y], i) => { const [u, v] = toScreen(x, y); i ? context.lineTo(u, v) : context.moveTo(u, v); });
  for (const p of app.pins || []) {
    if (p.corners) both(p.colour, () => { ring(p.corners); context.closePath(); });
    else { const [u, v] = toScreen(p.x + 0.5, p.y + 0.5); both(p.colour, () => context.arc(u, v, 5, 0, 7)); }
  }
  if (state.polygon) { both("#fff", () => ring([...state.polygon, ...(state.hover ? [state.hover] : [])])); }
  if (app.pixel) {
    const [u, v] = toScreen(app.pixel.x + 0.5, app.pixel.y + 0.5), g = Math.max(4, state.view.scale / 2);
    both("#fff", () => { for (const [a, b] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) { context.moveTo(u + a * g, v + b * g); context.lineTo(u + a * (g + 9), v + b * (g + 9)); } });
    if (state.view.scale > 5) both("#fff", () => context.rect(u - state.view.scale / 2, v - state.view.scale / 2, state.view.scale, state.view.scale));
  }
  canvas.dataset.drawn = String(++drawn);
}
let drawn = 0;

function fitAll() {
  const run = app.run();
  state.view = {x: run.width / 2, y: run.height / 2, scale: Math.min(canvas.clientWidth / run.width, canvas.clientHeight / run.height) * 0.98 || 1};
}

function zoom(factor, x = app.pixel ? app.pixel.x + 0.5 : state.view.x, y = app.pixel ? app.pixel.y + 0.5 : state.view.y) {
  const v = state.view, scale = Math.min(64, Math.max(0.005, v.scale * factor)), f = v.scale / scale;
  v.x = x + (v.x - x) * f;
  v.y = y + (v.y - y) * f;
  v.scale = scale;
  show();
  refine();
}

export function choosePixel(x, y) {
  const run = app.run();
  app.pixel = {x: Math.min(run.width - 1, Math.max(0, Math.floor(x))), y: Math.min(run.height - 1, Math.max(0, Math.floor(y)))};
  show();
  app.tell("pixel");
}

export function startPolygon() {
  state.polygon = state.polygon ? null : [];
  $("polygon").setAttribute("aria-pressed", String(Boolean(state.polygon)));
  show();
}
function endPolygon() {
  const corners = state.polygon;
  state.polygon = state.hover = null;
  $("polygon").setAttribute("aria-pressed", "false");
  if (corners.length > 2) { app.corners = corners.map(c => c.map(v => +v.toFixed(2))); app.tell("region"); }
  show();
}

export function chooseBand(b) {
  const run = app.run(), limit = spectral() || state.layer === "colour" ? run.channels.length : app.cube(state.layer).bands;
  app.band = Math.min(limit - 1, Math.max(0, b));
  $("band").value = app.band;
  load();
  app.tell("band");
}

const nearest = (run, um) => run.channels.reduce((best, c, i) => Math.abs(c.um - um) < Math.abs(run.channels[best].um - um) ? i : best, 0);

function chooseLayer(layer) {
  state.layer = layer;
  const run = app.run(), cube = app.cube(layer), bands = spectral() || layer === "colour" ? run.channels.length : cube.bands;
  $("band").max = bands - 1;
  $("band").disabled = layer === "colour" || bands < 2;
  $("band-label").hidden = layer === "colour" || bands < 2;
  app.band = Math.min(app.band, bands - 1);
  $("band").value = app.band;
  load();
}

// New products: what there is to show.
app.on("runs", () => {
  const run = app.run();
  if (!run) { sheets = []; return; }
  const other = app.run(1), same = other && other.width === run.width && other.height === run.height && other.channels.length === run.channels.length;
  $("compare").hidden = !same;
  if (!same) state.compare = "a";
  const main = app.main(), um = run.channels.map(c => c.um), options = [];
  const colour = run.rgb.length === 3 || (Math.min(...um) < 0.5 && Math.max(...um) > 0.62);
  if (run.channels.length > 2) options.push(["colour", "colour picture"]);
  options.push(["channel", main.what || "radiance"]);
  if (hasKelvin(run)) options.push(["kelvin", "brightness temperature"]);
  if (app.cube("half_width")) options.push(["relative", "relative error"]);
  for (const cube of run.cubes.slice(1)) options.push([cube.name, cube.what]);
  fill($("layer"), options, state.layer);
  state.rgb = run.rgb.length === 3 ? run.rgb.map(b => b - 1) : [0.66, 0.56, 0.48].map(v => nearest(run, v));
  if (!options.some(o => o[0] === state.layer)) state.layer = run.channels.length > 2 && colour ? "colour" : Math.min(...um) > 2.5 && hasKelvin(run) ? "kelvin" : "channel";
  $("layer").value = state.layer;
  if (!state.view) fitAll();
  chooseLayer(state.layer);
  if (!app.pixel) choosePixel(run.width >> 1, run.height >> 1);
  else choosePixel(app.pixel.x, app.pixel.y);
});
app.on("selection", show);
app.on("pins", show);
app.on("shown", () => { show(); refine(); });
app.on("colours", load);

$("layer").addEventListener("change", e => chooseLayer(e.target.value));
$("band").addEventListener("input", e => chooseBand(+e.target.value));
["red", "green", "blue"].forEach((id, i) => $(id).addEventListener("change", e => { state.rgb[i] = nearest(app.run(), +e.target.value); load(); e.target.value = app.run().channels[state.rgb[i]].um; }));
for (const id of ["low", "high"]) $(id).addEventListener("change", load);
$("swipe").addEventListener("input", show);
for (const button of document.querySelectorAll("#compare button")) button.addEventListener("click", () => compare(button.dataset.compare));
function compare(way) {
  if ($("compare").hidden) return;
  state.compare = way;
  app.shown = way === "b" ? 1 : 0;
  for (const b of document.querySelectorAll("#compare button")) b.setAttribute("aria-pressed", String(b.dataset.compare === way));
  $("swipe-label").hidden = way !== "swipe";
  load();
  app.tell("pixel");
}
setInterval(() => { if (state.compare === "blink" && !document.hidden) { state.blink = !state.blink; show(); } }, 700);

let drag = null;
canvas.addEventListener("pointerdown", e => {
  if (!state.view) return;
  const [x, y] = toImage(e);
  canvas.setPointerCapture(e.pointerId);
  drag = {x: e.clientX, y: e.clientY, vx: state.view.x, vy: state.view.y, moved: false, swipe: state.compare === "swipe" && Math.abs(e.offsetX - canvas.clientWidth * $("swipe").value / 100) < 8};
  if (state.polygon) { state.polygon.push([x, y]); drag = null; show(); }
});
canvas.addEventListener("pointermove", e => {
  if (state.polygon) { state.hover = toImage(e); show(); return; }
  if (!drag) return;
  if (drag.swipe) { $("swipe").value = 100 * e.offsetX / canvas.clientWidth; drag.moved = true; show(); return; }
  const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
  if (!drag.moved && Math.hypot(dx, dy) < 4) return;
  drag.moved = true;
  state.view.x = drag.vx - dx / state.view.scale;
  state.view.y = drag.vy - dy / state.view.scale;
  show();
  refine();
});
canvas.addEventListener("pointerup", e => {
  if (drag && !drag.moved) choosePixel(...toImage(e));
  drag = null;
});
canvas.addEventListener("dblclick", () => { if (state.polygon && state.polygon.length > 2) { state.polygon.pop(); endPolygon(); } });
canvas.addEventListener("wheel", e => { e.preventDefault(); if (state.view) zoom(Math.exp(-e.deltaY / 400), ...toImage(e)); }, {passive: false});
canvas.addEventListener("keydown", e => {
  const p = app.pixel, step = e.shiftKey ? 10 : 1;
  const act = {ArrowLeft: () => choosePixel(p.x - step, p.y), ArrowRight: () => choosePixel(p.x + step, p.y), ArrowUp: () => choosePixel(p.x, p.y - step),
    ArrowDown: () => choosePixel(p.x, p.y + step), "+": () => zoom(1.5), "=": () => zoom(1.5), "-": () => zoom(1 / 1.5), 0: () => { fitAll(); show(); refine(); },
    "[": () => chooseBand(app.band - 1), "]": () => chooseBand(app.band + 1), p: () => app.tell("pin"), g: startPolygon, b: () => compare(state.compare === "blink" ? "a" : "blink"),
    s: () => compare(state.compare === "swipe" ? "a" : "swipe"),
    Enter: () => { if (state.polygon) endPolygon(); }, " ": () => { if (state.polygon) state.polygon.push([p.x + 0.5, p.y + 0.5]); show(); },
    Escape: () => { state.polygon = state.hover = null; $("polygon").setAttribute("aria-pressed", "false"); show(); }}[e.key];
  if (!act || !p || e.ctrlKey || e.metaKey || e.altKey) return;
  e.preventDefault();
  act();
});
$("polygon").addEventListener("click", () => { startPolygon(); canvas.focus(); });
new ResizeObserver(() => { show(); refine(); }).observe($("stage"));
