#include "session/surveys/survey_stage.h"

#include "geometry/world/world_builder.h"
#include "io/document/document.h"
#include "sensor/camera.h"
#include "session/assembly/whole/light_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/one_material.h"

namespace ifov::session {

SurveyStage::SurveyStage(const io::Document& document) {
  scene.world = geometry::WorldBuilder().build();
  assemble_light({document.sources, document.light, document.atmosphere, document.scene.origin, document.time,
                  surroundings_material(document)},
                 scene);
  channels = assemble_channels(document.sources, document.sensor.channels);
  camera = assemble_camera(document.sources, document.sensor.camera, document.scene.origin, *scene.world,
                           document.seed);
}

SurveyStage::~SurveyStage() = default;

}  // namespace ifov::session
