#include "materials/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
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

struct Excess {
  double share = 0.0, cosine = 1.0;
  std::optional<double> um;  ///< none: at all wavelengths
};

/// The most that goes on of light from one direction, and where in the spectrum.
Excess most_of(const Bsdf& bsdf, double cosine) {
  radiometry::Spectrum whole = directional_hemispherical(bsdf, Side::reflected, cosine);
  if (bsdf.may_transmit())
    whole = radiometry::sum(whole, directional_hemispherical(bsdf, Side::transmitted, cosine));
  const auto most = std::max_element(whole.values().begin(), whole.values().end());
  Excess excess{*most, cosine, std::nullopt};
  if (!whole.is_constant())
    excess.um = whole.wavelength_um()[static_cast<std::size_t>(most - whole.values().begin())];
  return excess;
}

/// A model may be such that parameters in their ranges reflect more than what arrives.
void check_energy(const Material& material) {
  constexpr double kCosines[] = {1.0, 0.7, 0.4, 0.2, 0.1, 0.02}, kRounding = 1e-3;
  std::array<Excess, std::size(kCosines)> all;
  parallel_for(std::ssize(kCosines), 0, [&](std::int64_t k) {
    all[static_cast<std::size_t>(k)] = most_of(*material.bsdf, kCosines[k]);
  });
  // The first of those that are alike but for rounding.
  Excess worst;
  for (const Excess& one : all)
    if (one.share > worst.share * (1.0 + 1e-4)) worst = one;
  if (worst.share > 1.0 + kRounding)
    throw InputError(format(
        "material '{}': of light{} that comes {:.0f} deg from the normal it sends back {}{:.4g} times as "
        "much; its parameters belong to no passive surface",
        material.name, worst.um ? format(" of {:.4g} um", *worst.um) : "",
        std::acos(worst.cosine) * 180.0 / std::numbers::pi,
        material.bsdf->may_transmit() ? "and lets through " : "", worst.share));
}

}  // namespace

const std::shared_ptr<const Bsdf>& usual_bsdf() { return Lambertian::shared(); }

double holds_to_um(const Material& material) { return material.bsdf->holds_to_um(); }

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
