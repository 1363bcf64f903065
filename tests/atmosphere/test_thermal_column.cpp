#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/linear_source.h"
#include "atmosphere/thermal/thermal_column.h"
#include "radiometry/planck.h"

namespace test_thermal_column {
using namespace ifov::atmosphere;

namespace {

constexpr double kPi = std::numbers::pi;

/// Air whose extinction falls by exp(-z / scale) and whose Planck radiance follows a temperature profile.
struct Air {
  double depth = 1.0, scale_km = 2.0, wavelength_um = 10.0;
  bool isothermal = false;
  double temperature_k(double z) const { return isothermal ? 280.0 : std::max(220.0, 294.0 - 6.0 * z); }
  double planck(double z) const {
    return ifov::radiometry::planck_w_m2_sr_um(wavelength_um, temperature_k(z));
  }
  double depth_between(double low, double high) const {
    return depth * (std::exp(-low / scale_km) - std::exp(-high / scale_km));
  }

  /// Layers as a solver has them: thin at the ground.
  std::vector<double> levels() const {
    std::vector<double> z{0.0, 0.05, 0.1, 0.25, 0.5};
    while (z.back() < 20.0) z.push_back(std::min(20.0, z.back() + (z.back() < 3.0 ? 0.5 : 1.0)));
    return z;
  }
};

struct Solved {
  std::vector<double> altitude, planck, depth;
  explicit Solved(const Air& air, std::vector<double> levels) : altitude(std::move(levels)) {
    for (double z : altitude) planck.push_back(air.planck(z));
    for (std::size_t i = 0; i + 1 < altitude.size(); ++i) {
      depth.push_back(air.depth_between(altitude[i], altitude[i + 1]));
    }
  }
  ThermalColumn column() const { return {altitude, planck, depth}; }
};

/// Sky radiance at the ground by brute force, in 40,000 thin layers.
double sky_by_sum(const Air& air, double mu) {
  double sky = 0.0, depth = 0.0;
  constexpr int kSteps = 40000;
  for (int i = 0; i < kSteps; ++i) {
    // Layers of equal depth, so that opaque air is resolved.
    const double total = air.depth_between(0.0, 20.0);
    const double low = -air.scale_km * std::log(1.0 - total / air.depth * i / kSteps);
    const double high = -air.scale_km * std::log(1.0 - total / air.depth * (i + 1) / kSteps);
    const double step = total / kSteps / mu;
    sky += air.planck(0.5 * (low + high)) * std::exp(-depth) * -std::expm1(-step);
    depth += step;
  }
  return sky;
}

}  // namespace

TEST(ThermalColumn, IsothermalColumnOverGroundOfItsTemperatureIsPlanck) {
  Air air;
  air.isothermal = true;
  for (double depth : {1e-6, 0.3, 5.0, 1e5}) {
    air.depth = depth;
    const Solved solved(air, air.levels());
    const double planck = air.planck(0.0);
    const GaussNodes nodes = gauss_nodes(8);
    const ThermalRadiance light = solved.column().radiances(nodes, {1.0, planck});
    const double total = air.depth_between(0.0, 20.0);
    for (std::size_t j = 0; j < nodes.position.size(); ++j) {
      for (std::size_t level = 0; level < solved.altitude.size(); ++level) {
        EXPECT_NEAR(light.up_at(level, j) / planck, 1.0, 1e-13);
      }
      const double sky = -std::expm1(-total / nodes.position[j]);
      EXPECT_NEAR(light.down_at(0, j) / planck, sky, 1e-12 * sky) << "depth " << depth;
    }
    EXPECT_NEAR(light.flux_up[0], kPi * planck, 1e-12 * planck);
    EXPECT_NEAR(light.flux_up.back(), kPi * planck, 1e-12 * planck);
  }
}

TEST(ThermalColumn, SourceLinearInDepthIsExact) {
  // One layer, B from 9 at its top to 5 at its bottom: the analytic integral of (B - I) dtau.
  const std::vector<double> altitude{0.0, 2.0}, planck{5.0, 9.0};
  for (double depth : {1e-7, 1e-3, 0.02, 0.7, 4.0, 60.0, 1e4}) {
    const std::vector<double> depths{depth};
    const ThermalColumn column(altitude, planck, depths);
    for (double mu : {1.0, 0.3}) {
      const double t = depth / mu, e = std::exp(-t);
      // Series where the closed form cancels.
      const double mean = t > 1e-4 ? (1.0 - e) / t : 1.0 - t / 2.0 + t * t / 6.0;
      const double down = t > 1e-4 ? 5.0 - 9.0 * e + 4.0 * mean : 7.0 * t;
      EXPECT_NEAR(column.path(0.0, -mu).radiance, down, 1e-4 * t * t * t + 1e-11) << depth;
      EXPECT_NEAR(column.path(0.0, -mu).transmittance, e, 1e-14);
      // The planted fault: a source that is constant in the layer.
      const double constant = 7.0 * (1.0 - e);
      if (t > 0.5) {
        EXPECT_GT(std::abs(constant - down), 0.05);
      }
    }
  }
}

TEST(ThermalColumn, CuttingALayerChangesNothing) {
  const std::vector<double> altitude{0.0, 1.0, 3.0}, planck{9.0, 7.0, 4.0}, depth{0.8, 0.3};
  std::vector<double> fine_altitude, fine_planck, fine_depth;
  for (int i = 0; i <= 40; ++i) {
    const double z = i <= 20 ? i / 20.0 : 1.0 + (i - 20) / 10.0;
    fine_altitude.push_back(z);
    fine_planck.push_back(z <= 1.0 ? 9.0 - 2.0 * z : 7.0 - 1.5 * (z - 1.0));
    if (i < 40) fine_depth.push_back(i < 20 ? 0.8 / 20.0 : 0.3 / 20.0);
  }
  const GaussNodes nodes = gauss_nodes(6);
  const ThermalGround ground{0.9, 8.0};
  const ThermalRadiance coarse = ThermalColumn(altitude, planck, depth).radiances(nodes, ground);
  const ThermalRadiance fine = ThermalColumn(fine_altitude, fine_planck, fine_depth).radiances(nodes, ground);
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_NEAR(coarse.down_at(0, j), fine.down_at(0, j), 1e-12);
    EXPECT_NEAR(coarse.up_at(2, j), fine.up_at(40, j), 1e-12);
    EXPECT_NEAR(coarse.up_at(1, j), fine.up_at(20, j), 1e-12);
  }
}

TEST(ThermalColumn, OpaqueAirIsAsWarmAsItsNearestPart) {
  Air air;
  air.depth = 1e5;
  const Solved solved(air, air.levels());
  EXPECT_NEAR(solved.column().path(0.0, -1.0).radiance / air.planck(0.0), 1.0, 1e-3);
  const ThermalPath up = solved.column().path(30.0, 1.0);
  EXPECT_EQ(up.transmittance, 0.0);
  EXPECT_LT(up.radiance, 0.6 * air.planck(0.0)) << "emission comes from the cold top";
  for (double depth : {1e12, 1e300}) {
    const std::vector<double> altitude{0.0, 1.0}, planck{9.0, 7.0}, depths{depth};
    const ThermalColumn column(altitude, planck, depths);
    EXPECT_NEAR(column.path(0.0, -0.5).radiance, 9.0, 1e-11);
    EXPECT_NEAR(column.path(1.0, 0.5).radiance, 7.0, 1e-11);
    EXPECT_NEAR(column.path(0.5, 0.0, 10.0).radiance, 8.0, 1e-11);
  }
}

TEST(ThermalColumn, SkyOfExponentialAirAgainstAFineSum) {
  std::vector<double> kilometres;
  for (int i = 0; i <= 20; ++i) kilometres.push_back(i);
  // Worst relative error over depths and slants: of linear sources, and of the planted fault, in which every
  // layer has the mean of its levels.
  const auto worst = [](const std::vector<double>& levels) {
    std::pair<double, double> result;
    for (double depth : {0.1, 1.0, 10.0, 100.0}) {
      for (double mu : {1.0, 0.2}) {
        Air air;
        air.depth = depth;
        const Solved solved(air, levels);
        const double exact = sky_by_sum(air, mu);
        double constant = 0.0, along = 0.0;
        for (std::size_t i = 0; i < solved.depth.size(); ++i) {
          const double step = solved.depth[i] / mu;
          constant += 0.5 * (solved.planck[i] + solved.planck[i + 1]) * std::exp(-along) * -std::expm1(-step);
          along += step;
        }
        const double linear = solved.column().path(0.0, -mu).radiance;
        result.first = std::max(result.first, std::abs(linear / exact - 1.0));
        result.second = std::max(result.second, std::abs(constant / exact - 1.0));
      }
    }
    return result;
  };
  const auto [fine, fine_constant] = worst(Air().levels());
  EXPECT_LT(fine, 1.5e-3);
  EXPECT_GT(fine_constant, 1.5e-3);
  const auto [coarse, coarse_constant] = worst(kilometres);
  EXPECT_LT(coarse, 6e-3);
  EXPECT_GT(coarse_constant, 0.03);
}

TEST(ThermalColumn, FluxesAgainstAFineQuadrature) {
  Air air;
  for (double depth : {0.05, 0.5, 5.0}) {
    air.depth = depth;
    const Solved solved(air, air.levels());
    const ThermalRadiance coarse = solved.column().radiances(gauss_nodes(8), {0.95, air.planck(0.0)});
    const ThermalRadiance fine = solved.column().radiances(gauss_nodes(96), {0.95, air.planck(0.0)});
    EXPECT_NEAR(coarse.flux_down[0] / fine.flux_down[0], 1.0, 3e-4) << depth;
    EXPECT_NEAR(coarse.flux_up.back() / fine.flux_up.back(), 1.0, 1e-4) << depth;
    // Two nodes would not do.
    const ThermalRadiance crude = solved.column().radiances(gauss_nodes(1), {0.95, air.planck(0.0)});
    EXPECT_GT(std::abs(crude.flux_down[0] / fine.flux_down[0] - 1.0), 1e-3);
  }
}

TEST(ThermalColumn, GroundReflectsTheSky) {
  Air air;
  const Solved solved(air, air.levels());
  const GaussNodes nodes = gauss_nodes(8);
  const double planck = air.planck(0.0);
  const ThermalRadiance mirror = solved.column().radiances(nodes, {0.0, planck});
  EXPECT_NEAR(mirror.flux_up[0], mirror.flux_down[0], 1e-12 * planck);
  const ThermalRadiance grey = solved.column().radiances(nodes, {0.7, planck});
  EXPECT_NEAR(grey.up_at(0, 3), 0.7 * planck + 0.3 * grey.flux_down[0] / kPi, 1e-12 * planck);
}

TEST(ThermalColumn, PathsJoinAndAgreeWithTheLevels) {
  Air air;
  const Solved solved(air, air.levels());
  const ThermalColumn column = solved.column();
  const double mu = 0.4;
  // Looking down from 9.3 km: the near piece to 1.7 km, then what is below.
  const ThermalPath whole = column.path(9.3, mu), near = column.path(9.3, mu, (9.3 - 1.7) / mu),
                    rest = column.path(1.7, mu);
  EXPECT_NEAR(whole.transmittance, near.transmittance * rest.transmittance, 1e-13);
  EXPECT_NEAR(whole.radiance, near.radiance + near.transmittance * rest.radiance, 1e-12 * whole.radiance);
  // Looking up from 1.7 km.
  const ThermalPath up = column.path(1.7, -mu), low = column.path(1.7, -mu, 3.0 / mu),
                    high = column.path(4.7, -mu);
  EXPECT_NEAR(up.radiance, low.radiance + low.transmittance * high.radiance, 1e-12 * up.radiance);
  // A slant path that is nearly level, and a level one.
  EXPECT_NEAR(column.path(1.7, 1e-9, 5.0).radiance, column.path(1.7, 0.0, 5.0).radiance,
              1e-7 * air.planck(1.7));
  EXPECT_NEAR(column.path(1.7, -1e-9, 5.0).radiance, column.path(1.7, 0.0, 5.0).radiance,
              1e-7 * air.planck(1.7));

  const GaussNodes nodes = gauss_nodes(4);
  const ThermalGround ground{1.0, 12.0};
  const ThermalRadiance light = column.radiances(nodes, ground);
  const std::size_t top = solved.depth.size();
  for (std::size_t j = 0; j < 4; ++j) {
    const double node = nodes.position[j];
    EXPECT_NEAR(light.down_at(0, j), column.path(0.0, -node).radiance, 1e-12);
    const ThermalPath to_space = column.path(1e3, node);
    EXPECT_NEAR(light.up_at(top, j), to_space.radiance + 12.0 * to_space.transmittance, 1e-12);
  }
}

TEST(ThermalColumn, SkyToTheHorizon) {
  Air air;
  air.depth = 0.01;
  const Solved solved(air, air.levels());
  const ThermalColumn column = solved.column();
  for (double observer : {0.0, 0.3, 4.0}) {
    EXPECT_NEAR(column.sky(1.0, observer) / column.path(observer, -1.0).radiance, 1.0, 1e-12);
    EXPECT_NEAR(column.sky(0.5, observer) / column.path(observer, -0.5).radiance, 1.0, 3e-3);
    EXPECT_EQ(column.sky(0.5, 25.0), 0.0);
  }
  // Along the horizon by stepping through the same air.
  double sky = 0.0, depth = 0.0;
  for (double s = 0.05; s < 600.0; s += 0.1) {
    const double z = std::sqrt(6371.0 * 6371.0 + s * s) - 6371.0;
    if (z > 20.0) break;
    const double step = air.depth / air.scale_km * std::exp(-z / air.scale_km) * 0.1;
    sky += air.planck(z) * std::exp(-depth) * -std::expm1(-step);
    depth += step;
  }
  EXPECT_NEAR(column.sky(0.0, 0.0) / sky, 1.0, 0.01);
  EXPECT_GT(column.path(0.0, -1e-6).radiance / sky, 1.5) << "flat layers pass for shells";
}

TEST(ThermalColumn, OutsideTheAirThereIsNothing) {
  Air air;
  const Solved solved(air, air.levels());
  EXPECT_EQ(solved.column().path(25.0, -0.5).radiance, 0.0);
  EXPECT_EQ(solved.column().path(25.0, -0.5).transmittance, 1.0);
  EXPECT_EQ(solved.column().path(25.0, 0.5, 1.0).transmittance, 1.0) << "the path ends above the air";
  EXPECT_EQ(solved.column().path(3.0, 0.5, 0.0).transmittance, 1.0);
}

TEST(ThermalColumn, RefusesWhatDoesNotFit) {
  const std::vector<double> two{0.0, 1.0}, one{1.0}, none, falling{1.0, 0.0};
  EXPECT_THROW(ThermalColumn(two, two, two), std::invalid_argument);
  EXPECT_THROW(ThermalColumn(one, one, none), std::invalid_argument);
  EXPECT_THROW(ThermalColumn(falling, two, one), std::invalid_argument);
}

}  // namespace test_thermal_column
