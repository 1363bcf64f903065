#include "exposure/past_suns.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "sampling/random.h"
#include "sampling/warp.h"

namespace ifov::exposure {

PastSuns::PastSuns(const thermal::ClassesOfTimes& classes, double sun_radius_rad)
    : bins_(classes.bins()), places_(kSets * bins_) {
  // Steps of the plane's lattice by the root of x^3 = x + 1 (Roberts 2018): with evenly spaced times, even in all three.
  constexpr double kAcross = 0.7548776662466927, kAlong = 0.5698402909980532;
  const sampling::UniformCone disc(sun_radius_rad);
  const auto part = [](double x) { return x - std::floor(x); };
  std::vector<std::size_t> order(kSets);
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = kSets - 1; k > 0; --k) std::swap(order[k], order[sampling::hash(bin, k) % (k + 1)]);
    for (std::size_t k = 0; k < kSets; ++k) {
      const auto number = static_cast<double>(order[k]);
      const auto moment = classes.draw(bin, (number + 0.5) / kSets);
      const math::Vec3 towards =
          disc.sample(classes.towards_sun(moment), {part(number * kAcross), part(number * kAlong)});
      places_[k * bins_ + bin] = {static_cast<float>(towards.x), static_cast<float>(towards.y),
                                  static_cast<float>(towards.z), moment};
    }
  }
}

}  // namespace ifov::exposure
