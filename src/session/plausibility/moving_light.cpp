#include <algorithm>

#include "core/format.h"
#include "geometry/motion/moving_world.h"
#include "io/document/document.h"
#include "sensor/flying/image_way.h"
#include "session/loaded/parts.h"
#include "session/plausibility/motion_lines.h"
#include "transport/shining_parts.h"
#include "transport/spectral_scene.h"

namespace ifov::session {

void warn_of_moving_light(const Parts& parts, LogSink& log) {
  if (!parts.plan.request || !parts.plan.request->image_wide) return;
  const transport::ShiningParts of_scene(*parts.spectral_scene);
  geometry::WantedMaterials shining;
  for (std::uint32_t a = 0; a < parts.scene.assignments.size(); ++a) shining.push_back(of_scene.wants(a));
  if (std::find(shining.begin(), shining.end(), true) == shining.end()) return;
  const char* const by_chance =
      "where it looks smaller than a pixel, the accuracy of an image as a whole meets it by chance alone and may not know that it "
      "is missing; \"of\": \"pixel\" seeks it";
  if (const auto motion = sensor::frame_motion(*parts.camera, parts.scene.world->heights().low_m);
      motion && (motion->exposure_px > 0.0 || motion->row_px > 0.0))
    log.warn(
        format("the camera moves while it is exposed, and something outshines the scene: {}", by_chance));
  const geometry::MovingWorld* const world = parts.scene.world->moving();
  for (std::size_t m = 0; world != nullptr && m < world->mover_count(); ++m) {
    bool shines = false;
    world->body(m).visit_surfaces(shining, [&](const geometry::SurfacePiece&) { shines = true; });
    if (shines)
      log.warn(format("{} moves and outshines the scene: {}",
                      title_of(parts.document.scene.objects, parts.placed.of(world->first_object(m))),
                      by_chance));
  }
}

}  // namespace ifov::session
