#pragma once

#include <memory>

#include "render/field/label_detail.h"
#include "render/parts/light_told.h"
#include "sampling/field.h"
#include "transport/transport_options.h"

namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// A SceneField, for who samples one without knowing more of it. Keeps references to scene and camera.
std::unique_ptr<sampling::Field> make_field(const transport::SpectralScene& scene,
                                            const sensor::Camera& camera,
                                            const transport::TransportOptions& transport, LabelDetail detail,
                                            const LightTold& told = {});

}  // namespace ifov::render
