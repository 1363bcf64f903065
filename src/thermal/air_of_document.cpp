#include "thermal/air_of_document.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::thermal {
namespace {

constexpr double kDark_rad = -6.0 * std::numbers::pi / 180.0;

}  // namespace

SunAndSky ClearSunlight::at(double sun_elevation_rad, double sun_distance_au) const {
  const double above = kSolarConstant_w_m2 / (sun_distance_au * sun_distance_au);
  const double lowest = elevation_rad.front();
  if (sun_elevation_rad < lowest)
    return {above * direct.front() * std::max(0.0, sun_elevation_rad / lowest),
            above * diffuse.front() * std::max(0.0, (sun_elevation_rad - kDark_rad) / (lowest - kDark_rad))};
  const auto after = std::upper_bound(elevation_rad.begin(), elevation_rad.end(), sun_elevation_rad);
  const std::size_t i = after == elevation_rad.end()
                            ? elevation_rad.size() - 2
                            : static_cast<std::size_t>(after - elevation_rad.begin()) - 1;
  const auto between = [&](const std::vector<double>& values, const auto& x) {
    const double begin = x(std::sin(elevation_rad[i])), end = x(std::sin(elevation_rad[i + 1]));
    const double share = std::clamp((x(std::sin(sun_elevation_rad)) - begin) / (end - begin), 0.0, 1.0);
    return above * std::exp(std::lerp(std::log(values[i]), std::log(values[i + 1]), share));
  };
  // Of direct light the logarithm goes with the air that it crosses, of the sky's about with that of the height.
  return {between(direct, [](double height) { return 1.0 / (height + 0.03); }),
          between(diffuse, [](double height) { return std::log(height); })};
}

SunAndSky under_cloud(const SunAndSky& clear, double sun_elevation_rad, double cloud_fraction) {
  const double height = std::max(0.0, std::sin(sun_elevation_rad));
  const double global =
      (clear.direct_w_m2 * height + clear.diffuse_w_m2) * (1.0 - 0.75 * std::pow(cloud_fraction, 3.4));
  const double direct = clear.direct_w_m2 * (1.0 - cloud_fraction);
  return {direct, global - direct * height};
}

}  // namespace ifov::thermal
