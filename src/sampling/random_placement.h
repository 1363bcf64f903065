#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "sampling/random.h"

namespace ifov::sampling {

/// A rectangle in metres.
struct PlacementArea {
  double west_m = 0.0, south_m = 0.0, east_m = 0.0, north_m = 0.0;
  double square_metres() const { return (east_m - west_m) * (north_m - south_m); }
  bool holds(Point2 p) const { return p.x >= west_m && p.x < east_m && p.y >= south_m && p.y < north_m; }
};

/// Places at random that keep a distance from each other.
struct PlacementPlan {
  PlacementArea area;
  double minimum_distance_m = 0.0;           ///< 0: places know nothing of each other
  double peak_density_m2 = 0.0;              ///< places per square metre, the largest of any place
  std::function<double(Point2)> density_m2;  ///< 0 to `peak_density_m2`; empty: the peak everywhere
  std::uint64_t seed = 0;
};

struct RandomPosition {
  Point2 at_m;
  std::uint64_t key = 0;  ///< for further random numbers of this place, see unit_double
};

/// The largest density that random_positions() reaches with a minimum distance: 90 % of that of jammed disks, 0.627
/// over its square. Infinite for a distance of 0.
double largest_placement_density(double minimum_distance_m);

/// Proposals per square metre among which random_positions() finds `density_m2` places, at most
/// largest_placement_density(): random sequential adsorption, whose rate at a coverage c is (1 + 0.812 x +
/// 0.426 x^2 + 0.0717 x^3) (1 - x)^3, x = c / 0.547 (Schaaf and Talbot 1989, J. Chem. Phys. 91, 4401).
double placement_proposals(double density_m2, double minimum_distance_m);

/// Proposals of a Poisson process, hashed from the seed and the cell of the plane that they fall in, come one
/// after another by hashed times; one that lies nearer than the minimum distance to one that stays is
/// dropped. There are as many as lead to the peak density (to the largest possible, where that is less), and
/// the survivors are thinned to the density of their place, so the density is that of the map, also at the
/// edges of the area: proposals go on beyond it. Schaaf and Talbot's formula is true to 0.2 % up to half of
/// the jammed density, and at most 1.7 % too high above. Places do not depend on threads or order, nor, away
/// from its edges, on the area. In the order of cells. Throws InputError where there would be more than 2^25
/// proposals.
std::vector<RandomPosition> random_positions(const PlacementPlan& plan);

}  // namespace ifov::sampling
