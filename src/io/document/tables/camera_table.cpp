#include "io/document/cameras/camera_model.h"
#include "io/document/schema/record.h"
#include "io/document/sensor_document.h"
#include "io/document/tables/tables.h"

namespace ifov::io {

SchemaType<CameraDocument> camera_type() {
  Record<CameraDocument> record("camera", "Where the rays of pixels go.");
  record.exactly_one();
  for (const CameraModel* model : camera_models())
    record.one(std::string(model->key),
               via(
                   [model](CameraDocument& camera, std::shared_ptr<const CameraSettings> settings) {
                     camera.model = model->key;
                     camera.settings = std::move(settings);
                   },
                   [](const CameraDocument& camera) { return camera.settings; }),
               model->type(), std::string(model->what));
  return record.type();
}

}  // namespace ifov::io
