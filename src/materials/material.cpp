#include "materials/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/lambertian.h"

namespace ifov::materials {

namespace {

constexpr double kSlack = 1e-9;

void check_fraction(const Material& material, const radiometry::Spectrum& spectrum, const char* what) {
  const double low = spectrum.minimum(), high = spectrum.maximum();
  if (low < -kSlack || high > 1.0 + kSlack)
    throw InputError(format("material '{}': {} must lie between 0 and 1; it reaches from {:g} to {:g}{}",
                            material.name, what, low, high,
                            high > 1.5 && high <= 100.0 ? "; if it is in percent, say \"scale\": 0.01" : ""));
}

/// Both are linear between the points of either, so that their sum is highest at one of them.
void check_sum(const Material& material, const radiometry::Spectrum& transmittance) {
  const radiometry::Spectrum& reflectance = material.reflectance;
  std::vector<double> wavelengths_um;
  for (const radiometry::Spectrum* spectrum : {&reflectance, &transmittance})
    wavelengths_um.insert(wavelengths_um.end(), spectrum->wavelength_um().begin(),
                          spectrum->wavelength_um().end());
  if (wavelengths_um.empty()) wavelengths_um.push_back(1.0);
  const double first = std::max(reflectance.first_um(), transmittance.first_um());
  const double last = std::min(reflectance.last_um(), transmittance.last_um());
  for (const double wavelength_um : wavelengths_um) {
    if (wavelength_um < first || wavelength_um > last) continue;
    const double rho = reflectance.at(wavelength_um), tau = transmittance.at(wavelength_um);
    if (rho + tau <= 1.0 + kSlack) continue;
    const bool everywhere = reflectance.is_constant() && transmittance.is_constant();
    throw InputError(
        format("material '{}': reflectance and transmittance must not sum to more than 1; {} they are "
               "{:g} and {:g}",
               material.name, everywhere ? "here" : format("at {:g} um", wavelength_um), rho, tau));
  }
}

/// A model may be such that parameters in their ranges reflect more than what arrives.
void check_energy(const Material& material) {
  constexpr double kCosines[] = {1.0, 0.7, 0.4, 0.2, 0.1, 0.02}, kRounding = 1e-3;
  std::array<double, std::size(kCosines)> most;
  parallel_for(std::ssize(kCosines), 0, [&](std::int64_t k) {
    const double cosine = kCosines[k];
    radiometry::Spectrum whole = directional_hemispherical(*material.bsdf, Side::reflected, cosine);
    if (material.bsdf->may_transmit())
      whole = radiometry::sum(whole, directional_hemispherical(*material.bsdf, Side::transmitted, cosine));
    most[static_cast<std::size_t>(k)] = whole.maximum();
  });
  for (std::size_t k = 0; k < most.size(); ++k)
    if (most[k] > 1.0 + kRounding)
      throw InputError(format(
          "material '{}': of light that comes {:.0f} deg from the normal it sends back {:.4g} times as "
          "much; its parameters belong to no passive surface",
          material.name, std::acos(kCosines[k]) * 180.0 / std::numbers::pi, most[k]));
}

}  // namespace

const std::shared_ptr<const Bsdf>& usual_bsdf() { return Lambertian::shared(); }

void check(const Material& material) {
  check_fraction(material, material.reflectance, "reflectance");
  if (material.transmittance) {
    check_fraction(material, *material.transmittance, "transmittance");
    if (!material.bsdf->may_transmit() || !material.bsdf->is_separable())
      throw InputError(
          format("material '{}': only \"lambertian\" scattering can have a transmittance", material.name));
    check_sum(material, *material.transmittance);
  }
  if (!material.bsdf->is_separable()) check_energy(material);
  if (material.temperature_k && !(*material.temperature_k > 0.0))
    throw InputError(format("material '{}': a temperature must be above 0 K; found {:g} K", material.name,
                            *material.temperature_k));
}

}  // namespace ifov::materials
