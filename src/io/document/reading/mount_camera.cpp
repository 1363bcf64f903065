#include "io/document/reading/mount_camera.h"

#include "core/format.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/document.h"
#include "io/document/mount_document.h"
#include "io/document/platform_document.h"
#include "io/document/reading/tracked_objects.h"
#include "io/document/samplers/accuracy_sampling.h"

namespace ifov::io {

namespace {

/// Each single view is a tile of its own.
void settle_views(Document& document) {
  if (dynamic_cast<const ViewSettings*>(document.sensor.camera.settings.get()) == nullptr) return;
  document.sampling.tile_px = 1;
  const auto* accuracy = sampler_as<AccuracySampling>(document.sampling);
  const auto refuse = [&](const char* what) {
    throw document_error(document.sources,
                         accuracy != nullptr ? accuracy->position : document.sampling.position,
                         format("{}, and '{}' makes none: each of its views has an error of its own", what,
                                document.sensor.camera.model));
  };
  if (accuracy != nullptr && accuracy->of_image())
    refuse("\"of\": \"image\" is of the pixels of a picture together");
  if (document.sampling.method->audited_pixels()) refuse("an audit is of the pixels of a picture");
}

/// Those of a platform and of one of its sensors.
std::shared_ptr<const MountList> with_own(const PlatformDocument& platform, const SensorDocument& sensor) {
  const std::span<const MountDocument> carried = mounts_in(platform.mounts), own = mounts_in(sensor.mounts);
  MountList all{{carried.begin(), carried.end()}};
  all.mounts.insert(all.mounts.end(), own.begin(), own.end());
  return std::make_shared<const MountList>(std::move(all));
}

}  // namespace

void mount_camera(Document& document) {
  settle_views(document);
  std::shared_ptr<const PlatformFlight> flight;
  if (document.platform) {
    PlatformFlight carrying{*document.platform, document.time, document.scene.origin, document.seed};
    if (document.sensor.mounts) carrying.platform.mounts = with_own(*document.platform, document.sensor);
    find_tracked(document, carrying);
    flight = std::make_shared<const PlatformFlight>(std::move(carrying));
  }
  CameraDocument& camera = document.sensor.camera;
  if (document.sensor.mounts && !document.platform)
    throw document_error(document.sources, document.sensor.mounts->position,
                         "the sensor has a 'mount', and there is no 'platform' that carries it");
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
