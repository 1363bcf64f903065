#include "exposure/point_rays.h"

namespace ifov::exposure {
namespace {

constexpr double kShareInFull = 0.25;  // of the light: smaller ones have few rays
// Of asking for the temperature of a share of the light. What is not asked scatters a path's light by no more than half of what that is itself
// off by, and asking costs what the path costs: about where more of it is not worth its time.
constexpr double kChanceByShare = 2.0, kLeastChance = 0.01;
constexpr double kPairsOfSpread = 12.0;  // pairs of rays to the Sun by how far apart its places are
constexpr double kApart_w_m2 = 60.0, kApartOfLittle_w_m2 = 10.0;

}  // namespace

PointRays::PointRays(const thermal::SurfaceClasses::AtStake& at_stake, double share)
    : sun_pairs(1), sky_pairs(1), apart_w_m2(kApartOfLittle_w_m2), chance_behind(kChanceBehind) {
  in_full = share >= kShareInFull;
  if (!in_full) return;
  apart_w_m2 = kApart_w_m2;
  if (at_stake.rise_k > kLittle_k)
    sun_pairs = std::clamp(static_cast<int>(std::ceil(at_stake.sun_spread * kPairsOfSpread)), 1, kSunPairs);
}

AskedByChance::AskedByChance(const thermal::SurfaceClasses& classes, double share)
    : else_k_(classes.middle_k()), chance_(std::clamp(share * kChanceByShare, kLeastChance, 1.0)) {}

scene::EstimatedTemperature AskedByChance::counted(const scene::EstimatedTemperature& asked) const {
  if (chance_ >= 1.0) return asked;
  return {asked.kelvin, asked.deviation_k, else_k_, 1.0 / chance_};
}

}  // namespace ifov::exposure
