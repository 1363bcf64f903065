#include "studies/aliasing_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/format.h"
#include "studies/common/html_page.h"
#include "studies/common/report_plot.h"

namespace ifov::studies {

namespace {

ImagePanel panel(const std::string& title, std::vector<double> values, double low, double high,
                 const std::string& unit, bool heat = false) {
  return {title, ChartScene::kWidth_px, ChartScene::kWidth_px, std::move(values), low, high, unit, heat};
}

std::vector<double> first_chart(const std::vector<double>& values) {
  return {values.begin(), values.begin() + ChartScene::kWidth_px * ChartScene::kWidth_px};
}

std::string panels(const ChartResult& result, const std::string& name, ReportFigures& figures) {
  std::vector<double> radiance(result.image->mean().begin(), result.image->mean().end());
  std::vector<double> samples(result.image->samples().begin(), result.image->samples().end());
  std::vector<double> error = first_chart(result.error);
  for (double& e : error) e = std::abs(e);
  // A few hard pixels must not hide where the other samples went.
  std::vector<double> sorted = samples;
  std::sort(sorted.begin(), sorted.end());
  const double most = sorted[static_cast<std::size_t>(0.995 * static_cast<double>(sorted.size()))];
  const double brightest = *std::max_element(radiance.begin(), radiance.end());
  return "<div class=\"row\">" +
         figures.add(panel(name, std::move(radiance), 0.0, brightest, "W m⁻² sr⁻¹ µm⁻¹")) +
         figures.add(panel("samples per pixel: " + name, std::move(samples), 0.0, most, "")) +
         figures.add(panel("error: " + name, std::move(error), 0.0, 0.05, "of the contrast", true)) +
         "</div>\n";
}

std::string error_plot(const AliasingResults& r, ReportFigures& figures) {
  Plot plot;
  plot.title = "Error against cost";
  plot.x_label = "samples per pixel";
  plot.y_label = "RMS error, in units of the contrast";
  plot.x_log = plot.y_log = true;
  PlotSeries grid{"grid", "#888", {}, {}, true}, adaptive{"adaptive", "#c2571a", {}, {}, true},
      accuracy{"accuracy", "#0b6fb8", {}, {}, true};
  for (const ChartResult& c : r.results) {
    PlotSeries& series = c.name.starts_with("accuracy")   ? accuracy
                         : c.name.starts_with("adaptive") ? adaptive
                                                          : grid;
    series.x.push_back(c.samples_per_px);
    series.y.push_back(c.rms);
  }
  plot.series = {grid, adaptive, accuracy};
  return figures.add(plot);
}

std::string table(const AliasingResults& r) {
  std::string rows;
  const ChartResult& ten = r.results[1];
  for (const ChartResult& c : r.results)
    rows += format(
        "<tr><td>{}</td><td class=\"n\">{:.2f}</td><td class=\"n\">{:.1f}</td><td class=\"n\">{:.5f}</td><td "
        "class=\"n\">{:.2f}</td><td class=\"n\">{:.4f}</td><td class=\"n\">{:.3f}</td><td "
        "class=\"n\">{}</td><td "
        "class=\"n\">{:.3f}</td><td class=\"n\">{:.1f}</td></tr>\n",
        html_text(c.name), c.samples_per_px, ten.samples_per_px / c.samples_per_px, c.rms, c.rms / ten.rms,
        c.error_99, c.worst, c.coverage > 0.0 ? format("{:.3f}", c.coverage) : "-", c.seconds,
        ten.seconds / c.seconds);
  return "<table><tr><th>sampling</th><th>samples per pixel</th><th>times fewer than 10 x 10</th><th>RMS "
         "error</th><th>over "
         "10 x 10</th><th>99 % below</th><th>worst</th><th>intervals that hold, mixed "
         "pixels</th><th>seconds</th><th>times "
         "faster than 10 x 10</th></tr>\n" +
         rows + "</table>\n";
}

}  // namespace

std::string aliasing_report(const AliasingResults& r, ReportFigures& figures) {
  const ChartResult& best = r.results[r.chosen];
  std::vector<double> white;
  for (double black : r.black_fraction) white.push_back(1.0 - black);
  const std::string body =
      "<p>A USAF-1951 chart, black on white, turned against the pixels so that no line falls in step with "
      "them. Its bars "
      "go from 2.6 pixels down to a twentieth of one. The exact answer of every pixel is known from the "
      "chart's outlines; "
      "errors are in units of the contrast between black and white, over all pixels.</p>\n" +
      r.figures.html() + "<h2>Images (figure 9 of the paper)</h2>\n" +
      figures.add(panel("exact", std::move(white), 0.0, 1.0, "share of white")) +
      panels(r.results[0], "(a) one ray a pixel", figures) +
      panels(r.results[1], "(b) grid, 100 rays a pixel", figures) +
      panels(r.results[2], "(c, d) adaptive, 9 to 100 samples", figures) + panels(best, best.name, figures) +
      "<h2>Cost and error</h2>\n<figure>" + error_plot(r, figures) +
      "<figcaption>One point for each way of sampling; lower and further left is "
      "better.</figcaption></figure>\n" +
      table(r);
  return html_page("Sampling and aliasing", body);
}

}  // namespace ifov::studies
