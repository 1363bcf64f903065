#include "studies/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/format.h"
#include "studies/figures.h"
#include "studies/html_page.h"

namespace ifov::studies {

namespace {

constexpr double kWidth = 640, kHeight = 400, kLeft = 70, kRight = 15, kTop = 30, kBottom = 50;

/// One axis: data to picture coordinates, and where its ticks are.
struct Axis {
  bool logarithmic;
  double low, high, from, to;

  double scaled(double v) const { return logarithmic ? std::log10(v) : v; }
  double at(double v) const {
    const double share = (scaled(v) - scaled(low)) / (scaled(high) - scaled(low));
    return from + share * (to - from);
  }
  bool shows(double v) const { return std::isfinite(v) && (!logarithmic || v > 0.0); }

  std::vector<double> ticks() const {
    std::vector<double> out;
    if (logarithmic) {
      for (int e = static_cast<int>(std::ceil(std::log10(low) - 1e-9)); e <= std::log10(high) + 1e-9; ++e)
        out.push_back(std::pow(10.0, e));
      return out;
    }
    const double raw = (high - low) / 6.0, magnitude = std::pow(10.0, std::floor(std::log10(raw)));
    const double step = magnitude * (raw / magnitude > 5   ? 10
                                     : raw / magnitude > 2 ? 5
                                     : raw / magnitude > 1 ? 2
                                                           : 1);
    for (double k = std::ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) out.push_back(k * step + 0.0);  // no -0
    return out;
  }
};

Axis axis_of(bool logarithmic, double low, double high, double from, double to) {
  if (!(low < high)) high = low + 1.0;
  return {logarithmic, low, high, from, to};
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double v, bool logarithmic) {
    if (!std::isfinite(v) || (logarithmic && !(v > 0.0))) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

}  // namespace

std::string svg_plot(const Plot& plot) {
  Extent x, y;
  for (const PlotSeries& s : plot.series) {
    for (double v : s.x) x.add(v, plot.x_log);
    for (double v : s.y) y.add(v, plot.y_log);
  }
  for (const PlotLevel& level : plot.levels) y.add(level.value, plot.y_log);
  // Room for dots at the edges.
  if (!plot.x_log && std::any_of(plot.series.begin(), plot.series.end(), [](const auto& s) { return s.markers_only; })) {
    const double room = 0.02 * (x.high - x.low);
    x.low -= room;
    x.high += room;
  }
  if (plot.y_low < plot.y_high) y = {plot.y_low, plot.y_high};
  const Axis across = axis_of(plot.x_log, x.low, x.high, kLeft, kWidth - kRight);
  const Axis up = axis_of(plot.y_log, y.low, y.high, kHeight - kBottom, kTop);

  std::string out = format(
      "<svg viewBox=\"0 0 {} {}\" width=\"{}\" font-family=\"sans-serif\" font-size=\"12\" role=\"img\">\n"
      "<title>{}</title><text x=\"{}\" y=\"18\" font-size=\"14\">{}</text>\n"
      "<clipPath id=\"in\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
      kWidth, kHeight, kWidth, html_text(plot.title), kLeft, html_text(plot.title), kLeft, kTop,
      kWidth - kLeft - kRight, kHeight - kTop - kBottom);
  for (double v : across.ticks())
    out += format(
        "<path d=\"M{:.1f} {}V{}\" stroke=\"#ddd\"/><text x=\"{:.1f}\" y=\"{}\" "
        "text-anchor=\"middle\">{}</text>\n",
        across.at(v), kTop, kHeight - kBottom, across.at(v), kHeight - kBottom + 16, number_text(v));
  for (double v : up.ticks())
    out += format(
        "<path d=\"M{} {:.1f}H{}\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{:.1f}\" "
        "text-anchor=\"end\">{}</text>\n",
        kLeft, up.at(v), kWidth - kRight, kLeft - 6, up.at(v) + 4, number_text(v));
  out += "<g clip-path=\"url(#in)\">\n";
  for (const PlotLevel& level : plot.levels) {
    if (level.half_width > 0.0)
      out +=
          format("<rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\" opacity=\"0.2\"/>\n",
                 kLeft, up.at(level.value + level.half_width), kWidth - kLeft - kRight,
                 up.at(level.value - level.half_width) - up.at(level.value + level.half_width), level.colour);
    out += format("<path d=\"M{} {:.2f}H{}\" stroke=\"{}\" stroke-dasharray=\"5 3\"/>\n", kLeft,
                  up.at(level.value), kWidth - kRight, level.colour);
  }
  for (const PlotSeries& s : plot.series) {
    std::string path, dots;
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      if (!across.shows(s.x[k]) || !up.shows(s.y[k])) continue;
      path += format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", across.at(s.x[k]), up.at(s.y[k]));
      if (s.markers_only)
        dots += format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3\" fill=\"{}\"/>", across.at(s.x[k]),
                       up.at(s.y[k]), s.colour);
    }
    out += s.markers_only ? dots + "\n"
                          : format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
                                   path, s.colour);
  }
  out += "</g>\n";
  double row = kTop + 14;
  const auto legend = [&](const std::string& name, const std::string& colour) {
    if (name.empty()) return;
    out += format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"16\" fill=\"#fff\" opacity=\"0.8\"/>"
        "<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"4\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
        kWidth - 236, row - 12, 236 - kRight, kWidth - 230, row - 6, colour, kWidth - 210, row, html_text(name));
    row += 16;
  };
  for (const PlotSeries& s : plot.series) legend(s.name, s.colour);
  for (const PlotLevel& level : plot.levels) legend(level.name, level.colour);
  return out +
         format(
             "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n"
             "<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</svg>\n",
             0.5 * (kLeft + kWidth - kRight), kHeight - 12, html_text(plot.x_label),
             0.5 * (kTop + kHeight - kBottom), html_text(plot.y_label));
}

}  // namespace ifov::studies
