// Small things that all screens use. Text becomes a node of text, never markup.
export const $ = id => document.getElementById(id);

export function make(name, attributes = {}, ...children) {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children);
  return e;
}

const NS = "http://www.w3.org/2000/svg";
export function draw(parent, name, attributes, text) {
  const e = document.createElementNS(NS, name);
  for (const key in attributes) e.setAttribute(key, attributes[key]);
  if (text !== undefined) e.textContent = text;
  return parent.appendChild(e);
}

export function swatch(colour) {
  const e = make("span", {class: "swatch", "aria-hidden": "true"});
  e.style.backgroundColor = colour;
  return e;
}

export function fill(select, options, chosen) {
  select.replaceChildren(...options.map(([value, text]) => new Option(text, value, false, String(value) === String(chosen))));
}

export const brief = v => !Number.isFinite(v) ? "\u2013" : v === 0 ? "0"
  : Math.abs(v) >= 1e6 || Math.abs(v) < 1e-3 ? v.toExponential(2).replace("e+", "e") : String(+v.toPrecision(4));

export function ticks(low, high, most) {
  const raw = (high - low) / most, p = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map(m => m * p).find(s => s >= raw * 0.999999), list = [];
  if (!(step > 0)) return [low];
  for (let t = Math.ceil(low / step - 1e-9) * step; t <= high + 1e-9 * step; t += step) list.push(Math.abs(t) < step * 1e-6 ? 0 : t);
  return list;
}

// Texts of such ticks, with as many digits as tell them apart.
export function tickTexts(list) {
  const step = list.length > 1 ? list[1] - list[0] : 0, most = Math.max(...list.map(Math.abs));
  if (!(step > 0) || most >= 1e6 || step < 1e-6) return list.map(brief);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return list.map(t => t.toFixed(digits));
}

// Of a part of the values, where there are many. Percent.
export function percentiles(values, from, to) {
  const stride = Math.max(1, Math.floor(values.length / 120000)), some = new Float32Array(Math.ceil(values.length / stride));
  let n = 0;
  for (let i = 0; i < values.length; i += stride) if (Number.isFinite(values[i])) some[n++] = values[i];
  if (!n) return [0, 1];
  const s = some.subarray(0, n).sort(), at = q => s[Math.min(n - 1, Math.floor(q / 100 * (n - 1)))];
  let low = at(from), high = at(to);
  if (!(high > low)) { low = s[0]; high = s[n - 1]; }
  if (!(high > low)) { const m = Math.max(Math.abs(low) * 1e-3, 1e-12); low -= m; high += m; }
  return [low, high];
}

// Planck's law at one wavelength (the channel's centre), inverted: 2 h c^2 and h c / k of CODATA 2018.
const C1 = 1.191042972e8, C2 = 1.438776877e4;  // W m-2 sr-1 um4; um K
export const hasKelvin = run => run.unit === "W m-2 sr-1 um-1" && run.channels.some(c => c.um > 2.5);
export const kelvin = (um, l) => l > 0 && um > 0 ? C2 / (um * Math.log1p(C1 / (um ** 5 * l))) : NaN;

// Seven hues that are told apart by those who miss red or green (Okabe and Ito), dark enough for lines.
export const hues = ["#d55e00", "#7a4fbf", "#b8860b", "#cc79a7", "#0072b2", "#009e73", "#56b4e9"];

// Hues a golden angle apart, as those of classes.
export function distinct(k) {
  const h = (k * 137.508) % 360, l = 0.42 + 0.1 * (k % 3), a = 0.65 * Math.min(l, 1 - l);
  return [0, 8, 4].map(n => {
    const t = (n + h / 30) % 12;
    return Math.round(255 * (l - a * Math.max(-1, Math.min(t - 3, 9 - t, 1))));
  });
}

// A canvas as large as it is shown, and its context in CSS pixels.
export function fit(canvas) {
  const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
  if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, w, h);
  context.imageSmoothingEnabled = false;
  return {context, w, h};
}

export function inside(x, y, corners) {
  let is = false;
  for (let i = 0, j = corners.length - 1; i < corners.length; j = i++) {
    const [xi, yi] = corners[i], [xj, yj] = corners[j];
    if (yi > y !== yj > y && x < (xj - xi) * (y - yi) / (yj - yi) + xi) is = !is;
  }
  return is;
}

export function colourBar(svg, range, map, label) {
  svg.replaceChildren();
  const w = svg.clientWidth || 480;
  svg.setAttribute("viewBox", `0 0 ${w} 46`);
  const id = svg.id + "-gradient", gradient = draw(draw(svg, "defs", {}), "linearGradient", {id});
  for (let k = 0; k <= 32; ++k) {
    const c = 3 * Math.round(255 * k / 32);
    draw(gradient, "stop", {offset: k / 32, "stop-color": `rgb(${map[c]},${map[c + 1]},${map[c + 2]})`});
  }
  draw(svg, "rect", {x: 0, y: 2, width: w, height: 11, fill: `url(#${id})`});
  const marks = ticks(range[0], range[1], 6), texts = tickTexts(marks);
  for (const [k, t] of marks.entries()) {
    const x = w * (t - range[0]) / (range[1] - range[0]);
    draw(svg, "line", {x1: x, x2: x, y1: 13, y2: 17, class: "axis"});
    draw(svg, "text", {x, y: 28, "text-anchor": x < 14 ? "start" : x > w - 14 ? "end" : "middle"}, texts[k]);
  }
  draw(svg, "text", {x: 0, y: 42}, label);
}

export function save(name, text) {
  const link = make("a", {download: name, href: URL.createObjectURL(new Blob([text], {type: "text/csv"}))});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Calls once things have come to rest.
export function later(wait, what) {
  let timer = 0;
  return () => { clearTimeout(timer); timer = setTimeout(what, wait); };
}
