#pragma once

#include <string>
#include <vector>

#include "landscape/plots/plot_plan.h"
#include "landscape/plots/power_line.h"
#include "landscape/streets/street_plan.h"

namespace ifov::landscape {

/// A copy of a plant.
struct Planted {
  Vec2 at;
  double rotation_rad = 0.0, scale = 1.0;
};

/// An individual of a species: the name of its prototype, its size at scale 1, and where copies of it stand.
struct Stock {
  std::string prototype;
  double crown_radius_m = 1.0;
  bool low_branches = false;
  std::vector<Planted> copies;
};

/// All that is in the way of plants.
struct Obstacles {
  const StreetPlan& streets;
  const PlotPlan& plots;
  const PowerLine& line;
};

/// Trees in gardens, along the verge opposite the power line, and around the tennis court. Crowns keep clear of
/// houses, wires and, mostly, of each other.
void plant_trees(std::vector<Stock>& species, const Obstacles& obstacles, const RandomStream& random);

/// Hedges along the sides of some back gardens, in segments of 1 m.
void plant_hedges(std::vector<Stock>& segments, const std::vector<Stock>& trees, const Obstacles& obstacles,
                  const RandomStream& random);

/// Shrubs before the front walls of houses.
void plant_shrubs(std::vector<Stock>& shrubs, const Obstacles& obstacles, const RandomStream& random);

/// The bed before a house in which its shrubs stand.
Footprint front_bed(const Plot& plot, const HousePlan& design);

}  // namespace ifov::landscape
