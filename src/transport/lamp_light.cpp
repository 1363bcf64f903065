#include "transport/lamp_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "geometry/surface_piece.h"
#include "geometry/surface_point.h"
#include "geometry/world.h"
#include "scene/lamp.h"
#include "scene/scene.h"
#include "transport/shapes/emitter_shape.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {
namespace {

/// The mean over all directions.
double mean_of(const scene::RadiationPattern* pattern) {
  constexpr int kSide = 24;
  if (pattern == nullptr) return 1.0;
  double sum = 0.0;
  for (int k = 0; k < kSide * kSide; ++k) {
    const double z = -1.0 + 2.0 * (k / kSide + 0.5) / kSide, r = std::sqrt(1.0 - z * z);
    const double about = 2.0 * std::numbers::pi * (k % kSide + 0.5) / kSide;
    sum += pattern->at({r * std::cos(about), r * std::sin(about), z});
  }
  return sum / (kSide * kSide);
}

}  // namespace

std::vector<double> white_below_lamps(const SpectralScene& spectral) {
  constexpr double kNearest_m = 0.5;
  constexpr std::size_t kMost = 4096;  // lamps that are looked at
  const scene::Scene& scene = spectral.scene();
  std::vector<double> white(spectral.nodes().channel_count(), 0.0);
  if (scene.lamps.empty() || scene.world == nullptr) return white;
  geometry::WantedMaterials wanted(scene.assignments.size(), false);
  for (std::size_t a = 0; a < wanted.size(); ++a)
    wanted[a] =
        scene.assignments[a].states.size() == 1 && scene.states[scene.assignments[a].states[0]].lamp > 0;
  std::vector<math::Ray> rays;
  std::vector<EmitterShape> shapes;
  std::vector<std::uint32_t> states;
  scene.world->visit_surfaces(wanted, [&](const geometry::SurfacePiece& piece) {
    if (shapes.size() >= kMost) return;
    const EmitterShape shape(piece, false);
    const math::Vec3 down{0.0, 0.0, -1.0};
    rays.push_back({shape.centre_m() + 1.001 * shape.radius_m() * down, down});
    shapes.push_back(shape);
    states.push_back(scene.assignments[piece.material].states[0]);
  });
  std::vector<geometry::SurfacePoint> below(rays.size());
  scene.world->intersect(rays, below);
  std::vector<float> at_nodes(spectral.node_count());
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (!below[k].hit()) continue;
    const double distance_m = std::max(kNearest_m, below[k].distance_m + shapes[k].radius_m());
    const double factor = shapes[k].area_m2() * mean_of(spectral.lamp_pattern(states[k])) /
                          (distance_m * distance_m * std::numbers::pi);
    std::copy_n(spectral.lamp_radiance(states[k]), at_nodes.size(), at_nodes.begin());
    spectral.nodes().to_channels(at_nodes.data(), at_nodes.data());
    for (std::size_t c = 0; c < white.size(); ++c)
      white[c] = std::max(white[c], factor * static_cast<double>(at_nodes[c]));
  }
  return white;
}

}  // namespace ifov::transport
