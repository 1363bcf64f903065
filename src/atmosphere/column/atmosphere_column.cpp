#include "atmosphere/column/atmosphere_column.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/column/light_limits.h"
#include "atmosphere/gas/column_terms.h"
#include "atmosphere/particles/rayleigh.h"
#include "atmosphere/profile/column_integral.h"
#include "atmosphere/scattering/phase/phase_function.h"
#include "core/error.h"

namespace ifov::atmosphere {
namespace {

Levels levels_of(const Profile& profile, std::vector<double> extra, const AerosolColumn& aerosol) {
  extra.insert(extra.end(), aerosol.boundaries_km().begin(), aerosol.boundaries_km().end());
  Levels levels;
  for (const double altitude : level_altitudes_km(profile.ground_km(), extra)) {
    levels.altitude_km.push_back(altitude);
    levels.pressure_hPa.push_back(profile.pressure_at(altitude));
    levels.temperature_K.push_back(profile.temperature_at(altitude));
  }
  return levels;
}

}  // namespace

std::vector<double> level_altitudes_km(double ground_km, const std::vector<double>& extra) {
  std::vector<double> altitudes;
  for (const double above : {0.0, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5})
    altitudes.push_back(ground_km + above);
  for (const double altitude :
       {3.0,  3.5,  4.0,  4.5,  5.0,  6.0,  7.0,  8.0,  9.0,  10.0, 11.0, 12.0, 13.0, 14.0,
        15.0, 16.0, 17.0, 18.0, 19.0, 20.0, 22.0, 24.0, 26.0, 28.0, 30.0, 32.5, 35.0, 37.5,
        40.0, 42.5, 45.0, 47.5, 50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 90.0, 100.0})
    if (altitude > altitudes.back() + 0.3) altitudes.push_back(altitude);
  for (const double altitude : extra) {
    if (!(altitude >= ground_km && altitude <= kTopOfAtmosphereKm))
      throw InputError(
          format("a level at {} km: expected {} to {} km", altitude, ground_km, kTopOfAtmosphereKm));
    const auto above = std::lower_bound(altitudes.begin(), altitudes.end(), altitude);
    constexpr double kSame_km = 1e-6;
    const bool there = *above - altitude < kSame_km ||
                       (above != altitudes.begin() && altitude - *std::prev(above) < kSame_km);
    if (!there) altitudes.insert(above, altitude);
  }
  return altitudes;
}

AtmosphereColumn::AtmosphereColumn(const AtmosphereDescription& description, const ColumnOptions& options)
    : description_(description),
      options_(options),
      built_(build_profile(description.air)),
      aerosol_(description.aerosol, built_.profile, description.air.model),
      levels_(levels_of(built_.profile, options.extra_altitudes_km, aerosol_)),
      gases_(layer_amounts(built_.profile, levels_.altitude_km)) {
  const Profile& profile = built_.profile;
  if (description.gas_terms)
    terms_ = std::make_shared<const ColumnTerms>(description.gas_terms, profile, levels_.altitude_km);
  std::vector<double> air(profile.levels());
  for (std::size_t i = 0; i < air.size(); ++i) air[i] = 1e5 * profile.air_per_cm3(i);
  for (std::size_t l = 0; l < levels_.layers(); ++l) {
    const double low = levels_.altitude_km[l], high = levels_.altitude_km[l + 1];
    air_molecules_cm2_.push_back(column_integral(profile.altitude_km, air, low, high));
    aerosol_550_.emplace_back();
    for (std::size_t r = 0; r < aerosol_.regions(); ++r)
      aerosol_550_.back().push_back(aerosol_.thickness_550(r, low, high));
  }
}

ColumnOptics AtmosphereColumn::at(double wavenumber_cm1) const {
  if (!(wavenumber_cm1 >= 200.0 && wavenumber_cm1 <= 50000.0))
    throw InputError(format("the atmosphere at {} cm-1: expected 200 to 50000 cm-1", wavenumber_cm1));
  ColumnOptics optics;
  optics.wavenumber_cm1 = wavenumber_cm1;
  optics.wavelength_um = 1e4 / wavenumber_cm1;
  const bool warm = optics.wavelength_um >= kFirstThermal_um;
  const std::optional<std::size_t> bin =
      terms_ != nullptr ? terms_->table().bin_at(wavenumber_cm1) : std::nullopt;
  if (bin) optics.terms_error = terms_->table().bins[*bin].error;
  const std::vector<Gas> tabulated = bin ? terms_->gases() : std::vector<Gas>();
  optics.lines =
      line_absorption(wavenumber_cm1, gases_, description_.gas_model,
                      warm ? std::max(options_.terms, options_.warm_terms) : options_.terms,
                      warm ? std::max(options_.most_terms, options_.most_warm_terms) : options_.most_terms,
                      bin ? std::optional(terms_->at(*bin)) : std::nullopt, tabulated);
  const double co2_ppm = built_.profile.of(Gas::co2).front();
  const double cross_section = rayleigh_cross_section_cm2(optics.wavelength_um, co2_ppm);
  LayerOptics& layers = optics.scattering;
  layers.depolarization =
      description_.depolarization.value_or(rayleigh_depolarization(optics.wavelength_um, co2_ppm));
  std::vector<AerosolProperties> properties;
  const auto phases = std::make_shared<AerosolPhases>();
  for (std::size_t r = 0; r < aerosol_.regions(); ++r) {
    properties.push_back(aerosol_.properties(r, optics.wavelength_um));
    phases->functions.push_back(aerosol_.phase_function(r, optics.wavelength_um));
  }
  for (std::size_t l = 0; l < levels_.layers(); ++l) {
    ContinuumDepths continuum = continuum_depths(wavenumber_cm1, gases_[l], description_.gas_model);
    if (bin) terms_->leave_out(continuum);
    optics.continuum.push_back(continuum.total());
    layers.rayleigh_scattering.push_back(cross_section * air_molecules_cm2_[l]);
    double scattering = 0.0, absorption = 0.0, forward = 0.0, cloud_scattering = 0.0, cloud_absorption = 0.0;
    std::vector<double> scattered_by;
    for (std::size_t r = 0; r < properties.size(); ++r) {
      const double scattered =
          aerosol_550_[l][r] * std::max(properties[r].extinction - properties[r].absorption, 0.0);
      scattered_by.push_back(scattered);
      scattering += scattered;
      forward += scattered * properties[r].asymmetry;
      absorption += aerosol_550_[l][r] * properties[r].absorption;
      if (r < aerosol_.first_cloud()) continue;
      cloud_scattering += scattered;
      cloud_absorption += aerosol_550_[l][r] * properties[r].absorption;
    }
    if (aerosol_.cloudy()) {
      layers.cloud_scattering.push_back(cloud_scattering);
      layers.cloud_absorption.push_back(cloud_absorption);
    }
    layers.aerosol_scattering.push_back(scattering);
    layers.aerosol_absorption.push_back(absorption);
    layers.aerosol_asymmetry.push_back(scattering > 0.0 ? forward / scattering : 0.0);
    for (const double scattered : scattered_by)
      phases->share.push_back(scattering > 0.0 ? scattered / scattering : 0.0);
  }
  if (!aerosol_.empty()) layers.aerosol_phases = phases;
  return optics;
}

LayerOptics ColumnOptics::term(std::size_t term) const {
  LayerOptics layers = scattering;
  layers.gas_absorption = continuum;
  for (std::size_t l = 0; l < continuum.size(); ++l) layers.gas_absorption[l] += lines.depth[term][l];
  return layers;
}

}  // namespace ifov::atmosphere
