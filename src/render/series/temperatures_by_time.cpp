#include "render/series/temperatures_by_time.h"

#include <bit>

#include "geometry/surface_point.h"
#include "sampling/random.h"

namespace ifov::render {

scene::EstimatedTemperature TemperaturesByTime::at(std::size_t number, const geometry::SurfacePoint& point,
                                                   std::uint64_t draw, double share, std::size_t time) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const math::Vec3 normal = point.shading_normal.as_vector();
  const std::uint64_t key = sampling::hash(number, draw, bits(share), bits(point.position_m.x),
                                           bits(point.position_m.y), bits(point.position_m.z), bits(normal.x),
                                           bits(normal.y), bits(normal.z), point.instance, point.front);
  // Times ask in the same order, as a rule.
  std::size_t one = next_[time];
  if (one >= key_.size() || key_[one] != key) {
    const auto [found, is_new] = number_.try_emplace(key, key_.size());
    one = found->second;
    if (is_new) {
      key_.push_back(key);
      known_.resize(known_.size() + times_);
      of_.at(number, point, draw, share, {known_.data() + one * times_, times_});
    }
  }
  next_[time] = one + 1;
  return known_[one * times_ + time];
}

}  // namespace ifov::render
