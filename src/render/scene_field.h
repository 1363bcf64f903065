#pragma once

#include <vector>

#include "render/path_tracer.h"
#include "render/surface_label.h"
#include "sampling/field.h"
#include "sensor/camera.h"

namespace ifov::render {

/// How much a label says.
enum class LabelDetail {
  material,   ///< instance, patch, material, facing: no further rays
  sun_state,  ///< and how the Sun's disc is seen, by rays to fixed points of it
};

/// The picture on a camera's focal plane: answers a sampler's queries by tracing the scene. One tile, one thread.
class SceneField final : public sampling::Field {
 public:
  /// Keeps references to all; they must outlive this.
  SceneField(const SpectralScene& scene, const sensor::Camera& camera, TransportOptions transport,
             LabelDetail detail);

  int columns() const override { return static_cast<int>(scene_.nodes().channel_count()); }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override;
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override;
  /// Rays that met nothing stand on the material of the surroundings, the last of the scene.
  std::uint32_t material_of(sampling::Label label) const override;
  sampling::RayCounts counts() const override { return counts_; }

 private:
  void label_hits(std::span<const geometry::SurfacePoint> hits, std::span<sampling::Label> labels);

  const SpectralScene& scene_;
  const sensor::Camera& camera_;
  LabelDetail detail_;
  PathTracer tracer_;
  std::vector<math::Vec3> disc_points_;  // directions to the fixed points of the Sun's disc
  sampling::RayCounts counts_;
  std::vector<sampling::FocalPoint> points_;
  std::vector<math::Ray> rays_, sun_rays_;
  std::vector<PathKey> keys_;
  std::vector<geometry::SurfacePoint> hits_;
  std::vector<std::uint8_t> blocked_;
  std::vector<std::uint32_t> owner_;  // of each group of sun rays: index of its hit
  radiometry::SpectrumBlock radiance_;
};

}  // namespace ifov::render
