#include "session/surveys/brdf_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.h"
#include "io/document/document.h"
#include "io/document/reading/scattering_models.h"
#include "materials/bsdf/bsdf.h"
#include "math/angle.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/scattering_assembly.h"
#include "session/one_material.h"
#include "session/surface_at.h"

namespace ifov::session {
namespace {

using math::kDegree;

constexpr int kMapSide = 480;
constexpr double kLastView_deg = 89.0, kLastZenith_deg = 87.5, kZenithStep_deg = 2.5;
constexpr double kSpectra_deg[] = {0.0, 60.0};

/// "slope 25 deg, reflectance 0.3", of what the material was made of.
std::string parameter_line(const io::Document& document, const io::MaterialDocument& source, int curve,
                           double wavelength_um) {
  std::string text;
  const auto add = [&](std::string_view key, const std::string& value) {
    text += format("{}{} {}", text.empty() ? "" : ", ", key, value);
  };
  const auto at = [&](const io::SpectrumDocument& spectrum) {
    return format("{:.4g}", assemble_spectrum(document.sources, spectrum, source.name).at(wavelength_um));
  };
  add(source.is_emissivity ? "emissivity" : "reflectance",
      at(curve == 1 ? source.spectrum : source.further_curves[static_cast<std::size_t>(curve - 2)]));
  if (source.transmittance) add("transmittance", at(*source.transmittance));
  for (const auto& [key, value] : io::parameter_texts(source.scattering)) add(key, value);
  for (const auto& [key, value] : source.scattering.values)
    if (const auto* spectrum = std::get_if<io::SpectrumDocument>(&value)) add(key, at(*spectrum));
  return text;
}

std::vector<std::string> description_of(const io::MaterialDocument& source,
                                        const materials::Material& material, int curve) {
  std::vector<std::string> lines;
  const std::size_t curves = source.further_curves.size() + 1;
  if (curves > 1) lines.push_back(format("curve {} of {}; its texture is left out", curve, curves));
  if (source.relief) lines.push_back("its relief is left out");
  if (ScatteringAssembly::map_count(source) > 0)
    lines.push_back("a parameter from a map is taken at the map's mean");
  if (material.transmittance && material.bsdf->is_separable())
    lines.push_back(
        "what it transmits leaves the other side as Lambert's law says, transmittance / pi, 1/sr");
  if (material.bsdf->is_delta())
    lines.push_back(
        "all light leaves in one direction (a delta): there is no BRDF to draw, and this is its reflectance");
  if (!material.bsdf->is_isotropic())
    lines.push_back(
        "lobes and map: the light is in azimuth 0, the surface's tangent; reflectance and emissivity: means over azimuth");
  return lines;
}

/// Every degree, and closer and closer to where light comes from or would be mirrored to: lobes may be narrow.
std::vector<double> views(const std::vector<double>& light_rad) {
  constexpr double kClosest_deg = 0.01, kGrowth = 1.3;
  std::vector<double> all;
  for (double deg = -kLastView_deg; deg <= kLastView_deg; deg += 1.0) all.push_back(deg * kDegree);
  for (const double light : light_rad)
    for (const double middle : {-light, light}) {
      all.push_back(middle);
      for (double away = kClosest_deg; away < 4.0; away *= kGrowth)
        for (const double sign : {-1.0, 1.0}) all.push_back(middle + sign * away * kDegree);
    }
  std::erase_if(all, [](double rad) { return std::abs(rad) > kLastView_deg * kDegree; });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < 1e-9; }), all.end());
  return all;
}

io::BrdfReport::Map map_of(const SurfaceAt& surface, double light_rad) {
  io::BrdfReport::Map map{light_rad, kMapSide, {}};
  map.brdf.assign(static_cast<std::size_t>(kMapSide) * kMapSide, std::numeric_limits<double>::quiet_NaN());
  parallel_for(kMapSide, 0, [&](std::int64_t row) {
    for (int column = 0; column < kMapSide; ++column) {
      const double x = 2.0 * (column + 0.5) / kMapSide - 1.0;
      const double y = 1.0 - 2.0 * (static_cast<double>(row) + 0.5) / kMapSide;
      const double distance = std::hypot(x, y);
      if (distance > 1.0) continue;
      map.brdf[static_cast<std::size_t>(row) * kMapSide + static_cast<std::size_t>(column)] =
          surface.brdf(light_rad, std::min(distance * 90.0, kLastView_deg) * kDegree, std::atan2(y, x));
    }
  });
  return map;
}

void add_by_angle(const SurfaceAt& surface, io::BrdfReport& report) {
  for (double deg = 0.0; deg <= kLastZenith_deg; deg += kZenithStep_deg) {
    const SurfaceAt::Shares shares = surface.shares(deg * kDegree);
    report.zenith_rad.push_back(deg * kDegree);
    report.reflectance.push_back(shares.reflectance[0]);
    if (!shares.transmittance.empty()) report.transmittance.push_back(shares.transmittance[0]);
    report.emissivity.push_back(shares.emissivity[0]);
  }
}

}  // namespace

io::BrdfReport survey_brdf(const io::Document& document, const std::string& name,
                           const BrdfQuestion& question, std::optional<double> usual_um) {
  for (const double light : question.light_rad)
    if (!(light >= 0.0 && light <= kLastView_deg * kDegree))
      throw InputError(format("light from {:g} deg: expected 0 to {:g} deg from the normal", light / kDegree,
                              kLastView_deg));
  const io::MaterialDocument& source = find_material(document, name);
  if (source.sides)
    throw io::document_error(document.sources, source.position,
                             format("'{}' has two sides: ask for '{}' or '{}'", name,
                                    source.sides->first.name, source.sides->second.name));
  const materials::Material material = assemble_material(document, source, question.curve);
  io::BrdfReport report;
  report.name = name;
  report.model = source.scattering.model;
  report.wavelength_um = question.wavelength_um;
  const std::optional<double> asked_um = question.wavelength_um ? question.wavelength_um : usual_um;
  const radiometry::CommonWavelengths known =
      with_position(document.sources, source.position, [&] { return wavelengths_of(material, asked_um); });
  if (!known.um.empty()) report.wavelength_um = asked_um;
  const double wavelength_um = asked_um.value_or(1.0);
  report.description = description_of(source, material, question.curve);
  report.description.insert(report.description.begin(),
                            parameter_line(document, source, question.curve, wavelength_um));

  const SurfaceAt surface(material, {wavelength_um});
  report.is_delta = material.bsdf->is_delta();
  if (!report.is_delta) {
    report.view_rad = views(question.light_rad);
    for (const double light : question.light_rad) {
      io::BrdfReport::Lobe& lobe = report.lobes.emplace_back();
      lobe.light_rad = light;
      for (const double view : report.view_rad)
        lobe.brdf.push_back(surface.brdf(light, std::abs(view), view < 0.0 ? std::numbers::pi : 0.0));
    }
    if (question.figure && !question.light_rad.empty())
      report.map = map_of(surface, question.light_rad[question.light_rad.size() / 2]);
  }
  add_by_angle(surface, report);
  report.spectrum_um = known.um;
  if (known.um.empty()) return report;
  const SurfaceAt everywhere(material, known.um);
  for (const double zenith_deg : kSpectra_deg) {
    if (zenith_deg > 0.0 && material.bsdf->is_separable()) continue;  // the same from all angles
    const SurfaceAt::Shares shares = everywhere.shares(zenith_deg * kDegree);
    report.spectra.push_back(
        {zenith_deg * kDegree, shares.reflectance, shares.transmittance, shares.emissivity});
  }
  return report;
}

io::Document document_of_model(const std::string& key, const std::vector<std::string>& set,
                               const std::string& reflectance) {
  const io::ScatteringModelText model = io::scattering_model(key);
  const std::string named = format("\"{}\"", key);
  const std::string text = format(
      "{{\"ifov\": 1, \"scene\": {{\"materials\": {{{}: {{\"reflectance\": {}, \"scattering\": {}}}}}, "
      "\"objects\": [{{\"plane\": {{}}, \"material\": {}}}]}}, "
      "\"sensor\": {{\"camera\": {{\"orthographic\": {{\"gsd\": \"1 m\", \"pixels\": [1, 1]}}}}, "
      "\"channels\": [{{\"name\": \"one\", \"monochromatic\": {{\"at\": \"1 um\"}}}}]}}}}",
      named, model.usual_reflectance, model.parameters.empty() ? named : format("{{{}: {{}}}}", named),
      named);

  using Step = io::DocumentOverride::Step;
  const std::vector<Step> material{{"scene"}, {"materials"}, {key}};
  std::vector<io::DocumentOverride> overrides;
  const auto put = [&](io::DocumentOverride override, const std::vector<Step>& within) {
    std::vector<Step> steps = material;
    steps.insert(steps.end(), within.begin(), within.end());
    override.steps.insert(override.steps.begin(), steps.begin(), steps.end());
    overrides.push_back(std::move(override));
  };
  if (!reflectance.empty()) put({{{"reflectance"}}, "reflectance", reflectance}, {});
  std::vector<std::string> given;
  for (const std::string& written : set) {
    io::DocumentOverride override = io::read_override(written);
    given.push_back(override.steps.front().key);
    if (model.parameters.empty()) throw InputError(format("--set {}: '{}' has no parameters", written, key));
    put(std::move(override), {{"scattering"}, {key}});
  }
  std::string missing;
  for (const auto& parameter : model.parameters)
    if (parameter.required && std::find(given.begin(), given.end(), parameter.key) == given.end())
      missing += format("\n  --set {}=...  {}: {}", parameter.key, parameter.value, parameter.doc);
  if (!missing.empty()) throw InputError(format("'{}' needs its parameters:{}", key, missing));
  io::Document document = io::parse_document(text, key, overrides);
  document.scene.materials.front().position = {};  // nobody has written the text that it stands in
  return document;
}

}  // namespace ifov::session
