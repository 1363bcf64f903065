#pragma once

#include <string>
#include <vector>

#include "landscape/buildings/house.h"
#include "landscape/streets/street_plan.h"

namespace ifov::landscape {

/// A plot with its house. Footprints are of things flat on the ground unless said otherwise.
struct Plot {
  Stand stand;  ///< at the middle of its front, on the sidewalk's inner edge
  double width = 20.0, depth = 34.0;
  int number = 0;
  Footprint area() const { return {stand, -0.5 * width, 0.5 * width, 0.0, depth}; }

  int design = 0;  ///< of the house
  Stand house;
  Footprint house_footprint;       ///< with eaves
  Footprint driveway, front_walk;  ///< from the garage and from the door to the asphalt or the sidewalk
  Footprint patio;
  bool has_pool = false;
  Footprint pool_deck, pool;
  bool paved_driveway = true;  ///< concrete, else asphalt
};

struct PlotPlan {
  std::vector<HousePlan> designs;
  std::vector<Plot> plots;
  Stand court_stand;     ///< at the middle of the tennis court, its length along the street
  Footprint court_park;  ///< the lot of the court
  std::size_t court_street = 0;
};

/// Plots on both sides of the main streets; a plot whose house would stand in a street, or within 3 m of another
/// house, is left out. One lot, as near to the origin as can be, holds the court.
PlotPlan plan_plots(const StreetPlan& streets, const RandomStream& random);

}  // namespace ifov::landscape
