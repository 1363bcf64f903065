#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "thermal/times/classes_of_times.h"

namespace ifov::exposure {

/// Where rays to the Sun of past times go: sets of one in each bin of the past, of which a point draws two. The sets together have kSets times of each bin, spread evenly by its density, each with
/// a place of the Sun's disc as it stood then: what is seen until some moment of a bin, and hidden from then on, is off by half of one in the mean. Which go together is by chance.
class PastSuns {
 public:
  static constexpr std::size_t kSets = 1024;

  PastSuns(const thermal::ClassesOfTimes& classes, double sun_radius_rad);

  struct Place {
    float x = 0.0f, y = 0.0f, z = 0.0f;  ///< towards it, unit
    thermal::ClassesOfTimes::Moment moment;

    math::Vec3 direction() const { return {double(x), double(y), double(z)}; }
  };
  using Set = std::span<const Place>;  ///< by bin
  /// Two, independent of each other, by 64 random bits.
  std::array<Set, 2> draw(std::uint64_t random) const { return {set(random >> 32), set(random)}; }

 private:
  Set set(std::uint64_t random) const { return {places_.data() + random % kSets * bins_, bins_}; }

  std::size_t bins_;
  std::vector<Place> places_;  ///< set by set: what a point reads lies side by side
};

}  // namespace ifov::exposure
