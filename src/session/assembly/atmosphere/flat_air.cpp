#include "session/assembly/atmosphere/flat_air.h"

#include "core/format.h"
#include "math/angle.h"

namespace ifov::session {

std::vector<std::string> flat_air_warnings(double view_zenith_rad, std::optional<double> sun_zenith_rad,
                                           const std::string& body) {
  constexpr double kView_deg = 75.0, kSun_deg = 80.0, kRounding_deg = 1e-6;
  const double view_deg = view_zenith_rad / math::kDegree;
  std::vector<std::string> warnings;
  if (view_deg > kView_deg + kRounding_deg)
    warnings.push_back(format(
        "lines of sight reach {:.0f} deg from the nadir, and layers of air are flat for them: about the round "
        "Earth the path's scattered light at 80 deg is 4 % less with the Sun 60 deg from the zenith, 6 % at 84 "
        "deg and 17 % at 89 deg; no half-width holds that",
        view_deg));
  if (sun_zenith_rad && *sun_zenith_rad / math::kDegree > kSun_deg + kRounding_deg)
    warnings.push_back(format(
        "the {} stands {:.1f} deg above the horizon, and all of a line of sight has this height of it: with the "
        "Sun at 1 deg the sky 80 deg from the zenith is up to 27 % too bright; no half-width holds that",
        body, 90.0 - *sun_zenith_rad / math::kDegree));
  return warnings;
}

}  // namespace ifov::session
