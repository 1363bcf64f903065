#include <array>

#include "core/error.h"
#include "io/document/cameras/camera_model.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/cameras/orthographic_camera.h"
#include "io/document/cameras/pushbroom_camera.h"

namespace ifov::io {
namespace {

constexpr std::array kModels{&OrthographicCamera::kModel, &FrameCamera::kModel, &PushbroomCamera::kModel};

}  // namespace

std::span<const CameraModel* const> camera_models() { return kModels; }

std::shared_ptr<const CameraSettings> CameraSettings::carried_by(
    std::shared_ptr<const PlatformFlight> by) const {
  if (by)
    throw InputError(
        "a platform carries a camera that scans: expected a 'pushbroom' camera, or no 'platform'");
  return nullptr;
}

}  // namespace ifov::io
