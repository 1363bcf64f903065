#pragma once

#include <string>
#include <vector>

#include "landscape/plots/plot_plan.h"
#include "landscape/streets/street_plan.h"
#include "landscape/things/car.h"

namespace ifov::landscape {

struct ParkedCar {
  Stand stand;  ///< the car heads along its `along`
  CarKind kind = CarKind::sedan;
  std::string paint;  ///< material of the body
  double ground_m = 0.0;
};

/// Cars before garages, at kerbs and in the lanes; none touches another.
std::vector<ParkedCar> plan_cars(const StreetPlan& streets, const PlotPlan& plots,
                                 const RandomStream& random);

/// The rectangle that a car takes up.
Footprint car_footprint(const Stand& stand);

}  // namespace ifov::landscape
