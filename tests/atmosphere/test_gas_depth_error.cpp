// What a gas model says its spectra are off by, in the error of the model of the air.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/sensor/channel_bins.h"
#include "atmosphere/sensor/model_error.h"
#include "atmosphere/sensor/model_error_table.h"
#include "atmosphere/sensor/sensor_geometry.h"
#include "radiometry/solar_spectrum.h"

namespace ifov::atmosphere::test_gas_depth_error {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Methane in two terms; at every state the same.
std::shared_ptr<const GasTermTable> methane(double first_cm1, double factor,
                                            std::optional<double> depth_error) {
  auto table = std::make_shared<GasTermTable>();
  table->name = "methane";
  table->first_cm1 = first_cm1;
  table->step_cm1 = 5.0;
  table->states = StateGrid({1.0, 1080.0}, {180.0, 320.0});
  table->gases = {{Gas::ch4, 1.0, false, depth_error}};
  TermBin bin{{0.7, 0.3}, {{}}, 0.0};
  for (int state = 0; state < 4; ++state)
    for (const double k : {2e-21, 6e-20}) bin.log_k[0].push_back(log_cross_section(factor * k));
  table->bins.assign(8, bin);
  return table;
}

ChannelModelError error_of(double um, double factor, std::optional<double> depth_error, double by_bands,
                           double air = 0.0) {
  AtmosphereDescription description;
  description.aerosol.type = "none";
  description.gas_terms = methane(1e4 / um - 20.0, factor, depth_error);
  const AtmosphereColumn column(description);
  const radiometry::Channel channel = radiometry::Channel::top_hat("", um - 1e-3 * um, um + 1e-3 * um);
  const std::vector<ChannelBin> bins =
      channel_bins(channel, radiometry::solar_irradiance_1au(), column.gas_terms());
  const BinOptics optics(column, std::span(&bins, 1), 1);
  SensorGeometry geometry;
  geometry.sun_zenith_rad = 50.0 * kDegree;
  geometry.view_zenith_rad = 30.0 * kDegree;
  const ModelErrorTable table({{0.2, 50.0, air, 0.0, by_bands, 0.0, 0.0, 0.0, 0.0}});
  return channel_model_error(column, bins, optics, geometry, table);
}

double emitted(double um, double factor) { return error_of(um, factor, 0.0, 0.0).emission; }

}  // namespace

// Spectra that are a tenth too strong: what is stated is what spectra without that tenth would show. Planted: a hundredth.
TEST(GasDepthError, IsWhatWeakerSpectraWouldShow) {
  AtmosphereDescription description;
  const AtmosphereColumn column(description);
  double molecules = 0.0;
  for (const LayerGas& layer : layer_gas(column.profile(), {Gas::ch4}, column.levels().altitude_km))
    molecules += layer.molecules_cm2 / std::cos(30.0 * kDegree);
  const auto through = [&](double factor) {
    return 0.7 * std::exp(-2e-21 * factor * molecules) + 0.3 * std::exp(-6e-20 * factor * molecules);
  };
  const double right = through(0.9) / through(1.0) - 1.0;
  EXPECT_GT(right, 0.01);
  EXPECT_NEAR(error_of(2.3, 1.0, 0.1, 0.0).surface, right, 1e-3 * right);
  EXPECT_LT(error_of(2.3, 1.0, 0.01, 0.0).surface, 0.2 * right);
  const double less = emitted(11.0, 0.9) - emitted(11.0, 1.0);
  EXPECT_GT(std::abs(less), 0.01);
  EXPECT_NEAR(error_of(11.0, 1.0, 0.1, 0.0).emission_less, less, 1e-3 * std::abs(less));
}

TEST(GasDepthError, TakesThePlaceOfThatOfTheBands) {
  const ChannelModelError said = error_of(2.3, 1.0, 0.02, 0.4),
                          unsaid = error_of(2.3, 1.0, std::nullopt, 0.4);
  EXPECT_GT(unsaid.surface, 4.0 * said.surface);
  EXPECT_TRUE(unsaid.of_bands);
  EXPECT_FALSE(said.of_bands);
  // What has no lines in the model at all stays.
  EXPECT_GT(error_of(2.3, 1.0, 0.02, 0.4, 0.05).surface, said.surface + 0.04);
}

}  // namespace ifov::atmosphere::test_gas_depth_error
