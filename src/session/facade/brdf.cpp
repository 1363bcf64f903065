#include "ifov/brdf.h"

#include "core/call_scope.h"
#include "io/brdf_report/brdf_report.h"
#include "io/document/reading/scattering_models.h"
#include "io/document/schema/schema_type.h"
#include "io/files/inputs.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/surveys/brdf_survey.h"

namespace ifov {

struct BrdfReport::Inside {
  io::BrdfReport report;
};

void FacadeAccess::set(BrdfReport& report, io::BrdfReport inside) {
  report.inside_ = std::make_shared<const BrdfReport::Inside>(BrdfReport::Inside{std::move(inside)});
}

namespace {

BrdfReport report_of(io::BrdfReport found) {
  BrdfReport report;
  report.name = found.name;
  report.model = found.model;
  report.description = found.description;
  report.wavelength_um = found.wavelength_um;
  report.is_delta = found.is_delta;
  report.view_rad = found.view_rad;
  for (const io::BrdfReport::Lobe& lobe : found.lobes) report.lobes.push_back({lobe.light_rad, lobe.brdf});
  report.zenith_rad = found.zenith_rad;
  report.by_angle = {found.reflectance, found.transmittance, found.emissivity};
  report.spectrum_um = found.spectrum_um;
  for (const io::BrdfReport::Spectrum& spectrum : found.spectra)
    report.spectra.push_back(
        {{spectrum.reflectance, spectrum.transmittance, spectrum.emissivity}, spectrum.zenith_rad});
  FacadeAccess::set(report, std::move(found));
  return report;
}

}  // namespace

std::vector<ScatteringModel> scattering_models() {
  std::vector<ScatteringModel> models;
  for (const io::ScatteringModelText& source : io::scattering_models()) {
    ScatteringModel& model = models.emplace_back();
    model.key = source.key;
    model.doc = source.doc;
    model.usual_reflectance = source.usual_reflectance;
    for (const auto& parameter : source.parameters)
      model.parameters.push_back(
          {parameter.key, parameter.doc, parameter.value, parameter.default_json, parameter.required});
  }
  return models;
}

std::string scattering_models_list() { return io::list_scattering_models(io::scattering_models()); }

std::string scattering_models_reference() { return io::scattering_models_markdown(io::scattering_models()); }

BrdfReport survey_brdf(const Document& document, const std::string& material, const BrdfQuestion& question) {
  const auto& source = FacadeAccess::inside(document);
  const Call call{source.inputs, nullptr};
  const CallScope scope(call);
  return report_of(session::survey_brdf(source.document, material, question));
}

BrdfReport survey_model(const std::string& model, const std::vector<std::string>& set,
                        const std::string& reflectance, const BrdfQuestion& question) {
  constexpr double kUsual_um = 0.55;
  return report_of(
      session::survey_brdf(session::document_of_model(model, set, reflectance), model, question, kUsual_um));
}

double wavelength_um_of(const std::string& text) {
  const std::optional<io::QuantityText> split = io::split_quantity(text);
  const io::Unit* unit = split ? io::kWavelength.find(split->unit) : nullptr;
  const double um = unit != nullptr ? split->number * unit->factor : 0.0;
  if (!(um >= io::kWavelength.smallest && um <= io::kWavelength.largest))
    throw InputError(format("'{}' is no wavelength; expected one with its unit, such as {} (units: {})", text,
                            io::kWavelength.example, io::kWavelength.unit_list()));
  return um;
}

std::string BrdfReport::table() const { return io::brdf_text(inside_->report); }

std::string BrdfReport::csv() const { return io::brdf_csv(inside_->report); }

std::string BrdfReport::figure() const { return io::brdf_figure(inside_->report); }

}  // namespace ifov
