#include "render/wings/outshining.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/bsdf/bsdf.h"
#include "radiometry/spectral_nodes.h"
#include "scene/scene.h"
#include "transport/emitter_choice.h"
#include "transport/shining_parts.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

/// What is Lambertian shows no image of it.
bool shows_sun(const scene::Scene& scene) {
  return scene.sun && scene.sun->is_up() &&
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const auto& material) { return !material.bsdf->is_lambertian(); });
}

}  // namespace

Outshining outshining(const transport::SpectralScene& spectral) {
  const scene::Scene& scene = spectral.scene();
  const radiometry::SpectralNodes& nodes = spectral.nodes();
  Outshining found;
  found.radiance.assign(nodes.channel_count(), 0.0);
  const transport::EmitterChoice shining(
      spectral, transport::EmitterChoice::InMirrors{transport::ShiningParts::kContrast});
  for (std::uint32_t a = 0; shining.any() && a < scene.assignments.size(); ++a) {
    if (!shining.wanted()[a]) continue;
    found.contrast = std::max(found.contrast, shining.contrast(a));
    const std::vector<double> highest = shining.highest(a);
    for (std::size_t c = 0; c < highest.size(); ++c)
      found.radiance[c] = std::max(found.radiance[c], highest[c]);
  }
  if (!shows_sun(scene)) return found;
  constexpr double kDisc_rad = 0.00465;  // a point's image is taken to be as small as the Sun's
  const double sine = std::sin(std::max(scene.sun->half_angle_rad, kDisc_rad)), square = sine * sine;
  found.contrast = std::max(found.contrast, 1.0 / square);
  for (std::size_t c = 0; c < found.radiance.size(); ++c) {
    double irradiance = 0.0;
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      irradiance += nodes.node_weight(n) * static_cast<double>(spectral.sun_irradiance()[n]);
    found.radiance[c] = std::max(found.radiance[c], irradiance / (std::numbers::pi * square));
  }
  return found;
}

}  // namespace ifov::render
