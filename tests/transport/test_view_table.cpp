// The air between surfaces and a sensor that has more than one height.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "radiometry/polarization_frame.h"
#include "radiometry/solar_spectrum.h"
#include "transport/sky/ground_around.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"
#include "transport/view_table.h"

namespace ifov::transport::test_view_table {
namespace {

using atmosphere::LineOfSightGrid;
using atmosphere::SensorAltitudes;
using atmosphere::SensorAtmosphere;
using math::Vec3;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLow_km = 0.5, kHigh_km = 4.0;

class ViewTableByHeight : public testing::Test {
 protected:
  static const atmosphere::AtmosphereColumn& column() {
    static const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
    return column;
  }
  /// Surfaces up to `highest_km`; the same spectral nodes whatever the altitudes are.
  static SensorAtmosphere build(SensorAltitudes altitudes, bool polarized = false, double highest_km = 0.4) {
    static const std::vector<radiometry::Channel> channels{
        radiometry::Channel::monochromatic("blue", 0.45),
        radiometry::Channel::gaussian("thermal", 10.0, 0.3)};
    SensorAtmosphere::Inputs inputs;
    inputs.channels = channels;
    inputs.solar_irradiance = radiometry::solar_irradiance_1au();
    inputs.geometry.sun_zenith_rad = 50.0 * kDegree;
    inputs.geometry.sensor_altitude_km = kHigh_km;
    inputs.scattering.nodes_per_hemisphere = 6;
    inputs.lines_of_sight = LineOfSightGrid({-0.6, 0.5, 0.0, 0.55, highest_km}, column().levels(), altitudes);
    inputs.polarized = polarized;
    return SensorAtmosphere(column(), inputs);
  }
  struct Seen {
    double through = 0.0, added = 0.0;
  };
  static Seen seen(const ViewTable& table, std::size_t node, Vec3 towards, double height_m, double sensor_m) {
    const ViewTable::Weights place = table.at(towards, height_m, sensor_m);
    Seen sum;
    for (std::size_t k = 0; k < place.count; ++k) {
      sum.through += static_cast<double>(place.weight[k]) * static_cast<double>(place.transmittance[k][node]);
      sum.added += static_cast<double>(place.weight[k]) * static_cast<double>(place.radiance[k][node]);
    }
    return sum;
  }
  static std::vector<Vec3> directions() {
    std::vector<Vec3> all;
    for (const auto& [along, across] :
         {std::pair{0.0, 0.0}, {0.3, 0.1}, {-0.55, 0.4}, {0.01, -0.35}, {0.5, 0.55}})
      all.push_back(math::normalized({along, across, 1.0}));
    return all;
  }

  const Vec3 towards_sun_{std::sin(50.0 * kDegree), 0.0, std::cos(50.0 * kDegree)};
};

TEST_F(ViewTableByHeight, EachPoseHasTheTableOfThatPoseAlone) {
  const SensorAtmosphere both = build({kLow_km, kHigh_km}), low = build({kLow_km, kLow_km}),
                         high = build({kHigh_km, kHigh_km});
  ASSERT_EQ(both.node_count(), low.node_count());
  ASSERT_EQ(both.node_count(), high.node_count());
  GroundAround ground;
  for (std::size_t n = 0; n < both.node_count(); ++n)
    ground.even.push_back(1.0 + 0.1 * static_cast<double>(n));
  const ViewTable table(both, towards_sun_, ground), of_low(low, towards_sun_, ground),
      of_high(high, towards_sun_, ground);
  double apart = 0.0;
  for (const Vec3 towards : directions())
    for (const double height_m : {0.0, 130.0, 400.0})
      for (std::size_t n = 0; n < both.node_count(); ++n)
        for (const bool up : {false, true}) {
          const Seen own = seen(table, n, towards, height_m, 1e3 * (up ? kHigh_km : kLow_km));
          // Of one pose: wherever the sensor is said to be.
          const Seen alone = seen(up ? of_high : of_low, n, towards, height_m, 12345.0);
          EXPECT_NEAR(own.through, alone.through, 1e-7 * alone.through) << up << ' ' << height_m;
          EXPECT_NEAR(own.added, alone.added, 1e-7 * alone.added) << up << ' ' << height_m;
          const Seen other = seen(up ? of_low : of_high, n, towards, height_m, 0.0);
          apart = std::max(apart, std::abs(own.added / other.added - 1.0));
        }
  EXPECT_GT(apart, 0.5) << "the poses differ, or this test could not fail";
}

TEST_F(ViewTableByHeight, OnePoseTakesAsManyRowsAsBefore) {
  const SensorAtmosphere one = build({kHigh_km, kHigh_km}), flat = build({kHigh_km, kHigh_km}, false, 0.0),
                         both = build({kLow_km, kHigh_km});
  const GroundAround black{std::vector<double>(one.node_count(), 0.0), {}};
  const Vec3 towards = math::normalized({0.2, 0.1, 1.0});
  EXPECT_EQ(ViewTable(one, towards_sun_, black).at(towards, 100.0, 4000.0).count, 4u);
  EXPECT_EQ(ViewTable(flat, towards_sun_, black).at(towards, 100.0, 4000.0).count, 3u);
  EXPECT_EQ(ViewTable(both, towards_sun_, black).at(towards, 100.0, 2000.0).count, 5u);
  float sum = 0.0f;
  for (const float weight : ViewTable(both, towards_sun_, black).at(towards, 100.0, 2000.0).weight)
    sum += weight;
  EXPECT_NEAR(sum, 1.0f, 1e-6f);
}

// Between its poses, at altitudes that are none of the column's levels.
TEST_F(ViewTableByHeight, BetweenPosesItIsNearWhatIsThere) {
  const SensorAtmosphere both = build({kLow_km, kHigh_km});
  const GroundAround black{std::vector<double>(both.node_count(), 0.0), {}};
  const ViewTable table(both, towards_sun_, black);
  for (const double altitude_km : {0.7, 1.4, 3.3}) {
    const SensorAtmosphere there = build({altitude_km, altitude_km});
    const ViewTable exact(there, towards_sun_, black);
    for (const Vec3 towards : directions())
      for (std::size_t n = 0; n < both.node_count(); ++n) {
        const Seen given = seen(table, n, towards, 200.0, 1e3 * altitude_km),
                   right = seen(exact, n, towards, 200.0, 0.0);
        EXPECT_NEAR(given.through / right.through, 1.0, 0.012) << altitude_km;
        EXPECT_NEAR(given.added / right.added, 1.0, 0.03) << altitude_km;
      }
  }
}

TEST_F(ViewTableByHeight, PolarizationFollows) {
  const SensorAtmosphere both = build({kLow_km, kHigh_km}, true), low = build({kLow_km, kLow_km}, true);
  const GroundAround black{std::vector<double>(both.node_count(), 0.0), {}};
  const ViewTable table(both, towards_sun_, black), alone(low, towards_sun_, black);
  std::vector<radiometry::StokesVector> a(both.node_count()), b(both.node_count()), other(both.node_count());
  double apart = 0.0;
  for (const Vec3 towards : directions()) {
    table.stokes(towards, 100.0, 1e3 * kLow_km, a);
    alone.stokes(towards, 100.0, 0.0, b);
    table.stokes(towards, 100.0, 1e3 * kHigh_km, other);
    EXPECT_NEAR(a[0].q, b[0].q, 1e-6 * b[0].i);
    EXPECT_NEAR(a[0].u, b[0].u, 1e-6 * b[0].i);
    apart = std::max(apart, std::abs(a[0].q - other[0].q) / b[0].i);
  }
  EXPECT_GT(apart, 0.01);
}

// Paths are seen through the air below the point that their ray started from.
TEST_F(ViewTableByHeight, PathsTakeTheAirOfTheirOwnSensor) {
  const SensorAtmosphere both = build({kLow_km, kHigh_km}), low = build({kLow_km, kLow_km}),
                         high = build({kHigh_km, kHigh_km});
  const auto radiance = [&](const SensorAtmosphere& air, double from_m) {
    test::SmallScene scene;
    scene.place(geometry::Plane{}, scene.material(0.3, 300.0));
    scene.build();
    scene.scene().sun.emplace().direction = towards_sun_;
    scene.scene().sun->irradiance = radiometry::solar_irradiance_1au();
    const SpectralScene spectral(scene.scene(), air);
    PathTracer tracer(spectral, {});
    const math::Vec3 towards = math::normalized({0.3, 0.1, 1.0});
    const math::Ray ray{.origin_m = math::Point3{} + towards * (from_m / towards.z), .direction = -towards};
    const PathKey key{3, 1};
    geometry::SurfacePoint hit;
    sampling::RayCounts counts;
    const PathRecord& paths = tracer.trace({&ray, 1}, {&key, 1}, {&hit, 1}, counts);
    PathLight light(spectral);
    float* nodes = light.radiance(paths, 0);
    ViewAtmosphere(spectral).apply(paths.paths[0], nodes);
    return std::vector<float>(nodes, nodes + spectral.node_count());
  };
  const std::vector<float> from_low = radiance(both, 1e3 * kLow_km),
                           from_high = radiance(both, 1e3 * kHigh_km),
                           right_low = radiance(low, 1e3 * kLow_km),
                           right_high = radiance(high, 1e3 * kHigh_km);
  for (std::size_t n = 0; n < from_low.size(); ++n) {
    EXPECT_NEAR(from_low[n], right_low[n], 1e-5f * right_low[n]);
    EXPECT_NEAR(from_high[n], right_high[n], 1e-5f * right_high[n]);
  }
  EXPECT_GT(std::abs(from_high[0] / from_low[0] - 1.0f), 0.05f);
}

TEST(SensorAltitudes, AreOneWhereTheSensorFliesLevelOrBeyondTheAir) {
  const atmosphere::AtmosphereColumn column{atmosphere::AtmosphereDescription{}};
  const auto known = [&](double low_km, double high_km) {
    return atmosphere::LineOfSightAxis::sensors(column.levels(), {low_km, high_km}).known();
  };
  EXPECT_EQ(known(3.0, 3.0), std::vector{3.0});
  EXPECT_EQ(known(3.0, 3.0 + 1e-4), std::vector{3.0});
  EXPECT_EQ(known(500.0, 700.0), std::vector{500.0});
  const std::vector<double> through = known(1.25, 700.0);
  EXPECT_EQ(through.front(), 1.25);
  EXPECT_EQ(through.back(), 100.0);
  EXPECT_GT(through.size(), 20u) << "the column's levels between";
  EXPECT_TRUE(std::is_sorted(through.begin(), through.end()));
}

}  // namespace
}  // namespace ifov::transport::test_view_table
