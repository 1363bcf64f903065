#pragma once

#include <span>
#include <vector>

#include "math/transform.h"
#include "scene/scene.h"

namespace ifov::io {
struct DocumentSources;
struct LampDocument;
}  // namespace ifov::io

namespace ifov::session {

class MapFrame;

/// A lamp as the scene has it: a unit sphere, or the unit disk (outside up), and the state of its surface.
struct PlacedLamp {
  bool is_disk = false;
  math::Transform scene_from_unit;
  scene::SurfaceState state;
};

/// A document's lamps; adds their light and one black material to the scene. Lamps of the same light share it.
std::vector<PlacedLamp> assemble_lamps(const io::DocumentSources& sources,
                                       std::span<const io::LampDocument> lamps, const MapFrame& frame,
                                       scene::Scene& scene);

}  // namespace ifov::session
