#pragma once

#include <span>
#include <string>

#include "geodesy/attitude.h"

namespace ifov::platform {

struct Pose;

/// What turns what it carries against its carrier: a gimbal, a table of angles, steps. Any number of threads may ask.
class Bearing {
 public:
  virtual ~Bearing() = default;

  /// Yaw, pitch and roll of what it carries, in this order, at an instant, while what carries it stands so.
  virtual geodesy::Attitude angles(double time_s, const Pose& carrier) const = 0;

  /// The shortest time between points that its angles pass smoothly; infinite: none.
  virtual double step_s() const = 0;

  /// Share of the platform's jitter that it does not see, and so does not take out.
  virtual double blind_share() const { return 1.0; }

  /// Its angles at times that increase in words: from where to where they go, and when it stands at its limits.
  virtual std::string told(std::span<const double> times_s,
                           std::span<const geodesy::Attitude> angles) const = 0;

  /// Throws InputError where it cannot do this: its angles at times that increase, the first and last of which are those asked for.
  virtual void check(std::span<const double> times_s, std::span<const geodesy::Attitude> angles) const = 0;
};

/// From where to where angles go, axis by axis: "pitch 3 to 12.5 deg, roll 1 deg".
std::string angles_told(std::span<const geodesy::Attitude> angles);

}  // namespace ifov::platform
