#include "session/survey_stage.h"

#include "geometry/world/world_builder.h"
#include "sensor/camera.h"
#include "session/assembly/whole/light_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"

namespace ifov::session {

SurveyStage::SurveyStage(const io::Document& document) {
  scene.world = geometry::WorldBuilder().build();
  assemble_light(document, scene);
  channels = assemble_channels(document);
  camera = assemble_camera(document, scene);
}

SurveyStage::~SurveyStage() = default;

}  // namespace ifov::session
