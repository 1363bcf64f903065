#pragma once

#include <vector>

#include "math/vec3.h"

namespace ifov::platform {
struct Mount;
}

namespace ifov::io {

struct PlatformFlight;

/// What lies between a platform and its camera. Opens the files of mounts and of what they track: InputError with the place there,
/// SystemError. `offset_m` is subtracted from coordinates of the scene.
std::vector<platform::Mount> mounts_of(const PlatformFlight& flight, math::Vec3 offset_m, double from_s,
                                       double to_s);

}  // namespace ifov::io
