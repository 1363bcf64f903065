#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/mirrors/focal_lights.h"
#include "render/mirrors/glint_search.h"
#include "render/mirrors/mirrored_spectra.h"
#include "render/parts/light_told.h"

namespace ifov::scene {
struct ResolvedSurface;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class StokesColumns;

/// The Sun's glints on curved mirrors that the sensor sees directly: images of the disc that are far smaller than a
/// pixel and far brighter than anything in it, so that paths would not meet them. Where they lie follows from the
/// surfaces' shapes (GlintSearch); what stands before the mirror and between it and the Sun is traced. Paths leave them
/// out (TransportOptions::sought_only), and they are added to finished tiles.
class Glints {
 public:
  /// Whether glints are to be found in a scene: it has curved mirrors under a Sun, once each (of a periodic scene the
  /// copies are not searched, and its pixels are marked instead).
  static bool in(const transport::SpectralScene& scene);

  /// Traces all of them. Keeps a reference to the scene. `margin_px`: a footprint's half width.
  Glints(const transport::SpectralScene& scene, const sensor::Camera& camera, double margin_px,
         std::uint64_t seed, const LightTold& told = {});
  ~Glints();

  /// As FocalLights::add_to.
  void add_to(const sampling::ColumnFootprints& footprints, const sampling::Tolerance* tolerance,
              sampling::TileResult& tile, std::span<const double> kept = {}) const {
    lights_.add_to(footprints, tolerance, tile, kept);
  }
  const FocalLights& lights() const { return lights_; }

  std::size_t count() const { return lights_.lights().size(); }

 private:
  void trace(std::vector<GlintPoint>& points);
  std::uint32_t row_of(const geometry::SurfacePoint& hit, const scene::ResolvedSurface& surface,
                       const math::Ray& seen, const sampling::FocalPoint& image);

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  std::uint64_t seed_;
  MirroredSpectra mirrored_;
  bool polarized_;  // the sensor tells polarization
  std::unique_ptr<StokesColumns> stokes_;
  FocalLights lights_;  // radiance of the Sun's disc, reflected, at the sensor
  std::uint32_t last_material_ = ~0u, last_row_ = 0;
  double last_cosine_ = 0.0;
  math::Vec3 last_normal_;
};

}  // namespace ifov::render
