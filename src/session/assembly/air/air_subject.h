#pragma once

#include <span>

#include "io/document/document.h"
#include "radiometry/channel.h"
#include "render/accuracy_tolerance.h"
#include "scene/scene.h"
#include "sensor/camera.h"

namespace ifov::session {

/// What the air is worked out for: a sensor over a scene, and how exactly.
struct AirSubject {
  const io::Document& document;
  const scene::Scene& scene;
  const sensor::Camera& camera;
  std::span<const radiometry::Channel> channels;
  const render::AccuracyRequest* request = nullptr;  ///< null: no accuracy is asked for
};

}  // namespace ifov::session
