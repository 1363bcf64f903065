#pragma once

#include "landscape/shapes/region.h"
#include "landscape/streets/street_plan.h"

namespace ifov::landscape {

/// Paint on the streets: double yellow lines in the middle and white lines at the edges of main streets, stop lines
/// and crosswalks where side streets end at them.
struct RoadMarkings {
  Region white, yellow;
};

RoadMarkings paint_streets(const StreetPlan& streets);

}  // namespace ifov::landscape
