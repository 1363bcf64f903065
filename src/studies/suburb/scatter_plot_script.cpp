#include "studies/suburb/scatter_plot_script.h"

namespace ifov::studies {

const char* const kScatterPlotScript = R"js(
"use strict";
(() => {
  const $ = id => document.getElementById(id);
  const meta = JSON.parse($("scatter-meta").textContent), axes = meta.axes, size = 300;
  const bytes = id => Uint8Array.from(atob($(id).textContent.trim()), c => c.charCodeAt(0));
  const images = meta.images.map((name, k) => ({
    name,
    principal: new Uint16Array(bytes(`scatter-${k}-principal`).buffer),
    noise_fraction: new Uint16Array(bytes(`scatter-${k}-noise_fraction`).buffer),
    dominant: bytes(`scatter-${k}-dominant`),
  }));
  const panels = [...document.querySelectorAll(".scatter canvas")];
  for (const canvas of panels) canvas.width = canvas.height = size;
  const shown = [0, 1, 2, images.length - 1];

  const hues = meta.materials.map((_, k) => {
    const h = (k * 137.508) % 360, l = 0.38 + 0.12 * (k % 3), a = 0.62 * Math.min(l, 1 - l);
    return [0, 8, 4].map(n => {
      const t = (n + h / 30) % 12;
      return Math.round(255 * (l - a * Math.max(-1, Math.min(t - 3, 9 - t, 1))));
    });
  });
  const legend = $("scatter-legend");
  const used = new Set(images.flatMap(i => [...new Set(i.dominant)]));
  [...used].sort((a, b) => a - b).forEach(k => {
    const item = document.createElement("span");
    item.innerHTML = `<i style="background:rgb(${hues[k]})"></i>`;
    item.append(meta.materials[k]);
    legend.append(item);
  });

  // Rows of the turning matrix: what goes to the right, up and towards the eye.
  let turn = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], zoom = 1;
  const rotated = (a, b) => {  // about the picture's own vertical by a, then horizontal by b
    const [r, u, e] = turn, ca = Math.cos(a), sa = Math.sin(a), cb = Math.cos(b), sb = Math.sin(b);
    const mix = (p, q, s, t) => p.map((v, k) => s * v + t * q[k]);
    const r2 = mix(r, e, ca, sa), e2 = mix(e, r, ca, -sa);
    return [r2, mix(u, e2, cb, sb), mix(e2, u, cb, -sb)];
  };

  const count = new Uint32Array(size * size), depth = new Float32Array(size * size), who = new Uint8Array(size * size);
  function draw() {
    const transform = $("scatter-transform").value, chosen = [0, 1, 2].map(k => +$(`scatter-axis-${k}`).value);
    const material = $("scatter-colour").value === "material";
    legend.hidden = !material;
    panels.forEach((canvas, p) => {
      const image = images[shown[p]], data = image[transform], n = image.dominant.length;
      canvas.nextElementSibling.textContent = image.name;
      const context = canvas.getContext("2d"), picture = context.createImageData(size, size), out = picture.data;
      count.fill(0); depth.fill(-1e9);
      const scale = 0.62 * size * zoom / 65535;
      for (let i = 0; i < n; ++i) {
        const x = data[axes * i + chosen[0]] - 32768, y = data[axes * i + chosen[1]] - 32768, z = data[axes * i + chosen[2]] - 32768;
        const u = size / 2 + scale * (turn[0][0] * x + turn[0][1] * y + turn[0][2] * z) | 0;
        const v = size / 2 - scale * (turn[1][0] * x + turn[1][1] * y + turn[1][2] * z) | 0;
        if (u < 0 || v < 0 || u >= size || v >= size) continue;
        const to = v * size + u, near = turn[2][0] * x + turn[2][1] * y + turn[2][2] * z;
        ++count[to];
        if (near > depth[to]) { depth[to] = near; who[to] = image.dominant[i]; }
      }
      for (let k = 0; k < count.length; ++k) {
        out[4 * k] = out[4 * k + 1] = out[4 * k + 2] = 255; out[4 * k + 3] = 255;
        if (!count[k]) continue;
        if (material) { for (let c = 0; c < 3; ++c) out[4 * k + c] = hues[who[k]][c]; continue; }
        const s = Math.min(1, 0.35 + 0.2 * Math.log2(count[k]));
        out[4 * k] = 255 - 244 * s; out[4 * k + 1] = 255 - 190 * s; out[4 * k + 2] = 255 - 110 * s;
      }
      context.putImageData(picture, 0, 0);
      context.strokeStyle = "#999"; context.fillStyle = "#444"; context.font = "11px sans-serif";
      for (let k = 0; k < 3; ++k) {
        const e = [turn[0][k], turn[1][k]], l = 0.42 * size;
        context.beginPath(); context.moveTo(size / 2, size / 2);
        context.lineTo(size / 2 + l * e[0], size / 2 - l * e[1]); context.stroke();
        if (Math.hypot(...e) > 0.12)
          context.fillText(`${transform === "principal" ? "PC" : "MNF"} ${chosen[k] + 1}`, size / 2 + l * e[0] - 10, size / 2 - l * e[1] - 3);
      }
    });
  }

  let from = null, spinning = 0;
  for (const canvas of panels) {
    canvas.addEventListener("pointerdown", e => { from = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener("pointerup", () => { from = null; });
    canvas.addEventListener("pointermove", e => {
      if (!from) return;
      turn = rotated((e.clientX - from[0]) / 150, (from[1] - e.clientY) / 150);
      from = [e.clientX, e.clientY];
      draw();
    });
    canvas.addEventListener("wheel", e => { e.preventDefault(); zoom *= Math.exp(-e.deltaY / 600); draw(); }, {passive: false});
  }
  const spin = () => { if (!spinning) return; turn = rotated(0.012, 0.004); draw(); requestAnimationFrame(spin); };
  $("scatter-spin").addEventListener("click", () => { spinning ^= 1; $("scatter-spin").textContent = spinning ? "stop" : "turn"; spin(); });
  $("scatter-front").addEventListener("click", () => { turn = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]; zoom = 1; draw(); });
  for (const id of ["scatter-transform", "scatter-colour", "scatter-axis-0", "scatter-axis-1", "scatter-axis-2"])
    $(id).addEventListener("change", draw);
  const last = $("scatter-last");
  images.slice(3).forEach((image, k) => last.append(new Option(image.name, 3 + k, false, 3 + k === images.length - 1)));
  last.addEventListener("change", () => { shown[3] = +last.value; draw(); });
  draw();
})();
)js";

}  // namespace ifov::studies
