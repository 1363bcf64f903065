#pragma once

#include <memory>

namespace ifov::platform {
class Trajectory;
}

namespace ifov::io {

struct PlatformFlight;

/// What a platform's path becomes for what it carries.
struct Motions {
  std::shared_ptr<const platform::Trajectory> truth;     ///< with its mount and jitter
  std::shared_ptr<const platform::Trajectory> reported;  ///< null: the true one
};

/// Of a platform on its path; random motion is drawn for the times from `from_s` to `to_s`. Opens the table of jitter: InputError with its
/// place there, SystemError.
Motions motions_of(const PlatformFlight& flight, const platform::Trajectory& path, double from_s,
                   double to_s);

}  // namespace ifov::io
