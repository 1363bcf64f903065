#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "math/vec3.h"
#include "platform/bearing.h"

namespace ifov::platform {

class Trajectory;

/// Two axes that keep the belly of what they carry towards something.
class Gimbal final : public Bearing {
 public:
  /// Which axis is the outer one. Pitch and roll: the picture's top stays at the nose, whatever is below; nothing straight to the left
  /// or right. Pan and tilt: yaw about the belly, pitch away from it; the top is away from the belly, and nothing is straight below.
  enum class Axes { pitch_roll, pan_tilt };

  /// What moves, and a point of it to its right, ahead and up.
  struct Follow {
    std::shared_ptr<const Trajectory> path;
    math::Vec3 offset_m;
  };
  struct Limits {
    double least_rad, most_rad;
  };

  struct Settings {
    std::variant<math::Point3, Follow> target = {};  ///< scene frame
    std::string name = {};                           ///< of the target, for messages
    Axes axes = Axes::pitch_roll;
    std::optional<Limits> yaw = {}, pitch = {}, roll = {};
    bool stops = false;  ///< at its limits, and looks past the target; else that is an error
    std::optional<double> rate_rad_s = {};
    double blind_share = 0.0;
  };

  explicit Gimbal(Settings settings) : settings_(std::move(settings)) {}

  geodesy::Attitude angles(double time_s, const Pose& carrier) const override;
  double step_s() const override;
  double blind_share() const override { return settings_.blind_share; }
  std::string told(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const override;
  void check(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const override;

  /// Where the target is.
  math::Point3 target_m(double time_s) const;

 private:
  geodesy::Attitude towards(math::Point3 target_m, const Pose& carrier) const;

  Settings settings_;
};

}  // namespace ifov::platform
