#pragma once

#include "geometry/unit_primitive.h"

namespace ifov::geometry::units {

/// The two crossings of a line with a unit circle (about z) or sphere; infinity where there are none.
struct Crossings {
  double t[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};
Crossings round_crossings(math::Point3 p, math::Vec3 d, bool spherical);

/// One coordinate of a map's image: of the origin, and of how far the unit disk reaches from it on either side; what z
/// adds.
struct Extent {
  double origin = 0.0, disc = 0.0, rise = 0.0;
};
/// The bounds that `span` gives of each coordinate: its lowest and highest.
World::Bounds bounds_by_coordinate(const math::Transform& object_from_unit,
                                   std::pair<double, double> (*span)(const Extent& extent));

/// Bounds on the distance from a point to the images of the unit ball, and of the unit circle at z above the origin.
double ball_reach_m(const math::Transform& object_from_unit, math::Point3 from_m);
double rim_reach_m(const math::Transform& object_from_unit, math::Point3 from_m, double z);

/// Azimuth from +x as a share of a turn; [-1, 1] as [0, 1].
double turn_of(math::Point3 p);
double half_of(double x);

}  // namespace ifov::geometry::units
