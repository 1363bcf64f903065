#pragma once

#include <vector>

#include "math/vec3.h"

namespace ifov::platform {
struct Mount;
}

namespace ifov::io {

struct PlatformFlight;
struct SceneFrame;

/// What lies between a platform and its camera. Opens the files of mounts and of what they track: InputError with the place there,
/// SystemError.
std::vector<platform::Mount> mounts_of(const PlatformFlight& flight, const SceneFrame& scene, double from_s,
                                       double to_s);

}  // namespace ifov::io
