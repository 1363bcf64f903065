// Spectra of pixels and regions with their intervals, library spectra over them, and a table to take along.
import {app, ask, complain} from "/api.js";
import {$, brief, draw, hasKelvin, hues, kelvin, make, save, swatch} from "/tools.js";
import {plotSpectra} from "/plot.js";
import {chooseBand} from "/image.js";

app.pins = [];
let current = [], library = [], read = () => NaN, turn = 0, range = null;

const runName = k => (app.sources.length > 1 ? `${"AB"[k]} ` : "") + (app.times.length ? `${app.times[app.sources[k].index]} ` : "");

async function lookAtPixel() {
  const {x, y} = app.pixel, mine = ++turn;
  try {
    const both = !$("compare").hidden && app.run(1) ? [0, 1] : [app.shown];
    const answers = await Promise.all(both.map(k => ask("pixel", {...app.query(k), x, y})));
    if (mine !== turn) return;
    current = answers.map((answer, i) => ({...spectrumOf(both[i], answer), name: `${runName(both[i])}pixel ${x}, ${y}`, x, y, source: both[i]}));
    listValues(answers[Math.max(0, both.indexOf(app.shown))]);
    show();
  } catch (error) { complain(error); }
}

function spectrumOf(k, answer) {
  const run = app.run(k), value = answer[app.main(k).name], half = answer.half_width || value.map(() => NaN);
  return {um: run.channels.map(c => c.um || NaN), names: run.channels.map(c => c.name), value: value.map(v => v ?? NaN), half: half.map(v => v ?? NaN), unit: run.unit};
}

function listValues(answer) {
  const run = app.run(), rows = $("value-rows");
  rows.replaceChildren();
  const row = (name, value) => rows.append(make("tr", {}, make("th", {scope: "row"}, name), make("td", {}, value)));
  for (const cube of run.cubes) {
    const values = answer[cube.name];
    if (cube.spectral || !values) continue;
    const named = (v, b) => `${cube.names[b] ? cube.names[b] + " " : ""}${exact(v)}`;
    if (cube.classes.length) row(cube.what, cube.classes[values[0]] ?? "\u2013");
    else if (cube.role === "share") row(cube.what, values.map((v, b) => [v, b]).filter(([v]) => v > 0).sort((a, b) => b[0] - a[0])
      .map(([v, b]) => `${cube.names[b]} ${brief(v)}`).join(", ") || "\u2013");
    else row(cube.what, values.map((v, b) => cube.bands > 1 ? named(v, b) : exact(v)).join(", ") + (cube.unit && cube.unit !== "1" && cube.unit !== "count" ? ` ${cube.unit}` : ""));
  }
}
const exact = v => v === null ? "\u2013" : Number.isInteger(v) ? String(v) : String(+v.toPrecision(8));

const shown = () => [...current.map((s, i) => ({...s, colour: i ? "#b85a9a" : getComputedStyle(document.documentElement).getPropertyValue("--accent").trim()})), ...app.pins];

function inUnit(s) {
  if ($("quantity").value !== "kelvin") return s;
  const value = s.value.map((l, i) => kelvin(s.um[i], l));
  return {...s, value, half: s.value.map((l, i) => Math.max(kelvin(s.um[i], l + s.half[i]) - value[i], value[i] - kelvin(s.um[i], l - s.half[i])))};
}

function show() {
  const run = app.run();
  if (!run) return;
  const inKelvin = $("quantity").value === "kelvin", c = run.channels[Math.min(app.band, run.channels.length - 1)];
  const label = inKelvin ? "brightness temperature at centres, K" : `radiance, ${run.unit || "as stored"}`;
  read = plotSpectra($("spectrum"), shown().map(inUnit), library, {label, band: c.um, range});
  $("whole-plot").hidden = !range;
  const b = run.channels.indexOf(c);
  $("readout").textContent = current.map(inUnit).map(s => {
    const v = s.value[b], e = s.half[b];
    let text = `${s.name}: ${c.name}${c.um ? ` (${brief(c.um)} \u00b5m)` : ""} = ${inKelvin && v ? v.toFixed(2) : brief(v)}${Number.isFinite(e) ? ` \u00b1 ${brief(e)}` : ""} ${inKelvin ? "K" : s.unit}`;
    if (Number.isFinite(e) && run.confidence) text += ` at ${brief(100 * run.confidence)} %`;
    return text;
  }).join("; ");
  list();
}

function list() {
  const pins = $("pins");
  pins.replaceChildren();
  const item = (colour, name, drop) => {
    const remove = make("button", {"aria-label": `Remove ${name}`}, "\u00d7");
    remove.addEventListener("click", drop);
    pins.append(make("li", {}, swatch(colour), make("span", {class: "name", title: name}, name), remove));
  };
  app.pins.forEach((p, i) => item(p.colour, p.name, () => { app.pins.splice(i, 1); app.tell("pins"); show(); }));
  library.forEach((s, i) => item("transparent", `library: ${s.name}`, () => { library.splice(i, 1); show(); }));
}

function pin(spectrum) {
  const colour = hues.find(h => !app.pins.some(p => p.colour === h)) || hues[app.pins.length % hues.length];
  app.pins.push({...spectrum, colour});
  app.tell("pins");
  show();
}

async function lookAtRegion() {
  const corners = app.corners, k = app.shown;
  try {
    const answer = await ask("region", {...app.query(k), corners: corners.flat().join(",")});
    const run = app.run(k);
    pin({um: run.channels.map(c => c.um || NaN), names: run.channels.map(c => c.name), value: answer.mean.map(v => v ?? NaN), half: answer.halfWidth.map(v => v ?? NaN), unit: run.unit,
      name: `${runName(k)}mean of ${answer.pixels} pixels${answer.converged < answer.pixels ? `, ${answer.pixels - answer.converged} not converged` : ""}`, corners, source: k});
  } catch (error) { complain(error); }
}

// A column of text may begin with what a table program takes for a formula.
const cell = text => `"${/^[=+\-@\t\r]/.test(text) ? "'" : ""}${text.replaceAll('"', '""')}"`;
function csv() {
  const all = shown(), inKelvin = $("quantity").value === "kelvin";
  if (!all.length) return;
  const unit = inKelvin ? "K" : app.run().unit;
  const lines = [["channel", "wavelength_um", ...all.flatMap(s => [`${s.name} (${unit})`, `half-width of ${s.name} (${unit})`])].map(cell).join(",")];
  const converted = all.map(inUnit);
  all[0].um.forEach((um, i) => lines.push([cell(all[0].names[i]), Number.isFinite(um) ? um : "", ...converted.flatMap(s => [s.value[i], s.half[i]].map(v => Number.isFinite(v) ? v : ""))].join(",")));
  app.csv = lines.join("\n") + "\n";
  save("spectra.csv", app.csv);
}

$("library").addEventListener("input", async e => {
  try {
    const {materials} = await ask("materials", {text: e.target.value, curves: 0});
    $("library-names").replaceChildren(...materials.map(m => new Option(m.name)));
  } catch (error) { complain(error); }
});
async function addLibrary() {
  try {
    const {materials} = await ask("materials", {text: $("library").value, curves: 1});
    if (!materials.length) { complain(new Error(`the library has no material '${$("library").value}'`)); return; }
    const [m] = materials, curve = m.curves[0];
    library.push({name: m.curves.length > 1 ? `${m.name}, ${curve.name}` : m.name, um: curve.um, value: curve.reflectance});
    show();
  } catch (error) { complain(error); }
}
$("library-add").addEventListener("click", addLibrary);
$("library").addEventListener("keydown", e => { if (e.key === "Enter") addLibrary(); });
$("pin").addEventListener("click", () => app.tell("pin"));
$("clear").addEventListener("click", () => { app.pins = []; library = []; app.tell("pins"); show(); });
$("csv").addEventListener("click", csv);
$("quantity").addEventListener("change", show);
// A click chooses the band, a drag the wavelengths that are shown.
let from = null;
const zoom = (a, b) => { range = a && [Math.min(a, b), Math.max(a, b)]; show(); };
$("spectrum").addEventListener("pointerdown", e => { from = {x: e.clientX, um: read(e)}; $("spectrum").setPointerCapture(e.pointerId); });
$("spectrum").addEventListener("pointermove", e => {
  const mark = $("spectrum").querySelector(".chosen"), far = from && Math.abs(e.clientX - from.x) > 5;
  if (mark) mark.remove();
  if (!far || !Number.isFinite(from.um)) return;
  const r = $("spectrum").getBoundingClientRect(), [a, b] = [from.x, e.clientX].map(x => (x - r.left) / r.width * 520);
  draw($("spectrum"), "rect", {class: "chosen", x: Math.min(a, b), y: 26, width: Math.abs(b - a), height: 284});
});
$("spectrum").addEventListener("pointercancel", () => { from = null; show(); });
$("spectrum").addEventListener("dblclick", () => zoom(null));
$("whole-plot").addEventListener("click", () => zoom(null));
$("spectrum").addEventListener("pointerup", e => {
  const um = read(e), run = app.run(), begun = from;
  from = null;
  if (!run || !begun || !Number.isFinite(um)) return;
  if (Math.abs(e.clientX - begun.x) > 5) {
    const within = run.channels.filter(c => c.um >= Math.min(um, begun.um) && c.um <= Math.max(um, begun.um)).length;
    if (within > 1) zoom(begun.um, um); else show();
    return;
  }
  chooseBand(run.channels.reduce((best, c, i) => Math.abs(c.um - um) < Math.abs(run.channels[best].um - um) ? i : best, 0));
});
app.on("pin", () => current.forEach(pin));
app.on("pixel", lookAtPixel);
app.on("region", lookAtRegion);
app.on("band", show);
app.on("theme", show);
app.on("runs", () => {
  if (!app.times.length) range = null;
  app.pins = app.pins.filter(p => app.run(p.source));
  const kelvinFits = Boolean(app.run()) && hasKelvin(app.run());
  $("quantity").querySelector("option[value=kelvin]").disabled = !kelvinFits;
  if (!kelvinFits) $("quantity").value = "radiance";
});
