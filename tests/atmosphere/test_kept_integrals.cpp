#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

#include "atmosphere/sensor/directions/kept_integrals.h"
#include "math/angle.h"

namespace ifov::atmosphere::test_kept_integrals {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSun = 0.6;

using Sky = std::function<double(double zenith, double azimuth)>;

/// A blue sky's shape: bright towards the horizon and about the Sun (Perez et al. 1993 have it so, with other numbers).
double clear_sky(double zenith, double azimuth) {
  const double apart =
      std::cos(zenith) * std::cos(kSun) + std::sin(zenith) * std::sin(kSun) * std::cos(azimuth);
  return (1.0 - 0.6 * std::exp(-0.3 / std::max(0.05, std::cos(zenith)))) *
         (1.0 + apart * apart + std::exp(apart));
}

/// Irradiance of a surface inclined towards an azimuth, by the middles of many small cells.
double irradiance(const Sky& sky, double tilt, double towards) {
  constexpr int kZeniths = 360, kAzimuths = 720;
  double sum = 0.0;
  for (int i = 0; i < kZeniths; ++i)
    for (int j = 0; j < kAzimuths; ++j) {
      const double z = 0.5 * kPi * (i + 0.5) / kZeniths, a = 2.0 * kPi * (j + 0.5) / kAzimuths;
      const double facing =
          std::cos(tilt) * std::cos(z) + std::sin(tilt) * std::sin(z) * std::cos(a - towards);
      sum += std::max(0.0, facing) * std::sin(z) * sky(z, std::min(a, 2.0 * kPi - a));
    }
  return sum * 0.5 * kPi / kZeniths * 2.0 * kPi / kAzimuths;
}

std::vector<double> at_directions(const SkyDirections& at, const Sky& sky) {
  std::vector<double> values;
  for (const double zenith : at.zenith_rad)
    for (const double azimuth : at.azimuth_rad) values.push_back(sky(zenith, azimuth));
  return values;
}

double linear(const SkyDirections& at, const std::vector<double>& values, double zenith, double azimuth) {
  const auto below = [](const std::vector<double>& nodes, double x) {
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    return static_cast<std::size_t>(above - nodes.begin()) - 1;
  };
  const std::size_t z = below(at.zenith_rad, zenith), a = below(at.azimuth_rad, azimuth),
                    n = at.azimuth_rad.size();
  const double up = std::min(1.0, (zenith - at.zenith_rad[z]) / (at.zenith_rad[z + 1] - at.zenith_rad[z])),
               along = (azimuth - at.azimuth_rad[a]) / (at.azimuth_rad[a + 1] - at.azimuth_rad[a]);
  return (1 - up) * ((1 - along) * values[z * n + a] + along * values[z * n + a + 1]) +
         up * ((1 - along) * values[(z + 1) * n + a] + along * values[(z + 1) * n + a + 1]);
}

/// The worst of nine surfaces, relative.
double worst_error(const SkyDirections& at, const std::vector<double>& values) {
  double worst = 0.0;
  for (const double tilt : {0.0, 45.0, 90.0})
    for (const double towards : {0.0, 90.0, 180.0}) {
      const double right = irradiance(clear_sky, tilt * math::kDegree, towards * math::kDegree);
      const double given = irradiance([&](double z, double a) { return linear(at, values, z, a); },
                                      tilt * math::kDegree, towards * math::kDegree);
      worst = std::max(worst, std::abs(given / right - 1.0));
    }
  return worst;
}

// Planted: values as they are, whose chords lie beside the sky.
TEST(KeptIntegrals, InclinedSurfacesTakeWhatTheSkySends) {
  const SkyDirections table = SkyDirections::standard(kSun);
  const std::vector<double> plain = at_directions(table, clear_sky);
  std::vector<double> kept = plain;
  keep_integrals(table, kept);
  const double worst = worst_error(table, kept), without = worst_error(table, plain);
  EXPECT_LT(worst, 7e-4);
  EXPECT_GT(without, 3.0 * worst);
}

// A parabola's chord lies c h^2 / 12 above it in the mean; steps of one size.
TEST(KeptIntegrals, AParabolaMovesByItsClosedForm) {
  SkyDirections table;
  for (int k = 0; k < 7; ++k) {
    table.zenith_rad.push_back(0.2 * k);
    table.azimuth_rad.push_back(kPi * k / 6.0);
  }
  std::vector<double> sky = at_directions(table, [](double z, double) { return 5.0 + 2.0 * z * z; });
  const std::vector<double> before = sky;
  keep_integrals(table, sky);
  for (std::size_t z = 2; z < 5; ++z)
    for (std::size_t a = 0; a < 7; ++a)
      EXPECT_NEAR(sky[z * 7 + a] - before[z * 7 + a], -4.0 * 0.2 * 0.2 / 12.0, 1e-12);
}

// About a peak, here the Sun's, second derivatives change sign: nothing moves, and nothing falls below 0.
TEST(KeptIntegrals, LeavesAPeakAlone) {
  const SkyDirections table = SkyDirections::standard(kSun);
  std::vector<double> sky = at_directions(
      table, [](double z, double a) { return 1.0 + (std::abs(z - kSun) < 1e-9 && a == 0.0 ? 500.0 : 0.0); });
  const std::vector<double> before = sky;
  keep_integrals(table, sky);
  EXPECT_EQ(sky, before);
}

}  // namespace
}  // namespace ifov::atmosphere::test_kept_integrals
