#include "io/document/reading/mount_camera.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/format.h"
#include "core/names.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/document.h"
#include "io/document/mount_document.h"
#include "io/document/platform_document.h"
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

/// Paths of what gimbals track.
void find_tracked(const Document& document, PlatformFlight& flight) {
  for (const MountDocument& mount : mounts_in(flight.platform.mounts)) {
    const auto* gimbal = std::get_if<GimbalDocument>(&mount.bearing);
    if (gimbal == nullptr) continue;
    if (const auto* point = std::get_if<FramedPoint>(&gimbal->target)) {
      if (point->frame != PathFrame::scene && !document.scene.origin.geographic)
        throw document_error(
            document.sources, gimbal->position,
            "a point about the Earth needs the place of the scene: expected an 'origin' of the scene with 'latitude' and "
            "'longitude'");
      continue;
    }
    const DocumentName& wanted = std::get<TrackedObject>(gimbal->target).name;
    std::vector<std::string> moving;
    for (const ObjectDocument& object : document.scene.objects)
      if (object.motion && !object.name.empty()) {
        moving.push_back(object.name);
        if (object.name == wanted.name) flight.tracked[object.name] = object.motion;
      }
    if (flight.tracked.contains(wanted.name)) continue;
    const bool exists = std::any_of(document.scene.objects.begin(), document.scene.objects.end(),
                                    [&](const ObjectDocument& object) { return object.name == wanted.name; });
    throw document_error(document.sources, wanted.position,
                         format("{}{}; expected {}, or a 'point'",
                                exists ? format("'{}' does not move", wanted.name)
                                       : format("there is no object '{}'", wanted.name),
                                did_you_mean(wanted.name, moving),
                                moving.empty() ? std::string("the name of an object that has a 'motion'")
                                               : format("an object that moves ({})", list_names(moving))));
  }
  const std::size_t mounts = mounts_in(flight.platform.mounts).size();
  const auto& reported = flight.platform.reported;
  if (const std::size_t told = reported ? mounts_in(reported->mounts).size() : 0;
      told > std::max<std::size_t>(mounts, 1))
    throw document_error(document.sources, flight.platform.position,
                         format("'reported' tells of {} mounts, and there {}", told,
                                mounts == 1 ? std::string("is one") : format("are {}", mounts)));
}

}  // namespace

void mount_camera(Document& document) {
  settle_views(document);
  std::shared_ptr<const PlatformFlight> flight;
  if (document.platform) {
    PlatformFlight carrying{*document.platform, document.time, document.scene.origin, document.seed};
    find_tracked(document, carrying);
    flight = std::make_shared<const PlatformFlight>(std::move(carrying));
  }
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
