#include "atmosphere/profile/built_profile.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/profile/gas_requests.h"
#include "atmosphere/profile/profile_description.h"
#include "core/error.h"

namespace ifov::atmosphere {
namespace {

constexpr double kHighestGroundKm = 6.0;
constexpr double kAirMolarMass = 28.964, kWaterMolarMass = 18.015;

void check_level(const UserLevel& level, const UserLevel* below) {
  if (below != nullptr && level.altitude_km <= below->altitude_km)
    throw InputError(format("the altitudes of a profile must rise: {} km follows {} km", level.altitude_km,
                            below->altitude_km));
  if (level.altitude_km >= kTopOfAtmosphereKm)
    throw InputError(
        format("a profile level at {} km: expected below {} km", level.altitude_km, kTopOfAtmosphereKm));
  if (!(level.pressure_hPa > 0.0) || (below != nullptr && level.pressure_hPa >= below->pressure_hPa))
    throw InputError(format("pressure {} hPa at {} km: expected above 0 and falling with altitude",
                            level.pressure_hPa, level.altitude_km));
  if (!(level.temperature_K > 120.0 && level.temperature_K < 350.0))
    throw InputError(
        format("temperature {} K at {} km: expected 120 to 350 K", level.temperature_K, level.altitude_km));
  if (level.relative_humidity_percent && level.mixing_ratio_g_kg)
    throw InputError(
        format("the level at {} km has both a relative humidity and a mixing ratio; expected one",
               level.altitude_km));
}

void check_humidity(const UserLevel& level) {
  for (const auto& [value, what] : {std::pair{level.relative_humidity_percent, "relative humidity, %,"},
                                    std::pair{level.mixing_ratio_g_kg, "mixing ratio, g/kg,"},
                                    std::pair{level.ozone_ppmv, "ozone, ppmv,"}})
    if (value && !(*value >= 0.0 && std::isfinite(*value)))
      throw InputError(format("{} of {} at {} km: expected 0 or more", what, *value, level.altitude_km));
}

double vapour_ppmv(const UserLevel& level, const Profile& profile, std::size_t i) {
  if (level.mixing_ratio_g_kg) {
    const double ratio = *level.mixing_ratio_g_kg * 1e-3 * kAirMolarMass / kWaterMolarMass;
    return 1e6 * ratio / (1.0 + ratio);
  }
  const double density = 0.01 * *level.relative_humidity_percent * saturated_vapour_g_m3(level.temperature_K);
  return density / (profile.air_per_cm3(i) * kVapourGramPerPpmvMolecule);
}

/// A relative humidity of the lowest air, said of thin and warm air, is more vapour than there is air.
void check_vapour(const UserLevel& level, double ppmv) {
  if (ppmv >= 1e6)
    throw InputError(
        format("water vapour of {:.3g} hPa at {} km: expected less than the {:.3g} hPa of the air there",
               1e-6 * ppmv * level.pressure_hPa, level.altitude_km, level.pressure_hPa));
}

/// The user's levels with the model's gases, and the model above the last of them, its pressure scaled to
/// join.
Profile with_user_levels(const Profile& model, const std::vector<UserLevel>& levels) {
  if (levels.size() < 2)
    throw InputError("a profile of one level: expected two or more, or none for the model's own");
  Profile profile;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const UserLevel& level = levels[i];
    check_level(level, i > 0 ? &levels[i - 1] : nullptr);
    check_humidity(level);
    profile.altitude_km.push_back(level.altitude_km);
    profile.pressure_hPa.push_back(level.pressure_hPa);
    profile.temperature_K.push_back(level.temperature_K);
    const Profile here = model.between(std::max(level.altitude_km, 0.0), model.altitude_km.back());
    for (std::size_t g = 0; g < kGasCount; ++g)
      profile.mixing_ratio_ppmv[g].push_back(here.mixing_ratio_ppmv[g][0]);
    if (level.relative_humidity_percent || level.mixing_ratio_g_kg)
      profile.of(Gas::h2o)[i] = vapour_ppmv(level, profile, i);
    check_vapour(level, profile.of(Gas::h2o)[i]);
    if (level.ozone_ppmv) profile.of(Gas::o3)[i] = *level.ozone_ppmv;
  }
  const UserLevel& top = levels.back();
  const double join = top.pressure_hPa / model.pressure_at(std::max(top.altitude_km, 0.0));
  for (std::size_t i = 0; i < model.levels(); ++i) {
    if (model.altitude_km[i] <= top.altitude_km) continue;
    profile.altitude_km.push_back(model.altitude_km[i]);
    profile.pressure_hPa.push_back(join * model.pressure_hPa[i]);
    profile.temperature_K.push_back(model.temperature_K[i]);
    for (std::size_t g = 0; g < kGasCount; ++g)
      profile.mixing_ratio_ppmv[g].push_back(model.mixing_ratio_ppmv[g][i]);
  }
  return profile;
}

void scale(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

void require_positive(std::string_view what, const std::optional<double>& value, std::string_view unit) {
  if (value && !(*value >= 0.0 && std::isfinite(*value)))
    throw InputError(format("{} of {} {}: expected 0 or more", what, *value, unit));
}

/// The vapour profile times `factor`, at most saturated where that is asked for.
std::vector<double> scaled_vapour(const Profile& profile, double factor, bool limit) {
  std::vector<double> vapour = profile.of(Gas::h2o);
  for (std::size_t i = 0; i < vapour.size(); ++i) {
    const double humidity = profile.relative_humidity_percent(i);
    const double most = limit && humidity > 0.0 ? std::max(100.0 / humidity, 0.0) : factor;
    vapour[i] *= std::min(factor, most);
  }
  return vapour;
}

void set_water(Profile& profile, double wanted_g_cm2, bool limit, std::vector<std::string>& remarks) {
  const auto column_with = [&](double factor) {
    Profile tried = profile;
    tried.of(Gas::h2o) = scaled_vapour(profile, factor, limit);
    return tried.precipitable_water_g_cm2();
  };
  const double plain = wanted_g_cm2 / profile.precipitable_water_g_cm2();
  double low = plain, high = plain;
  constexpr double kMostFactor = 1e4;
  while (column_with(high) < wanted_g_cm2 * (1.0 - 1e-9) && high < kMostFactor) high *= 2.0;
  for (int step = 0; step < 60 && high > low; ++step) {
    const double middle = 0.5 * (low + high);
    (column_with(middle) < wanted_g_cm2 ? low : high) = middle;
  }
  profile.of(Gas::h2o) = scaled_vapour(profile, high, limit);
  const double reached = profile.precipitable_water_g_cm2();
  if (reached < 0.999 * wanted_g_cm2)
    remarks.push_back(
        format("{:.3g} g/cm2 of water vapour is more than this air can hold: it is saturated everywhere with "
               "{:.3g} g/cm2",
               wanted_g_cm2, reached));
  else if (high > plain * (1.0 + 1e-6))
    remarks.push_back(
        format("with {:.3g} g/cm2 of water vapour the air saturates; relative humidity is kept at 100 % "
               "there and the rest "
               "of the profile is moister instead",
               wanted_g_cm2));
}

double ground_of(const ProfileDescription& description, const Profile& source) {
  const double first = source.altitude_km.front();
  const double ground = description.ground_altitude_km.value_or(description.levels.empty() ? 0.0 : first);
  if (ground < first)
    throw InputError(
        format("the ground at {} km is below the lowest level of the profile, {} km", ground, first));
  if (ground >= kHighestGroundKm)
    throw InputError(format("ground at {} km: expected below {} km", ground, kHighestGroundKm));
  return ground;
}

}  // namespace

BuiltProfile build_profile(const ProfileDescription& description) {
  const Profile& model = model_atmosphere(description.model);
  const GasRequests none, &gases = description.gases ? *description.gases : none;
  const auto request = [&](Gas gas) -> const std::optional<GasRequest>& {
    return gases.of[static_cast<std::size_t>(gas)];
  };
  std::vector<std::string> remarks;
  Profile source = description.levels.empty() ? model : with_user_levels(model, description.levels);
  const double ground_km = ground_of(description, source);
  for (std::size_t g = 0; g < kGasCount; ++g)
    if (gases.of[g] && !gases.of[g]->levels.empty())
      source = with_gas_levels(source, static_cast<Gas>(g), *gases.of[g], ground_km, remarks);
  require_positive("water vapour", description.water_vapour_g_cm2, "g/cm2");
  require_positive("ozone", description.ozone_DU, "DU");
  BuiltProfile built{source.between(ground_km, kTopOfAtmosphereKm), std::move(remarks)};
  Profile& profile = built.profile;
  if (!gases.nitrogen) profile.nitrogen = 0.0;
  for (std::size_t g = 0; g < kGasCount; ++g)
    if (gases.of[g]) scale_gas(profile, static_cast<Gas>(g), *gases.of[g]);
  const auto set_at_ground = [&](Gas gas, std::string_view name, const std::optional<double>& ppm) {
    require_positive(name, ppm, "ppm");
    if (ppm && !request(gas)) scale(profile.of(gas), *ppm / profile.of(gas).front());
  };
  set_at_ground(Gas::co2, "carbon dioxide", description.co2_ppm);
  set_at_ground(Gas::ch4, "methane", description.ch4_ppm);
  set_at_ground(Gas::n2o, "nitrous oxide", description.n2o_ppm);
  const auto require_some = [&](Gas gas, std::string_view name) {
    if (!(profile.column_atm_cm(gas) > 0.0))
      throw InputError(format("the profile has no {} that a column could be scaled from", name));
  };
  if (description.ozone_DU && !request(Gas::o3)) {
    require_some(Gas::o3, "ozone");
    scale(profile.of(Gas::o3), 1e-3 * *description.ozone_DU / profile.column_atm_cm(Gas::o3));
  }
  if (description.limit_humidity) {
    const std::vector<double> limited = scaled_vapour(profile, 1.0, true);
    if (limited != profile.of(Gas::h2o))
      built.remarks.push_back("relative humidity above 100 % in the profile is taken as 100 %");
    profile.of(Gas::h2o) = limited;
  }
  std::optional<double> water_g_cm2 = description.water_vapour_g_cm2;
  if (const auto& asked = request(Gas::h2o)) {
    require_positive("H2O", asked->column_atm_cm, "atm-cm");
    water_g_cm2 =
        asked->column_atm_cm ? std::optional(*asked->column_atm_cm / kVapourAtmCmPerGram) : std::nullopt;
  }
  if (water_g_cm2) {
    require_some(Gas::h2o, "water vapour");
    set_water(profile, *water_g_cm2, description.limit_humidity, built.remarks);
  }
  return built;
}

}  // namespace ifov::atmosphere
