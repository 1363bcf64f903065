#include "render/polarized/scene_light.h"

#include <algorithm>
#include <stdexcept>

#include "radiometry/polarization_frame.h"
#include "radiometry/spectral_nodes.h"
#include "render/polarized/polarimetry.h"
#include "sensor/camera.h"
#include "transport/polarized/polarized_air.h"
#include "transport/polarized/polarized_path_light.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

struct SceneLight::Polarized {
  explicit Polarized(const transport::SpectralScene& scene) : light(scene), air(scene) {}
  transport::PolarizedPathLight light;
  transport::PolarizedAir air;
};

SceneLight::SceneLight(const transport::SpectralScene& scene, const sensor::Camera& camera,
                       const Polarimetry* polarimetry)
    : scene_(scene),
      camera_(camera),
      light_(scene),
      air_(scene),
      polarized_(polarimetry != nullptr && polarimetry->any() ? std::make_unique<Polarized>(scene) : nullptr),
      columns_(polarimetry, scene.nodes()) {
  if (polarized_ != nullptr && !scene.polarized())
    throw std::invalid_argument("a sensor that tells polarization needs a scene that keeps it");
}

SceneLight::~SceneLight() = default;

void SceneLight::to_channels(const float* radiance, float* row) const {
  scene_.nodes().to_channels(radiance, row);
}

void SceneLight::write_polarized(const transport::PathRecord& paths, std::size_t k,
                                 const sampling::FocalPoint& point, const math::Ray& ray, float* row) {
  const radiometry::PolarizationFrame frame = sensor::focal_frame(camera_, point.y_px, ray);
  const transport::StokesRows light = polarized_->light.light(paths, k, frame);
  polarized_->air.apply(paths.paths[k], frame, light);
  columns_.write(light, row);
}

void SceneLight::write_sunlight(const transport::PathRecord& paths, std::size_t k,
                                const sampling::FocalPoint& point, const math::Ray& ray, float* row) {
  if (polarized_ != nullptr) {
    const transport::StokesRows light =
        polarized_->light.first_sunlight(paths, k, sensor::focal_frame(camera_, point.y_px, ray));
    polarized_->air.see_through(paths.paths[k], light);
    return columns_.write(light, row);
  }
  radiometry::SpectrumBlock nothing(1, scene_.node_count());
  float* radiance = light_.first_sunlight(paths, k);
  // Of what the air makes of light its own light is no part here.
  air_.apply(paths.paths[k], radiance);
  air_.apply(paths.paths[k], nothing.row(0));
  for (std::size_t n = 0; n < nothing.stride(); ++n)
    radiance[n] = std::max(0.0f, radiance[n] - nothing.row(0)[n]);
  to_channels(radiance, row);
}

}  // namespace ifov::render
