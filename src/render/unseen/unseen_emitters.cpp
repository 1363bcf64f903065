#include "render/unseen/unseen_emitters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "geometry/motion/motion.h"
#include "geometry/motion/moving_world.h"
#include "geometry/surface_piece.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/unseen/widen_unseen.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/emitter_choice.h"
#include "transport/emitters.h"
#include "transport/shapes/emitter_shape.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// Rays along a side of a pixel.
constexpr int kRaysAcross = 2;
/// Instants of an exposure at which it is asked where something that moves is.
constexpr int kInstants = 8;

}  // namespace

std::unique_ptr<const UnseenEmitters> UnseenEmitters::find(const transport::SpectralScene& scene,
                                                           const sensor::Camera& camera) {
  if (scene.emitters() == nullptr) return nullptr;
  std::unique_ptr<const UnseenEmitters> unseen(new UnseenEmitters(scene, camera));
  if (scene.emitters()->left_out().empty() && unseen->carried_.empty()) return nullptr;
  return unseen;
}

UnseenEmitters::UnseenEmitters(const transport::SpectralScene& scene, const sensor::Camera& camera)
    : scene_(scene), camera_(camera) {
  const transport::EmitterChoice choice(scene);
  for (std::uint32_t c = 0; c < scene.scene().assignments.size(); ++c)
    highest_.push_back(choice.wanted()[c] ? choice.highest(c) : std::vector<double>());
  list_moving(choice.wanted());
}

void UnseenEmitters::list_moving(const std::vector<bool>& wanted) {
  const geometry::MovingWorld* const moving = scene_.scene().world->moving();
  if (moving == nullptr) return;
  for (std::size_t m = 0; m < moving->mover_count(); ++m) {
    std::map<std::uint32_t, Carried> of_mover;
    std::map<std::uint32_t, std::vector<math::Point3>> ends;
    moving->body(m).visit_surfaces(wanted, [&](const geometry::SurfacePiece& piece) {
      const transport::EmitterShape shape(piece, false);
      const double r = shape.radius_m();
      of_mover[piece.material].area_m2 += geometry::area_m2(piece);
      for (const double sign : {-1.0, 1.0})
        ends[piece.material].push_back(shape.centre_m() + math::Vec3{sign * r, sign * r, sign * r});
    });
    for (auto& [assignment, carried] : of_mover) {
      math::Point3 low = ends[assignment].front(), high = low;
      for (const math::Point3& end : ends[assignment]) {
        low = {std::min(low.x, end.x), std::min(low.y, end.y), std::min(low.z, end.z)};
        high = {std::max(high.x, end.x), std::max(high.y, end.y), std::max(high.z, end.z)};
      }
      carried.mover = m, carried.assignment = assignment;
      carried.centre_m = low + 0.5 * (high - low), carried.radius_m = 0.5 * math::length(high - low);
      carried_.push_back(carried);
    }
  }
}

template <class At>
void UnseenEmitters::visit(double time_s, const At& at) const {
  for (const transport::Emitters::LeftOut& left : scene_.emitters()->left_out())
    at(left.ball.centre_m, left.ball.radius_m, left.area_m2, left.assignment, 1.0);
  const double exposure_s = camera_.exposure_s();
  const int instants = exposure_s > 0.0 ? kInstants : 1;
  for (const Carried& carried : carried_) {
    const geometry::MovingWorld& moving = *scene_.scene().world->moving();
    for (int k = 0; k < instants; ++k) {
      const double at_s = time_s + exposure_s * ((k + 0.5) / instants - 0.5);
      at(moving.motion(carried.mover).scene_from_carrier(at_s)(carried.centre_m), carried.radius_m,
         carried.area_m2, carried.assignment, 1.0 / instants);
    }
  }
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
      const double time_s = rays[pixel * kRaysAcross * kRaysAcross + k].time_s;
      visit(time_s, [&](math::Point3 centre_m, double radius_m, double area_m2, std::uint32_t assignment,
                        double of_time) {
        const math::Vec3 to = centre_m - hit.position_m;
        const double before = length(to) - radius_m;
        if (!(passes > 0.0) && dot(to, outward) < -radius_m) return;
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
