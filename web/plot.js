// Spectra with their intervals: lines, bands of uncertainty, and library spectra on an axis of their own.
import {brief, draw, ticks, tickTexts} from "/tools.js";

// series: {um, value, half, colour}; library: {um, value, name}; range: wavelengths that are wanted, null: all. Returns a function from a
// place in the picture to a wavelength.
export function plotSpectra(svg, series, library, {label, band, range}) {
  svg.replaceChildren();
  const W = 520, H = 358, box = {l: 62, t: 26, w: library.length ? 400 : 444, h: 284};
  svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
  const all = series.flatMap(s => s.um.map((um, i) => ({um, y: s.value[i], e: Number.isFinite(s.half[i]) ? s.half[i] : 0})))
    .filter(p => p.um > 0 && Number.isFinite(p.y) && (!range || (p.um >= range[0] && p.um <= range[1])));
  if (!all.length) {
    draw(svg, "text", {x: W / 2, y: H / 2, "text-anchor": "middle"}, "Click a pixel of the image");
    return () => NaN;
  }
  const [least, most] = range || [Math.min(...all.map(p => p.um)), Math.max(...all.map(p => p.um))];
  const wide = most > 6 * least, scale = wide ? Math.log10 : v => v;
  let low = Math.min(...all.map(p => p.y - p.e)), high = Math.max(...all.map(p => p.y + p.e));
  const margin = (high - low || Math.abs(high) || 1) * 0.06;
  low = low >= 0 && low < (high - low) * 0.6 ? 0 : low - margin;
  high += margin;
  const x0 = scale(least), x1 = scale(most), xm = range ? 0 : (x1 - x0) * 0.03 || Math.abs(x0) * 0.1 || 1;
  const px = um => box.l + (scale(um) - x0 + xm) / (x1 - x0 + 2 * xm) * box.w;
  const py = y => box.t + box.h - (y - low) / (high - low) * box.h;
  const rows = ticks(low, high, 5), texts = tickTexts(rows);
  for (const [k, t] of rows.entries()) {
    draw(svg, "line", {x1: box.l, x2: box.l + box.w, y1: py(t), y2: py(t), class: "grid"});
    draw(svg, "text", {x: box.l - 7, y: py(t) + 4, "text-anchor": "end"}, texts[k]);
  }
  const marks = wide ? [0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 7, 10, 15, 20, 50, 100].filter(t => scale(t) >= x0 - xm && scale(t) <= x1 + xm)
    : ticks(x0 - xm, x1 + xm, 6);
  for (const t of marks) {
    draw(svg, "line", {x1: px(t), x2: px(t), y1: box.t + box.h, y2: box.t + box.h + 4, class: "axis"});
    draw(svg, "text", {x: px(t), y: box.t + box.h + 17, "text-anchor": "middle"}, brief(t));
  }
  draw(svg, "path", {d: `M${box.l},${box.t}V${box.t + box.h}H${box.l + box.w}`, class: "axis"});
  draw(svg, "text", {x: box.l + box.w, y: H - 6, "text-anchor": "end"}, "wavelength, \u00b5m");
  draw(svg, "text", {x: 4, y: 14}, label);
  draw(draw(svg, "clipPath", {id: "within"}), "rect", {x: box.l, y: box.t - 6, width: box.w, height: box.h + 6});
  const curves = draw(svg, "g", range ? {"clip-path": "url(#within)"} : {});
  if (band >= least && band <= most) draw(svg, "line", {x1: px(band), x2: px(band), y1: box.t, y2: box.t + box.h, class: "band"});

  if (library.length) {
    const right = box.l + box.w, ly = v => box.t + box.h - v * box.h;
    draw(svg, "path", {d: `M${right},${box.t}V${box.t + box.h}`, class: "axis"});
    for (const t of [0, 0.2, 0.4, 0.6, 0.8, 1]) draw(svg, "text", {x: right + 7, y: ly(t) + 4}, brief(t));
    draw(svg, "text", {x: W - 2, y: 14, "text-anchor": "end"}, "reflectance (library)");
    for (const s of library) {
      const points = s.um.map((um, i) => [um, s.value[i]]).filter(([um]) => um >= least * 0.98 && um <= most * 1.02);
      if (points.length > 1)
        draw(draw(curves, "path", {class: "library", d: "M" + points.map(([um, v]) => `${px(um).toFixed(1)},${ly(v).toFixed(1)}`).join("L")}), "title", {}, s.name);
    }
  }
  for (const s of series) {
    const points = s.um.map((um, i) => ({x: px(um), y: s.value[i], e: s.half[i]}))
      .filter(p => Number.isFinite(p.x) && Number.isFinite(p.y)).sort((a, b) => a.x - b.x);
    const known = points.filter(p => p.e > 0);
    if (known.length > 1 && points.length > 40)
      draw(curves, "path", {d: "M" + known.map(p => `${p.x.toFixed(1)},${py(p.y + p.e).toFixed(1)}`).join("L") + "L" +
        known.slice().reverse().map(p => `${p.x.toFixed(1)},${py(p.y - p.e).toFixed(1)}`).join("L") + "Z", fill: s.colour, opacity: 0.22});
    const line = draw(curves, "path", {class: "curve", stroke: s.colour, d: "M" + points.map(p => `${p.x.toFixed(1)},${py(p.y).toFixed(1)}`).join("L")});
    draw(line, "title", {}, s.name);
    if (points.length > 40) continue;
    for (const p of points) {
      if (p.e > 0) draw(curves, "path", {stroke: s.colour, fill: "none", d: `M${p.x},${py(p.y - p.e)}V${py(p.y + p.e)}M${p.x - 4},${py(p.y - p.e)}h8M${p.x - 4},${py(p.y + p.e)}h8`});
      draw(curves, "circle", {cx: p.x, cy: py(p.y), r: 2.6, fill: s.colour});
    }
  }
  return event => {
    const r = svg.getBoundingClientRect(), x = (event.clientX - r.left) / r.width * W;
    const s = (x - box.l) / box.w * (x1 - x0 + 2 * xm) + x0 - xm;
    return wide ? 10 ** s : s;
  };
}
