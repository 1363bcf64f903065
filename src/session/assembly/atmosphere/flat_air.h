#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ifov::session {

/// What to warn of where the modelled atmosphere's flat layers are not those of a round Earth: lines of sight of more
/// than 75 degrees from the nadir, a Sun or Moon (`body`) within 10 degrees of the horizon. Angles in radians;
/// `view_zenith_rad` the largest of the image; no Sun: night. How much is off was measured against a spherical Monte
/// Carlo program (docs/theory/atmosphere_sensor.md).
std::vector<std::string> flat_air_warnings(double view_zenith_rad, std::optional<double> sun_zenith_rad,
                                           const std::string& body = "Sun");

}  // namespace ifov::session
