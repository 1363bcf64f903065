#include "io/document/reading/tracked_objects.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/names.h"
#include "io/document/cameras/frame_check.h"
#include "io/document/document.h"
#include "io/document/mount_document.h"
#include "io/document/platform_document.h"

namespace ifov::io {

void find_tracked(const Document& document, PlatformFlight& flight) {
  for (const MountDocument& mount : mounts_in(flight.platform.mounts)) {
    const auto* gimbal = std::get_if<GimbalDocument>(&mount.bearing);
    if (gimbal == nullptr) continue;
    if (const auto* point = std::get_if<FramedPoint>(&gimbal->target)) {
      try {
        check_frame(*point, "a point about the Earth", document.scene.origin);
      } catch (const InputError& error) {
        throw document_error(document.sources, gimbal->position, error.what());
      }
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

}  // namespace ifov::io
