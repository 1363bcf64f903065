#include "render/views/point_irradiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/world.h"
#include "render/seen_through.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "sampling/hash.h"
#include "sampling/replicated_mean.h"
#include "sampling/tile.h"
#include "sampling/warp.h"
#include "scene/scene.h"
#include "sensor/single_views.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

constexpr std::uint64_t kSunPoints = 0x73756e706f696e74ull;  // purpose, in hash(seed, kSunPoints)
constexpr std::uint64_t kMostRays = 1u << 20;
constexpr double kUsualError = 1e-3;  // where nothing is asked
constexpr double kShareOfLimit = 0.25;

/// By channel, on a surface that faces the Sun.
std::vector<double> sunlight_of(const transport::SpectralScene& scene) {
  const radiometry::SpectralNodes& nodes = scene.nodes();
  std::vector<double> sunlight(nodes.channel_count(), 0.0);
  for (std::size_t c = 0; c < sunlight.size(); ++c)
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      sunlight[c] += nodes.node_weight(n) * static_cast<double>(scene.sun_irradiance()[n]);
  return sunlight;
}

/// Of the Sun's irradiance on a surface that faces it, what reaches the plane: the cosine, and what of the disc is free.
struct SunShare {
  double cosine = 0.0;  ///< mean over the free part of the disc times its share
  double standard_error = 0.0, half_width = 0.0;
  double through_panes = 0.0;  ///< the most that comes through panes besides
};

SunShare share_of_sun(const transport::SpectralScene& scene, const math::Ray& along, double limit,
                      double confidence, std::uint64_t seed, sampling::RayCounts& counts) {
  const scene::Sun& sun = *scene.scene().sun;
  const math::Vec3 normal = along.direction;
  const double facing = math::dot(sun.direction, normal);
  if (facing <= -std::sin(sun.half_angle_rad)) return {};
  SeenThrough through(scene);
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
      if (blocked[k] != 0 && cosine > 0.0 && through.any() && through.passed(rays[k], counts) != 0) ++passed;
    }
  };
  const sampling::ReplicatedMean mean =
      sampling::replicated_mean(sampling::hash(seed, kSunPoints), confidence, limit, kMostRays, free);
  return {mean.mean, mean.standard_error, mean.half_width,
          std::max(0.0, facing + sine) * static_cast<double>(passed) / static_cast<double>(all)};
}

}  // namespace

void to_irradiance(const transport::SpectralScene& scene, const sensor::SingleView& view,
                   const AccuracyTolerance* tolerance, std::uint64_t seed, sampling::TileResult& tile) {
  const auto columns = static_cast<std::size_t>(tile.columns);
  std::vector<double> mean(columns), limit(columns, 0.0);
  const std::vector<double> sunlight = sunlight_of(scene);
  const math::Ray along = view.middle_ray();
  SunShare share;
  if (scene.scene().sun && scene.scene().sun->is_up()) {
    const double most = std::max(0.0, math::dot(scene.scene().sun->direction, along.direction));
    double error = kUsualError;
    if (tolerance != nullptr) {
      for (std::size_t c = 0; c < columns; ++c)
        mean[c] = static_cast<double>(tile.mean[c]) + most * sunlight[c] / std::numbers::pi;
      tolerance->asked(mean, limit);
      error = 1.0;
      for (std::size_t c = 0; c < columns; ++c)
        if (sunlight[c] > 0.0) error = std::min(error, std::numbers::pi * limit[c] / sunlight[c]);
    }
    share = share_of_sun(scene, along, kShareOfLimit * error,
                         tolerance != nullptr ? tolerance->confidence() : 0.95, seed, tile.rays);
  }
  for (std::size_t c = 0; c < columns; ++c)
    mean[c] = static_cast<double>(tile.mean[c]) + share.cosine * sunlight[c] / std::numbers::pi;
  if (tolerance != nullptr) tolerance->asked(mean, limit);
  double worst = 0.0;
  for (std::size_t c = 0; c < columns; ++c) {
    tile.mean[c] = static_cast<float>(std::numbers::pi * mean[c]);
    if (!tile.has_errors()) continue;
    constexpr double kSquare = std::numbers::pi * std::numbers::pi;
    if (!tile.variance_path.empty()) {
      const double sun = share.standard_error * sunlight[c];
      tile.variance_geometry[c] =
          static_cast<float>(kSquare * static_cast<double>(tile.variance_geometry[c]) + sun * sun);
      tile.variance_path[c] = static_cast<float>(kSquare * static_cast<double>(tile.variance_path[c]));
    }
    const double half_width = std::numbers::pi * static_cast<double>(tile.half_width[c]) +
                              (share.half_width + share.through_panes) * sunlight[c];
    tile.half_width[c] = static_cast<float>(half_width);
    if (tolerance != nullptr) worst = std::max(worst, half_width / (std::numbers::pi * limit[c]));
  }
  if (tolerance == nullptr || tile.worst_ratio.empty()) return;
  constexpr double kRounding = 1e-5;
  tile.worst_ratio[0] = static_cast<float>(worst);
  if (worst > 1.0 + kRounding)
    tile.set(0, share.through_panes > 0.0 ? sampling::Reason::unseen_light : sampling::Reason::error);
}

}  // namespace ifov::render
