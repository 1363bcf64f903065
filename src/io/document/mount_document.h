#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "geodesy/attitude.h"
#include "io/document/document_values.h"
#include "io/document/framed_point.h"
#include "math/vec3.h"

namespace ifov::io {

/// An object that moves, and a point of it to its right, ahead and up.
struct TrackedObject {
  DocumentName name;
  math::Vec3 offset_m;
};

/// What keeps the camera towards something.
struct GimbalDocument {
  enum class Axes { pitch_roll, pan_tilt };
  enum class AtLimits { refuse, stop };
  using Limits = std::array<double, 2>;

  std::variant<FramedPoint, TrackedObject> target;
  Axes axes = Axes::pitch_roll;
  std::optional<Limits> yaw_rad, pitch_rad, roll_rad;
  AtLimits at_limits = AtLimits::refuse;
  std::optional<double> rate_rad_s;
  double jitter_share = 0.0;  ///< of the platform's, which it does not take out
  SourcePosition position;
};

/// Looks from place to place, whatever its carrier does.
struct StepStareDocument {
  geodesy::Attitude first, step;
  int steps = 1;
  double period_s = 0.0, slew_s = 0.0, start_s = 0.0;
};

/// Angles by time.
struct TurnTableDocument {
  DocumentFile file;
};

/// How something is carried: where it is along the body's nose, right wing and belly, how it is turned against them, and what turns it from there.
struct MountDocument {
  math::Vec3 lever_arm_m;
  geodesy::Attitude boresight;
  std::variant<std::monostate, GimbalDocument, StepStareDocument, TurnTableDocument> bearing;
};

/// Each on the one before, the last of which has the camera.
struct MountList {
  std::vector<MountDocument> mounts;
  SourcePosition position = {};  ///< of a sensor's own
};

inline std::span<const MountDocument> mounts_in(const std::shared_ptr<const MountList>& list) {
  return list ? std::span<const MountDocument>(list->mounts) : std::span<const MountDocument>();
}

}  // namespace ifov::io
