#include "session/assembly/atmosphere/cloud_assembly.h"

#include <algorithm>
#include <utility>

#include "atmosphere/particles/cloud_particles.h"
#include "atmosphere/particles/particle_layer.h"
#include "atmosphere/profile/profile.h"
#include "core/format.h"
#include "io/document/cloud_document.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

struct CloudOptics {
  std::shared_ptr<const atmosphere::Particles> particles;
  double mass_extinction_m2_g;
};

CloudOptics optics(const io::CloudDocument& cloud) {
  if (cloud.is_ice()) {
    const auto crystals =
        std::make_shared<const atmosphere::IceCrystals>(cloud.radius_um(), cloud.effective_variance);
    return {crystals, atmosphere::mass_extinction_m2_g(crystals->spheres(), atmosphere::kIceDensity_g_m3)};
  }
  const auto drops = atmosphere::droplets(cloud.radius_um(), cloud.effective_variance);
  return {drops, atmosphere::mass_extinction_m2_g(*drops, atmosphere::kWaterDensity_g_m3)};
}

std::string name(const io::CloudDocument& cloud) { return "cloud of " + cloud.kind; }

}  // namespace

std::vector<std::shared_ptr<const atmosphere::ParticleLayer>> assemble_clouds(
    const io::DocumentSources& sources, const std::vector<io::CloudDocument>& written, double ground_km) {
  std::vector<std::shared_ptr<const atmosphere::ParticleLayer>> layers;
  for (const io::CloudDocument& cloud : written)
    layers.push_back(with_position(sources, cloud.position, [&] {
      const CloudOptics of = optics(cloud);
      atmosphere::ParticleLayer layer;
      layer.name = name(cloud);
      layer.optical_depth = cloud.optical_depth ? *cloud.optical_depth
                                                : of.mass_extinction_m2_g * cloud.water_path_g_m2.value();
      if (layer.optical_depth > atmosphere::kThickestCloud)
        throw InputError(
            format("the {} has an optical depth of {:.4g} ({:g} g/m2 at an effective radius of {:g} um): "
                   "expected {:g} or less",
                   layer.name, layer.optical_depth, *cloud.water_path_g_m2, cloud.radius_um(),
                   atmosphere::kThickestCloud));
      layer.particles = of.particles;
      layer.base_km = cloud.base_km;
      layer.top_km = cloud.top_km;
      const atmosphere::LayerHeights within_the_air(layer, ground_km);
      return std::make_shared<const atmosphere::ParticleLayer>(std::move(layer));
    }));
  return layers;
}

std::string cloud_statement(const io::CloudDocument& cloud) {
  const double per_gram = optics(cloud).mass_extinction_m2_g;
  const double depth = cloud.optical_depth.value_or(per_gram * cloud.water_path_g_m2.value_or(0.0));
  return format("{} from {:.4g} to {:.4g} km, optical depth {:.4g} ({:.3g} g/m2), effective radius {:g} um",
                cloud.kind, cloud.base_km, cloud.top_km, depth, depth / per_gram, cloud.radius_um());
}

std::vector<std::string> cloud_remarks(const std::vector<io::CloudDocument>& clouds,
                                       const atmosphere::Profile& profile) {
  // Droplets freeze without a nucleus at 235 K (Pruppacher and Klett 1997, ch. 7); crystals melt at 273.15 K.
  constexpr double kFreezes_k = 235.0, kMelts_k = 273.15;
  std::vector<std::string> remarks;
  for (const io::CloudDocument& cloud : clouds) {
    double coldest = profile.temperature_at(cloud.base_km), warmest = coldest;
    constexpr int kSteps = 50;
    for (int k = 1; k <= kSteps; ++k) {
      const double at = profile.temperature_at(cloud.base_km + (cloud.top_km - cloud.base_km) * k / kSteps);
      coldest = std::min(coldest, at);
      warmest = std::max(warmest, at);
    }
    if (!cloud.is_ice() && coldest < kFreezes_k)
      remarks.push_back(
          format("the {} between {:g} and {:g} km has air down to {:.1f} K, where droplets freeze ({:g} K)",
                 name(cloud), cloud.base_km, cloud.top_km, coldest, kFreezes_k));
    if (cloud.is_ice() && warmest > kMelts_k)
      remarks.push_back(
          format("the {} between {:g} and {:g} km has air up to {:.1f} K, where crystals melt ({:g} K)",
                 name(cloud), cloud.base_km, cloud.top_km, warmest, kMelts_k));
  }
  return remarks;
}

}  // namespace ifov::session
