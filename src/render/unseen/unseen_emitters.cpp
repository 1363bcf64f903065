#include "render/unseen/unseen_emitters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/unseen/widen_unseen.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/emitter_choice.h"
#include "transport/emitters.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Rays along a side of a pixel.
constexpr int kRaysAcross = 2;

}  // namespace

std::unique_ptr<const UnseenEmitters> UnseenEmitters::find(const transport::SpectralScene& scene,
                                                           const sensor::Camera& camera) {
  if (scene.emitters() == nullptr || scene.emitters()->left_out().empty()) return nullptr;
  return std::unique_ptr<const UnseenEmitters>(new UnseenEmitters(scene, camera));
}

UnseenEmitters::UnseenEmitters(const transport::SpectralScene& scene, const sensor::Camera& camera)
    : scene_(scene), camera_(camera) {
  const transport::EmitterChoice choice(scene);
  for (std::uint32_t c = 0; c < scene.scene().assignments.size(); ++c)
    highest_.push_back(choice.wanted()[c] ? choice.highest(c) : std::vector<double>());
}

void UnseenEmitters::settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const {
  if (tolerance == nullptr || !tile.has_errors()) return;
  const scene::Scene& scene = scene_.scene();
  const std::size_t channels = scene_.nodes().channel_count();
  std::vector<sampling::FocalPoint> points;
  for (int y = tile.tile.y0; y < tile.tile.y1; ++y)
    for (int x = tile.tile.x0; x < tile.tile.x1; ++x)
      for (int k = 0; k < kRaysAcross * kRaysAcross; ++k)
        points.push_back(
            {x + (k % kRaysAcross + 0.5) / kRaysAcross, y + (k / kRaysAcross + 0.5) / kRaysAcross});
  std::vector<math::Ray> rays(points.size());
  std::vector<geometry::SurfacePoint> hits(points.size());
  camera_.rays(points, rays);
  scene.world->intersect(rays, hits);
  tile.rays.primary += rays.size();
  std::vector<double> most(channels), here(channels);
  UnseenWidening widening(*tolerance, channels, kNegligible);
  for (std::size_t pixel = 0; pixel < static_cast<std::size_t>(tile.tile.count()); ++pixel) {
    std::fill(most.begin(), most.end(), 0.0);
    for (std::size_t k = 0; k < kRaysAcross * kRaysAcross; ++k) {
      const geometry::SurfacePoint& hit = hits[pixel * kRaysAcross * kRaysAcross + k];
      if (!hit.hit()) continue;
      double share = 0.0, passes = 0.0;
      for (const scene::Constituent& part : scene.resolve(hit)) {
        share += part.weight * scene_.brightest(part.material);
        passes += static_cast<double>(scene_.materials().maximum_transmittance(part.material));
      }
      if (!(share > 0.0)) continue;
      const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
      std::fill(here.begin(), here.end(), 0.0);
      for (const transport::Emitters::LeftOut& left : scene_.emitters()->left_out()) {
        const math::Vec3 to = left.ball.centre_m - hit.position_m;
        const double before = length(to) - left.ball.radius_m;
        if (!(passes > 0.0) && dot(to, outward) < -left.ball.radius_m) continue;
        const double projected_sr =
            before > 0.0 ? std::min(std::numbers::pi, left.area_m2 / (before * before)) : std::numbers::pi;
        const std::vector<double>& emitted = highest_[left.assignment];
        for (std::size_t c = 0; c < channels; ++c)
          here[c] += share * projected_sr / std::numbers::pi * emitted[c];
      }
      for (std::size_t c = 0; c < channels; ++c) most[c] = std::max(most[c], here[c]);
    }
    widening.widen(pixel, most, tile);
  }
}

}  // namespace ifov::render
