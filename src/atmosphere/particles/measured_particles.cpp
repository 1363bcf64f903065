#include "atmosphere/particles/measured_particles.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/error.h"
#include "core/format.h"

namespace ifov::atmosphere {
namespace {

struct Place {
  std::size_t low;
  double share;  // of the next one; outside 0 to 1 beyond the ends
};

Place place(const std::vector<double>& um, double wavelength_um) {
  const auto above = std::upper_bound(um.begin() + 1, um.end() - 1, wavelength_um);
  const std::size_t low = static_cast<std::size_t>(above - um.begin()) - 1;
  return {low, std::log(wavelength_um / um[low]) / std::log(um[low + 1] / um[low])};
}

double held(const std::vector<double>& um, const std::vector<double>& values, double wavelength_um) {
  const double at = std::clamp(wavelength_um, um.front(), um.back());
  const std::size_t low = place(um, at).low;
  return values[low] + (values[low + 1] - values[low]) * (at - um[low]) / (um[low + 1] - um[low]);
}

}  // namespace

MeasuredParticles::MeasuredParticles(Optics optics) : optics_(std::move(optics)) {
  const std::size_t count = optics_.wavelength_um.size();
  const auto* asymmetry = std::get_if<std::vector<double>>(&optics_.scatters);
  if (count < 2 || optics_.optical_depth.size() != count ||
      optics_.single_scattering_albedo.size() != count ||
      (asymmetry != nullptr && asymmetry->size() != count))
    throw InputError(
        "measured haze needs depths, albedos and asymmetries at the same wavelengths, two or more");
  for (std::size_t k = 0; k < count; ++k) {
    const double um = optics_.wavelength_um[k];
    if (!(um > (k > 0 ? optics_.wavelength_um[k - 1] : 0.0)))
      throw InputError(format("the wavelengths of measured haze must rise: found {:g} um", um));
    if (!(optics_.optical_depth[k] > 0.0))
      throw InputError(
          format("an optical depth of {:g} at {:g} um: expected above 0", optics_.optical_depth[k], um));
    const double albedo = optics_.single_scattering_albedo[k];
    if (!(albedo >= 0.0 && albedo <= 1.0))
      throw InputError(format("a single-scattering albedo of {:g} at {:g} um: expected 0 to 1", albedo, um));
    if (asymmetry != nullptr && !(std::abs((*asymmetry)[k]) <= 0.99))
      throw InputError(
          format("an asymmetry of {:g} at {:g} um: expected -0.99 to 0.99", (*asymmetry)[k], um));
  }
}

double MeasuredParticles::optical_depth(double wavelength_um) const {
  const Place at = place(optics_.wavelength_um, wavelength_um);
  const std::vector<double>& depth = optics_.optical_depth;
  return depth[at.low] * std::pow(depth[at.low + 1] / depth[at.low], at.share);
}

AerosolProperties MeasuredParticles::properties(double wavelength_um) const {
  const double extinction = optical_depth(wavelength_um) / optical_depth(kReference_um);
  const double albedo = held(optics_.wavelength_um, optics_.single_scattering_albedo, wavelength_um);
  const auto* asymmetry = std::get_if<std::vector<double>>(&optics_.scatters);
  return {extinction, extinction * (1.0 - albedo),
          asymmetry != nullptr ? held(optics_.wavelength_um, *asymmetry, wavelength_um)
                               : phase_function(wavelength_um).moment(1)};
}

PhaseFunction MeasuredParticles::phase_function(double wavelength_um) const {
  if (const auto* asymmetry = std::get_if<std::vector<double>>(&optics_.scatters))
    return henyey_greenstein(held(optics_.wavelength_um, *asymmetry, wavelength_um));
  const PhaseFunctionTable& table = std::get<PhaseFunctionTable>(optics_.scatters);
  return table.at(wavelength_um, std::make_shared<const PolarizationRatios>(
                                     PolarizationRatios::none(table.angles->angle_rad)));
}

}  // namespace ifov::atmosphere
