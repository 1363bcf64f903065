#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/vec3.h"

namespace ifov::platform {
class Trajectory;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::io {

enum class PathFrame;
struct PlatformDocument;
struct PlatformFlight;
struct SceneFrame;

/// Throws InputError where a path needs the document's time or the scene's place on Earth and has none.
void check_flight(const PlatformFlight& flight);

/// Opens the files that the path names. Of a satellite's orbit, and of what flies straight about the Earth, the times from `from_s` to `to_s`, after the document's, are covered. Throws InputError with the place in the file, SystemError.
platform::Trajectory trajectory_of(const PlatformFlight& flight, const SceneFrame& scene, double from_s,
                                   double to_s);

/// The frame that a path is told in; none: an orbit's.
std::optional<PathFrame> frame_of(const PlatformDocument& platform);

/// Whether the path is given about the Earth and not about the scene.
bool flies_about_earth(const PlatformDocument& platform);

/// Of a path about the Earth: throws InputError where the platform is below the scene's horizon, looks past the scene, or sees ground
/// so far from the scene's origin that the Earth's surface lies more than 1 m below the flat scene.
void check_flatness(const sensor::Camera& camera, const PlatformFlight& flight);

/// "straight from x, y, z 0, 0, 1000 m at 70 m/s"; positions are shifted, behind the name of their axes.
std::string path_description(const PlatformFlight& flight, math::Vec3 shift_m, std::string_view axes);

/// Old elements of an orbit, with the error to be expected.
std::vector<std::string> flight_remarks(const PlatformFlight& flight);

}  // namespace ifov::io
