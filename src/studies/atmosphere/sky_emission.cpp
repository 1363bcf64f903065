#include "studies/atmosphere/sky_emission.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/gas/gas_transmittance.h"
#include "atmosphere/gauss_nodes.h"
#include "radiometry/planck.h"

namespace ifov::studies {

using namespace atmosphere;

EmittingColumn::EmittingColumn(const AtmosphereColumn& column, const ModelErrorTable& table)
    : column_(column), table_(table), amounts_(layer_amounts(column.profile(), column.levels().altitude_km)) {
  const std::vector<double>& z = column.levels().altitude_km;
  const Profile& profile = column.profile();
  double water = 0.0;
  for (std::size_t l = 0; l < amounts_.size(); ++l) {
    water += profile.between(z[l], z[l + 1]).precipitable_water_g_cm2();
    water_.push_back(water);
    air_.push_back(1.0 - profile.pressure_at(z[l + 1]) / profile.pressure_at(z.front()));
  }
}

SkyEmission EmittingColumn::towards_ground(double nu, double slant) const {
  const std::vector<double>& z = column_.levels().altitude_km;
  const double um = 1e4 / nu;
  const LayerOptics layers = column_.at(nu).scattering;
  std::vector<double> planck, depth{0.0}, less{0.0};
  for (const double altitude : z)
    planck.push_back(radiometry::planck_w_m2_sr_um(um, column_.profile().temperature_at(altitude)));
  GasAmounts sum = vertical_amounts(column_.profile(), z.front(), z.front());
  double haze = 0.0;
  for (std::size_t l = 0; l < amounts_.size(); ++l) {
    sum.add(amounts_[l], slant);
    haze += slant * layers.aerosol_absorption[l];
    const double gas =
        -std::log(std::max(1e-30, gas_transmittance(nu, sum, column_.description().gas_model)));
    depth.push_back(gas + haze);
    less.push_back(gas + haze - table_.of_depth(um, {slant * air_[l], slant * water_[l], gas, haze}));
  }
  const double radiance = emission_of_levels(planck, depth);
  return {radiance, std::abs(emission_of_levels(planck, less) - radiance)};
}

SkyEmission EmittingColumn::flux(double nu, int count) const {
  const GaussNodes nodes = gauss_nodes(count);
  SkyEmission sum;
  for (std::size_t j = 0; j < nodes.position.size(); ++j) {
    const double share = 2.0 * std::numbers::pi * nodes.weight[j] * nodes.position[j];
    const SkyEmission one = towards_ground(nu, 1.0 / nodes.position[j]);
    sum.radiance += share * one.radiance;
    sum.by_depth += share * one.by_depth;
  }
  return sum;
}

}  // namespace ifov::studies
