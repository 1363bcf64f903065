#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/body.h"
#include "geometry/shapes.h"
#include "math/transform.h"

namespace ifov::geometry {

/// A shape or prototype as the builder hands it over: a plane or a body.
struct Template {
  std::optional<Plane> plane;
  Body body;
  std::uint32_t uses = 0;
};

/// One placed object.
struct Placement {
  std::uint32_t of = 0;         ///< index of its template
  std::uint32_t materials = 0;  ///< where its materials begin in the list, one per slot
  bool seed = true;
  math::Transform scene_from_object;
};

struct WorldContent {
  std::vector<Template> templates;
  std::vector<Placement> placements;
  std::vector<std::uint32_t> materials;
};

}  // namespace ifov::geometry
