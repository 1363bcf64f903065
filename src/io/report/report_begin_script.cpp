#include "io/report/report_page.h"

namespace ifov::io {

const char* const kReportBeginScript = R"js(
  // A click chooses a pixel, a drag a region.
  let begun = null;
  const locate = event => {
    const r = $("image").getBoundingClientRect();
    return [Math.min(W - 1, Math.max(0, Math.floor((event.clientX - r.left) / r.width * W))),
      Math.min(H - 1, Math.max(0, Math.floor((event.clientY - r.top) / r.height * H)))];
  };
  const choose = ([x, y]) => {
    const [bx, by] = begun;
    if (x === bx && y === by) { state.x = x; state.y = y; state.region = null; }
    else state.region = {x0: Math.min(x, bx), y0: Math.min(y, by), x1: Math.max(x, bx) + 1, y1: Math.max(y, by) + 1};
    drawMark(); drawSpectrum();
  };
  $("image").addEventListener("mousedown", e => { begun = locate(e); choose(begun); e.preventDefault(); });
  $("image").addEventListener("mousemove", e => { if (begun && e.buttons & 1) choose(locate(e)); });
  window.addEventListener("mouseup", e => { if (begun && e.target !== $("image")) choose(locate(e)); begun = null; });
  $("band").addEventListener("input", e => { state.band = +e.target.value; drawImage(); drawSpectrum(); });
  for (const b of document.querySelectorAll("#views button"))
    b.addEventListener("click", () => { state.view = b.dataset.view; drawImage(); });

  $("band").value = state.band;
  const asked = /^#region=(\d+),(\d+),(\d+),(\d+)$/.exec(location.hash);
  if (asked) {
    const [x0, y0, x1, y1] = asked.slice(1).map(v => Math.floor(v / meta.step));
    if (x0 < x1 && y0 < y1 && x1 <= W && y1 <= H) state.region = {x0, y0, x1, y1};
  }
  drawImage();
  drawSpectrum();
  drawMap("map-samples", samples, 0, maps.seq, meta.histograms.samples.logarithmic ? "samples per pixel (logarithmic)" : "samples per pixel", meta.histograms.samples.logarithmic);
  drawMap("map-error", quality, 1, maps.heat, "half-width over limit", false);
  drawReasons();
  drawHistogram("hist-samples", meta.histograms.samples, "samples per pixel");
  drawHistogram("hist-error", meta.histograms.error, "half-width over limit", 1);
  document.body.dataset.ready = "yes";
})();
)js";

}  // namespace ifov::io
