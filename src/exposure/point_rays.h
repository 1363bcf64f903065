#pragma once

#include <algorithm>
#include <cmath>

#include "scene/solved_temperature.h"
#include "thermal/surface_classes.h"

namespace ifov::exposure {

/// Which rays tell of a point's temperature: by what they may bring in kelvins, and by how much light it is asked for. Without bias however many they are.
struct PointRays {
  static constexpr int kSunPairs = 5, kSkyPairs = 2;  ///< at most
  static constexpr double kChanceBehind = 1.0 / 3.0;

  int sun_pairs = kSunPairs, sky_pairs = kSkyPairs;
  double apart_w_m2 = 1e30;    ///< by which what is met is taken to differ from the ground
  double chance_behind = 1.0;  ///< as Neighbours::Behind
  int depth = 2;
  bool in_full = true;  ///< not for a small share of the light

  /// Of a share of the light that is asked for.
  PointRays(const thermal::SurfaceClasses::AtStake& at_stake, double share);
  /// All there are.
  explicit PointRays(int behind) : depth(behind) {}

  /// By which what a ray meets is asked what it sends: of a share of the view, where `worth_k` is what a gain throughout the past is worth.
  double chance_beside(double view, double worth_k) const {
    return std::clamp(view * worth_k * apart_w_m2 / kLittle_k, kLeastAsked, 1.0);
  }

  static constexpr double kLittle_k = 2.0;  ///< scatter that few rays may leave
  static constexpr double kLeastAsked = 0.25;
};

/// A temperature for a small share of the light, which is asked for by chance alone, and else taken for some other one: what light it is more than that one's counts by the inverse of the chance.
class AskedByChance {
 public:
  AskedByChance(const thermal::SurfaceClasses& classes, double share);
  double chance() const { return chance_; }
  scene::EstimatedTemperature else_taken() const { return {else_k_}; }
  scene::EstimatedTemperature counted(const scene::EstimatedTemperature& asked) const;

 private:
  double else_k_, chance_;
};

}  // namespace ifov::exposure
