#include "atmosphere/sensor/sky_table_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "atmosphere/sensor/directions/kept_integrals.h"
#include "math/angle.h"
#include "radiometry/gauss_legendre.h"

namespace ifov::atmosphere {
namespace {

constexpr std::array kInclinations{0.0, 30.0, 60.0, 90.0};
constexpr std::array kAzimuths{0.0, 90.0, 180.0};

std::vector<double> with_middles(const std::vector<double>& nodes) {
  std::vector<double> all{nodes.front()};
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    all.push_back(0.5 * (nodes[i - 1] + nodes[i]));
    all.push_back(nodes[i]);
  }
  return all;
}

/// Cosine between surface k and a direction; 0 behind it.
double facing(std::size_t k, double x, double y, double z) {
  const double inclination = kInclinations[k / kAzimuths.size()] * math::kDegree,
               azimuth = kAzimuths[k % kAzimuths.size()] * math::kDegree;
  return std::max(0.0, std::cos(inclination) * z +
                           std::sin(inclination) * (std::cos(azimuth) * x + std::sin(azimuth) * y));
}

/// Irradiances of surfaces by a sky that is linear between directions.
class Irradiances {
 public:
  std::vector<double> sum = std::vector<double>(kInclinations.size() * kAzimuths.size(), 0.0);

  void add(const SkyDirections& at, std::span<const double> radiance) {
    const std::size_t azimuths = at.azimuth_rad.size();
    for (std::size_t z = 0; z + 1 < at.zenith_rad.size(); ++z)
      for (std::size_t a = 0; a + 1 < azimuths; ++a)
        for (const radiometry::GaussPoint& i : radiometry::kGauss4)
          for (const radiometry::GaussPoint& j : radiometry::kGauss4) {
            const double height = at.zenith_rad[z + 1] - at.zenith_rad[z];
            const double width = at.azimuth_rad[a + 1] - at.azimuth_rad[a];
            const double zenith = at.zenith_rad[z] + i.position * height;
            const double azimuth = at.azimuth_rad[a] + j.position * width;
            const double* low = radiance.data() + z * azimuths + a;
            const double* high = low + azimuths;
            const double here = (1.0 - i.position) * ((1.0 - j.position) * low[0] + j.position * low[1]) +
                                i.position * ((1.0 - j.position) * high[0] + j.position * high[1]);
            add(zenith, azimuth, here * std::sin(zenith) * i.weight * height * j.weight * width);
          }
  }

 private:
  /// From both sides of the Sun's plane.
  void add(double zenith, double azimuth, double light) {
    const double z = std::cos(zenith), x = std::sin(zenith) * std::cos(azimuth),
                 y = std::sin(zenith) * std::sin(azimuth);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += light * (facing(k, x, y, z) + facing(k, x, -y, z));
  }
};

}  // namespace

SkyDirections halved(const SkyDirections& table) {
  return {with_middles(table.zenith_rad), with_middles(table.azimuth_rad)};
}

double inclined_error(const SkyDirections& table, std::span<const double> radiance, double beam,
                      double sun_zenith_rad, double beyond_at_sun) {
  const SkyDirections finer = halved(table);
  const std::size_t zeniths = finer.zenith_rad.size(), azimuths = finer.azimuth_rad.size();
  // The table's own sky at the finer directions: the mean of the two or four around.
  std::vector<double> linear(radiance.size()), known(radiance.begin(), radiance.end());
  const auto sun = std::find(table.zenith_rad.begin(), table.zenith_rad.end(), sun_zenith_rad);
  if (sun != table.zenith_rad.end())
    known[2 * static_cast<std::size_t>(sun - table.zenith_rad.begin()) * azimuths] += beyond_at_sun;
  std::vector<double> kept;
  for (std::size_t z = 0; z < zeniths; z += 2)
    for (std::size_t a = 0; a < azimuths; a += 2) kept.push_back(known[z * azimuths + a]);
  keep_integrals(table, kept);
  for (std::size_t z = 0; z < zeniths; z += 2)
    for (std::size_t a = 0; a < azimuths; a += 2)
      known[z * azimuths + a] = kept[z / 2 * table.azimuth_rad.size() + a / 2];
  std::vector<double> smooth(radiance.begin(), radiance.end());
  keep_integrals(finer, smooth);
  for (std::size_t z = 0; z < zeniths; ++z)
    for (std::size_t a = 0; a < azimuths; ++a) {
      const std::size_t up = z - z % 2, down = z + z % 2, left = a - a % 2, right = a + a % 2;
      linear[z * azimuths + a] = 0.25 * (known[up * azimuths + left] + known[up * azimuths + right] +
                                         known[down * azimuths + left] + known[down * azimuths + right]);
    }
  Irradiances right, given;
  right.add(finer, smooth);
  given.add(finer, linear);
  if (!(given.sum.front() > 0.0)) return 0.0;
  const double scale = right.sum.front() / given.sum.front();
  double worst = 0.0;
  for (std::size_t k = 0; k < right.sum.size(); ++k)
    worst = std::max(worst, std::abs(scale * given.sum[k] - right.sum[k]) /
                                (right.sum[k] +
                                 beam * facing(k, std::sin(sun_zenith_rad), 0.0, std::cos(sun_zenith_rad))));
  return 4.0 / 3.0 * worst;
}

}  // namespace ifov::atmosphere
