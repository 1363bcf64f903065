#pragma once

#include <memory>

#include "render/parts/light_told.h"
#include "render/polarized/stokes_columns.h"
#include "sampling/field.h"

namespace ifov::math {
struct Ray;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::transport {
class LightInParts;
class PathLight;
class SpectralScene;
class ViewAtmosphere;
struct PartRows;
struct PathRecord;
}  // namespace ifov::transport

namespace ifov::render {

/// The light of recorded paths as it reaches a sensor, by column (StokesColumns): radiance alone, or with its polarization where
/// that is asked for and the scene tells it, and in parts where these are. Radiance alone of a scene that is polarized() has what
/// surfaces make of polarized light. An object serves one thread.
class SceneLight {
 public:
  /// Keeps references.
  SceneLight(const transport::SpectralScene& scene, const sensor::Camera& camera, const LightTold& told);
  ~SceneLight();

  StokesColumns& columns() { return columns_; }
  const StokesColumns& columns() const { return columns_; }

  /// Of path k, which began with `ray` through `point`. `row` has room for the scene's nodes, or for the columns where they are more.
  void write(const transport::PathRecord& paths, std::size_t k, const sampling::FocalPoint& point,
             const math::Ray& ray, float* row);
  bool polarized() const { return polarized_ != nullptr; }
  /// Of light that is not polarized, in nodes, as it leaves the air (transport::PathLight::levels()).
  struct Levels {
    float *direct, *rest;
  };
  Levels levels(const transport::PathRecord& paths, std::size_t k, bool whole);
  /// Of light that is told in parts: those of both into rows of columns; of a path that is not `whole` the first alone.
  void write_parts(const transport::PathRecord& paths, std::size_t k, bool whole, float* direct, float* rest);
  /// What of it its first surface makes of direct sunlight, as it leaves the air.
  void write_sunlight(const transport::PathRecord& paths, std::size_t k, const sampling::FocalPoint& point,
                      const math::Ray& ray, float* row);

 private:
  struct Polarized;
  struct Changed;
  void to_channels(const float* radiance, float* row) const;
  /// At the far end of a path's first segment, with what surfaces make of its polarization. The spectrum is the caller's until
  /// the next call.
  float* radiance(const transport::PathRecord& paths, std::size_t k);
  /// Whether a path's radiance is another one for the polarization of light on its way.
  bool is_changed(const transport::PathRecord& paths, std::size_t k) const;
  const transport::PartRows& changed_parts(const transport::PathRecord& paths, std::size_t k);
  void write_polarized(const transport::PathRecord& paths, std::size_t k, const sampling::FocalPoint& point,
                       const math::Ray& ray, float* row);

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  std::unique_ptr<transport::PathLight> light_;
  std::unique_ptr<const transport::ViewAtmosphere> air_;
  std::unique_ptr<Polarized> polarized_;            // null: radiance alone
  std::unique_ptr<Changed> changed_;                // of radiance alone that surfaces change; null: none do
  std::unique_ptr<transport::LightInParts> parts_;  // null: as a whole
  StokesColumns columns_;
};

}  // namespace ifov::render
