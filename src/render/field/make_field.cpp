#include "render/field/make_field.h"

#include "render/field/scene_field.h"

namespace ifov::render {

std::unique_ptr<sampling::Field> make_field(const transport::SpectralScene& scene,
                                            const sensor::Camera& camera,
                                            const transport::TransportOptions& transport, LabelDetail detail,
                                            const LightTold& told) {
  return std::make_unique<SceneField>(scene, camera, transport, detail, told);
}

}  // namespace ifov::render
