#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/brdf_report/brdf_report.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

/// What the tables show of the angles that were worked out.
constexpr double kTableStep_deg = 15.0, kTableLast_deg = 75.0;

bool is_multiple(double rad, double step_deg) {
  return std::abs(std::remainder(rad / math::kDegree, step_deg)) < 1e-6;
}

/// Five digits, from narrow peaks to what is dark beside them.
std::string number_text(double value) {
  return value != 0.0 && (std::abs(value) < 1e-3 || std::abs(value) >= 1e4) ? format("{:.3e}", value)
                                                                            : format("{:.5g}", value);
}

std::string heading(const BrdfReport& report) {
  std::string text = report.name == report.model ? report.model : format("{}: {}", report.name, report.model);
  if (report.wavelength_um) text += format(", {:g} um", *report.wavelength_um);
  text += "\n";
  for (const std::string& line : report.description) text += "  " + line + "\n";
  return text;
}

std::string lobe_table(const BrdfReport& report) {
  std::string text =
      "\nBRDF in the principal plane, 1/sr; view zenith above 0 on the side of the light\n"
      "  view deg   light from";
  for (const BrdfReport::Lobe& lobe : report.lobes)
    text += format("{:>9}{}", format("{:g} deg", lobe.light_rad / math::kDegree), "  ");
  while (text.back() == ' ') text.pop_back();
  text += "\n";
  for (std::size_t v = 0; v < report.view_rad.size(); ++v) {
    const double view_rad = report.view_rad[v];
    if (!is_multiple(view_rad, kTableStep_deg) || std::abs(view_rad) > kTableLast_deg * math::kDegree + 1e-6)
      continue;
    text += format("  {:>8.0f}            ", view_rad / math::kDegree + 0.0);
    for (const BrdfReport::Lobe& lobe : report.lobes) text += format("{:>11}", number_text(lobe.brdf[v]));
    text += "\n";
  }
  return text;
}

std::string angle_table(const BrdfReport& report) {
  const bool transmits = !report.transmittance.empty();
  std::string text = format(
      "\nDirectional-hemispherical reflectance{}, and emissivity\n"
      "  zenith deg   reflectance{}    emissivity\n",
      transmits ? " and transmittance" : "", transmits ? "  transmittance" : "");
  for (std::size_t k = 0; k < report.zenith_rad.size(); ++k) {
    const double zenith_deg = report.zenith_rad[k] / math::kDegree;
    const bool is_last = std::abs(zenith_deg - 85.0) < 1e-6;
    if (!is_last && !is_multiple(report.zenith_rad[k], kTableStep_deg)) continue;
    text += format("  {:>10.0f}   {:>11.5f}", zenith_deg, report.reflectance[k]);
    if (transmits) text += format("  {:>13.5f}", report.transmittance[k]);
    text += format("  {:>12.5f}\n", report.emissivity[k]);
  }
  return text;
}

}  // namespace

std::string brdf_text(const BrdfReport& report) {
  return heading(report) + (report.is_delta ? std::string() : lobe_table(report)) + angle_table(report);
}

std::string brdf_csv(const BrdfReport& report) {
  std::string text = format(
      "# {} of '{}' by ifov\n"
      "# brdf: 1/sr, of light from light_zenith_deg, in the principal plane; view_zenith_deg is above 0 on the side of the "
      "light\n"
      "# reflectance, transmittance: directional-hemispherical, of light from light_zenith_deg; emissivity: towards there\n",
      report.model, report.name);
  for (const std::string& line : report.description) text += "# " + line + "\n";
  text += "quantity,wavelength_um,light_zenith_deg,view_zenith_deg,value\n";
  const std::string at = report.wavelength_um ? format("{:.9g}", *report.wavelength_um) : std::string();
  for (const BrdfReport::Lobe& lobe : report.lobes)
    for (std::size_t v = 0; v < report.view_rad.size(); ++v)
      text += format("brdf,{},{:.9g},{:.9g},{:.9g}\n", at, lobe.light_rad / math::kDegree,
                     report.view_rad[v] / math::kDegree, lobe.brdf[v]);
  const auto add = [&](const char* what, const std::string& wavelength, double zenith_rad, double value) {
    text += format("{},{},{:.9g},,{:.9g}\n", what, wavelength, zenith_rad / math::kDegree, value);
  };
  const auto add_all = [&](const std::string& wavelength, double zenith_rad, const auto& of, std::size_t k) {
    add("reflectance", wavelength, zenith_rad, of.reflectance[k]);
    if (!of.transmittance.empty()) add("transmittance", wavelength, zenith_rad, of.transmittance[k]);
    add("emissivity", wavelength, zenith_rad, of.emissivity[k]);
  };
  for (std::size_t k = 0; k < report.zenith_rad.size(); ++k) add_all(at, report.zenith_rad[k], report, k);
  for (const BrdfReport::Spectrum& spectrum : report.spectra)
    for (std::size_t k = 0; k < report.spectrum_um.size(); ++k)
      add_all(format("{:.9g}", report.spectrum_um[k]), spectrum.zenith_rad, spectrum, k);
  return text;
}

}  // namespace ifov::io
