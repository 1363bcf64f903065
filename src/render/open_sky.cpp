#include "render/open_sky.h"

#include <algorithm>
#include <cstdint>

#include "geometry/world.h"
#include "sampling/sequence.h"
#include "sampling/warp.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/sky/sky_dome.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

constexpr int kAcross = 24;                // rays along each side of the image
constexpr std::uint32_t kDirections = 16;  // from each place
constexpr double kFacesDown = -0.9;        // cosine: surfaces that see next to nothing of the sky
constexpr float kMost = 0.9f;

struct Seen {
  double open = 0.0, all = 0.0;
  double share() const { return open / all; }
};

}  // namespace

std::vector<float> open_sky_shares(const transport::SpectralScene& scene, const sensor::Camera& camera) {
  const geometry::World& world = *scene.scene().world;
  if (scene.sky_dome() == nullptr || world.storage().chunks > 0) return {};
  const std::vector<sampling::FocalPoint> points = sensor::grid_over(camera, kAcross, kAcross, 0.0);
  std::vector<math::Ray> rays(points.size()), up;
  std::vector<geometry::SurfacePoint> hits(points.size());
  camera.rays(points, rays);
  world.intersect(rays, hits);
  std::vector<std::uint32_t> materials;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const geometry::SurfacePoint& hit = hits[k];
    if (!hit.hit()) continue;
    const math::Vec3 outward = (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
    if (outward.z < kFacesDown) continue;
    const sampling::TangentFrame frame(outward);
    const std::uint32_t material = scene.scene().resolve_without_temperature(hit).constituents[0].material;
    for (std::uint32_t d = 0; d < kDirections; ++d) {
      // One sequence for all places: each has its own part of it.
      const sampling::Point2 u = sampling::halton_point(static_cast<std::uint32_t>(k) * kDirections + d);
      const math::Vec3 direction = frame.to_world(sampling::cosine_hemisphere(u));
      if (direction.z <= 0.0) continue;
      up.push_back(rays[k].onward(hit.position_m + hit.offset_m * outward, direction));
      materials.push_back(material);
    }
  }
  if (up.empty()) return {};
  std::vector<std::uint8_t> blocked(up.size());
  world.occluded(up, blocked);
  Seen whole;
  std::vector<Seen> seen(scene.scene().materials.size());
  for (std::size_t k = 0; k < up.size(); ++k)
    for (Seen* of : {&whole, &seen[materials[k]]}) {
      of->open += blocked[k] == 0;
      of->all += 1.0;
    }
  std::vector<float> shares;
  for (const Seen& of : seen)
    shares.push_back(std::min(kMost, static_cast<float>(of.all > 0.0 ? of.share() : whole.share())));
  return shares;
}

}  // namespace ifov::render
