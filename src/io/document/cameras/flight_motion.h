#pragma once

#include <memory>
#include <string>
#include <vector>

#include "math/vec3.h"

namespace ifov::platform {
class Trajectory;
}

namespace ifov::io {

struct PlatformFlight;
struct SceneFrame;

/// What a platform's path becomes for what it carries.
struct Motions {
  std::shared_ptr<const platform::Trajectory> truth;     ///< with its mount and jitter
  std::shared_ptr<const platform::Trajectory> reported;  ///< null: the true one
};

/// Of a platform and what it carries, as trajectory_of; random motion is drawn for so long before and after, too. Opens files of the path,
/// the jitter and the mounts: InputError with its place there, or where a mount cannot turn as it should; SystemError.
Motions motions_of(const PlatformFlight& flight, const SceneFrame& scene, double from_s, double to_s,
                   double beyond_s);

/// Of mounts that turn, one after the other, from where to where they do so meanwhile, in words.
std::vector<std::string> bearings_told(const PlatformFlight& flight, const SceneFrame& scene, double from_s,
                                       double to_s);

}  // namespace ifov::io
