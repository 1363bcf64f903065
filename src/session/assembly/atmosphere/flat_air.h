#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ifov::radiometry {
struct Channel;
}

namespace ifov::session {

/// What to warn of where the modelled atmosphere's flat layers are not those of a round Earth: lines of sight of more
/// than 75 degrees from the nadir, a Sun or Moon (`body`) within 10 degrees of the horizon. Angles in radians;
/// `view_zenith_rad` the largest of the image; no Sun: night, or no channel that its scattered light matters in
/// (shines_in()). How much is off was measured against a spherical Monte
/// Carlo program (docs/theory/atmosphere_sensor.md).
/// `height_km`: of the sensor above the ground; from a mast or a low aircraft lines of sight are too short for the Earth to bend
/// away from them.
std::vector<std::string> flat_air_warnings(double view_zenith_rad, double height_km,
                                           std::optional<double> sun_zenith_rad,
                                           const std::string& body = "Sun");

/// Whether one of the channels is centred where the air scatters more sunlight than it emits, below 4 um.
bool shines_in(std::span<const radiometry::Channel> channels);

}  // namespace ifov::session
