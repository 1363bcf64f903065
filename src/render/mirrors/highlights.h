#pragma once

#include <memory>
#include <vector>

#include "render/mirrors/focal_lights.h"
#include "render/mirrors/glint_search.h"
#include "render/parts/light_told.h"

namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class PathTracer;
class SpectralScene;
}  // namespace ifov::transport

namespace ifov::render {

class SceneLight;

/// The Sun's highlights in narrow lobes on curved surfaces and on meshes that the sensor sees directly (SunLobes): found by the
/// surfaces' shapes (GlintSearch), traced as paths of one scattering, left out of all other paths
/// (TransportOptions::highlights), and added to finished tiles.
class Highlights {
 public:
  static bool in(const transport::SpectralScene& scene);

  /// Traces all of them. Keeps a reference to the scene. `margin_px`: a footprint's half width.
  Highlights(const transport::SpectralScene& scene, const sensor::Camera& camera, double margin_px,
             std::uint64_t seed, const LightTold& told = {});
  ~Highlights();

  /// As FocalLights::add_to.
  void add_to(const sampling::ColumnFootprints& footprints, const sampling::Tolerance* tolerance,
              sampling::TileResult& tile, std::span<const double> kept = {}) const {
    lights_.add_to(footprints, tolerance, tile, kept);
  }
  const FocalLights& lights() const { return lights_; }

  std::size_t count() const { return lights_.lights().size(); }

  /// Objects of so many pixels that their highlights are left to paths, sorted: there is room for some 250,000 triangles of the
  /// focal plane, taken by the smallest things first. Of many small things triangles are wider, up to 4 times at the highlight's middle, so that there is
  /// room for all.
  const std::vector<std::uint32_t>& large() const { return large_; }
  /// Of these the ones in which a lobe that throws_rarely() may show highlights smaller than a pixel.
  const std::vector<std::uint32_t>& unsure() const { return unsure_; }

 private:
  /// Parts of one object, which are sought together or not at all.
  struct Thing {
    std::uint32_t object = 0;
    double radius_m = 0.0;
    std::vector<std::size_t> rounds, smooths;
  };
  /// The smallest first.
  std::vector<Thing> things() const;
  GlintSearch search_for(const sensor::Camera& camera, const GlintSearch::Coarseness& coarse,
                         double margin_px, std::uint64_t seed) const;
  static void search(const Thing& thing, const geometry::SurfaceSurvey& survey, GlintSearch& search,
                     const GlintSearch::Found& found);
  /// How wide triangles have to be, over usual: as little as leaves the fewest things unsure.
  GlintSearch::Coarseness coarseness(const sensor::Camera& camera, const std::vector<Thing>& things,
                                     double margin_px) const;
  bool is_unsure_without(const Thing& thing) const;
  void trace(std::vector<GlintPoint>& points);
  void add(const GlintPoint& point, const float* channels);
  void find(std::uint64_t seed, double margin_px);
  /// Of a thing's image; 0 where it has none.
  double radius_px(const geometry::SurfaceSurvey::Ball& ball) const;

  const transport::SpectralScene& scene_;
  const sensor::Camera& camera_;
  std::uint64_t seed_, traced_ = 0;
  const std::unique_ptr<transport::PathTracer> tracer_;
  const std::unique_ptr<SceneLight> light_;
  std::vector<std::uint32_t> large_, unsure_;
  FocalLights lights_;           // radiance over that of their spectra at the sensor
  std::vector<float> spectrum_;  // the last one that was kept
  std::uint32_t spectrum_number_ = 0;
};

}  // namespace ifov::render
