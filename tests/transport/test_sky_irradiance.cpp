// What surfaces take from a sky by their normal, against closed forms and sums over directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "sampling/hash.h"
#include "sampling/random.h"
#include "transport/sky/sky_irradiance.h"

namespace ifov::transport::test_sky_irradiance {
namespace {

constexpr double kPi = std::numbers::pi;

/// A sky of one node, by zenith angle and azimuth from the Sun's.
struct Sky {
  std::vector<double> zenith_rad, azimuth_rad;
  radiometry::SpectrumBlock spectra;
  math::Vec3 towards_sun{std::sin(0.6) * std::cos(2.0), std::sin(0.6) * std::sin(2.0), std::cos(0.6)};

  explicit Sky(const std::function<double(double, double)>& radiance) {
    for (int z = 0; z <= 18; ++z) zenith_rad.push_back(0.5 * kPi * z / 18);
    for (int a = 0; a <= 18; ++a) azimuth_rad.push_back(kPi * a / 18);
    spectra.resize(19 * 19, 1);
    for (std::size_t z = 0; z < 19; ++z)
      for (std::size_t a = 0; a < 19; ++a)
        spectra.row(z * 19 + a)[0] = static_cast<float>(radiance(zenith_rad[z], azimuth_rad[a]));
  }
  SkyTable table() const { return {zenith_rad, azimuth_rad, spectra, towards_sun}; }

  double radiance(double zenith, double azimuth) const {
    const double z = std::min(zenith / (0.5 * kPi) * 18, 17.999), a = std::min(azimuth / kPi * 18, 17.999);
    const auto at = [&](int down, int right) {
      return static_cast<double>(
          spectra.row((static_cast<std::size_t>(z) + static_cast<std::size_t>(down)) * 19 +
                      static_cast<std::size_t>(a) + static_cast<std::size_t>(right))[0]);
    };
    const double u = z - std::floor(z), v = a - std::floor(a);
    return (1 - u) * ((1 - v) * at(0, 0) + v * at(0, 1)) + u * ((1 - v) * at(1, 0) + v * at(1, 1));
  }
  /// The integral, by the middles of small cells of equal cosine and azimuth.
  double summed(math::Vec3 normal) const {
    constexpr int kSteps = 400;
    double sum = 0.0;
    for (int c = 0; c < kSteps; ++c)
      for (int s = 0; s < 2 * kSteps; ++s) {
        const double cosine = (c + 0.5) / kSteps, azimuth = kPi * (s + 0.5) / kSteps;
        const double sine = std::sqrt(1 - cosine * cosine), own = azimuth + 2.0;
        const math::Vec3 direction{sine * std::cos(own), sine * std::sin(own), cosine};
        sum += std::max(0.0, math::dot(normal, direction)) *
               radiance(std::acos(cosine), std::min(azimuth, 2 * kPi - azimuth));
      }
    return sum * 2.0 * kPi / (2.0 * kSteps * kSteps) / kPi;
  }
};

double taken(const SkyIrradiance& sky, math::Vec3 normal, const SkyTable& table) {
  const SkyIrradiance::Corners corners = sky.at(normal, table);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    sum += static_cast<double>(corners.weight[k]) * static_cast<double>(corners.spectrum[k][0]);
  return sum;
}

math::Vec3 random_normal(int k) {
  const double z = 2.0 * sampling::unit_double(sampling::hash(k, 1)) - 1.0;
  const double azimuth = 2.0 * kPi * sampling::unit_double(sampling::hash(k, 2)), sine = std::sqrt(1 - z * z);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), z};
}

TEST(SkyIrradiance, OfAUniformSkyIsTheShareOfItThatASurfaceFaces) {
  const Sky sky([](double, double) { return 1.0; });
  const SkyIrradiance irradiance(sky.table());
  EXPECT_NEAR(taken(irradiance, {0.0, 0.0, 1.0}, sky.table()), 1.0, 1e-6);
  for (int k = 0; k < 200; ++k) {
    const math::Vec3 normal = random_normal(k);
    EXPECT_NEAR(taken(irradiance, normal, sky.table()), 0.5 * (1.0 + normal.z), 5e-4);
  }
}

// Brighter towards the horizon, with an aureole of some 10 degrees about the Sun, 50 times as bright as the zenith.
TEST(SkyIrradiance, OfASunnySkyIsItsIntegral) {
  const Sky sky([](double zenith, double azimuth) {
    const double cosine =
        std::cos(zenith) * std::cos(0.6) + std::sin(zenith) * std::sin(0.6) * std::cos(azimuth);
    return 1.0 + zenith * zenith + 50.0 * std::exp(-std::acos(std::min(1.0, cosine)) / 0.1);
  });
  const SkyIrradiance irradiance(sky.table());
  const double level = sky.summed({0.0, 0.0, 1.0});
  EXPECT_NEAR(taken(irradiance, {0.0, 0.0, 1.0}, sky.table()), level, 2e-5 * level);
  for (int k = 0; k < 60; ++k) {
    const math::Vec3 normal = random_normal(k);
    EXPECT_NEAR(taken(irradiance, normal, sky.table()), sky.summed(normal), 1e-3 * level) << normal.z;
  }
}

}  // namespace
}  // namespace ifov::transport::test_sky_irradiance
