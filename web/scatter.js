// Points of the image in the space of its bands or of their projections, turned in as many dimensions as one likes, linked to the
// image both ways.
import {app, ask, complain} from "/api.js";
import {drawAxes, outline, pointsBelow} from "/points.js";
import {$, brief, distinct, fill, fit, inside, make, percentiles, swatch} from "/tools.js";

const canvas = $("cloud"), places = $("places");
const state = {points: null, basis: [], zoom: 1, lasso: null, tool: "turn", spinning: false, planes: [], frame: 0, materials: null, wanted: "", picture: null, chosen: [0, 1, 2], active: false};

const MOST = 1 << 20;  // points
let painter = null;
function paintBy(by) {
  if (painter) painter.canvas.remove();
  painter = pointsBelow(canvas, () => { paintBy("hand"); drawCloud(); }, by);
  if (!state.points) return;
  painter.take(state.points.unit, state.points.n, state.points.axes);
  tint();
}

const unit = (n, k) => Array.from({length: n}, (_, i) => +(i === k));
const dimensions = () => $("kind").value === "bands" ? 3 : Math.min(state.points.axes, Math.max(2, Math.min(10, Math.round(+$("dimensions").value) || 3)));

// Which axes point to the right, up and towards the eye.
function front() {
  const n = dimensions(), [a, b, c] = $("kind").value === "bands" ? [0, 1, 2] : state.chosen.map(k => Math.min(k, state.points.axes - 1));
  const size = Math.max(n, a + 1, b + 1, c + 1);
  state.basis = [unit(size, a), unit(size, b), unit(size, c)];
  state.zoom = 1;
}

// Turns two directions of the view into each other.
function turn(p, q, angle) {
  const c = Math.cos(angle), s = Math.sin(angle), [u, v] = [state.basis[p], state.basis[q]];
  state.basis[p] = u.map((x, i) => c * x + s * v[i]);
  state.basis[q] = u.map((x, i) => c * v[i] - s * x);
}

// One step of a tour through all dimensions: the space turns in two of its planes at a time, and in others after a while.
function tour() {
  const n = state.basis[0].length;
  if (state.frame++ % 150 === 0) {
    const pick = () => { const i = Math.floor(Math.random() * n), j = (i + 1 + Math.floor(Math.random() * (n - 1))) % n; return [i, j, (0.006 + 0.006 * Math.random()) * (Math.random() < 0.5 ? -1 : 1)]; };
    state.planes = [pick(), pick()];
  }
  for (const [i, j, angle] of state.planes) {
    const c = Math.cos(angle), s = Math.sin(angle);
    for (const row of state.basis) { const [x, y] = [row[i], row[j]]; row[i] = c * x - s * y; row[j] = s * x + c * y; }
  }
}

async function load() {
  const run = app.run();
  if (!run || !state.active) return;
  if (!painter) paintBy();
  const kind = $("kind").value, query = {...app.query(), kind, most: MOST};
  if (kind === "bands") [query.a, query.b, query.c] = state.chosen.map(k => Math.min(k, run.channels.length - 1));
  const key = JSON.stringify(query);
  if (key === state.wanted) return;
  state.wanted = key;
  $("cloud-text").textContent = "Working it out ...";
  try {
    const {about, values} = await ask("projection", query);
    if (state.wanted !== key) return;
    const n = about.columns * about.rows, axes = about.axes, middle = [], spread = [], thin = Math.max(1, Math.floor(n / 60000));
    for (let k = 0; k < axes; ++k) {
      const [low, high] = percentiles(Float32Array.from({length: Math.ceil(n / thin)}, (_, i) => values[i * thin * axes + k]), 1, 99);
      middle.push((low + high) / 2);
      spread.push((high - low) / 2 || 1);
    }
    // In units of their spread, about their middle.
    const unit = new Float32Array(n * axes);
    for (let i = 0, at = 0; i < n; ++i) for (let k = 0; k < axes; ++k, ++at) unit[at] = (values[at] - middle[k]) / spread[k];
    const sameGrid = state.points && state.points.step === about.step && state.points.columns === about.columns && state.source === app.shown && state.generation === query.generation;
    state.points = {...about, n, values, unit, middle, spread};
    painter.take(unit, n, axes);
    state.source = app.shown;
    state.generation = query.generation;
    state.mask = sameGrid ? state.mask : new Uint8Array(n);
    if (!sameGrid) { state.materials = null; state.picture = null; }
    const fromBands = kind === "bands";
    $("dimensions-label").hidden = fromBands;
    const name = k => fromBands ? run.channels[k].name + (run.channels[k].um ? ` \u00b7 ${brief(run.channels[k].um)} \u00b5m` : "") : `${kind === "pca" ? "PC" : "MNF"} ${k + 1}`;
    const choices = Array.from({length: fromBands ? run.channels.length : axes}, (_, k) => [k, name(k)]);
    [0, 1, 2].forEach(k => fill($(`axis-${k}`), choices, state.chosen[k]));
    front();
    paintPicture();
    if ($("paint").value === "material") await loadMaterials();
    select();
    say();
  } catch (error) { state.wanted = ""; $("cloud-text").textContent = ""; complain(error); }
}

function say() {
  const p = state.points, kind = $("kind").value, chosen = state.mask.reduce((s, v) => s + v, 0);
  let text = `${p.n} pixels${p.step > 1 ? `, each ${p.step}th of each ${p.step}th line` : ""}. `;
  if (kind === "pca") text += `Variance along the axes: ${p.strength.slice(0, 5).map(brief).join(", ")} ... `;
  if (kind === "mnf") text += `Variance over that of the known noise: ${p.strength.slice(0, 5).map(brief).join(", ")} ...; noise from the ${p.noise}; errors of channels count as independent. `;
  text += chosen ? `${chosen} are selected.` : "Draw a lasso here or in the picture to select.";
  $("cloud-text").textContent = text;
}

// Dominant material and its share, and where the purest pixels of each lie: endmembers of mixed pixels.
async function loadMaterials() {
  const run = app.run(), cube = app.cube("abundance"), p = state.points;
  if (!cube || cube.bands > 80) { complain(new Error(cube ? "too many materials to show" : "the run has no abundance, which tells true materials")); $("paint").value = "density"; return; }
  if (state.materials) return;
  const window = {x0: 0, y0: 0, x1: run.width, y1: run.height, step: p.step};
  const shares = (await Promise.all(Array.from({length: cube.bands}, (_, band) => ask("band", {...app.query(), cube: "abundance", band, ...window})))).map(a => a.values);
  const who = new Uint8Array(p.n), share = new Float32Array(p.n).fill(-1);
  shares.forEach((values, m) => { for (let i = 0; i < p.n; ++i) if (values[i] > share[i]) { share[i] = values[i]; who[i] = m; } });
  const ends = shares.map((values, m) => {
    let best = 0;
    for (let i = 0; i < p.n; ++i) if (values[i] > best) best = values[i];
    const members = [];
    if (best >= 0.3) for (let i = 0; i < p.n; ++i) if (values[i] >= Math.min(0.99, best) && Number.isFinite(p.values[i * p.axes])) members.push(i);
    return {m, name: cube.names[m] || `material ${m + 1}`, best, members};
  }).filter(e => e.members.length);
  state.materials = {who, share, ends, colours: ends.reduce((all, e) => ({...all, [e.m]: distinct(e.m)}), {})};
}

function screen(w, h) {
  const p = state.points, size = state.basis[0].length, scale = 0.4 * Math.min(w, h) * state.zoom, [r, u, e] = state.basis;
  return i => {
    let x = 0, y = 0, z = 0;
    for (let k = 0; k < size; ++k) {
      const v = p.unit[i * p.axes + k];
      x += r[k] * v; y += u[k] * v; z += e[k] * v;
    }
    return [w / 2 + scale * x, h / 2 - scale * y, z];
  };
}

const isDark = () => document.documentElement.dataset.theme === "dark";

// What each point's colour is, by selection, material or density.
function tint() {
  const p = state.points, colours = new Uint8Array(4 * p.n), material = $("paint").value === "material" && state.materials, ink = isDark() ? [120, 205, 220] : [11, 75, 95];
  for (let i = 0; i < p.n; ++i) {
    let colour = ink, s = 0;
    if (state.mask[i]) { colour = [224, 60, 30]; s = 255; }
    else if (material) { colour = material.colours[material.who[i]] || [128, 128, 128]; s = 254 * (0.25 + 0.75 * Math.max(0, (material.share[i] - 0.4) / 0.6)); }
    for (let c = 0; c < 3; ++c) colours[4 * i + c] = colour[c];
    colours[4 * i + 3] = s;
  }
  painter.tint(colours);
}

// `what`: "moving" may be coarser; "above" leaves the points as they are.
function drawCloud(what = "") {
  const {context, w, h} = fit(canvas), p = state.points;
  if (!p || !w) return;
  const at = screen(w, h), dark = isDark(), ground = dark ? [11, 16, 21] : [223, 228, 231], material = $("paint").value === "material" && state.materials;
  if (what !== "above") painter.draw({basis: state.basis, scale: 0.4 * Math.min(w, h) * state.zoom * canvas.width / w, W: canvas.width, H: canvas.height, ground, moving: what === "moving"});
  const axis = k => $("kind").value === "bands" ? $(`axis-${k}`).selectedOptions[0].text : `${$("kind").value === "pca" ? "PC" : "MNF"} ${k + 1}`;
  drawAxes(context, w, h, {basis: state.basis, middle: p.middle, spread: p.spread, zoom: state.zoom, name: axis, colour: dark ? "#9fadb8" : "#55626f"});
  const text = dark ? "#e4eaee" : "#16202c";
  if (material) for (const end of material.ends) {
    let x = 0, y = 0;
    for (const i of end.members) { const [a, b] = at(i); x += a / end.members.length; y += b / end.members.length; }
    context.lineWidth = 2;
    context.strokeStyle = text;
    context.setLineDash(end.best >= 0.99 ? [] : [3, 2]);
    context.beginPath(); context.arc(x, y, 7, 0, 7); context.stroke();
    context.setLineDash([]);
    if (end.best < 0.5) continue;
    const name = end.best >= 0.99 ? end.name : `${end.name}, ${Math.round(100 * end.best)} % at most`;
    context.font = "12px sans-serif";
    context.lineWidth = 3;
    context.strokeStyle = `rgb(${ground})`;
    context.strokeText(name, x + 10, y + 4);
    context.fillStyle = text;
    context.fillText(name, x + 10, y + 4);
  }
  if (state.lasso && state.lasso.where === canvas) outline(context, state.lasso.points);
  canvas.dataset.drawn = String(+(canvas.dataset.drawn || 0) + 1);
}

// The image behind the points, from the first axis or three bands, in grey.
function paintPicture() {
  const p = state.points, sheet = make("canvas");
  sheet.width = p.columns; sheet.height = p.rows;
  const context = sheet.getContext("2d"), picture = context.createImageData(p.columns, p.rows);
  for (let i = 0; i < p.n; ++i) {
    const v = Math.min(1, Math.max(0, 0.5 + 0.5 * (p.values[i * p.axes] - p.middle[0]) / p.spread[0]));
    const c = Number.isFinite(v) ? 40 + 190 * v : 0;
    picture.data.set([c, c, c, 255], 4 * i);
  }
  context.putImageData(picture, 0, 0);
  state.picture = sheet;
}
const placesFrame = (w, h) => { const p = state.points, s = Math.min(w / p.columns, h / p.rows); return [(w - s * p.columns) / 2, (h - s * p.rows) / 2, s]; };

function drawPlaces() {
  const {context, w, h} = fit(places), p = state.points;
  if (!p || !state.picture || !w) return;
  const [x, y, s] = placesFrame(w, h);
  context.drawImage(state.picture, x, y, s * p.columns, s * p.rows);
  if (app.selection) context.drawImage(app.selection.sheet, x, y, s * p.columns, s * p.rows);
  if (state.lasso && state.lasso.where === places) outline(context, state.lasso.points);
}

// Makes the selection known to the image, as a sheet of marks on the grid of the points.
function select() {
  const p = state.points, sheet = make("canvas");
  sheet.width = p.columns; sheet.height = p.rows;
  const context = sheet.getContext("2d"), picture = context.createImageData(p.columns, p.rows);
  let any = false;
  for (let i = 0; i < p.n; ++i) if (state.mask[i]) { any = true; picture.data.set([224, 60, 30, 235], 4 * i); }
  context.putImageData(picture, 0, 0);
  app.selection = any ? {source: state.source, step: p.step, columns: p.columns, rows: p.rows, sheet} : null;
  app.tell("selection");
}
function legend() {
  $("materials").replaceChildren(...($("paint").value === "material" && state.materials ? state.materials.ends.map(e => make("li", {}, swatch(`rgb(${state.materials.colours[e.m]})`), e.name)) : []));
}
app.on("selection", () => { if (state.points) tint(); drawCloud(); drawPlaces(); legend(); if (state.points) say(); });

function endLasso() {
  const {where, points, add} = state.lasso, p = state.points;
  state.lasso = null;
  if (points.length > 2) {
    const w = where.clientWidth, h = where.clientHeight, at = screen(w, h), [x0, y0, s] = placesFrame(w, h);
    for (let i = 0; i < p.n; ++i) {
      const [x, y] = where === canvas ? at(i) : [x0 + s * (i % p.columns + 0.5), y0 + s * (Math.floor(i / p.columns) + 0.5)];
      const is = inside(x, y, points);
      state.mask[i] = is || (add && state.mask[i]) ? 1 : 0;
    }
  }
  select();
}
function tool(name) {
  state.tool = name;
  for (const n of ["turn", "lasso"]) $(`tool-${n}`).setAttribute("aria-pressed", String(n === name));
}
let from = null;
for (const where of [canvas, places]) {
  where.addEventListener("pointerdown", e => {
    if (!state.points) return;
    where.setPointerCapture(e.pointerId);
    if (where === places || state.tool === "lasso") state.lasso = {where, points: [[e.offsetX, e.offsetY]], add: e.shiftKey};
    else from = [e.clientX, e.clientY];
  });
  where.addEventListener("pointermove", e => {
    if (state.lasso) { state.lasso.points.push([e.offsetX, e.offsetY]); where === canvas ? drawCloud("above") : drawPlaces(); return; }
    if (!from || where !== canvas) return;
    turn(0, 2, (e.clientX - from[0]) / 150);
    turn(1, 2, (from[1] - e.clientY) / 150);
    from = [e.clientX, e.clientY];
    drawCloud("moving");
  });
  where.addEventListener("pointerup", () => { if (from) drawCloud(); from = null; if (state.lasso) endLasso(); });
}
canvas.addEventListener("wheel", e => { e.preventDefault(); state.zoom *= Math.exp(-e.deltaY / 500); drawCloud(); }, {passive: false});
canvas.addEventListener("keydown", e => {
  const act = {ArrowLeft: () => turn(0, 2, -0.1), ArrowRight: () => turn(0, 2, 0.1), ArrowUp: () => turn(1, 2, 0.1), ArrowDown: () => turn(1, 2, -0.1),
    "+": () => { state.zoom *= 1.3; }, "-": () => { state.zoom /= 1.3; }, 0: front, " ": spin}[e.key];
  if (!act || !state.points || e.ctrlKey || e.metaKey) return;
  e.preventDefault();
  act();
  drawCloud();
});
function spin() {
  state.spinning = !state.spinning;
  $("spin").setAttribute("aria-pressed", String(state.spinning));
  const step = () => { if (!state.spinning || !state.active) { if (state.active) drawCloud(); return; } tour(); drawCloud("moving"); requestAnimationFrame(step); };
  state.frame = 0;
  step();
}
$("spin").addEventListener("click", () => { if (state.points) spin(); });
$("front").addEventListener("click", () => { if (state.points) { front(); drawCloud(); } });
$("unselect").addEventListener("click", () => { if (state.points) { state.mask.fill(0); select(); } });
$("tool-turn").addEventListener("click", () => tool("turn"));
$("tool-lasso").addEventListener("click", () => tool("lasso"));
$("dimensions").addEventListener("change", () => { if (state.points) { front(); drawCloud(); } });
$("kind").addEventListener("change", () => { state.chosen = $("kind").value === "bands" ? firstBands() : [0, 1, 2]; load(); });
$("paint").addEventListener("change", async () => {
  try { if ($("paint").value === "material" && state.points) await loadMaterials(); } catch (error) { complain(error); }
  if (state.points) tint();
  drawCloud();
  legend();
});
for (const k of [0, 1, 2]) $(`axis-${k}`).addEventListener("change", e => {
  state.chosen[k] = +e.target.value;
  if ($("kind").value === "bands") { load(); return; }
  front();
  drawCloud();
});
// Red and near infrared, where there are such: the classic pair.
function firstBands() {
  const run = app.run(), near = um => run.channels.reduce((best, c, i) => Math.abs(c.um - um) < Math.abs(run.channels[best].um - um) ? i : best, 0);
  const last = run.channels.length - 1, [a, b] = [near(0.66), near(0.85)];
  return a !== b ? [a, b, near(1.65)] : [0, Math.min(1, last), Math.min(2, last)];
}
app.on("runs", () => { if (app.run()) { state.wanted = ""; if (!state.points) state.chosen = firstBands(); load(); } });
app.on("screen-scatter", () => { state.active = true; load(); drawCloud(); drawPlaces(); });
app.on("screen-left", () => { state.active = false; state.spinning = false; $("spin").setAttribute("aria-pressed", "false"); });
app.on("theme", () => { if (state.points) tint(); drawCloud(); });
new ResizeObserver(() => { drawCloud(); drawPlaces(); }).observe($("cloud-stage"));
