#include "atmosphere/sensor/channel_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::atmosphere {
namespace {

double relative(double given, double right) {
  return right > 0.0 ? std::min(1.0, std::abs(given / right - 1.0)) : 0.0;
}

}  // namespace

ChannelChecks::ChannelChecks(const ChannelScattering& scattering, const ChannelPoints& points,
                             const SensorGeometry& geometry, const FinerAtmosphere& air)
    : points_(points), geometry_(geometry), air_(air) {
  for (const ChannelScattering::WeakPoint& at : scattering.weak_points()) checks_.emplace_back().at = at;
}

void ChannelChecks::solve(const ColumnSolver& finer, std::size_t solution, KeptSolutions* kept) {
  Check& check = checks_[solution];
  const ChannelPoints::Point& point = points_.points[check.at.point];
  const Levels& levels = air_.column().levels();
  const LayerOptics optics = air_.cut(point.layers(), point.optics->wavenumber_cm1);
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

ChannelChecks::Errors ChannelChecks::against(const ChannelScattering::AtPoints& given) const {
  Errors errors;
  for (const Check& check : checks_) {
    const std::size_t p = check.at.point;
    const double sun = points_.irradiance[p], share = check.at.share;
    errors.path += share * relative(given.path[p], sun * check.path);
    errors.sky_irradiance += share * relative(given.sky_irradiance[p], sun * check.sky_irradiance);
    errors.diffuse_transmittance +=
        share * relative(given.diffuse_transmittance[p], check.diffuse_transmittance);
    errors.spherical_albedo += share * relative(given.spherical_albedo[p], check.spherical_albedo);
  }
  return errors;
}

}  // namespace ifov::atmosphere
