#pragma once

#include <cstdint>
#include <optional>

#include "geometry/world/surface_survey.h"
#include "math/vec3.h"

namespace ifov::transport {

/// The outer side of a mirror that is a sphere, half of one or the side of a circular cylinder: from each point
/// outside, the Sun is seen in it once at most, at a place that follows from the law of reflection (of all points of a
/// convex body the way by the image is the shortest).
class RoundMirror {
 public:
  /// None where the shape is stretched into an ellipsoid or an elliptic cylinder.
  static std::optional<RoundMirror> of(const geometry::SurfaceSurvey::Round& round);

  struct Image {
    math::Point3 at;       ///< where the light is reflected
    math::Vec3 direction;  ///< towards it, unit
    double distance_m = 0.0;
    /// Solid angle that light of one steradian from the Sun's side fills at the point; the irradiance across
    /// `direction` is that of the Sun over `spread`, as light comes with the Sun's radiance.
    double spread = 1.0;
  };
  /// The image of a point light in the direction `towards_sun` (unit), ends of the shape minded, other things not;
  /// none for a point that is inside, or in the shape's own shadow.
  std::optional<Image> image(math::Point3 from, math::Vec3 towards_sun) const;

  std::uint32_t object() const { return object_; }
  /// An upper bound of the share of all directions that it takes, as seen from a point: no more than 1.
  double share_of_view(math::Point3 from) const;
  /// Whether it has an inner side that light can reach.
  bool hollow() const { return hollow_; }

 private:
  math::Point3 centre_m_;  // of the sphere; of the cylinder's lower end
  math::Vec3 axis_{};      // of the cylinder or of the half sphere, unit
  double radius_m_ = 0.0, length_m_ = 0.0;
  bool cylinder_ = false, half_ = false, hollow_ = false;
  std::uint32_t object_ = 0;
};

}  // namespace ifov::transport
