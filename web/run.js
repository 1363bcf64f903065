// A run that another process is at work on: how far it is, and its tiles as they come.
import {app, ask, complain} from "/api.js";
import {$, brief, colourBar, fill, fit, make, percentiles} from "/tools.js";

const canvas = $("tiles");
let looks = 0, known = "", tiles = new Map(), asked = new Set(), key = "", missed = new Map();

const time = s => s < 60 ? `${s.toFixed(0)} s` : s < 3600 ? `${(s / 60).toFixed(1)} min` : `${(s / 3600).toFixed(1)} h`;
const watched = () => [...app.sources, ...app.other].find(s => s.watch);

function show() {
  const k = watched(), figures = $("figures");
  figures.replaceChildren();
  offerStop(k ? k.watch.atWork : "");
  const put = (value, name) => figures.append(make("div", {}, make("b", {}, value), make("span", {}, name)));
  if (!k) {
    const run = app.run();
    $("progress").value = run ? 1 : 0;
    if (run) { put("done", "products are whole"); put(run.reached || "\u2013", "accuracy reached"); }
    $("status").textContent = run ? run.notes : app.sources.map(s => s.fault).join("\n");
    return;
  }
  const w = k.watch, share = w.pixelsDone / w.pixelsWanted;
  $("progress").value = share;
  put(`${(100 * share).toFixed(1)} %`, `${w.tilesDone} of ${w.tilesWanted} tiles`);
  put(share > 0 && share < 1 ? time(w.elapsed * (1 - share) / share) : "\u2013", "left, at this rate");
  put(w.pixelsDone && w.judged ? `${(100 * w.pixelsConverged / w.pixelsDone).toFixed(1)} %` : "\u2013", "of the pixels done converged");
  put(w.judged ? `${brief(w.worst)} \u00d7` : "\u2013", "largest error over its limit");
  put(brief(w.rays), "rays");
  put(w.atWork || "nobody", "at work");
  $("status").textContent = w.text;
  const now = `${k.folder} ${w.width} ${w.height} ${w.channels.length} ${w.document}`;
  if (now !== key) {
    key = now;
    tiles = new Map(); asked = new Set(); missed = new Map();
    fill($("tile-band"), w.channels.map((c, i) => [i, c.um ? `${c.name} \u00b7 ${brief(c.um)} \u00b5m` : c.name]), 0);
  }
  if (known.length === w.done.length && [...known].some((c, i) => c === "1" && w.done[i] === "0")) { tiles = new Map(); asked = new Set(); }
  known = w.done;
  ++looks;
  take();
}

// Who is asked to stop; a process that comes later may be asked again.
let stopping = "";
function offerStop(atWork) {
  const button = $("stop-run");
  button.hidden = !atWork;
  if (atWork !== stopping) stopping = "";
  button.disabled = stopping !== "";
  button.textContent = stopping ? "Stopping \u2026" : "Stop the run";
}
$("stop-run").addEventListener("click", () => {
  const k = watched();
  if (!k) return;
  stopping = k.watch.atWork;
  offerStop(stopping);
  ask("stop", {source: k.index}, undefined, "POST").catch(error => { stopping = ""; offerStop(k.watch.atWork); complain(error); });
});

let busy = 0;
async function take() {
  const k = watched();
  if (!k || $("screen-run").hidden) return;
  while (busy < 4) {
    let next = -1;
    for (let i = 0; i < known.length; ++i) if (known[i] === "1" && !asked.has(i) && (missed.get(i) || 0) < looks) { next = i; break; }
    if (next < 0) return;
    asked.add(next);
    ++busy;
    const band = $("tile-band").value || 0, mine = tiles;
    ask("tile", {source: k.index, tile: next, band}).then(({about, values}) => mine.set(next, {...about, values}), error => {
      // It may have been moved to another file at this moment; a later look finds it.
      missed.set(next, looks);
      asked.delete(next);
      if (error.status !== 409 && error.status !== 503) complain(error);
    }).finally(() => { --busy; paint(); });
    await new Promise(resolve => setTimeout(resolve, 0));
  }
}

function paint() {
  const k = watched(), {context, w: width, h: height} = fit(canvas);
  if (!app.colours || !width) return;
  const w = k ? k.watch : null;
  if (!w) return;
  const ratio = $("tile-what").value === "ratio", part = t => { const n = (t.x1 - t.x0) * (t.y1 - t.y0); return ratio ? t.values.subarray(n, 2 * n) : t.values.subarray(0, n); };
  const all = [...tiles.values()];
  const some = new Float32Array(all.reduce((n, t) => n + Math.ceil(part(t).length / 8), 0));
  let at = 0;
  for (const t of all) { const v = part(t); for (let i = 0; i < v.length; i += 8) some[at++] = v[i]; }
  const range = percentiles(some, 1, 99), map = app.colours[ratio ? "heat" : "sequential"];
  const scale = Math.min(width / w.width, height / w.height), x0 = (width - scale * w.width) / 2, y0 = (height - scale * w.height) / 2;
  context.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--line");
  context.strokeRect(x0 + 0.5, y0 + 0.5, scale * w.width - 1, scale * w.height - 1);
  for (const t of all) {
    const columns = t.x1 - t.x0, rows = t.y1 - t.y0, v = part(t), sheet = make("canvas");
    sheet.width = columns; sheet.height = rows;
    const inner = sheet.getContext("2d"), picture = inner.createImageData(columns, rows);
    for (let i = 0; i < v.length; ++i) {
      const c = 3 * Math.round(255 * Math.min(1, Math.max(0, (v[i] - range[0]) / (range[1] - range[0]))));
      picture.data.set(Number.isFinite(v[i]) ? [map[c], map[c + 1], map[c + 2], 255] : [128, 128, 128, 255], 4 * i);
    }
    inner.putImageData(picture, 0, 0);
    context.drawImage(sheet, x0 + scale * t.x0, y0 + scale * t.y0, scale * columns, scale * rows);
  }
  if (all.length) colourBar($("tiles-bar"), range, map, ratio ? "largest half-width over its limit" : `radiance, ${w.unit}`);
  canvas.dataset.tiles = String(all.length);
  take();
}

app.on("sources", show);
app.on("screen-run", () => { show(); paint(); });
app.on("theme", paint);
$("tile-what").addEventListener("change", paint);
$("tile-band").addEventListener("change", () => { tiles = new Map(); asked = new Set(); take(); });
new ResizeObserver(paint).observe($("tiles-stage"));
