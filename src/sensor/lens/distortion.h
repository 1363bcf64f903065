#pragma once

#include <array>

#include "sensor/lens/distortion_terms.h"
#include "sensor/lens/lens.h"

namespace ifov::sensor {

/// Lens distortion of Brown (1966), in the terms of OpenCV: a direction (x, y) = (X / Z, Y / Z) beside the axis, x right and y down, appears where
/// without distortion (x', y') would, with r^2 = x^2 + y^2:
///   x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2)
///   y' = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y
/// Beyond where that folds back it goes on straight, so that all places have one direction.
class Distortion final : public Lens {
 public:
  using Terms = DistortionTerms;

  Distortion() = default;
  /// ifov::InputError on terms that are not finite. `far`: x and y of places that matter are no larger.
  Distortion(const Terms& terms, double far);

  bool none() const { return none_; }
  Place image_of(Place direction) const override;
  /// By Newton's method.
  Place direction_of(Place image) const override;
  double scale(Place direction) const override;
  bool holds(Place image) const override;

 private:
  /// The image and its derivatives: x' by x, x' by y, y' by x, y' by y.
  struct Mapped {
    Place image;
    std::array<double, 4> by;
  };
  Mapped mapped(Place direction) const;
  Mapped by_terms(Place direction) const;

  Terms terms_;
  bool none_ = true;
  double fold_ = 0.0;  // radius of directions up to which areas keep their sign
};

}  // namespace ifov::sensor
