#include "session/assembly/atmosphere/flat_air.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "math/angle.h"
#include "radiometry/channel.h"

namespace ifov::session {

std::vector<std::string> flat_air_warnings(double view_zenith_rad, double height_km,
                                           std::optional<double> sun_zenith_rad, const std::string& body) {
  constexpr double kView_deg = 75.0, kSun_deg = 80.0, kRounding_deg = 1e-6;
  const double view_deg = view_zenith_rad / math::kDegree;
  std::vector<std::string> warnings;
  if (!sun_zenith_rad) return warnings;
  // Over 16 km the ground falls by 20 m, a hundredth of the height in which haze thins out.
  constexpr double kAir_km = 30.0, kLong_km = 16.0;
  const double across_km = std::min(height_km, kAir_km) * std::tan(view_zenith_rad);
  if (view_deg > kView_deg + kRounding_deg && across_km > kLong_km)
    warnings.push_back(format(
        "lines of sight reach {:.0f} deg from the nadir, and layers of air are flat for them: about the round "
        "Earth the path's scattered light at 80 deg is 4 % less with the Sun 60 deg from the zenith, 6 % at 84 "
        "deg and 17 % at 89 deg; no half-width holds that",
        view_deg));
  if (*sun_zenith_rad / math::kDegree > kSun_deg + kRounding_deg)
    warnings.push_back(format(
        "the {} stands {:.1f} deg above the horizon, and all of a line of sight has this height of it: with the "
        "Sun at 1 deg the sky 80 deg from the zenith is up to 27 % too bright; no half-width holds that",
        body, 90.0 - *sun_zenith_rad / math::kDegree));
  return warnings;
}

bool shines_in(std::span<const radiometry::Channel> channels) {
  constexpr double kEmitted_um = 4.0;
  return std::any_of(channels.begin(), channels.end(),
                     [](const radiometry::Channel& channel) { return channel.centre_um < kEmitted_um; });
}

}  // namespace ifov::session
