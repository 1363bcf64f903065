#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/surface_point.h"
#include "ifov/temperature.h"
#include "math/ray.h"

namespace ifov::scene {
class SolvedTemperature;
}
namespace ifov::materials {
struct Material;
}

namespace ifov::session {

struct Parts;

/// The surface that a question about a point means, and what is known of its temperature.
struct LookedForPoint {
  math::Ray along;                                    ///< by which it was looked for
  geometry::SurfacePoint met;                         ///< no hit: nothing is there
  std::size_t object = 0;                             ///< of the document
  const scene::SolvedTemperature* surface = nullptr;  ///< null: its temperature is not solved
  std::uint32_t material = 0;
  const materials::Material* optics = nullptr;
  double half_width_k = 0.0;  ///< that images state for the material
};

/// `object`: of the document, whose surfaces alone are meant. InputError for a direction of no length.
LookedForPoint look_for(const Parts& parts, std::optional<std::size_t> object, const PointQuestion& question);

}  // namespace ifov::session
