#pragma once

#include <memory>

#include "render/polarized/stokes_columns.h"
#include "sampling/field.h"
#include "transport/path_light.h"
#include "transport/view_atmosphere.h"

namespace ifov::math {
struct Ray;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// The light of recorded paths as it reaches a sensor, by column (StokesColumns): radiance alone, or with its polarization where
/// that is asked for and the scene tells it. An object serves one thread.
class SceneLight {
 public:
  /// Keeps references; `polarimetry` may be null.
  SceneLight(const transport::SpectralScene& scene, const sensor::Camera& camera,
             const Polarimetry* polarimetry);
  ~SceneLight();

  StokesColumns& columns() { return columns_; }
  const StokesColumns& columns() const { return columns_; }

  /// Of path k, which began with `ray` through `point`. `row` has room for the scene's nodes, or for the columns where they are more.
  void write(const transport::PathRecord& paths, std::size_t k, const sampling::FocalPoint& point,
             const math::Ray& ray, float* row) {
    if (polarized_ != nullptr) return write_polarized(paths, k, point, ray, row);
    float* radiance = light_.radiance(paths, k);
    air_.apply(paths.paths[k], radiance);
    to_channels(radiance, row);
  }
  bool polarized() const { return polarized_ != nullptr; }
  /// Of light that is not polarized, in nodes, as it leaves the air (transport::PathLight::levels()).
  transport::PathLight::Levels levels(const transport::PathRecord& paths, std::size_t k, bool whole) {
    const transport::PathLight::Levels light = light_.levels(paths, k, whole);
    air_.apply(paths.paths[k], light.direct, light.rest);
    return light;
  }
  /// What of it its first surface makes of direct sunlight, as it leaves the air.
  void write_sunlight(const transport::PathRecord& paths, std::size_t k, const sampling::FocalPoint& point,
                      const math::Ray& ray, float* row);

 private:
  struct Polarized;
  void to_channels(const float* radiance, float* row) const;
  void write_polarized(const transport::PathRecord& paths, std::size_t k, const sampling::FocalPoint& point,
                       const math::Ray& ray, float* row);

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  transport::PathLight light_;
  transport::ViewAtmosphere air_;
  std::unique_ptr<Polarized> polarized_;  // null: radiance alone
  StokesColumns columns_;
};

}  // namespace ifov::render
