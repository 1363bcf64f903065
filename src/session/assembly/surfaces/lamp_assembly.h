#pragma once

#include <vector>

#include "math/transform.h"
#include "scene/scene.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

/// A lamp as the scene has it: a unit sphere, or the unit disk (outside up), and the state of its surface.
struct PlacedLamp {
  bool is_disk = false;
  math::Transform scene_from_unit;
  scene::SurfaceState state;
};

/// The document's lamps; adds their light and one black material to the scene. Lamps of the same light share it.
std::vector<PlacedLamp> assemble_lamps(const io::Document& document, scene::Scene& scene);

}  // namespace ifov::session
