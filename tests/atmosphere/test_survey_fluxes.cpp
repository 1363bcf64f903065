// What the survey of the air tells of fluxes, of polarization and over ground that reflects.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/particles/given_particles.h"
#include "atmosphere/particles/particle_layer.h"
#include "atmosphere/profile/gas_requests.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "atmosphere/survey/survey_effects.h"
#include "column_maker.h"
#include "measured.h"
#include "radiometry/solar_spectrum.h"
#include "support/truth_data.h"

namespace ifov::atmosphere::test_survey_fluxes {
namespace {

using radiometry::Channel;
using radiometry::Spectrum;
using test::kDegree;

/// Without water vapour, ozone and nitrogen dioxide air absorbs nothing in the blue. `haze`: depth of particles that absorb nothing either.
AtmosphereColumn lossless(double haze, std::optional<double> depolarization = {}) {
  AtmosphereDescription description;
  description.depolarization = depolarization;
  description.air.ozone_DU = 0.0;
  description.air.water_vapour_g_cm2 = 0.0;
  GasRequests gases;
  gases.of[static_cast<std::size_t>(Gas::no2)].emplace().off = true;
  description.air.gases = std::make_shared<const GasRequests>(gases);
  description.aerosol.type = "none";
  if (haze > 0.0) {
    ParticleLayer layer;
    layer.optical_depth = haze;
    layer.particles =
        std::make_shared<const GivenParticles>(1.0, Spectrum::constant(1.0), Spectrum::constant(0.7));
    description.aerosol = {};
    description.aerosol.stratosphere = "none";
    description.aerosol.own = {std::make_shared<const ParticleLayer>(layer)};
  }
  return AtmosphereColumn(description);
}

SensorGeometry geometry(double sun_deg, double sensor_km, double view_deg = 0.0, double azimuth_deg = 0.0) {
  SensorGeometry geometry;
  geometry.sun_zenith_rad = sun_deg * kDegree;
  geometry.sensor_altitude_km = sensor_km;
  geometry.view_zenith_rad = view_deg * kDegree;
  geometry.view_azimuth_rad = azimuth_deg * kDegree;
  return geometry;
}

AtmosphereEffects survey(const AtmosphereColumn& air, const Channel& channel, const SensorGeometry& where,
                         double ground = 0.0) {
  SurveyControl control;
  control.ground = radiometry::Spectrum::constant(ground);
  return survey_effects(air, {&channel, 1}, radiometry::solar_irradiance_1au(), where, control).front();
}

Channel blue() { return Channel::top_hat("blue", 0.4195, 0.4205); }

/// What goes down through the sensor's level less what goes up.
double net_at_sensor(const AtmosphereEffects& of) {
  return of.over_ground.sensor_direct + of.over_ground.sensor_diffuse - of.over_ground.sensor_up;
}
double net_at_ground(const AtmosphereEffects& of) {
  return of.direct_irradiance + of.over_ground.ground_diffuse - of.over_ground.ground_up;
}

/// The largest difference of the fluxes through a level and what the ground keeps, over the Sun's. `lost`: of what goes up.
double imbalance(const AtmosphereColumn& air, double lost = 0.0) {
  double worst = 0.0;
  for (const double sun_deg : {20.0, 60.0})
    for (const double sensor_km : {0.3, 3.0, 100.0})
      for (const double ground : {0.0, 0.8}) {
        const AtmosphereEffects of = survey(air, blue(), geometry(sun_deg, sensor_km), ground);
        const double above = of.solar_irradiance * std::cos(sun_deg * kDegree);
        const double net = net_at_sensor(of) + lost * of.over_ground.sensor_up;
        worst = std::max(worst, std::abs(net - net_at_ground(of)) / above);
        if (sensor_km == 100.0) {
          EXPECT_NEAR(of.over_ground.sensor_direct / above, 1.0, 1e-6);
          EXPECT_LT(of.over_ground.sensor_diffuse, 1e-6 * above);
        }
      }
  return worst;
}

TEST(SurveyFluxes, AirThatAbsorbsNothingKeepsNothing) {
  for (const double haze : {0.0, 0.4}) {
    const double worst = imbalance(lossless(haze));
    RecordProperty(haze > 0.0 ? "haze" : "molecules", std::to_string(worst));
    EXPECT_LT(worst, 2e-3) << haze;
  }
  EXPECT_GT(imbalance(lossless(0.0), 0.03), 4e-3) << "3 % of what goes up may be missing";
}

// Vermote, Tanre et al. (1997), the subroutine CSALBR of 6S, and their transmittance of molecules.
TEST(SurveyFluxes, MoleculesAreAs6SHasThem) {
  for (const double wavelength_um : {0.42, 0.55, 0.67}) {
    const AtmosphereColumn air = lossless(0.0);
    const Channel channel = Channel::top_hat("narrow", wavelength_um - 5e-4, wavelength_um + 5e-4);
    const double tau = test::rayleigh_depth(wavelength_um);
    double e3 = 0.0;  // exponential integral
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
      const double mu = (k + 0.5) / kSteps;
      e3 += mu * std::exp(-tau / mu) / kSteps;
    }
    const AtmosphereEffects of = survey(air, channel, geometry(40.0, 100.0, 40.0));
    const double albedo = (3.0 * tau - e3 * (4.0 + 2.0 * tau) + 2.0 * std::exp(-tau)) / (4.0 + 3.0 * tau);
    EXPECT_NEAR(of.spherical_albedo, albedo, 0.003) << wavelength_um;
    const double mu = std::cos(40.0 * kDegree);
    const double through = (2.0 / 3.0 + mu + (2.0 / 3.0 - mu) * std::exp(-tau / mu)) / (4.0 / 3.0 + tau);
    const double down = (of.direct_irradiance + of.solar_sky) / (of.solar_irradiance * mu);
    EXPECT_NEAR(down, through, 0.01) << wavelength_um;
    EXPECT_NEAR(of.view_transmittance + of.diffuse_transmittance, through, 0.01) << wavelength_um;
  }
}

/// One wavelength and term after the other, solved in full, over ground of a reflectance.
struct Full {
  double up = 0.0, down = 0.0, radiance = 0.0, q = 0.0, u = 0.0;
  void add(const ColumnSolution& solved, double weight, const SensorGeometry& where, double ground) {
    const double mu = std::cos(where.view_zenith_rad), sensor = where.sensor_altitude_km;
    const FluxProfile::Fluxes at_ground = solved.sunlit().fluxes().at(0.0),
                              here = solved.sunlit().fluxes().at(sensor);
    const double exitance = ground * (at_ground.direct_down + at_ground.diffuse_down) /
                            (1.0 - ground * solved.spherical_albedo());
    const ColumnSolution::GroundFlux share = solved.ground_flux(sensor);
    up += weight * (here.up + share.up * exitance);
    down += weight * (here.diffuse_down + share.down * exitance);
    const PathLight path =
        solved.sunlit().line_of_sight({mu, -where.view_azimuth_rad - std::numbers::pi}, sensor, 0.0);
    StokesVector light = path.radiance();
    const double leaving = exitance / std::numbers::pi;
    light += leaving * solved.diffuse_transmittance(mu, sensor);
    light.i += leaving * path.transmittance;
    radiance += weight * light.i;
    q += weight * light.q;
    u += weight * light.u;
  }
};

// Bands of water vapour and next to none, from within the air and from above it, over dark and bright ground.
TEST(SurveyFluxes, AgreeWithFullSolutionsOfEveryTerm) {
  AtmosphereDescription description;
  description.aerosol.type = "rural";
  const AtmosphereColumn air(description);
  const ColumnSolver solver;
  ifov::test::Measured fluxes, radiances;
  for (const Channel& channel :
       {Channel::top_hat("water", 0.936, 0.939), Channel::top_hat("blue", 0.4700, 0.4705)})
    for (const auto& [sensor_km, azimuth_deg] : {std::pair{2.0, -60.0}, std::pair{100.0, 60.0}}) {
      const SensorGeometry where = geometry(50.0, sensor_km, 30.0, azimuth_deg);
      Full dark, bright;
      for (const ChannelBin& bin : channel_bins(channel, radiometry::solar_irradiance_1au())) {
        const ColumnOptics optics = air.at(bin.wavenumber_cm1);
        for (std::size_t term = 0; term < optics.terms(); ++term) {
          const ColumnSolution solved = solver.solve(air.levels(), optics.term(term), *where.sun_zenith_rad);
          const double weight = bin.share * optics.weight(term) * bin.irradiance;
          dark.add(solved, weight, where, 0.1);
          bright.add(solved, weight, where, 0.6);
        }
      }
      for (const bool is_bright : {false, true}) {
        const Full& full = is_bright ? bright : dark;
        const AtmosphereEffects of = survey(air, channel, where, is_bright ? 0.6 : 0.1);
        const AtmosphereEffects::OverGround& found = of.over_ground;
        fluxes.add(channel.centre_um, found.sensor_up / full.up, 1.0);
        fluxes.add(channel.centre_um, (found.sensor_diffuse - full.down) / found.sensor_direct, 0.0);
        radiances.add(channel.centre_um, found.radiance / full.radiance, 1.0);
        radiances.add(channel.centre_um, (found.q - full.q) / full.radiance, 0.0);
        radiances.add(channel.centre_um, (found.u - full.u) / full.radiance, 0.0);
      }
    }
  fluxes.record("fluxes");
  radiances.record("radiances");
  EXPECT_LT(fluxes.largest(), 0.01) << fluxes.text();
  EXPECT_LT(radiances.largest(), 0.005) << radiances.text();
}

// Natraj et al. (2009): molecules of depth 0.5 that do not depolarize, in flat layers, 78 degrees from the Sun. Ours are
// round.
TEST(SurveyFluxes, PolarizationOfMoleculesIsNatrajs) {
  struct Row {
    double mu, phi_deg, i, q, u;
  };
  const auto file = ifov::test::truth_file("atmosphere/rayleigh_polarized/coulson_natraj_tau0.5_mu0_0.2.csv");
  if (!file) GTEST_SKIP() << "reference data not found";
  std::ifstream stream(*file);
  std::string line;
  const AtmosphereColumn air = lossless(0.0, 0.0);
  double low = 0.3, high = 0.45;
  while (high - low > 1e-6)
    (test::rayleigh_depth(0.5 * (low + high)) > 0.5 ? low : high) = 0.5 * (low + high);
  const Channel channel = Channel::top_hat("half", low - 5e-4, low + 5e-4);
  int rows = 0;
  while (std::getline(stream, line)) {
    double albedo = 0.0;
    Row row{};
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &albedo, &row.mu, &row.phi_deg, &row.i, &row.q,
                    &row.u) != 6 ||
        row.mu < 0.3)
      continue;
    ++rows;
    SensorGeometry where =
        geometry(std::acos(0.2) / kDegree, 100.0, std::acos(row.mu) / kDegree, 180.0 - row.phi_deg);
    const AtmosphereEffects of = survey(air, channel, where, albedo);
    const double scale = std::numbers::pi / of.solar_irradiance;
    const AtmosphereEffects::OverGround& found = of.over_ground;
    EXPECT_NEAR(scale * found.radiance / row.i, 1.0, 0.025) << line;
    EXPECT_NEAR(scale * found.q, -row.q, 0.02 * std::abs(row.q) + 1e-3)
        << line;  // the table has the other sign of Q
    EXPECT_NEAR(scale * found.u, row.u, 0.02 * std::abs(row.u) + 1e-3) << line;
  }
  EXPECT_EQ(rows, 8);
}

}  // namespace
}  // namespace ifov::atmosphere::test_survey_fluxes
