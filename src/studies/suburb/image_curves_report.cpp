#include "studies/suburb/image_curves_report.h"

#include <cmath>

#include "core/format.h"
#include "studies/common/html_page.h"
#include "studies/common/report_plot.h"
#include "studies/suburb/image_curves.h"

namespace ifov::studies {

namespace {

std::string number(const OverSeeds& value) {
  return std::isfinite(value.standard_error) ? format("{:.3f} ± {:.3f}", value.mean, value.standard_error)
                                             : format("{:.3f}", value.mean);
}

std::string row(const CurvePoint& p) {
  const std::string stated = std::isfinite(p.stated_low)
                                 ? format("{:.2f} to {:.2f}", p.stated_low, p.stated_high)
                                 : std::string("-");
  const std::string coverage = std::isfinite(p.coverage) ? format("{:.3f}", p.coverage) : std::string("-");
  return format(
      "<tr><td>{}</td><td class=\"n\">{:.1f}</td><td class=\"n\">{:.0f}</td><td class=\"n\">{:.2f}</td><td "
      "class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
      "class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
      html_text(p.name), p.samples_per_px, p.rays_per_px, p.seconds, number(p.mean_band),
      number(p.worst_band), number(p.tail_99), number(p.tail_999), stated, coverage);
}

std::string curve_plot(const ImageCurves& curves, ReportFigures& figures) {
  Plot plot;
  plot.title = "Time over error of the image";
  plot.x_label = "RMS error over that of the grid 10 x 10";
  plot.y_label = "processor time, s";
  plot.x_log = plot.y_log = true;
  const auto add = [&](const char* name, const char* colour, const std::vector<CurvePoint>& points,
                       OverSeeds CurvePoint::*error) {
    PlotSeries series{name, colour, {}, {}};
    for (const CurvePoint& p : points) {
      series.x.push_back((p.*error).mean);
      series.y.push_back(p.seconds);
    }
    plot.series.push_back(series);
  };
  add("grids, mean band", "#333", curves.grids, &CurvePoint::mean_band);
  add("grids, worst band", "#999", curves.grids, &CurvePoint::worst_band);
  add("of the image, mean band", "#0b6fb8", curves.ours, &CurvePoint::mean_band);
  add("of the image, worst band", "#7fb8e0", curves.ours, &CurvePoint::worst_band);
  return figures.add(plot);
}

}  // namespace

std::string image_curves_report(const ImageCurves& curves, ReportFigures& figures) {
  std::string rows;
  for (const auto* list : {&curves.grids, &curves.ours})
    for (const CurvePoint& p : *list) rows += row(p);
  rows += row(curves.audited_grid) + row(curves.audited_ours);
  std::string text =
      "<h2>Time over error, of the image as a whole</h2>\n<figure>" + curve_plot(curves, figures) +
      "</figure>\n<table><tr><th>sampling</th><th>samples per pixel</th><th>rays per pixel</th><th>processor time, s</th>"
      "<th>RMS error, mean band</th><th>worst band</th><th>|error| of 99 % of pixels</th><th>of 99.9 %</th>"
      "<th>stated over true RMS, by channel</th><th>half-widths hold</th></tr>\n" +
      rows + "</table>\n";
  text += format(
      "<p>Errors are over the RMS error of the grid 10 x 10 in the same channel: the root of the mean squared ratio over the channels, "
      "the ratio in the worst of them, and what |error| stays below in a share of the pixels, mean over the channels. "
      "{} seed{}: means and their standard errors, and the least processor time. Limits of the image's error are shares of "
      "the RMS error of the grid 10 x 10 in every channel. The reference's own error is about {:.2f} of that, and is part of all "
      "numbers. Who wants to know the error of a grid audits it, too: the last two rows are the pair to compare then.</p>\n",
      curves.seeds, curves.seeds == 1 ? "" : "s", curves.reference_error);
  if (std::isfinite(curves.instrument.seconds))
    text += format(
        "<p>An RMS error within the noise that MODIS was required to have in its bands of the land, between them by straight lines, took "
        "{:.1f} s of processor time; in the channel that has most of it, {:.2f} of the noise is stated.</p>\n",
        curves.instrument.seconds, curves.instrument_stated);
  return text;
}

}  // namespace ifov::studies
