#pragma once

#include <functional>
#include <vector>

#include "landscape/shapes/random_stream.h"
#include "math/vec3.h"

namespace ifov::landscape {

using math::Point3;
using math::Vec3;

/// A point of a branch. Parents stand before their children.
struct Joint {
  Point3 at;
  int parent = -1;
  double radius_m = 0.0;
  int tips = 0;  ///< ends of twigs that grow from here
};

/// The envelope of a broadleaved crown.
struct CrownShape {
  double height = 10.0, base = 2.5;  ///< of the tree and of its lowest leaves
  double radius = 3.5;
  /// Radius at a relative height (0 at the base, 1 at the top), as a share of the largest.
  std::function<double(double)> profile;
  double trunk_radius = 0.15;  ///< at breast height
  int attractors = 1200;
};

/// Branches that grow towards points scattered in the crown until every point is reached (space colonisation:
/// Runions, Lane and Prusinkiewicz 2007), with radii such that cross-sections follow the number of twigs (pipe
/// model) from 4 mm at the tips to the trunk's.
std::vector<Joint> grow_skeleton(const CrownShape& crown, const RandomStream& random);

/// Radii and numbers of twigs of a skeleton whose joints are placed.
void set_radii(std::vector<Joint>& joints, double trunk_radius_m, double tip_radius_m);

}  // namespace ifov::landscape
