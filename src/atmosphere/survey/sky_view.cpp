#include "atmosphere/survey/sky_view.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/column/light_limits.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/scattering/scattering_options.h"
#include "atmosphere/thermal/emitted_light.h"
#include "core/parallel.h"
#include "math/angle.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

constexpr int kZenithStep_deg = 2, kAzimuthStep_deg = 3;

/// What one absorption term scatters into every direction.
void add_scattered(const AtmosphereColumn& column, const LayerOptics& optics, double sun_zenith_rad,
                   double factor, SkyView& sky) {
  const ColumnSolution solution = ColumnSolver().solve(column.levels(), optics, sun_zenith_rad);
  const double ground_km = column.levels().altitude_km.front();
  for (std::size_t z = 0; z < sky.zenith_rad.size(); ++z) {
    const SlantSource ring = solution.sunlit().along(-std::cos(sky.zenith_rad[z]));
    for (std::size_t a = 0; a < sky.azimuth_rad.size(); ++a)
      sky.light[z * sky.azimuth_rad.size() + a] +=
          factor * ring.sky(sky.azimuth_rad[a], ground_km).radiance();
  }
}

void add_emitted(const AtmosphereColumn& column, const LayerOptics& optics, double factor, SkyView& sky) {
  const Levels& levels = column.levels();
  std::vector<double> planck;
  for (const double t : levels.temperature_K)
    planck.push_back(radiometry::planck_w_m2_sr_um(sky.wavelength_um, t));
  const EmittedLight thermal(levels, optics, std::move(planck));
  for (std::size_t z = 0; z < sky.zenith_rad.size(); ++z) {
    const double radiance =
        factor * thermal.sky(std::max(0.0, std::cos(sky.zenith_rad[z])), levels.altitude_km.front());
    for (std::size_t a = 0; a < sky.azimuth_rad.size(); ++a)
      sky.light[z * sky.azimuth_rad.size() + a].i += radiance;
  }
}

}  // namespace

SkyView view_sky(const AtmosphereColumn& column, double wavelength_um, double solar_irradiance,
                 std::optional<double> sun_zenith_rad, int threads) {
  SkyView sky;
  sky.wavelength_um = wavelength_um;
  for (int d = 0; d <= 90; d += kZenithStep_deg) sky.zenith_rad.push_back(d * math::kDegree);
  for (int d = 0; d <= 180; d += kAzimuthStep_deg) sky.azimuth_rad.push_back(d * math::kDegree);
  sky.light.resize(sky.zenith_rad.size() * sky.azimuth_rad.size());
  const ColumnOptics optics = column.at(1e4 / wavelength_um);
  std::vector<SkyView> by_term(optics.terms(), sky);  // added in order: the same for any number of threads
  parallel_for(static_cast<std::int64_t>(optics.terms()), threads, [&](std::int64_t k) {
    const std::size_t t = static_cast<std::size_t>(k);
    const LayerOptics layers = optics.term(t);
    if (sun_zenith_rad && wavelength_um <= kLastSolar_um)
      add_scattered(column, layers, *sun_zenith_rad, optics.weight(t) * solar_irradiance, by_term[t]);
    if (wavelength_um >= kFirstThermal_um) add_emitted(column, layers, optics.weight(t), by_term[t]);
  });
  for (const SkyView& part : by_term)
    for (std::size_t d = 0; d < sky.light.size(); ++d) sky.light[d] += part.light[d];
  return sky;
}

}  // namespace ifov::atmosphere
