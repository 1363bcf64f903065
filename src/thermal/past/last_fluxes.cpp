// What a surface gains at the end of a series.
#include <algorithm>
#include <cmath>
#include <limits>

#include "thermal/surface_classes.h"

namespace ifov::thermal {

Fluxes SurfaceClasses::last_fluxes(const Pose& pose, double visibility, double free_sky,
                                   const FromBeside& beside, double surface_k) const {
  const OutdoorsSeries last{end_s(), step_s(), {series_->rows.back()}, series_->anemometer};
  Stand stand = surface_.stand;
  stand.tilt_rad = std::acos(std::clamp(pose.normal.z, -1.0, 1.0));
  stand.azimuth_rad = std::atan2(pose.normal.x, pose.normal.y);
  stand.height_m = pose.height_m;
  // What holds a temperature or melts gives or takes what it has to, which a temperature known to a tenth of a kelvin does not tell.
  Skin skin = surface_.skin;
  skin.melts_k = std::numeric_limits<double>::infinity();
  skin.as_air = false;
  skin.held_k.reset();
  const SurfaceBalance balance(last, skin, stand, {visibility}, {free_sky}, {beside});
  return balance.fluxes(last.begin_s, surface_k);
}

}  // namespace ifov::thermal
