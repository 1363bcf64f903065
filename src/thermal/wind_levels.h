#pragma once

#include "thermal/wind_profile.h"

namespace ifov::thermal {

/// Heights over a terrain, from the lowest wind up to 60 m, each with the same ratio of wind speed to the one below, at most
/// kMostRatio. Level 0 is all that is as low as the lowest wind or lower.
class WindLevels {
 public:
  static constexpr double kMostRatio = 1.2;

  explicit WindLevels(Terrain terrain);
  int highest() const { return highest_; }  ///< of the levels' numbers: that at 60 m
  double height_m(int level) const;
  /// Between levels by the logarithm of the wind: 2.5 is midway from level 2 to 3.
  double place(double height_m) const;

 private:
  double roughness_m_, lowest_ln_, ln_ratio_;  ///< ln(z / z0) of level 0; of the wind from one to the next
  int highest_;
};

}  // namespace ifov::thermal
