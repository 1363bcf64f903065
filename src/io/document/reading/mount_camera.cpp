#include "io/document/reading/mount_camera.h"

#include "io/document/cameras/camera_settings.h"
#include "io/document/document.h"
#include "io/document/platform_document.h"

namespace ifov::io {

void mount_camera(Document& document) {
  std::shared_ptr<const PlatformFlight> flight;
  if (document.platform)
    flight = std::make_shared<const PlatformFlight>(
        PlatformFlight{*document.platform, document.time, document.scene.origin, document.seed});
  CameraDocument& camera = document.sensor.camera;
  try {
    if (auto carried = camera.settings->carried_by(flight)) {
      camera.settings = std::move(carried);
      // What is found when it is built, files of the path above all, is the platform's.
      if (flight) camera.position = flight->platform.position;
    }
  } catch (const InputError& error) {
    throw document_error(document.sources, flight ? flight->platform.position : camera.position,
                         error.what());
  }
}

}  // namespace ifov::io
