#pragma once

#include <cmath>
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
    math::Vec3 onward;     ///< from there to what is seen, unit
    double distance_m = 0.0;
    /// Solid angle that light of one steradian from the Sun's side fills at the point; the irradiance across
    /// `direction` is that of the Sun over `spread`, as light comes with the Sun's radiance.
    double spread() const { return std::abs(widens[2]); }
    /// Area across `onward` that one steradian at the point covers, so far behind the mirror: m2/sr.
    double area_m2(double onward_m) const {
      return std::abs(widens[0] + onward_m * (widens[1] + onward_m * widens[2]));
    }
    double widens[3] = {0.0, 0.0, 1.0};  ///< coefficients of that area in the distance
  };
  /// The image of a point light in the direction `towards_sun` (unit), ends of the shape minded, other things not;
  /// none for a point that is inside, or in the shape's own shadow.
  std::optional<Image> image(math::Point3 from, math::Vec3 towards_sun) const;
  /// The same of a point light at a place.
  std::optional<Image> image_of(math::Point3 from, math::Point3 light) const;
  /// What is seen at a point of its outer side; none where that is not on it.
  std::optional<Image> met(math::Point3 from, math::Point3 at) const;

  std::uint32_t object() const { return object_; }
  /// An upper bound of the share of all directions that it takes, as seen from a point: no more than 1.
  double share_of_view(math::Point3 from) const;
  /// Whether it has an inner side that light can reach.
  bool hollow() const { return hollow_; }
  /// Of the sphere, or of the axis.
  math::Point3 middle_m() const { return cylinder_ ? centre_m_ + axis_ * (0.5 * length_m_) : centre_m_; }

 private:
  math::Vec3 across_axis(math::Vec3 v) const;
  std::optional<math::Vec3> reflecting_normal(math::Point3 from, math::Vec3 towards, double nearness) const;
  std::optional<Image> seen_at(math::Point3 from, math::Point3 at, math::Vec3 normal) const;
  std::optional<Image> reflected(math::Point3 from, math::Point3 at, math::Vec3 normal) const;

  math::Point3 centre_m_;  // of the sphere; of the cylinder's lower end
  math::Vec3 axis_{};      // of the cylinder or of the half sphere, unit
  double radius_m_ = 0.0, length_m_ = 0.0;
  bool cylinder_ = false, half_ = false, hollow_ = false;
  std::uint32_t object_ = 0;
};

}  // namespace ifov::transport
