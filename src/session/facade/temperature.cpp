#include "ifov/temperature.h"

#include "core/call_scope.h"
#include "io/temperature_report/temperature_report.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/temperatures/temperature_survey.h"

namespace ifov {

struct TemperatureReport::Inside {
  io::TemperatureReport report;
};

void FacadeAccess::set(TemperatureReport& report, io::TemperatureReport inside) {
  report.inside_ =
      std::make_shared<const TemperatureReport::Inside>(TemperatureReport::Inside{std::move(inside)});
}

namespace {

TemperatureReport told(io::TemperatureReport found) {
  TemperatureReport report;
  report.notes = found.notes;
  report.time_s = found.time_s;
  report.air_k = found.air_k;
  for (const io::TemperatureReport::Material& material : found.materials)
    report.materials.push_back({material.name, material.sunlit.surface_k, material.shaded.surface_k,
                                material.unaccounted,
                                material.here ? material.here->day.surface_k : std::vector<double>()});
  for (const io::TemperatureReport::Crossover& one : found.crossovers)
    report.crossovers.push_back({one.time_s, one.warmer, one.cooler});
  FacadeAccess::set(report, std::move(found));
  return report;
}

}  // namespace

TemperatureReport survey_temperatures(const Document& document, const TemperatureQuestion& question) {
  const auto& source = FacadeAccess::inside(document);
  const Call call{source.inputs, nullptr};
  const CallScope scope(call);
  return told(session::survey_temperatures(source.document, question));
}

TemperatureReport point_temperature(const Document& document, const PointQuestion& question) {
  const auto& source = FacadeAccess::inside(document);
  const Call call{source.inputs, nullptr};
  const CallScope scope(call);
  return told(session::point_temperature(source.document, question));
}

std::string TemperatureReport::table() const { return io::temperature_text(inside_->report); }

std::string TemperatureReport::csv() const { return io::temperature_csv(inside_->report); }

std::string TemperatureReport::figure() const { return io::temperature_figure(inside_->report); }

}  // namespace ifov
