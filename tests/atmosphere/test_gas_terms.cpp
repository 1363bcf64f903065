// A table of terms in place of bands: what a column, the bins of channels and the air's error make of it.

#include <gtest/gtest.h>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/profile/gas_requests.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "atmosphere/survey/survey_effects.h"
#include "core/error.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::atmosphere::test_gas_terms {
namespace {

const StateGrid kStates({1.0, 10.0, 100.0, 400.0, 1100.0}, {180.0, 220.0, 270.0, 320.0});

/// Bins of one grey term, the same in all states.
GasTermTable grey(std::vector<TermGas> gases, double first_cm1, double step_cm1, std::size_t bins,
                  double k_cm2, double error = 0.0) {
  GasTermTable table;
  table.name = "grey.gases";
  table.first_cm1 = first_cm1;
  table.step_cm1 = step_cm1;
  table.states = kStates;
  table.gases = std::move(gases);
  for (std::size_t b = 0; b < bins; ++b)
    table.bins.push_back(
        {{1.0},
         std::vector(table.gases.size(), std::vector<float>(kStates.states(), log_cross_section(k_cm2))),
         error});
  return table;
}

AtmosphereDescription without_aerosol(std::optional<GasTermTable> table) {
  AtmosphereDescription description;
  description.aerosol.type = "none";
  if (table) description.gas_terms = std::make_shared<const GasTermTable>(std::move(*table));
  return description;
}

double depth_of(const ColumnOptics& optics) {
  double sum = 0.0;
  for (std::size_t t = 0; t < optics.terms(); ++t)
    for (const double depth : optics.lines.depth[t]) sum += optics.weight(t) * depth;
  return sum;
}

TEST(StateGrid, PowersOfPressureAndBoltzmannsLawComeBack) {
  const auto k = [](double p, double t) { return 1e-22 * std::pow(p, -0.7) * std::exp(900.0 / t); };
  GasTermTable table = grey({{Gas::ch4}}, 4000.0, 1.0, 1, 1.0);
  std::vector<float>& log_k = table.bins[0].log_k[0];
  log_k.clear();
  for (const double p : kStates.pressure_hPa())
    for (const double t : kStates.temperature_K()) log_k.push_back(log_cross_section(k(p, t)));
  for (const double p : {1.0, 3.3, 57.0, 800.0, 1100.0})
    for (const double t : {180.0, 201.0, 300.0, 320.0})
      EXPECT_NEAR(table.bins[0].cross_sections(0, kStates.place(p, t))[0] / k(p, t), 1.0, 1e-5)
          << p << " " << t;
  // Beyond the grid as at its end.
  EXPECT_NEAR(table.bins[0].cross_sections(0, kStates.place(0.01, 400.0))[0] / k(1.0, 320.0), 1.0, 1e-5);
}

TEST(StateGrid, ThinAirIsWithinWhereTheGridReachesThinAir) {
  EXPECT_TRUE(kStates.holds(1e-4, 250.0));
  EXPECT_TRUE(kStates.holds(1105.0, 250.0));
  EXPECT_FALSE(kStates.holds(1150.0, 250.0));
  EXPECT_FALSE(kStates.holds(500.0, 330.0));
  EXPECT_FALSE(StateGrid({100.0, 1000.0}, {250.0}).holds(50.0, 250.0));
}

TEST(GasTermTable, BinsAreOpenAtTheirEnds) {
  const GasTermTable table = grey({{Gas::ch4}}, 4000.0, 2.0, 5, 1.0);
  EXPECT_FALSE(table.bin_at(4000.0));
  EXPECT_FALSE(table.bin_at(4010.0));
  EXPECT_EQ(table.bin_at(4000.1), 0u);
  EXPECT_EQ(table.bin_at(4003.0), 1u);
  EXPECT_EQ(table.bin_at(4009.99), 4u);
  EXPECT_EQ(table.centre_cm1(4), 4009.0);
}

TEST(GasTerms, GreyGasAbsorbsAsMuchAsItsColumnHas) {
  constexpr double kCm2 = 2e-20;
  const AtmosphereColumn air(without_aerosol(grey({{Gas::ch4}}, 5000.0, 1.0, 10, kCm2)));
  const AtmosphereColumn bands(without_aerosol(std::nullopt));
  GasRequests none;
  none.of[static_cast<std::size_t>(Gas::ch4)].emplace().off = true;
  AtmosphereDescription off = without_aerosol(std::nullopt);
  off.air.gases = std::make_shared<const GasRequests>(none);
  const AtmosphereColumn others(off);
  const double column = kLoschmidtCm3 * air.profile().column_atm_cm(Gas::ch4);
  double through = 0.0, through_others = 0.0;
  const ColumnOptics with = air.at(5005.0), without = others.at(5005.0);
  const auto transmittance = [](const ColumnOptics& optics) {
    double sum = 0.0;
    for (std::size_t t = 0; t < optics.terms(); ++t) {
      double depth = 0.0;
      for (const double d : optics.lines.depth[t]) depth += d;
      sum += optics.weight(t) * std::exp(-depth);
    }
    return sum;
  };
  through = transmittance(with), through_others = transmittance(without);
  EXPECT_NEAR(-std::log(through / through_others) / (kCm2 * column), 1.0, 2e-4);
  EXPECT_EQ(with.continuum, without.continuum);
  // Beyond the table the bands hold, to the last bit.
  for (const double nu : {4995.0, 5000.0, 5010.0, 6000.0}) {
    EXPECT_EQ(air.at(nu).lines.depth, bands.at(nu).lines.depth) << nu;
    EXPECT_EQ(air.at(nu).lines.weight, bands.at(nu).lines.weight) << nu;
  }
}

TEST(GasTerms, AGasThatIsOffAbsorbsNothing) {
  AtmosphereDescription description = without_aerosol(grey({{Gas::ch4}, {Gas::co}}, 5000.0, 1.0, 10, 2e-20));
  GasRequests none;
  for (const Gas gas : {Gas::ch4, Gas::co, Gas::h2o, Gas::co2, Gas::n2o})
    none.of[static_cast<std::size_t>(gas)].emplace().off = true;
  description.air.gases = std::make_shared<const GasRequests>(none);
  EXPECT_EQ(depth_of(AtmosphereColumn(description).at(5005.0)), 0.0);
}

TEST(GasTerms, ContinuumIsLeftOutWhereTheSpectraHoldIt) {
  constexpr double kNu = 2400.0;  // the continuum of water, and that of nitrogen
  const AtmosphereColumn bands(without_aerosol(std::nullopt)),
      separate(without_aerosol(grey({{Gas::h2o}}, 2390.0, 5.0, 4, 1e-30))),
      held(without_aerosol(grey({{Gas::h2o, 1.0, true}}, 2390.0, 5.0, 4, 1e-30)));
  const double all = bands.at(kNu).continuum.front(), rest = held.at(kNu).continuum.front();
  EXPECT_EQ(separate.at(kNu).continuum.front(), all);
  EXPECT_GT(rest, 0.0);
  EXPECT_LT(rest, all);
  EXPECT_EQ(held.at(2500.0).continuum.front(), bands.at(2500.0).continuum.front());
}

TEST(GasTerms, SelfBroadeningRaisesThePressure) {
  const Profile& moist = model_atmosphere("tropical");
  const std::vector<double> altitude_km{0.0, 0.5};
  const LayerGas plain = layer_gas(moist, {Gas::h2o}, altitude_km)[0],
                 broadened = layer_gas(moist, {Gas::h2o, 5.0}, altitude_km)[0];
  EXPECT_EQ(plain.molecules_cm2, broadened.molecules_cm2);
  const double share = 1e-6 * 0.5 * (moist.of(Gas::h2o)[0] + moist.between(0.0, 0.5).of(Gas::h2o).back());
  EXPECT_NEAR(broadened.pressure_hPa / plain.pressure_hPa, 1.0 + 4.0 * share, 1e-3);
}

TEST(GasTerms, AnotherAirIsRefusedWithNumbers) {
  GasTermTable thin = grey({{Gas::co2}}, 2300.0, 1.0, 10, 1e-22);
  thin.states = StateGrid({0.01, 1.0, 10.0}, {130.0, 200.0, 280.0});
  thin.bins.assign(10, {{1.0}, {std::vector<float>(thin.states.states(), log_cross_section(1e-22))}, 0.0});
  try {
    const AtmosphereColumn column(without_aerosol(thin));
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"the gas model grey.gases is of another air", "0.01 to 10 hPa", "130 to 280 K",
                             "% of this air's CO2 lies outside"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST(GasTerms, ChannelsAreCutIntoTheBinsOfTheTable) {
  const GasTermTable table = grey({{Gas::ch4}}, 4300.0, 1.0, 60, 1e-22);
  const auto sum = [](const std::vector<ChannelBin>& bins) {
    double all = 0.0;
    for (const ChannelBin& bin : bins) all += bin.share;
    return all;
  };
  const radiometry::Spectrum sun = radiometry::Spectrum::constant(1.0);
  const auto within = radiometry::Channel::top_hat("", 1e4 / 4340.25, 1e4 / 4310.5);
  std::vector<ChannelBin> bins = channel_bins(within, sun, &table);
  ASSERT_EQ(bins.size(), 31u);
  EXPECT_EQ(bins.front().wavenumber_cm1, 4340.5);
  EXPECT_EQ(bins.back().wavenumber_cm1, 4310.5);
  EXPECT_NEAR(bins.front().share / bins[1].share, 0.25, 1e-3);
  EXPECT_NEAR(sum(bins), 1.0, 1e-12);
  for (std::size_t k = 1; k < bins.size(); ++k) EXPECT_GT(bins[k].wavelength_um, bins[k - 1].wavelength_um);
  // Partly outside: bands there, and nothing twice.
  const auto wider = radiometry::Channel::top_hat("", 1e4 / 4380.0, 1e4 / 4290.0);
  bins = channel_bins(wider, sun, &table);
  EXPECT_NEAR(sum(bins), 1.0, 1e-12);
  double inside = 0.0;
  for (const ChannelBin& bin : bins)
    if (table.bin_at(1e4 / bin.wavelength_um)) inside += bin.share;
  EXPECT_NEAR(inside, (1e4 / 4300.0 - 1e4 / 4360.0) / (1e4 / 4290.0 - 1e4 / 4380.0), 1e-9);
  EXPECT_EQ(covered(within, &table), Covered::all);
  EXPECT_EQ(covered(wider, &table), Covered::part);
  EXPECT_EQ(covered(radiometry::Channel::top_hat("", 1.0, 1.1), &table), Covered::nothing);
  EXPECT_EQ(covered(within, nullptr), Covered::nothing);
  const auto line = radiometry::Channel::monochromatic("", 1e4 / 4310.2);
  EXPECT_EQ(channel_bins(line, sun, &table).front().wavenumber_cm1, 4310.5);
  EXPECT_EQ(channel_bins(line, sun).front().wavenumber_cm1, 4310.0);
}

TEST(GasTerms, NarrowChannelsAreResolvedByTheBins) {
  const GasTermTable table = grey({{Gas::ch4}}, 4300.0, 1.0, 60, 1e-22);
  const auto narrow = radiometry::Channel::top_hat("", 1e4 / 4332.0, 1e4 / 4328.0),
             narrower = radiometry::Channel::top_hat("", 1e4 / 4330.5, 1e4 / 4330.0);
  EXPECT_TRUE(narrower_than_resolved(narrow));
  EXPECT_FALSE(narrower_than_resolved(narrow, &table));
  EXPECT_TRUE(narrower_than_resolved(narrower, &table));
}

TEST(GasTerms, StepsOfASpectrumAreTheBins) {
  const GasTermTable table = grey({{Gas::ch4}}, 4300.0, 1.0, 60, 1e-22);
  const auto steps = resolved_steps(1e4 / 4400.0, 1e4 / 4250.0, &table);
  ASSERT_EQ(steps.size(), 60u);
  EXPECT_NEAR(1e4 / steps.front().response.first_um(), 4360.0, 1e-6);
  EXPECT_NEAR(1e4 / steps.back().response.last_um(), 4300.0, 1e-6);
  EXPECT_EQ(resolved_steps(1e4 / 4400.0, 1e4 / 4250.0, &table, 20).size(), 20u);
}

/// What the table says that it is off by is in the air's error.
TEST(GasTerms, TheirErrorIsInThatOfTheAir) {
  const auto errors = [](double error) {
    const AtmosphereColumn column(without_aerosol(grey({{Gas::ch4}}, 4300.0, 2.0, 30, 2e-20, error)));
    const std::vector<radiometry::Channel> channels{
        radiometry::Channel::top_hat("", 1e4 / 4340.0, 1e4 / 4320.0),
        radiometry::Channel::top_hat("", 0.86, 0.865)};
    const std::vector<radiometry::Spectrum> surfaces{radiometry::Spectrum::constant(0.3)};
    SensorAtmosphere::Inputs inputs;
    inputs.channels = channels;
    inputs.solar_irradiance = radiometry::solar_irradiance_1au();
    inputs.surfaces = surfaces;
    inputs.demands.coldest_k = 280.0;
    inputs.demands.hottest_k = 310.0;
    inputs.geometry.sun_zenith_rad = 0.5;
    inputs.geometry.view_zenith_rad = 0.2;
    inputs.scattering.nodes_per_hemisphere = 4;
    inputs.with_errors = true;
    inputs.ground = radiometry::Spectrum::constant(0.3);
    const SensorAtmosphere air(column, inputs);
    return air.errors();
  };
  const std::vector<AtmosphereErrors> none = errors(0.0), some = errors(0.004);
  const double more = some[0].absorption.surface - none[0].absorption.surface;
  // Of a transmittance between what the methane and all else of the way let through, and 1.
  EXPECT_GT(more, 0.004);
  EXPECT_LT(more, 0.04);
  EXPECT_GT(some[0].absorption.path, none[0].absorption.path);
  EXPECT_EQ(some[1].absorption.surface, none[1].absorption.surface);
}

}  // namespace
}  // namespace ifov::atmosphere::test_gas_terms
