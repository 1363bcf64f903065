#pragma once

#include <cstdint>

#include "sampling/hash.h"
#include "sampling/random.h"

namespace ifov::landscape {

/// Random choices keyed by what they are for: the same key gives the same choice, whatever was chosen before.
class RandomStream {
 public:
  explicit constexpr RandomStream(std::uint64_t key) : key_(key) {}

  /// The choices of a part: random.of(Purpose::tree, 12).
  template <class... What>
  constexpr RandomStream of(What... what) const {
    return RandomStream(sampling::hash(key_, what...));
  }

  /// In [0, 1); `index` tells the choices of one part from each other.
  constexpr double unit(int index) const { return sampling::unit_double(sampling::hash(key_, index)); }
  constexpr double between(double low, double high, int index) const {
    return low + (high - low) * unit(index);
  }
  /// 0 to count - 1.
  constexpr int pick(int count, int index) const { return static_cast<int>(unit(index) * count); }
  constexpr bool happens(double probability, int index) const { return unit(index) < probability; }

 private:
  std::uint64_t key_;
};

/// Smooth noise between 0 and 1 that varies over `scale_m`, the sum of `octaves` of value noise, each half as
/// large and half as strong as the one before (fractal noise).
double fractal_noise(const RandomStream& random, double x_m, double y_m, double scale_m, int octaves);

}  // namespace ifov::landscape
