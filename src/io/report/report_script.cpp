#include "io/report/report_page.h"

namespace ifov::io {

const char* const kReportScript = R"js(
"use strict";
(() => {
  const $ = id => document.getElementById(id);
  const meta = JSON.parse($("meta").textContent);
  const bytes = id => Uint8Array.from(atob($(id).textContent.trim()), c => c.charCodeAt(0));
  const maps = {seq: bytes("colours-seq"), heat: bytes("colours-heat")};
  const W = meta.width, H = meta.height, N = W * H, bands = meta.channels.length;

  // A quantised raster: band b of it as numbers, NaN where there is none.
  function raster(id) {
    if (!meta.rasters[id]) return null;
    const raw = bytes(id), codes = new Uint16Array(raw.buffer), r = meta.rasters[id];
    const value = (b, i) => {
      const c = codes[b * N + i];
      return c === 65535 ? NaN : r.low[b] + c * (r.high[b] - r.low[b]) / 65534;
    };
    return {value, band: b => Float64Array.from({length: N}, (_, i) => value(b, i))};
  }
  const radiance = raster("radiance"), width = raster("half_width"), samples = raster("samples"), quality = raster("quality"), reasons = raster("reasons");

  const C1 = 1.191042972e8, C2 = 1.438776877e4;  // W m-2 sr-1 um4; um K
  const kelvin = (um, l) => l > 0 ? C2 / (um * Math.log1p(C1 / (um ** 5 * l))) : NaN;
  const slope = (um, t) => {
    const x = C2 / (um * t), e = Math.exp(x);
    return C1 / um ** 5 * e / (e - 1) ** 2 * x / t;
  };

  const brief = v => !isFinite(v) ? "\u2013" : v === 0 ? "0"
    : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(2).replace("e+", "e") : String(+v.toPrecision(4));
  function ticks(low, high, most) {
    const raw = (high - low) / most, p = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map(m => m * p).find(s => s >= raw * 0.999999);
    const list = [];
    for (let t = Math.ceil(low / step - 1e-9) * step; t <= high + 1e-9 * step; t += step) list.push(Math.abs(t) < step * 1e-6 ? 0 : t);
    return list;
  }
  function percentiles(values, a, b) {
    const s = values.filter(Number.isFinite).sort();
    if (!s.length) return [0, 1];
    const at = q => s[Math.floor(q * (s.length - 1))];
    let low = at(a), high = at(b);
    if (!(high > low)) { low = s[0]; high = s[s.length - 1]; }
    if (!(high > low)) { const m = Math.max(Math.abs(low) * 1e-3, 1e-12); low -= m; high += m; }
    return [low, high];
  }

  const NS = "http://www.w3.org/2000/svg";
  function add(parent, name, attributes, text) {
    const e = document.createElementNS(NS, name);
    for (const k in attributes) e.setAttribute(k, attributes[k]);
    if (text !== undefined) e.textContent = text;
    return parent.appendChild(e);
  }
  function clear(svg, w, h) {
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${w} ${h}`);
  }

  function paint(canvas, values, range, map) {
    canvas.width = W; canvas.height = H;
    const context = canvas.getContext("2d"), picture = context.createImageData(W, H), out = picture.data;
    for (let i = 0; i < N; ++i) {
      const v = values[i];
      if (!isFinite(v)) { out[4 * i] = out[4 * i + 1] = out[4 * i + 2] = 128; out[4 * i + 3] = 255; continue; }
      const k = 3 * Math.round(255 * Math.min(1, Math.max(0, (v - range[0]) / (range[1] - range[0]))));
      out[4 * i] = map[k]; out[4 * i + 1] = map[k + 1]; out[4 * i + 2] = map[k + 2]; out[4 * i + 3] = 255;
    }
    context.putImageData(picture, 0, 0);
  }
  function paintColour(canvas) {
    canvas.width = W; canvas.height = H;
    const context = canvas.getContext("2d"), picture = context.createImageData(W, H), out = picture.data;
    meta.rgb.forEach((b, k) => {
      const values = radiance.band(b), [low, high] = meta.rgbRanges[k];
      for (let i = 0; i < N; ++i) {
        const v = Math.min(1, Math.max(0, (values[i] - low) / (high - low)));
        out[4 * i + k] = 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
        out[4 * i + 3] = 255;
      }
    });
    context.putImageData(picture, 0, 0);
  }
  function colourBar(svg, range, map, label, back = v => v) {
    const w = 480;
    clear(svg, w, 48);
    const id = svg.id + "-gradient", gradient = add(add(svg, "defs", {}), "linearGradient", {id});
    for (let k = 0; k <= 32; ++k) {
      const c = 3 * Math.round(255 * k / 32);
      add(gradient, "stop", {offset: k / 32, "stop-color": `rgb(${map[c]},${map[c + 1]},${map[c + 2]})`});
    }
    add(svg, "rect", {x: 0, y: 2, width: w, height: 12, fill: `url(#${id})`});
    for (const t of ticks(range[0], range[1], 5)) {
      const x = w * (t - range[0]) / (range[1] - range[0]);
      add(svg, "line", {x1: x, x2: x, y1: 14, y2: 18, class: "axis"});
      add(svg, "text", {x, y: 29, "text-anchor": x < 14 ? "start" : x > w - 14 ? "end" : "middle"}, brief(back(t)));
    }
    add(svg, "text", {x: w, y: 43, "text-anchor": "end"}, label);
  }

  // Viewer: what is shown, of which channel, and the pixel that is looked at.
  const state = {view: meta.rgb.length === 3 ? "colour" : "channel", band: meta.first, x: W >> 1, y: H >> 1, region: null};
  const shown = b => meta.channels[b].thermal ? "brightness temperature, K" : `radiance, ${meta.unit}`;
  function layer(view, b) {
    const c = meta.channels[b];
    if (view === "channel") {
      const v = radiance.band(b);
      return {values: c.thermal ? v.map(l => kelvin(c.um, l)) : v, map: c.thermal ? maps.heat : maps.seq, label: shown(b)};
    }
    const v = width.band(b);
    if (!c.thermal) return {values: v, map: maps.heat, label: `half-width, ${meta.unit}`};
    return {values: v.map((w, i) => w / slope(c.um, kelvin(c.um, radiance.value(b, i)))), map: maps.heat, label: "half-width, K"};
  }
  function drawImage() {
    const c = meta.channels[state.band];
    $("band-name").textContent = `${c.name} \u00b7 ${brief(c.um)} \u00b5m`;
    if (state.view === "colour") {
      paintColour($("image"));
      clear($("image-bar"), 480, 48);
      const names = meta.rgb.map(b => `${meta.channels[b].name} (${brief(meta.channels[b].um)} \u00b5m)`).join(", ");
      add($("image-bar"), "text", {x: 0, y: 14}, "Red, green, blue: " + names);
    } else {
      const l = layer(state.view, state.band), range = percentiles(l.values, 0.01, 0.99);
      paint($("image"), l.values, range, l.map);
      colourBar($("image-bar"), range, l.map, l.label);
    }
    for (const b of document.querySelectorAll("#views button")) b.setAttribute("aria-pressed", b.dataset.view === state.view);
    $("band").disabled = state.view === "colour";
    drawMark();
  }
  function drawMark() {
    const svg = $("mark");
    clear(svg, W, H);
    svg.setAttribute("preserveAspectRatio", "none");
    if (state.region) {
      const r = state.region;
      for (const [stroke, w] of [["#000", 4], ["#fff", 1.6]])
        add(svg, "rect", {x: r.x0, y: r.y0, width: r.x1 - r.x0, height: r.y1 - r.y0, stroke, "stroke-width": w,
          "vector-effect": "non-scaling-stroke", fill: "none"});
      return;
    }
    const s = Math.max(W, H) / 60, x = state.x + 0.5, y = state.y + 0.5;
    for (const [stroke, w] of [["#000", 4], ["#fff", 1.6]])
      add(svg, "path", {d: `M${x - 2.2 * s},${y}H${x - 0.7 * s}M${x + 0.7 * s},${y}H${x + 2.2 * s}M${x},${y - 2.2 * s}V${y - 0.7 * s}M${x},${y + 0.7 * s}V${y + 2.2 * s}`,
        stroke, "stroke-width": w, "vector-effect": "non-scaling-stroke", fill: "none"});
  }

  function axes(svg, box, xr, yr, xLabel, yLabel, xTicks) {
    const px = x => box.l + (x - xr[0]) / (xr[1] - xr[0]) * box.w, py = y => box.t + box.h - (y - yr[0]) / (yr[1] - yr[0]) * box.h;
    for (const t of ticks(yr[0], yr[1], 5)) {
      add(svg, "line", {x1: box.l, x2: box.l + box.w, y1: py(t), y2: py(t), class: "grid"});
      add(svg, "text", {x: box.l - 6, y: py(t) + 4, "text-anchor": "end"}, brief(t));
    }
    for (const t of xTicks || ticks(xr[0], xr[1], 6)) {
      const at = px(Array.isArray(t) ? t[0] : t);
      add(svg, "line", {x1: at, x2: at, y1: box.t + box.h, y2: box.t + box.h + 4, class: "axis"});
      add(svg, "text", {x: at, y: box.t + box.h + 17, "text-anchor": "middle"}, Array.isArray(t) ? t[1] : brief(t));
    }
    add(svg, "path", {d: `M${box.l},${box.t}V${box.t + box.h}H${box.l + box.w}`, class: "axis"});
    add(svg, "text", {x: box.l + box.w, y: box.t + box.h + 34, "text-anchor": "end"}, xLabel);
    add(svg, "text", {x: box.l, y: box.t - 9}, yLabel);
    return {px, py};
  }
  function drawSpectrum() {
    const svg = $("spectrum"), at = looked(), box = {l: 58, t: 26, w: 440, h: 330};
    clear(svg, 510, 396);
    // Reflective and thermal channels together need a logarithmic axis.
    const um = meta.channels.map(c => c.um), wide = Math.max(...um) > 6 * Math.min(...um), scale = wide ? Math.log10 : v => v;
    const points = meta.channels.map((c, b) => ({x: scale(c.um), ...at.channel(b)}))
      .filter(p => isFinite(p.y)).sort((a, b) => a.x - b.x);
    if (!points.length) return;
    const e = p => isFinite(p.e) ? p.e : 0;
    let low = Math.min(...points.map(p => p.y - e(p))), high = Math.max(...points.map(p => p.y + e(p)));
    const margin = (high - low || Math.abs(high) || 1) * 0.06;
    low = low >= 0 && low < (high - low) * 0.6 ? 0 : low - margin;
    const x0 = points[0].x, x1 = points[points.length - 1].x, xm = (x1 - x0) * 0.03 || Math.abs(x0) * 0.1 || 1;
    const decades = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100].map(t => [Math.log10(t), String(t)]).filter(t => t[0] >= x0 - xm && t[0] <= x1 + xm);
    const {px, py} = axes(svg, box, [x0 - xm, x1 + xm], [low, high + margin], "wavelength, \u00b5m", `radiance, ${meta.unit}`, wide ? decades : undefined);
    if (bands > 60 && points.some(p => e(p) > 0))
      add(svg, "path", {d: "M" + points.map(p => `${px(p.x)},${py(p.y + e(p))}`).join("L") + "L" +
        points.slice().reverse().map(p => `${px(p.x)},${py(p.y - e(p))}`).join("L") + "Z", fill: "#0b6b7d", opacity: 0.22});
    add(svg, "path", {d: "M" + points.map(p => `${px(p.x).toFixed(2)},${py(p.y).toFixed(2)}`).join("L"), class: "curve"});
    if (bands <= 60) for (const p of points) {
      if (e(p) > 0) add(svg, "path", {d: `M${px(p.x)},${py(p.y - e(p))}V${py(p.y + e(p))}M${px(p.x) - 4},${py(p.y - e(p))}h8M${px(p.x) - 4},${py(p.y + e(p))}h8`, class: "error"});
      add(svg, "circle", {cx: px(p.x), cy: py(p.y), r: 2.6, class: "dot"});
    }
    const here = meta.channels[state.band], {y: l, e: h} = at.channel(state.band);
    let text = `${at.name}: ${here.name} = ${brief(l)}${isFinite(h) ? " \u00b1 " + brief(h) : ""}`;
    if (here.thermal) {
      const t = kelvin(here.um, l);
      text += ` = ${t.toFixed(2)} K` + (isFinite(h) ? ` \u00b1 ${brief(h / slope(here.um, t))} K` : "");
    }
    $("pixel").textContent = text + at.more;
  }

  function drawMap(id, r, band, map, label, logarithmic) {
    if (!r || !$(id)) return;
    let values = r.band(band), range, back = v => v;
    if (logarithmic) { values = values.map(v => Math.log10(Math.max(v, 1))); back = v => 10 ** v; }
    range = percentiles(values, 0, 1);
    paint($(id), values, range, map);
    colourBar($(id + "-bar"), range, map, label, back);
  }
  function drawHistogram(id, h, xLabel, limit) {
    const svg = $(id);
    if (!svg || !h || !h.counts.length) return;
    clear(svg, 510, 240);
    const scale = h.logarithmic ? Math.log10 : v => v, x = h.edges.map(scale);
    const xr = [x[0], x[x.length - 1]], top = Math.max(...h.counts), box = {l: 58, t: 26, w: 440, h: 168};
    const ticksLog = h.logarithmic ? ticks(xr[0], xr[1], 6).map(t => [t, brief(10 ** t)]) : undefined;
    const {px, py} = axes(svg, box, xr, [0, top * 1.05], xLabel, "pixels", ticksLog);
    h.counts.forEach((n, k) => n && add(svg, "rect", {x: px(x[k]) + 0.4, width: Math.max(0.6, px(x[k + 1]) - px(x[k]) - 0.8),
      y: Math.min(py(n), py(0) - 0.8), height: Math.max(0.8, py(0) - py(n)), class: "hist"}));
    if (limit !== undefined && scale(limit) >= xr[0] && scale(limit) <= xr[1]) {
      add(svg, "line", {x1: px(scale(limit)), x2: px(scale(limit)), y1: box.t, y2: box.t + box.h, class: "limit"});
      add(svg, "text", {x: px(scale(limit)), y: box.t - 5, "text-anchor": "middle", class: "limit-text"}, "limit");
    }
  }
)js";

}  // namespace ifov::io
