#include "render/unseen/unseen_emitters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "geometry/world/surface_survey.h"
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
/// Of flat mirrors: more are not seen from one place.
constexpr std::size_t kMostFacings = 4;

}  // namespace

std::unique_ptr<const UnseenEmitters> UnseenEmitters::find(const transport::SpectralScene& scene,
                                                           const sensor::Camera& camera) {
  if (scene.emitters() == nullptr) return nullptr;
  std::unique_ptr<const UnseenEmitters> unseen(new UnseenEmitters(scene, camera));
  if (scene.emitters()->left_out().empty() && !unseen->moving_.any()) return nullptr;
  return unseen;
}

UnseenEmitters::UnseenEmitters(const transport::SpectralScene& scene, const sensor::Camera& camera)
    : UnseenEmitters(scene, camera, transport::EmitterChoice(scene)) {}

UnseenEmitters::UnseenEmitters(const transport::SpectralScene& scene, const sensor::Camera& camera,
                               const transport::EmitterChoice& choice)
    : scene_(scene), camera_(camera), moving_(scene.scene(), camera, choice.wanted()) {
  for (std::uint32_t c = 0; c < scene.scene().assignments.size(); ++c)
    highest_.push_back(choice.wanted()[c] ? choice.highest(c) : std::vector<double>());
  // What a mirror shows of it is farther away than the thing itself.
  if (const geometry::SurfaceSurvey* const mirrors = scene.scene().world->survey())
    mirrored_ = static_cast<double>(std::min(kMostFacings, mirrors->flats.size()));
}

template <class At>
void UnseenEmitters::visit(std::span<const MovingParts::Place> places, const At& at) const {
  for (const transport::Emitters::LeftOut& left : scene_.emitters()->left_out())
    at(left.ball.centre_m, left.ball.radius_m, left.area_m2, left.assignment, 1.0);
  for (const MovingParts::Place& place : places)
    at(place.centre_m, place.part->radius_m, place.part->area_m2, place.part->assignment,
       place.of_time * (1.0 + mirrored_));
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
  MovingParts::Places moving(moving_);
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
      const math::Ray& ray = rays[pixel * kRaysAcross * kRaysAcross + k];
      visit(moving.at(ray.time_s), [&](math::Point3 centre_m, double radius_m, double area_m2,
                                       std::uint32_t assignment, double of_time) {
        const math::Vec3 to = centre_m - hit.position_m;
        const double before = length(to) - radius_m;
        if (!(passes > 0.0) && mirrored_ == 0.0 && dot(to, outward) < -radius_m) return;
        const double projected_sr =
            before > 0.0 ? std::min(std::numbers::pi, area_m2 / (before * before)) : std::numbers::pi;
        const std::vector<double>& emitted = highest_[assignment];
        for (std::size_t c = 0; c < channels; ++c)
          here[c] += of_time * share * projected_sr / std::numbers::pi * emitted[c];
      });
      for (std::size_t c = 0; c < channels; ++c) most[c] = std::max(most[c], here[c]);
    }
    widening.widen(pixel, most, tile);
  }
}

}  // namespace ifov::render
