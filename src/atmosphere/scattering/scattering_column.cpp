#include "atmosphere/scattering/scattering_column.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {

namespace {

void check(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad) {
  const std::size_t n = optics.layers();
  if (n == 0 || levels.layers() != n || optics.rayleigh_scattering.size() != n ||
      optics.aerosol_scattering.size() != n || optics.aerosol_absorption.size() != n ||
      optics.aerosol_asymmetry.size() != n) {
    throw std::invalid_argument("levels and layer optics must describe the same layers");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!(levels.altitude_km[i + 1] > levels.altitude_km[i])) {
      throw std::invalid_argument("altitudes of levels must rise");
    }
  }
  if (!(sun_zenith_rad >= 0.0 && sun_zenith_rad < 0.5 * std::numbers::pi)) {
    throw std::invalid_argument("the Sun must be above the horizon");
  }
}

}  // namespace

ScatteringColumn::ScatteringColumn(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                                   const ScatteringOptions& options)
    : spherical(options.spherical_earth),
      sun_mu(std::cos(sun_zenith_rad)),
      depolarization(optics.depolarization) {
  check(levels, optics, sun_zenith_rad);
  const std::size_t n = optics.layers();
  std::vector<double> scaled(n), whole(n);  // extinction per km, top down
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t layer = n - 1 - i;
    const double height = levels.altitude_km[layer + 1] - levels.altitude_km[layer];
    const double rayleigh = optics.rayleigh_scattering[layer], aerosol = optics.aerosol_scattering[layer];
    const double absorbed = optics.gas_absorption[layer] + optics.aerosol_absorption[layer];
    const double peak = std::pow(std::abs(optics.aerosol_asymmetry[layer]), 2 * options.nodes_per_hemisphere);
    const double all = rayleigh + aerosol + absorbed, kept = all - peak * aerosol;
    const double inverse = kept > 0.0 ? 1.0 / kept : 0.0;
    mixtures.push_back({rayleigh * inverse, aerosol * inverse, optics.aerosol_asymmetry[layer], peak});
    scaled[i] = kept / height;
    whole[i] = all / height;

    const double scattered = rayleigh + aerosol * (1.0 - peak);
    const double wanted = std::ceil((scattered + 0.1 * absorbed) / options.sublayer_depth);
    const int parts = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(options.most_sublayers)));
    for (int part = 0; part < parts; ++part) {
      altitude_km.push_back(levels.altitude_km[layer + 1] - height * part / parts);
      depth.push_back(kept / parts);
      true_depth.push_back(all / parts);
      mixture_of.push_back(i);
    }
  }
  altitude_km.push_back(levels.altitude_km[0]);

  // Length of the sunbeam that arrives at an altitude, from a level above.
  const auto beam_km = [&](double end_km, double level_km) {
    return options.spherical_earth ? length_to_shell_km(end_km, sun_mu, level_km)
                                   : (level_km - end_km) / sun_mu;
  };
  for (std::size_t level = 0; level < altitude_km.size(); ++level) {
    double sum = 0.0, true_sum = 0.0;
    const double end = altitude_km[level];
    for (std::size_t i = 0; i < n && levels.altitude_km[n - i] > end; ++i) {
      const double length = beam_km(end, levels.altitude_km[n - i]) -
                            beam_km(end, std::max(end, levels.altitude_km[n - 1 - i]));
      sum += scaled[i] * length;
      true_sum += whole[i] * length;
    }
    beam_depth.push_back(sum);
    true_beam_depth.push_back(true_sum);
  }
}

}  // namespace ifov::atmosphere
