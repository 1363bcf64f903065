#include "render/series/temperatures_by_time.h"

#include <bit>

#include "geometry/surface_point.h"
#include "sampling/random.h"

namespace ifov::render {

scene::EstimatedTemperature TemperaturesByTime::at(std::size_t number, const geometry::SurfacePoint& point,
                                                   std::uint64_t draw, std::size_t time) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const math::Vec3 normal = point.shading_normal.as_vector();
  const std::uint64_t key = sampling::hash(number, draw, bits(point.position_m.x), bits(point.position_m.y),
                                           bits(point.position_m.z), bits(normal.x), bits(normal.y),
                                           bits(normal.z), point.instance, point.front);
  const auto [found, is_new] = number_.try_emplace(key, known_.size());
  if (is_new) {
    known_.resize(known_.size() + times_);
    of_.at(number, point, draw, {known_.data() + found->second, times_});
  }
  return known_[found->second + time];
}

}  // namespace ifov::render
