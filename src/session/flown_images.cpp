#include "session/flown_images.h"

#include "core/error.h"
#include "geometry/world.h"
#include "render/moving/moving_parts.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "transport/shining_parts.h"

namespace ifov::session {

void refuse_flown_images(const Parts& parts) {
  if (!parts.camera->moves_while_exposed() || parts.scene.world->survey() == nullptr) return;
  const transport::ShiningParts shining(*parts.spectral_scene);
  const render::MovingParts moving(parts.scene, *parts.camera, shining);
  if (!shining.parts().empty() || !shining.complete() || moving.any())
    throw InputError(
        "images in mirrors and panes of what outshines the scene are sought for one place of the camera, and a frame camera that flies is "
        "exposed from many; expected no 'exposure', with or without a 'row_period', or a scene without one of both");
}

}  // namespace ifov::session
