#include "atmosphere/particles/given_particles.h"

#include <cmath>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/format.h"

namespace ifov::atmosphere {
namespace {

constexpr double kMostAsymmetric = 0.99;

void check(const radiometry::Spectrum& spectrum, std::string_view what, double low, double high) {
  for (std::size_t k = 0; k < spectrum.values().size(); ++k) {
    const double value = spectrum.values()[k];
    if (value >= low && value <= high) continue;
    throw InputError(spectrum.is_constant()
                         ? format("{} of {:g}: expected {:g} to {:g}", what, value, low, high)
                         : format("{} of {:g} at {:g} um: expected {:g} to {:g}", what, value,
                                  spectrum.wavelength_um()[k], low, high));
  }
}

}  // namespace

GivenParticles::GivenParticles(double angstrom, radiometry::Spectrum single_scattering_albedo,
                               std::variant<radiometry::Spectrum, PhaseFunctionTable> scatters)
    : angstrom_(angstrom), albedo_(std::move(single_scattering_albedo)), scatters_(std::move(scatters)) {
  check(albedo_, "a single-scattering albedo", 0.0, 1.0);
  if (const auto* asymmetry = std::get_if<radiometry::Spectrum>(&scatters_))
    check(*asymmetry, "an asymmetry", -kMostAsymmetric, kMostAsymmetric);
}

AerosolProperties GivenParticles::properties(double wavelength_um) const {
  const double extinction = std::pow(wavelength_um / kReference_um, -angstrom_);
  const auto* asymmetry = std::get_if<radiometry::Spectrum>(&scatters_);
  return {extinction, extinction * (1.0 - albedo_.at(wavelength_um)),
          asymmetry != nullptr ? asymmetry->at(wavelength_um) : phase_function(wavelength_um).moment(1)};
}

PhaseFunction GivenParticles::phase_function(double wavelength_um) const {
  if (const auto* asymmetry = std::get_if<radiometry::Spectrum>(&scatters_))
    return henyey_greenstein(asymmetry->at(wavelength_um));
  const PhaseFunctionTable& table = std::get<PhaseFunctionTable>(scatters_);
  return table.at(wavelength_um, std::make_shared<const PolarizationRatios>(
                                     PolarizationRatios::none(table.angles->angle_rad)));
}

}  // namespace ifov::atmosphere
