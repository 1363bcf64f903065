#include "session/temperatures/reported_day.h"

#include <cmath>

#include "session/solved/document_outdoors.h"
#include "thermal/outdoors_series.h"
#include "thermal/surface_solution.h"

namespace ifov::session {
namespace {

std::size_t first_shown(const thermal::OutdoorsSeries& series) {
  return series.rows.size() - 1 - static_cast<std::size_t>(std::round(thermal::kShownDay_s / series.step_s));
}

double time_of_s(const thermal::OutdoorsSeries& series, std::size_t row) {
  return series.begin_s + static_cast<double>(row) * series.step_s;
}

}  // namespace

io::TemperatureReport report_about(const std::string& document, const DocumentOutdoors& about) {
  const thermal::OutdoorsSeries& series = about.outdoors.series;
  io::TemperatureReport report;
  report.document = document;
  report.notes.push_back(about.statement);
  report.notes.insert(report.notes.end(), about.outdoors.notes.begin(), about.outdoors.notes.end());
  for (std::size_t row = first_shown(series); row < series.rows.size(); ++row) {
    report.time_s.push_back(time_of_s(series, row));
    report.air_k.push_back(series.rows[row].air.temperature_k);
  }
  return report;
}

io::TemperatureReport::Day day_of(const thermal::SurfaceSolution& solution, const DocumentOutdoors& about) {
  const thermal::OutdoorsSeries& series = about.outdoors.series;
  io::TemperatureReport::Day day;
  for (std::size_t row = first_shown(series); row < series.rows.size(); ++row) {
    day.surface_k.push_back(solution.surface_k(row));
    day.fluxes.push_back(solution.balance.fluxes(time_of_s(series, row), day.surface_k.back()));
  }
  return day;
}

double unaccounted_of(const thermal::SurfaceSolution& solution) {
  const thermal::Fluxes& mean = solution.mean;
  const double all_s = solution.history.nodes.back().time_s - solution.history.nodes.front().time_s;
  const double in = mean.sun + mean.sky + mean.reflected + mean.sky_longwave + mean.ground_longwave;
  return (mean.sum() - (solution.history.out_of_back_j_m2 + solution.history.stored_j_m2) / all_s) / in;
}

}  // namespace ifov::session
