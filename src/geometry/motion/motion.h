#pragma once

#include "math/transform.h"

namespace ifov::geometry {

/// Where something rigid that moves is, and how it is turned. Answers are the same each time; any number of threads may ask.
class Motion {
 public:
  virtual ~Motion() = default;
  /// A rotation and a shift, from the frame in which its shape is told. Seconds after the document's instant.
  virtual math::Transform scene_from_carrier(double time_s) const = 0;
  /// The shortest time in which it may turn back; infinite where it moves straight.
  virtual double step_s() const = 0;
};

}  // namespace ifov::geometry
