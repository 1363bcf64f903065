#include <array>

#include "io/document/cameras/camera_model.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/cameras/orthographic_camera.h"

namespace ifov::io {
namespace {

constexpr std::array kModels{&OrthographicCamera::kModel, &FrameCamera::kModel};

}  // namespace

std::span<const CameraModel* const> camera_models() { return kModels; }

}  // namespace ifov::io
