#pragma once

#include <span>

#include "radiometry/channel.h"

namespace ifov::render {
struct AccuracyRequest;
}
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::io {
struct DocumentSources;
}

namespace ifov::session {

/// What the air is worked out for: a sensor over a scene, and how exactly.
struct AtmosphereSubject {
  const io::DocumentSources& sources;
  const scene::Scene& scene;
  const sensor::Camera& camera;
  std::span<const radiometry::Channel> channels;
  const render::AccuracyRequest* request = nullptr;  ///< null: no accuracy is asked for
  bool polarized = false;                            ///< Q and U of sky and path are wanted
};

}  // namespace ifov::session
