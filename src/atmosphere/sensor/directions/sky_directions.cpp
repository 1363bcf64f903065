#include "atmosphere/sensor/directions/sky_directions.h"

#include <algorithm>
#include <cmath>

#include "math/angle.h"
#include "radiometry/gauss_legendre.h"

namespace ifov::atmosphere {
namespace {

constexpr double kHorizon_rad = 89.5 * math::kDegree;
/// Closer directions than this would be two for one.
constexpr double kLeastStep_rad = 1.5 * math::kDegree;

}  // namespace

SkyDirections SkyDirections::standard(std::optional<double> sun_zenith_rad) {
  std::vector<double> fixed, wanted;
  for (const double zenith : {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 68.0, 75.0, 80.0, 84.0, 87.0})
    fixed.push_back(zenith * math::kDegree);
  if (sun_zenith_rad)
    for (const double beside : {0.0, -3.0, 3.0, -6.0, 6.0})
      wanted.push_back(*sun_zenith_rad + beside * math::kDegree);
  SkyDirections directions;
  std::vector<double>& zeniths = directions.zenith_rad;
  zeniths = {0.0, kHorizon_rad};
  for (const std::vector<double>* list : {&wanted, &fixed})
    for (const double zenith : *list)
      if (zenith > 0.0 &&
          std::all_of(zeniths.begin(), zeniths.end(),
                      [&](double other) { return std::abs(other - zenith) >= kLeastStep_rad; }) &&
          zenith < kHorizon_rad)
        zeniths.push_back(zenith);
  std::sort(zeniths.begin(), zeniths.end());
  for (const double azimuth : {0.0, 4.0, 8.0, 13.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0,
                               110.0, 120.0, 135.0, 150.0, 165.0, 180.0})
    directions.azimuth_rad.push_back(azimuth * math::kDegree);
  return directions;
}

SunCell SkyDirections::sun_cell(double sun_zenith_rad) const {
  const auto sun = std::find(zenith_rad.begin(), zenith_rad.end(), sun_zenith_rad);
  if (sun == zenith_rad.end() || sun == zenith_rad.begin() || sun + 1 == zenith_rad.end()) return {};
  return {0.5 * (*(sun + 1) - *(sun - 1)), azimuth_rad[1] * std::sin(sun_zenith_rad)};
}

std::vector<double> SkyDirections::level_weights() const {
  const std::size_t zeniths = zenith_rad.size(), azimuths = azimuth_rad.size();
  std::vector<double> by_zenith(zeniths, 0.0), by_azimuth(azimuths, 0.0);
  for (std::size_t z = 0; z + 1 < zeniths; ++z) {
    const double width = zenith_rad[z + 1] - zenith_rad[z];
    for (const radiometry::GaussPoint& gauss : radiometry::kGauss4) {
      const double angle = zenith_rad[z] + gauss.position * width;
      const double weight = gauss.weight * width * std::sin(angle) * std::cos(angle);
      by_zenith[z] += (1.0 - gauss.position) * weight;
      by_zenith[z + 1] += gauss.position * weight;
    }
  }
  by_zenith.back() += 0.5 * std::pow(std::cos(zenith_rad.back()), 2);
  for (std::size_t a = 0; a + 1 < azimuths; ++a) {
    // Both sides of the Sun's plane, half to each end.
    const double width = azimuth_rad[a + 1] - azimuth_rad[a];
    by_azimuth[a] += width;
    by_azimuth[a + 1] += width;
  }
  std::vector<double> weights;
  for (const double zenith : by_zenith)
    for (const double azimuth : by_azimuth) weights.push_back(zenith * azimuth);
  return weights;
}

}  // namespace ifov::atmosphere
