#pragma once

#include "math/vec3.h"
#include "sampling/random.h"

/// Maps from the unit square to the domains that light and optics are sampled over. Each has its density and
/// its inverse. Directions are unit vectors; local ones have the surface's normal along +z.
namespace ifov::sampling {

/// Unit disk, uniform, by Shirley and Chiu's (1997) concentric map; density 1/pi.
Point2 uniform_disk(Point2 u);
Point2 uniform_disk_inverse(Point2 p);

/// Hemisphere about +z with density cos(theta)/pi (Malley: the disk lifted onto the sphere).
math::Vec3 cosine_hemisphere(Point2 u);
double cosine_hemisphere_density(math::Vec3 direction);
Point2 cosine_hemisphere_inverse(math::Vec3 direction);

/// Two unit vectors that make a right-handed frame (first, second, normal) (Duff et al. 2017).
struct TangentFrame {
  math::Vec3 first, second, normal;
  explicit TangentFrame(math::Vec3 unit_normal);
  math::Vec3 to_world(math::Vec3 local) const {
    return local.x * first + local.y * second + local.z * normal;
  }
  math::Vec3 to_local(math::Vec3 world) const {
    return {math::dot(world, first), math::dot(world, second), math::dot(world, normal)};
  }
};

/// Cone of directions within `half_angle_rad` of an axis, uniform in solid angle. Accurate for cones as
/// narrow as the Sun's.
class UniformCone {
 public:
  explicit UniformCone(double half_angle_rad);
  math::Vec3 sample(math::Vec3 axis, Point2 u) const;
  double density(math::Vec3 axis, math::Vec3 direction) const;
  Point2 inverse(math::Vec3 axis, math::Vec3 direction) const;
  double solid_angle_sr() const { return solid_angle_; }

 private:
  double versine_;  // 1 - cos(half angle), without cancellation
  double solid_angle_;
};

/// A direction towards a light with its weight: irradiance = radiance of the light * mean of the weights of
/// the directions that reach it.
struct LightSample {
  math::Vec3 direction;
  double weight_sr = 0.0;  ///< cos(theta) over the density of the direction
};

/// The Sun's disc as a plane surface sees it. A cap of half-angle a about `axis` projects onto the surface's
/// plane as an ellipse of area pi sin^2(a) cos(theta); points uniform in that ellipse are directions uniform
/// in projected solid angle, all with that weight: no variance where the whole disc is seen. Where the
/// horizon cuts the disc, directions are uniform in the cone and weigh their cosine.
class SolarDisc {
 public:
  explicit SolarDisc(double half_angle_rad);

  /// `normal` is the side of the surface that is lit; weight 0 where the disc is below its horizon.
  LightSample sample(math::Vec3 axis, math::Vec3 normal, Point2 u) const;
  /// Density per steradian with which sample() takes a direction.
  double density(math::Vec3 axis, math::Vec3 normal, math::Vec3 direction) const;
  Point2 inverse(math::Vec3 axis, math::Vec3 normal, math::Vec3 direction) const;

  /// Integral of cos(theta) over the disc where all of it is above the horizon.
  double projected_solid_angle_sr(math::Vec3 axis, math::Vec3 normal) const;
  /// Whether all of the disc is above the horizon of a surface.
  bool uncut(math::Vec3 axis, math::Vec3 normal) const { return math::dot(axis, normal) >= sine_; }
  double solid_angle_sr() const { return cone_.solid_angle_sr(); }

 private:
  UniformCone cone_;
  double sine_, cosine_;
};

}  // namespace ifov::sampling
