#pragma once

#include <memory>
#include <vector>

#include "radiometry/channel.h"
#include "scene/scene.h"

namespace ifov::io {
struct Document;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

/// What a survey of a document's atmosphere needs of it beside the atmosphere: a scene of light alone (no mesh is read),
/// and the sensor.
struct SurveyStage {
  explicit SurveyStage(const io::Document& document);
  ~SurveyStage();

  scene::Scene scene;
  std::vector<radiometry::Channel> channels;
  std::unique_ptr<sensor::Camera> camera;
};

}  // namespace ifov::session
