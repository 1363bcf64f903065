#include "atmosphere/sensor/channel_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/sensor/channel_emission.h"
#include "atmosphere/thermal/emitted_light.h"
#include "radiometry/planck.h"

namespace ifov::atmosphere {
namespace {

double relative(double given, double right) {
  return right > 0.0 ? std::min(1.0, std::abs(given / right - 1.0)) : 0.0;
}

}  // namespace

ChannelChecks::ChannelChecks(const ChannelScattering& scattering, const ChannelPoints& points,
                             const SensorGeometry& geometry, const FinerAtmosphere& air, bool glows)
    : points_(points), geometry_(geometry), air_(air), glows_(glows) {
  for (const ChannelScattering::WeakPoint& at : scattering.weak_points()) checks_.emplace_back().at = at;
}

void ChannelChecks::solve(const ColumnSolver& finer, std::size_t solution, KeptSolutions* kept) {
  Check& check = checks_[solution];
  const ChannelPoints::Point& point = points_.points[check.at.point];
  const Levels& levels = air_.column().levels();
  const LayerOptics optics = air_.cut(point.layers(), point.optics->wavenumber_cm1);
  if (glows_) solve_emission(finer.options(), levels, optics, check, kept);
  const std::vector<double> asked = solution_question(finer.options(), geometry_, levels, optics);
  std::vector<double> answer(4);
  if (kept == nullptr || !kept->find(asked, answer)) {
    const ColumnSolution solved = finer.solve(levels, optics, geometry_.any_sun_zenith_rad());
    const Propagation up{std::cos(geometry_.view_zenith_rad), geometry_.view_azimuth_rad - std::numbers::pi};
    answer = {solved.sunlit()
                  .line_of_sight(up, geometry_.sensor_altitude_km, levels.altitude_km.front())
                  .radiance()
                  .i,
              solved.sunlit().fluxes().at(levels.altitude_km.front()).diffuse_down,
              solved.diffuse_transmittance(up.mu, geometry_.sensor_altitude_km).i, solved.spherical_albedo()};
    if (kept != nullptr) kept->keep(asked, answer);
  }
  check.path = answer[0];
  check.sky_irradiance = answer[1];
  check.diffuse_transmittance = answer[2];
  check.spherical_albedo = answer[3];
}

void ChannelChecks::solve_emission(const ScatteringOptions& options, const Levels& levels,
                                   const LayerOptics& optics, Check& check, KeptSolutions* kept) const {
  std::vector<double> planck;
  for (const double kelvin : levels.temperature_K)
    planck.push_back(radiometry::planck_w_m2_sr_um(points_.points[check.at.point].wavelength_um, kelvin));
  std::vector<double> asked = solution_question(options, geometry_, levels, optics);
  asked.insert(asked.end(), planck.begin(), planck.end());
  std::vector<double> answer(2);
  if (kept == nullptr || !kept->find(asked, answer)) {
    const EmittedLight light(levels, optics, std::move(planck), options);
    const double ground_km = levels.altitude_km.front();
    answer = {
        light.line_of_sight(geometry_.sensor_altitude_km, std::cos(geometry_.view_zenith_rad), ground_km),
        light.irradiance(ground_km)};
    if (kept != nullptr) kept->keep(asked, answer);
  }
  check.emitted_path = answer[0];
  check.emitted_sky = answer[1];
}

ChannelChecks::Errors ChannelChecks::against(const ChannelScattering::AtPoints& given,
                                             const ChannelEmission* emitted) const {
  Errors errors;
  for (const Check& check : checks_) {
    const std::size_t p = check.at.point;
    const double sun = points_.irradiance[p], share = check.at.share;
    errors.path += share * relative(given.path[p], sun * check.path);
    errors.sky_irradiance += share * relative(given.sky_irradiance[p], sun * check.sky_irradiance);
    errors.diffuse_transmittance +=
        share * relative(given.diffuse_transmittance[p], check.diffuse_transmittance);
    errors.spherical_albedo += share * relative(given.spherical_albedo[p], check.spherical_albedo);
    if (!glows_ || emitted == nullptr) continue;
    errors.emitted_path = std::max(errors.emitted_path, relative(emitted->path[p], check.emitted_path));
    errors.emitted_sky =
        std::max(errors.emitted_sky, relative(emitted->sky_irradiance[p], check.emitted_sky));
  }
  return errors;
}

}  // namespace ifov::atmosphere
