#pragma once

namespace ifov::sensor {

/// Where directions appear on the focal plane, which a pinhole has at their own place: a direction is (X / Z, Y / Z) beside the axis, x right and y
/// down in the image, and so is a place, in focal lengths. Both ways are defined everywhere.
class Lens {
 public:
  struct Place {
    double x = 0.0, y = 0.0;
  };
  virtual ~Lens() = default;
  virtual Place image_of(Place direction) const = 0;
  /// The inverse: its image is within 1e-14 of the place.
  virtual Place direction_of(Place image) const = 0;
  /// How much larger an area is in the image, near a direction.
  virtual double scale(Place direction) const = 0;
  /// Whether a place shows a direction that the lens is described for: not beyond a fold.
  virtual bool holds(Place) const { return true; }
};

}  // namespace ifov::sensor
