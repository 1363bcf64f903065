#pragma once

#include <cstdint>

#include "geometry/surface_piece.h"
#include "math/vec3.h"
#include "sampling/random.h"

namespace ifov::transport {

/// A point that light is sought for, and the side of its surface: unit normal; 0: light from all sides counts alike, as to
/// EmitterShape::reach_sr.
struct Receiver {
  math::Point3 at_m;
  math::Vec3 normal;
  bool any_side() const { return normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0; }
};

/// A point of a surface, with the density that it is drawn with.
struct SurfaceSample {
  math::Point3 at_m;
  math::Vec3 normal;     ///< unit, outward of solids
  double density = 0.0;  ///< 1/m2
};

/// A direction with the density that it is drawn with; 0: none could be drawn.
struct AimedDirection {
  math::Vec3 direction;  ///< unit
  double density = 0.0;  ///< 1/sr
};

/// A piece of surface as it is sampled from points about it: flat ones with straight edges uniformly in projected solid
/// angle; balls, also unequally scaled ones, uniformly in the cone of the frame where they are spheres, and round ones
/// above the horizon in projected solid angle; disks by area; tubes over the half that faces the point, in equal angles along the axis. From
/// within a ball nothing is drawn.
class EmitterShape {
 public:
  /// `closed`: part of a mesh without a rim, of which only one side is likely to be seen.
  EmitterShape(const geometry::SurfacePiece& piece, bool closed);

  /// About the integral of the cosine over what the receiver would see of it if nothing stood between, sr; exact for
  /// triangles and parallelograms. What is likely to be hidden by its own body counts little.
  double reach_sr(const Receiver& receiver) const;

  AimedDirection aim(const Receiver& receiver, sampling::Point2 u) const;

  /// Of aim(), for a direction in which the piece was met at a distance.
  double density(const Receiver& receiver, math::Vec3 direction, double distance_m) const;

  /// A point anywhere on it, of balls by the area of the sphere that they are scaled from; and its density at a point.
  SurfaceSample point(sampling::Point2 u) const;
  double point_density(math::Point3 at_m) const;

  math::Point3 centre_m() const { return centre_m_; }
  double radius_m() const { return radius_m_; }  ///< of a sphere about it
  /// Area as seen along its normal (flat pieces), or the mean over all directions.
  double area_m2() const { return area_m2_; }
  bool flat() const { return flat_; }
  bool closed() const { return closed_; }
  math::Vec3 normal() const { return normal_; }  ///< unit; of flat pieces

 private:
  using Kind = geometry::PieceKind;
  bool straight() const { return kind_ == Kind::triangle || kind_ == Kind::parallelogram; }
  /// Whether a straight piece is so far away that its parts are seen alike.
  bool far(const Receiver& receiver) const;
  double by_area(const Receiver& receiver, math::Vec3 direction) const;
  double self_hiding(math::Point3 at_m) const;
  double reach_of_ball(const Receiver& receiver) const;
  double reach_by_area(const Receiver& receiver) const;
  AimedDirection aim_at_ball(const Receiver& receiver, sampling::Point2 u) const;
  SurfaceSample ball_point(math::Point3 unit) const;
  SurfaceSample flat_point(sampling::Point2 unit) const;
  double density_of_ball(const Receiver& receiver, math::Vec3 direction) const;
  AimedDirection aim_at_cylinder(const Receiver& receiver, sampling::Point2 u) const;
  double density_of_cylinder(const Receiver& receiver, math::Vec3 direction, double distance_m) const;

  Kind kind_;
  bool closed_, solid_, flat_ = false, round_ = false;
  math::Transform scene_from_unit_, unit_from_scene_;
  math::Point3 centre_m_;
  math::Vec3 normal_;
  double radius_m_ = 0.0, area_m2_ = 0.0, scale_ = 1.0;
};

/// The largest cosine between a normal and the directions to a sphere about a point `to` from here; at least 0.
double highest_cosine(math::Vec3 normal, math::Vec3 to, double radius_m);

}  // namespace ifov::transport
