#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "geodesy/utc_time.h"
#include "io/figures/axes.h"
#include "io/figures/palette.h"
#include "io/figures/words.h"
#include "io/temperature_report/temperature_report.h"

namespace ifov::io {
namespace {

constexpr double kZero_k = 273.15, kSheetWidth = 980.0, kLeftEdge = 74.0, kWide = 880.0, kHigh = 420.0;
constexpr double kNoteLine = 18.0, kNoteSize = 13.0, kKeyLine = 18.0;

Axis degrees_axis(const TemperatureReport& report) {
  double low = 1e9, high = -1e9;
  const auto add = [&](const std::vector<double>& values) {
    for (const double value : values) {
      low = std::min(low, value - kZero_k);
      high = std::max(high, value - kZero_k);
    }
  };
  add(report.air_k);
  for (const TemperatureReport::Material& material : report.materials) {
    add(material.sunlit.surface_k);
    add(material.shaded.surface_k);
    if (material.here) add(material.here->day.surface_k);
  }
  const double margin = std::max(1.0, 0.04 * (high - low));
  return {std::floor(low - margin), std::ceil(high + margin), false};
}

Curve curve_over_day(const TemperatureReport& report, const std::vector<double>& kelvins, const Ink& ink,
                     bool dashed, double width) {
  Curve curve{{}, ink, dashed, {}, width};
  const double begin_s = std::floor(report.time_s.front() / 86400.0) * 86400.0;
  for (std::size_t i = 0; i < kelvins.size(); ++i)
    curve.points.push_back({(report.time_s[i] - begin_s) / 3600.0, kelvins[i] - kZero_k});
  return curve;
}

}  // namespace

std::string temperature_figure(const TemperatureReport& report) {
  std::vector<std::string> lines;
  const Canvas measure(1.0, 1.0);
  for (const std::string& note : report.notes)
    for (const std::string& part : wrapped(measure, note, kNoteSize, kWide)) lines.push_back(part);
  const double top = 30.0 + kNoteLine * static_cast<double>(lines.size()) + 24.0;
  const double legend = top + kHigh + 66.0;
  const std::size_t rows = (report.materials.size() + 2) / 2;
  Canvas canvas(kSheetWidth, legend + kKeyLine * static_cast<double>(rows) + 14.0);
  canvas.text({kLeftEdge, 30.0}, "Surface temperatures: " + report.document, 17.0, Anchor::left, true);
  for (std::size_t k = 0; k < lines.size(); ++k)
    canvas.text({kLeftEdge, 30.0 + kNoteLine * static_cast<double>(k + 1)}, lines[k], kNoteSize);

  const double begin_s = std::floor(report.time_s.front() / 86400.0) * 86400.0;
  const std::string date = geodesy::format_utc({2440587.5, begin_s / 86400.0}).substr(0, 10);
  const bool is_point = !report.materials.empty() && report.materials.front().here.has_value();
  const Plot plot{
      .x = kLeftEdge,
      .y = top,
      .width = kWide,
      .height = kHigh,
      .across = {(report.time_s.front() - begin_s) / 3600.0, (report.time_s.back() - begin_s) / 3600.0},
      .up = degrees_axis(report),
      .label = "Surface temperature (\u00b0C)",
      .label_across = format("Hours of UTC after 0 h on {}; {}solid: in the Sun, dashed: in the shade", date,
                             is_point ? "thick: the point; thin " : "")};
  std::vector<double> ticks;
  for (double hour = std::ceil(plot.across.first / 3.0) * 3.0; hour <= plot.across.last + 1e-9; hour += 3.0)
    ticks.push_back(hour);
  draw_axes(canvas, plot, ticks, true);
  std::vector<Curve> curves{curve_over_day(report, report.air_k, kGreyInk, false, 1.0)};
  for (std::size_t k = 0; k < report.materials.size(); ++k) {
    curves.push_back(curve_over_day(report, report.materials[k].shaded.surface_k, curve_ink(k), true, 1.2));
    const auto& here = report.materials[k].here;
    curves.push_back(
        curve_over_day(report, report.materials[k].sunlit.surface_k, curve_ink(k), false, here ? 1.2 : 1.8));
    if (here) curves.push_back(curve_over_day(report, here->day.surface_k, kBlackInk, false, 2.4));
  }
  draw_lines(canvas, plot, curves);
  for (std::size_t k = 0; k <= report.materials.size(); ++k) {
    const bool is_air = k == report.materials.size();
    const double x = kLeftEdge + (k % 2 == 0 ? 0.0 : 0.5 * kWide),
                 y = legend + kKeyLine * static_cast<double>(k / 2);
    canvas.line(std::vector<CanvasPoint>{{x, y - 4.5}, {x + 28.0, y - 4.5}}, is_air ? kGreyInk : curve_ink(k),
                1.8);
    canvas.text({x + 38.0, y},
                fitted(canvas, is_air ? "the air" : report.materials[k].name, kNoteSize, 0.5 * kWide - 50.0),
                kNoteSize);
  }
  return canvas.png();
}

}  // namespace ifov::io
