#include "sensor/detector/element_light.h"

#include <numbers>
#include <vector>

#include "radiometry/channel.h"
#include "radiometry/channel_grid.h"
#include "radiometry/gauss_legendre.h"
#include "radiometry/planck.h"
#include "radiometry/spectrum.h"

namespace ifov::sensor {
namespace {

constexpr double kPlanck_j_s = 6.62607015e-34, kLight_m_s = 299792458.0;  // CODATA 2018, exact

double photons_per_joule(double wavelength_um) { return 1e-6 * wavelength_um / (kPlanck_j_s * kLight_m_s); }

/// Integral over the channel of filter * a * b * photons per joule * radiance, um.
template <class Radiance>
double integral(const radiometry::Channel& channel, const radiometry::Spectrum& a,
                const radiometry::Spectrum& b, const Radiance& radiance) {
  if (channel.is_monochromatic()) return 0.0;
  const radiometry::Spectrum* spectra[] = {&channel.response, &a, &b};
  const std::vector<double> steps = radiometry::integration_steps_um(
      radiometry::merged_wavelengths_um(spectra, channel.response.first_um(), channel.response.last_um()));
  const double scale = 1.0 / channel.response.maximum();
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    const double width_um = steps[i + 1] - steps[i];
    for (const radiometry::GaussPoint& gauss : radiometry::kGauss4) {
      const double um = steps[i] + gauss.position * width_um;
      sum += gauss.weight * width_um * scale * channel.response.at(um) * a.at(um) * b.at(um) *
             photons_per_joule(um) * radiance(um);
    }
  }
  return sum;
}

}  // namespace

double ElementOptics::throughput_m2_sr() const {
  return area_m2 * std::numbers::pi * (1.0 - obscuration * obscuration) / (4.0 * f_number * f_number);
}

double electrons_per_radiance(const ElementOptics& optics, const radiometry::Channel& channel,
                              const radiometry::Spectrum& transmittance,
                              const radiometry::Spectrum& quantum_efficiency) {
  return optics.throughput_m2_sr() * optics.integration_time_s *
         integral(channel, transmittance, quantum_efficiency, [](double) { return 1.0; });
}

double background_electrons(const ElementOptics& optics, const radiometry::Channel& channel,
                            const radiometry::Spectrum& emissivity,
                            const radiometry::Spectrum& quantum_efficiency, double temperature_k) {
  return optics.throughput_m2_sr() * optics.integration_time_s *
         integral(channel, emissivity, quantum_efficiency,
                  [&](double um) { return radiometry::planck_w_m2_sr_um(um, temperature_k); });
}

}  // namespace ifov::sensor
