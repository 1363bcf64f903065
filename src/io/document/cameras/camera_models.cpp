#include <array>

#include "core/error.h"
#include "io/document/cameras/camera_model.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/cameras/lens_tables.h"
#include "io/document/cameras/orthographic_camera.h"
#include "io/document/cameras/pushbroom_camera.h"
#include "io/document/cameras/scanning_cameras.h"
#include "sensor/detector/read_out.h"

namespace ifov::io {
namespace {

constexpr std::array kModels{&OrthographicCamera::kModel, &FrameCamera::kModel, &PushbroomCamera::kModel,
                             &WhiskbroomCamera::kModel, &ConicalCamera::kModel};

}  // namespace

std::span<const CameraModel* const> camera_models() { return kModels; }

std::shared_ptr<const CameraSettings> CameraSettings::carried_by(
    std::shared_ptr<const PlatformFlight> by) const {
  if (by)
    throw InputError(
        "a platform carries a camera that scans or has a frame: expected a 'pushbroom', 'whiskbroom', 'conical' or 'frame' camera, or no 'platform'");
  return nullptr;
}

sensor::ReadOut CameraSettings::read_out() const { return {}; }

std::optional<FocalPlane> CameraSettings::focal_plane() const { return std::nullopt; }

std::optional<SensitiveSide> CameraSettings::sensitive_side() const { return std::nullopt; }

}  // namespace ifov::io
