#include "atmosphere/profile/gas_requests.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace ifov::atmosphere {
namespace {

std::string_view name_of(Gas gas) { return kGasNames[static_cast<std::size_t>(gas)]; }

void require_amount(Gas gas, double value, std::string_view unit) {
  if (!(value >= 0.0 && std::isfinite(value)))
    throw InputError(format("{} of {:g} {}: expected 0 or more", name_of(gas), value, unit));
}

/// The profile with levels at further altitudes within it.
Profile with_altitudes(const Profile& profile, const std::vector<GasRequest::Level>& levels) {
  Profile made = profile;
  for (const GasRequest::Level& level : levels) {
    const double altitude = level.altitude_km;
    if (!(altitude > profile.altitude_km.front() && altitude < profile.altitude_km.back())) continue;
    const auto above = std::lower_bound(made.altitude_km.begin(), made.altitude_km.end(), altitude);
    if (*above == altitude) continue;
    const auto at = above - made.altitude_km.begin();
    const Profile here = profile.between(altitude, profile.altitude_km.back());
    made.altitude_km.insert(above, altitude);
    made.pressure_hPa.insert(made.pressure_hPa.begin() + at, here.pressure_hPa.front());
    made.temperature_K.insert(made.temperature_K.begin() + at, here.temperature_K.front());
    for (std::size_t g = 0; g < kGasCount; ++g)
      made.mixing_ratio_ppmv[g].insert(made.mixing_ratio_ppmv[g].begin() + at,
                                       here.mixing_ratio_ppmv[g].front());
  }
  return made;
}

double linear(const std::vector<GasRequest::Level>& levels, double altitude_km) {
  if (altitude_km <= levels.front().altitude_km) return levels.front().ppmv;
  std::size_t above = 1;
  while (above + 1 < levels.size() && levels[above].altitude_km < altitude_km) ++above;
  const GasRequest::Level &low = levels[above - 1], &high = levels[above];
  return low.ppmv +
         (high.ppmv - low.ppmv) * (altitude_km - low.altitude_km) / (high.altitude_km - low.altitude_km);
}

}  // namespace

Profile with_gas_levels(const Profile& profile, Gas gas, const GasRequest& request, double ground_km,
                        std::vector<std::string>& remarks) {
  const std::vector<GasRequest::Level>& levels = request.levels;
  if (levels.size() < 2)
    throw InputError(format("a profile of {} of one level: expected two or more", name_of(gas)));
  for (std::size_t k = 0; k < levels.size(); ++k) {
    require_amount(gas, levels[k].ppmv, "ppm");
    if (k > 0 && !(levels[k].altitude_km > levels[k - 1].altitude_km))
      throw InputError(format("the altitudes of the profile of {} must rise: {:g} km follows {:g} km",
                              name_of(gas), levels[k].altitude_km, levels[k - 1].altitude_km));
  }
  const double first = levels.front().altitude_km, last = levels.back().altitude_km;
  if (!(last > ground_km && first < kTopOfAtmosphereKm))
    throw InputError(
        format("the profile of {} reaches from {:g} to {:g} km, and the air from {:g} to {:g} km",
               name_of(gas), first, last, ground_km, kTopOfAtmosphereKm));
  if (first > ground_km)
    remarks.push_back(format(
        "the profile of {} begins at {:g} km, above the ground at {:g} km: its lowest value, {:g} ppm, holds below",
        name_of(gas), first, ground_km, levels.front().ppmv));
  Profile made = with_altitudes(profile, levels);
  std::vector<double>& mixing = made.of(gas);
  for (std::size_t i = 0; i < made.levels(); ++i)
    if (made.altitude_km[i] <= last) mixing[i] = linear(levels, made.altitude_km[i]);
  if (last < kTopOfAtmosphereKm) {
    constexpr double kTold = 1e-3;
    const double above = made.between(last, kTopOfAtmosphereKm).column_atm_cm(gas),
                 all = made.between(ground_km, kTopOfAtmosphereKm).column_atm_cm(gas);
    if (above > kTold * all)
      remarks.push_back(format(
          "the profile of {} ends at {:g} km: above it the model atmosphere's goes on, {:.1f} % of the column",
          name_of(gas), last, 100.0 * above / all));
  }
  return made;
}

void scale_gas(Profile& profile, Gas gas, const GasRequest& request) {
  std::vector<double>& mixing = profile.of(gas);
  double factor = 1.0;
  if (request.off) factor = 0.0;
  if (request.ground_ppmv) {
    require_amount(gas, *request.ground_ppmv, "ppm");
    if (!(mixing.front() > 0.0))
      throw InputError(format("the profile has no {} at the ground that could be scaled to {:g} ppm",
                              name_of(gas), *request.ground_ppmv));
    factor = *request.ground_ppmv / mixing.front();
  }
  if (request.column_atm_cm && gas != Gas::h2o) {
    require_amount(gas, *request.column_atm_cm, "atm-cm");
    const double column = profile.column_atm_cm(gas);
    if (!(column > 0.0))
      throw InputError(format("the profile has no {} that a column could be scaled from", name_of(gas)));
    factor = *request.column_atm_cm / column;
  }
  for (double& value : mixing) value *= factor;
}

}  // namespace ifov::atmosphere
