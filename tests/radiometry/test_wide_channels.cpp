// Channels that reach over many octaves, and spectra with features finer than a channel's steps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiometry/channel_grid.h"
#include "radiometry/planck.h"
#include "radiometry/spectral_nodes.h"

namespace test_wide_channels {
using namespace ifov::radiometry;

namespace {

constexpr double kStefanBoltzmann_w_m2_k4 = 5.670374419e-8;  // CODATA 2018, exact

/// Fraction of a blackbody's radiance at wavelengths below: the series of Chang and Rhee,
/// (15 / pi^4) sum exp(-n x) (x^3/n + 3 x^2/n^2 + 6 x/n^3 + 6/n^4), x = c2 / (lambda T).
double share_below(double wavelength_um, double temperature_k) {
  const double x = 14387.768775039337 / (wavelength_um * temperature_k);
  double sum = 0.0;
  for (int n = 200000; n >= 1; --n) {
    if (n * x > 700.0) continue;
    sum +=
        std::exp(-n * x) * (x * x * x / n + 3.0 * x * x / n / n + 6.0 * x / n / n / n + 6.0 / n / n / n / n);
  }
  return 15.0 / std::pow(std::numbers::pi, 4) * sum;
}

double band_radiance(double from_um, double to_um, double temperature_k) {
  return kStefanBoltzmann_w_m2_k4 * std::pow(temperature_k, 4) / std::numbers::pi *
         (share_below(to_um, temperature_k) - share_below(from_um, temperature_k));
}

}  // namespace

// The band's radiance by the series is sigma T^4 / pi less the tails on both sides of the band.
TEST(WideChannels, BlackbodiesHaveStefanAndBoltzmannsRadiance) {
  EXPECT_NEAR(share_below(2897.77, 1.0), 0.25006,
              1e-4);  // below the maximum, and half of all, as textbooks have them
  EXPECT_NEAR(share_below(4107.0, 1.0), 0.5, 1e-4);
  for (const auto& [from_um, to_um] : {std::pair{2.0, 1000.0}, {0.2, 1000.0}, {5.0, 200.0}, {50.0, 3000.0}}) {
    const std::vector<Channel> channels{Channel::top_hat("wide", from_um, to_um)};
    const auto nodes =
        SpectralNodes::build(channels, Spectrum(), {}, {.coldest_k = 300.0, .hottest_k = 2500.0});
    for (const double temperature : {300.0, 450.0, 700.0, 1000.0, 1600.0, 2500.0}) {
      double radiance = 0.0;
      nodes.planck_channels(temperature, std::span(&radiance, 1));
      const double expected = band_radiance(from_um, to_um, temperature) / (to_um - from_um);
      EXPECT_NEAR(radiance / expected, 1.0, 1e-5) << from_um << ' ' << to_um << ' ' << temperature;
      EXPECT_NEAR(channel_planck_w_m2_sr_um(channels[0], temperature) / expected, 1.0, 1e-5) << temperature;
    }
  }
}

// Steps of equal width, as channels of some micrometres bear them, miss fifty times what is asked there.
TEST(WideChannels, EqualStepsWouldNotDo) {
  double sum = 0.0;
  constexpr int kSteps = 256;
  for (int k = 0; k < kSteps; ++k)
    sum += planck_w_m2_sr_um(2.0 + (k + 0.5) * 998.0 / kSteps, 300.0) * 998.0 / kSteps;
  EXPECT_GT(std::abs(sum / band_radiance(2.0, 1000.0, 300.0) - 1.0), 5e-3);
}

TEST(WideChannels, GreySurfacesOverManyOctavesAreRight) {
  // Emissivity falls over wavelength, as that of metals does.
  std::vector<double> x, y;
  for (double wavelength = 1.0; wavelength < 1500.0; wavelength *= 1.1) {
    x.push_back(wavelength);
    y.push_back(1.0 - 0.5 / std::sqrt(wavelength));
  }
  const std::vector<Spectrum> surfaces{Spectrum(x, y, OutsideRange::extend, "metal")};
  const std::vector<Channel> channels{Channel::top_hat("wide", 2.0, 1000.0)};
  const auto nodes =
      SpectralNodes::build(channels, Spectrum(), surfaces, {.coldest_k = 300.0, .hottest_k = 2500.0});
  EXPECT_LE(nodes.worst_error(), 7e-4);
  std::vector<float> rho(nodes.node_count()), planck(nodes.node_count());
  nodes.average_surface(surfaces[0], rho);
  for (const double temperature : {300.0, 900.0, 2500.0}) {
    nodes.planck(temperature, std::span<float>(planck));
    for (std::size_t n = 0; n < planck.size(); ++n) planck[n] *= 1.0f - rho[n];
    float found = 0.0f;
    nodes.to_channels(planck.data(), &found);
    double expected = 0.0;
    constexpr int kSteps = 400000;
    for (int k = 0; k < kSteps; ++k) {
      const double wavelength = 2.0 * std::pow(500.0, (k + 0.5) / kSteps);
      expected += (1.0 - surfaces[0].at(wavelength)) * planck_w_m2_sr_um(wavelength, temperature) *
                  wavelength * std::log(500.0) / kSteps / 998.0;
    }
    EXPECT_NEAR(found / expected, 1.0, 1e-3) << temperature;
  }
}

// Lines of a surface between the points of a channel's own grid are seen: one of 4 nm in a channel of 6 um would fall
// between two points or on one that stands for ten times its width.
TEST(WideChannels, NarrowLinesOfSurfacesCount) {
  std::vector<double> x{7.0}, y{0.02};
  for (double line = 8.05; line < 13.95; line += 0.25) {
    for (const double d : {-0.003, -0.002, 0.002, 0.003}) {
      x.push_back(line + d);
      y.push_back(std::abs(d) < 0.0025 ? 0.9 : 0.02);
    }
  }
  x.push_back(15.0);
  y.push_back(0.02);
  const std::vector<Spectrum> surfaces{Spectrum(x, y, OutsideRange::error, "lines")};
  const Channel channel = Channel::top_hat("lwir", 8.0, 14.0);
  const auto error_of = [&](const ChannelGrid& grid) {
    double once = 0.0, twice = 0.0;
    for (std::size_t q = 0; q < grid.size(); ++q) {
      const double rho = surfaces[0].at(grid.wavelength_um[q]);
      once += grid.response[q] * rho;
      twice += grid.response[q] * rho * rho;
    }
    const Spectrum* factors[] = {&surfaces[0], &surfaces[0]};
    return std::max(std::abs(once / (integral(surfaces[0], 8.0, 14.0) / 6.0) - 1.0),
                    std::abs(twice / (integral_of_product(factors, 8.0, 14.0) / 6.0) - 1.0));
  };
  EXPECT_LT(error_of(ChannelGrid(channel, Spectrum(), surfaces)), 5e-5);
  EXPECT_GT(error_of(ChannelGrid(channel, Spectrum())), 0.01);  // without them
}

// A blue sky on green and red surfaces: nodes that only the Sun's spectrum was asked for miss what it lights.
TEST(WideChannels, TheSkyIsOneOfTheLights) {
  const Spectrum sun = Spectrum({0.3, 1.0}, {1500.0, 1500.0}),
                 sky({0.3, 0.4, 0.5, 0.6, 1.0}, {400.0, 300.0, 90.0, 20.0, 1.0});
  const std::vector<Spectrum> surfaces{Spectrum({0.3, 0.68, 0.74, 1.0}, {0.04, 0.05, 0.5, 0.5}),
                                       Spectrum({0.3, 0.5, 0.6, 1.0}, {0.03, 0.05, 0.4, 0.5})};
  const std::vector<Channel> channels{Channel::top_hat("pan", 0.4, 0.9)};
  const auto error_with = [&](const Spectrum* known) {
    const auto nodes =
        SpectralNodes::build(channels, sun, surfaces, {.reflections = 2, .hottest_k = 0.0}, known);
    std::vector<float> light(nodes.node_count()), rho(light.size());
    nodes.average_source(sky, light);
    for (const Spectrum& surface : surfaces) {
      nodes.average_surface(surface, rho);
      for (std::size_t n = 0; n < light.size(); ++n) light[n] *= rho[n];
    }
    float found = 0.0f;
    nodes.to_channels(light.data(), &found);
    const Spectrum* factors[] = {&sky, &surfaces[0], &surfaces[1]};
    return std::abs(found / (integral_of_product(factors, 0.4, 0.9) / 0.5) - 1.0);
  };
  EXPECT_LT(error_with(&sky), 7e-4);
  EXPECT_GT(error_with(nullptr), 3e-3);
}

}  // namespace test_wide_channels
