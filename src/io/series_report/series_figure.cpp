#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "geodesy/utc_time.h"
#include "io/figures/axes.h"
#include "io/figures/palette.h"
#include "io/figures/words.h"
#include "io/series_report/series_report.h"

namespace ifov::io {
namespace {

constexpr double kSheet = 980.0, kEdge = 74.0, kAcross = 880.0, kUp = 420.0, kLineOfWords = 18.0,
                 kWords = 13.0;
constexpr std::size_t kMostCrossings = 24;
constexpr Ink kNightInk{0.93, 0.93, 0.95};

Axis kelvins_axis(const SeriesReport& report) {
  double low = 1e9, high = -1e9;
  for (const SeriesReport::Material& material : report.materials)
    for (const double value : report.told(material).mean_k)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  const double margin = std::max(1.0, 0.05 * (high - low));
  return {std::floor(low - margin), std::ceil(high + margin), false};
}

/// Round hours, so many that their numbers find room.
std::vector<double> hour_ticks(const Axis& hours) {
  constexpr double kSteps[] = {0.25, 0.5, 1.0, 2.0, 3.0, 6.0, 12.0, 24.0, 48.0, 120.0, 240.0};
  const double* step = std::find_if(std::begin(kSteps), std::end(kSteps) - 1,
                                    [&](double s) { return (hours.last - hours.first) / s <= 12.0; });
  std::vector<double> ticks;
  for (double hour = std::ceil(hours.first / *step) * *step; hour <= hours.last + 1e-9; hour += *step)
    ticks.push_back(hour);
  return ticks;
}

std::string minute_of(double time_s) {
  return geodesy::format_utc({2440587.5, std::round(time_s / 60.0) * 60.0 / 86400.0}).substr(5, 11);
}

std::vector<std::string> crossing_lines(const SeriesReport& report) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < std::min(report.crossovers.size(), kMostCrossings); ++k) {
    const SeriesReport::Crossover& one = report.crossovers[k];
    std::string minute = minute_of(one.time_s);
    minute[5] = ' ';
    lines.push_back(format("{}{}: {} becomes warmer than {}", minute, one.when.empty() ? "" : ", " + one.when,
                           report.materials[one.warmer].name, report.materials[one.cooler].name));
  }
  if (report.crossovers.size() > kMostCrossings)
    lines.push_back(format("and {} more", report.crossovers.size() - kMostCrossings));
  if (lines.empty()) lines.push_back("No crossovers");
  return lines;
}

/// Where a curve stands between two of its times.
double value_at(const SeriesReport& report, const std::vector<double>& kelvins, double time_s) {
  for (std::size_t t = 1; t < kelvins.size(); ++t)
    if (report.time_s[t] >= time_s) {
      const double share = (time_s - report.time_s[t - 1]) / (report.time_s[t] - report.time_s[t - 1]);
      return kelvins[t - 1] + share * (kelvins[t] - kelvins[t - 1]);
    }
  return kelvins.back();
}

}  // namespace

std::string series_figure(const SeriesReport& report) {
  std::vector<std::string> lines;
  const Canvas measure(1.0, 1.0);
  for (const std::string& note : report.notes)
    for (const std::string& part : wrapped(measure, note, kWords, kAcross)) lines.push_back(part);
  const std::vector<std::string> crossings = crossing_lines(report);
  const double top = 30.0 + kLineOfWords * static_cast<double>(lines.size()) + 24.0;
  const double legend = top + kUp + 66.0;
  const std::size_t key_rows = (report.materials.size() + 1) / 2, crossing_rows = (crossings.size() + 1) / 2;
  const double below = legend + kLineOfWords * static_cast<double>(key_rows) + 12.0;
  Canvas canvas(kSheet, below + kLineOfWords * static_cast<double>(crossing_rows) + 14.0);
  canvas.text({kEdge, 30.0}, fitted(canvas, "Materials over time: " + report.document, 17.0, kAcross), 17.0,
              Anchor::left, true);
  for (std::size_t k = 0; k < lines.size(); ++k)
    canvas.text({kEdge, 30.0 + kLineOfWords * static_cast<double>(k + 1)}, lines[k], kWords);

  const double begin_s = std::floor(report.time_s.front() / 86400.0) * 86400.0;
  const auto hour_of = [&](double time_s) { return (time_s - begin_s) / 3600.0; };
  const Plot plot{.x = kEdge,
                  .y = top,
                  .width = kAcross,
                  .height = kUp,
                  .across = {hour_of(report.time_s.front()), hour_of(report.time_s.back())},
                  .up = kelvins_axis(report),
                  .label = report.tells_surface ? "Surface temperature (K)" : "Brightness temperature (K)",
                  .label_across = format("Hours of UTC after 0 h on {}{}",
                                         geodesy::format_utc({2440587.5, begin_s / 86400.0}).substr(0, 10),
                                         report.nights.empty() ? "" : "; grey: the Sun is down")};
  for (const SeriesReport::Night& night : report.nights)
    canvas.fill_rectangle(plot.to_x(hour_of(night.begin_s)), plot.y,
                          plot.to_x(hour_of(night.end_s)) - plot.to_x(hour_of(night.begin_s)), plot.height,
                          kNightInk);
  draw_axes(canvas, plot, hour_ticks(plot.across), true);
  std::vector<Curve> curves;
  for (std::size_t k = 0; k < report.materials.size(); ++k) {
    Curve curve{{}, curve_ink(k), false, {}, 1.8};
    const std::vector<double>& values = report.told(report.materials[k]).mean_k;
    for (std::size_t t = 0; t < values.size(); ++t)
      if (std::isfinite(values[t])) curve.points.push_back({hour_of(report.time_s[t]), values[t]});
    curves.push_back(std::move(curve));
  }
  draw_lines(canvas, plot, curves);
  for (const SeriesReport::Crossover& one : report.crossovers) {
    const double kelvin = value_at(report, report.told(report.materials[one.warmer]).mean_k, one.time_s);
    if (std::isfinite(kelvin))
      canvas.circle({plot.to_x(hour_of(one.time_s)), plot.to_y(kelvin)}, 4.5, kBlackInk, 1.2);
  }
  const auto place = [&](std::size_t k, double from) {
    return CanvasPoint{kEdge + (k % 2 == 0 ? 0.0 : 0.5 * kAcross),
                       from + kLineOfWords * static_cast<double>(k / 2)};
  };
  for (std::size_t k = 0; k < report.materials.size(); ++k) {
    const auto [x, y] = place(k, legend);
    canvas.line(std::vector<CanvasPoint>{{x, y - 4.5}, {x + 28.0, y - 4.5}}, curve_ink(k), 1.8);
    canvas.text({x + 38.0, y}, fitted(canvas, report.materials[k].name, kWords, 0.5 * kAcross - 50.0),
                kWords);
  }
  for (std::size_t k = 0; k < crossings.size(); ++k)
    canvas.text(place(k, below), fitted(canvas, crossings[k], kWords, 0.5 * kAcross - 12.0), kWords);
  return canvas.png();
}

}  // namespace ifov::io
