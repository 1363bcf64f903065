#include "exposure/point_rays.h"

namespace ifov::exposure {
namespace {

constexpr double kShareInFull = 0.25;    // of the light: smaller ones have few rays
constexpr double kMostMoved_k = 15.0;    // of temperatures that are asked for by chance
constexpr double kPairsOfSpread = 12.0;  // pairs of rays to the Sun by how far apart its places are
constexpr double kApart_w_m2 = 60.0, kApartOfLittle_w_m2 = 10.0;

}  // namespace

PointRays::PointRays(const thermal::SurfaceClasses::AtStake& at_stake, double share)
    : sun_pairs(1), sky_pairs(1), apart_w_m2(kApartOfLittle_w_m2), chance_behind(kChanceBehind) {
  if (share < kShareInFull) return;
  apart_w_m2 = kApart_w_m2;
  if (at_stake.rise_k > kLittle_k)
    sun_pairs = std::clamp(static_cast<int>(std::ceil(at_stake.sun_spread * kPairsOfSpread)), 1, kSunPairs);
  if (std::abs(at_stake.of_sky_k) > kLittle_k) sky_pairs = kSkyPairs;
}

AskedByChance::AskedByChance(const thermal::SurfaceClasses& classes, double share)
    : else_k_(classes.middle_k()) {
  const double moved_k = std::max(classes.hottest_k() - else_k_, else_k_ - classes.coldest_k());
  chance_ = std::clamp(std::max(share / kShareInFull, moved_k / kMostMoved_k), PointRays::kLeastAsked, 1.0);
}

scene::EstimatedTemperature AskedByChance::moved(const scene::EstimatedTemperature& asked) const {
  if (chance_ >= 1.0) return asked;
  const double off_k = asked.kelvin - else_k_;
  // Of a variance that holds those which are not asked: (1 / chance - 1) times the mean square.
  return {
      else_k_ + off_k / chance_,
      std::sqrt((off_k * off_k * (1.0 / chance_ - 1.0) + asked.deviation_k * asked.deviation_k) / chance_)};
}

}  // namespace ifov::exposure
