#include "render/views/sun_share.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/world.h"
#include "sampling/hash.h"
#include "sampling/means/replicated_mean.h"
#include "sampling/warp.h"
#include "scene/scene.h"
#include "transport/mirrors/sun_images.h"
#include "transport/mirrors/sun_mirrors.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

constexpr std::uint64_t kSunPoints = 0x73756e706f696e74ull;  // purpose, in hash(seed, kSunPoints)
constexpr std::uint64_t kMostRays = 1u << 20;

/// Of the Sun's images in flat mirrors that may stand before the plane, all cosines together: whether something hides them is not asked.
double mirrored_cosine(const transport::SpectralScene& scene, const math::Ray& along) {
  constexpr int kReflections = 2;
  constexpr double kSlope = 0.01;  // twice the Sun's half-angle
  if (scene.sun_mirrors() == nullptr) return 0.0;
  double sum = 0.0;
  const transport::SunImages images(*scene.sun_mirrors(), scene.scene().sun->direction, kReflections);
  for (const transport::SunImages::Image& image : images.images())
    if (transport::may_meet(image.bounds, along.origin_m, image.direction, kSlope))
      sum += std::max(0.0, math::dot(image.direction, along.direction));
  return sum;
}

}  // namespace

SunShare share_of_sun(const transport::SpectralScene& scene, const math::Ray& along,
                      const ThroughPanes& through_panes, double limit, double confidence, std::uint64_t seed,
                      sampling::RayCounts& counts) {
  if (!scene.scene().sun || !scene.scene().sun->is_up()) return {};
  const scene::Sun& sun = *scene.scene().sun;
  const math::Vec3 normal = along.direction;
  const double facing = math::dot(sun.direction, normal), mirrored = mirrored_cosine(scene, along);
  if (facing <= -std::sin(sun.half_angle_rad)) return {.unfound = mirrored};
  const sampling::UniformCone cone(sun.half_angle_rad);
  // Irradiance on what faces the disc is radiance times pi sin^2 of its half-angle; directions are uniform in solid angle.
  const double sine = std::sin(sun.half_angle_rad);
  const double of_facing =
      sun.half_angle_rad > 0.0 ? cone.solid_angle_sr() / (std::numbers::pi * sine * sine) : 1.0;
  std::vector<math::Ray> rays;
  std::vector<std::uint8_t> blocked;
  std::uint64_t passed = 0, all = 0;
  const auto free = [&](std::span<const sampling::Point2> points, std::span<double> values) {
    rays.clear(), blocked.assign(points.size(), 0);
    for (const sampling::Point2& u : points)
      rays.push_back(along.onward(along.origin_m,
                                  sun.half_angle_rad > 0.0 ? cone.sample(sun.direction, u) : sun.direction));
    scene.scene().world->occluded(rays, blocked);
    counts.shadow += rays.size();
    all += rays.size();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double cosine = std::max(0.0, math::dot(rays[k].direction, normal));
      values[k] = blocked[k] != 0 ? 0.0 : std::min(1.0, of_facing * cosine);
      if (blocked[k] != 0 && cosine > 0.0 && through_panes && through_panes(rays[k], counts)) ++passed;
    }
  };
  const sampling::ReplicatedMean mean =
      sampling::replicated_mean(sampling::hash(seed, kSunPoints), confidence, limit, kMostRays, free);
  return {mean.mean, mean.standard_error, mean.half_width,
          mirrored + std::max(0.0, facing + sine) * static_cast<double>(passed) / static_cast<double>(all)};
}

std::vector<double> sunlight_by_channel(const transport::SpectralScene& scene) {
  const radiometry::SpectralNodes& nodes = scene.nodes();
  std::vector<double> sunlight(nodes.channel_count(), 0.0);
  for (std::size_t c = 0; c < sunlight.size(); ++c)
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      sunlight[c] += nodes.node_weight(n) * static_cast<double>(scene.sun_irradiance()[n]);
  return sunlight;
}

double sun_cosine(const transport::SpectralScene& scene, const math::Ray& along) {
  const auto& sun = scene.scene().sun;
  return sun && sun->is_up() ? std::max(0.0, math::dot(sun->direction, along.direction)) : 0.0;
}

}  // namespace ifov::render
