#include "io/report/report_page.h"

namespace ifov::io {

const char* const kReportQualityScript = R"js(
  // Why pixels are not converged: sets of bits, one for each of meta.reasons.
  const bitsOf = i => reasons ? Math.round(reasons.value(0, i)) : 0;
  const wordsOf = bits => meta.reasons.filter((_, r) => bits >> r & 1).map(r => r.words).join("; ");
  function verdict(i) {
    if (quality.value(0, i) > 0.5) return "converged";
    const why = wordsOf(bitsOf(i));
    return "not converged" + (why ? ": " + why : "");
  }
  // What the spectrum is of: the pixel that was clicked, or the mean over the region that was dragged. The interval of a
  // mean is that of sampling/means/region_interval.h.
  function airWidth(b, l) {
    const a = meta.channels[b].air, own = a ? Math.max(0, l - a.path_radiance) : 0;
    if (!a) return 0;
    const m = a.model, ground = m ? m.surface * own : 0, sky = Math.min(own, a.white_in_sky);
    const model = m ? Math.max(Math.abs(ground + m.emission), (ground + Math.abs(m.emission)) / 4) + m.sunlight * own +
      m.path + m.sky * sky : 0;
    return a.path + a.surface * own + a.sky * sky + model;
  }
  function pixelLooked() {
    const i = state.y * W + state.x;
    let more = samples ? `; ${Math.round(samples.value(0, i))} samples` : "";
    if (quality && meta.judged) more += "; " + verdict(i);
    return {name: `Pixel (${state.x * meta.step}, ${state.y * meta.step})`, more,
      channel: b => ({y: radiance.value(b, i), e: width ? width.value(b, i) : NaN})};
  }
  function regionLooked() {
    const r = state.region, pixels = [];
    for (let y = r.y0; y < r.y1; ++y) for (let x = r.x0; x < r.x1; ++x) pixels.push(y * W + x);
    const channel = b => {
      let n = 0, sum = 0, widths = 0, squares = 0, common = 0, air = 0;
      for (const i of pixels) {
        const l = radiance.value(b, i);
        if (!isFinite(l)) continue;
        const h = width ? width.value(b, i) : NaN, a = Math.min(airWidth(b, l), h), own = h - a;
        const s = quality ? quality.value(3, i) : 1;
        ++n; sum += l; widths += own; squares += own * own; air += a;
        common += own * (meta.region.commonBorders * Math.sqrt(s) + meta.region.commonPaths * Math.sqrt(Math.max(0, 1 - s)));
      }
      const own = Math.min(widths, Math.sqrt(meta.region.shared * squares) + common);
      return {y: sum / n, e: meta.step > 1 ? NaN : (own + air) / n};
    };
    const at = [r.x0, r.y0, r.x1, r.y1].map(v => v * meta.step);
    let more = "";
    if (quality && meta.judged) {
      const missed = pixels.filter(i => !(quality.value(0, i) > 0.5));
      const counts = meta.reasons.map((reason, k) => ({reason, n: missed.filter(i => bitsOf(i) >> k & 1).length}))
        .filter(c => c.n > 0).sort((a, b) => b.n - a.n);
      more += missed.length ? `; ${missed.length} pixels not converged (${brief(100 * missed.length / pixels.length)} %): ` +
        counts.map(c => `${c.reason.words} (${c.n})`).join("; ") : "; all converged";
    }
    if (meta.step > 1) more += `; of the pixels shown: 'ifov info --region ${at.join(",")}' takes all, and knows the interval`;
    return {name: `Mean of ${pixels.length} pixels, region ${at.join(",")}`, more, channel};
  }
  const looked = () => state.region ? regionLooked() : pixelLooked();

  function drawReasons() {
    const canvas = $("map-reasons");
    if (!reasons || !canvas) return;
    canvas.width = W; canvas.height = H;
    const context = canvas.getContext("2d"), picture = context.createImageData(W, H), out = picture.data;
    for (let i = 0; i < N; ++i) {
      const bits = bitsOf(i), gravest = meta.gravity.find(r => bits >> r & 1);
      const colour = gravest === undefined ? meta.convergedColour : meta.reasons[gravest].colour;
      out.set([...colour, 255], 4 * i);
    }
    context.putImageData(picture, 0, 0);
  }
)js";

}  // namespace ifov::io
