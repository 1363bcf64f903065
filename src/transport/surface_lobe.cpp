#include "transport/surface_lobe.h"

namespace ifov::transport {

namespace {

materials::ScatteringKind kind_of(const SpectralScene& scene, const scene::Constituent& constituent) {
  return scene.scene().materials[constituent.material].scattering;
}

/// The shape of the constituent that the choice falls on, and the chance of all constituents of that shape.
void choose_shape(const SpectralScene& scene, const scene::ResolvedSurface& surface, double whole, double choice,
                  SurfaceLobe& lobe) {
  double passed = 0.0;
  const scene::Constituent* chosen = nullptr;
  for (const scene::Constituent& c : surface) {
    const double share = c.weight * scene.brightest(c.material);
    if (share <= 0.0) continue;
    chosen = &c;
    passed += share;
    if (choice * whole < passed) break;
  }
  lobe.kind = kind_of(scene, *chosen);
  lobe.chance = 0.0;
  bool alone = true;
  for (const scene::Constituent& c : surface) {
    if (kind_of(scene, c) == lobe.kind)
      lobe.chance += c.weight * scene.brightest(c.material) / whole;
    else
      alone = alone && scene.brightest(c.material) <= 0.0;
  }
  if (alone) lobe.chance = 1.0;
}

}  // namespace

SurfaceLobe surface_lobe(const SpectralScene& scene, const scene::ResolvedSurface& surface, double choice) {
  const materials::SpectralMaterials& materials = scene.materials();
  SurfaceLobe lobe;
  if (surface.count == 1) {
    const scene::Constituent& c = surface.constituents[0];
    lobe.kind = kind_of(scene, c);
    lobe.scattering = &materials::scattering(lobe.kind);
    lobe.highest_reflectance = materials.maximum_reflectance(c.material);
    lobe.highest_transmittance = materials.maximum_transmittance(c.material);
    return lobe;
  }
  double whole = 0.0;
  for (const scene::Constituent& c : surface) whole += c.weight * scene.brightest(c.material);
  if (whole <= 0.0) return lobe;
  choose_shape(scene, surface, whole, choice, lobe);
  lobe.scattering = &materials::scattering(lobe.kind);
  for (const scene::Constituent& c : surface) {
    if (kind_of(scene, c) != lobe.kind) continue;
    const double weight = c.weight / lobe.chance;
    lobe.highest_reflectance += weight * materials.maximum_reflectance(c.material);
    lobe.highest_transmittance += weight * materials.maximum_transmittance(c.material);
  }
  return lobe;
}

const float* lobe_factor(const SpectralScene& scene, const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                         bool through, float* scratch) {
  const materials::SpectralMaterials& materials = scene.materials();
  const auto row = [&](std::uint32_t material) {
    return through ? materials.transmittance(material) : materials.reflectance(material);
  };
  if (surface.count == 1) return row(surface.constituents[0].material);
  const std::size_t n = scene.stride();
  bool any = false;
  for (const scene::Constituent& c : surface) {
    if (kind_of(scene, c) != lobe.kind) continue;
    if (through && materials.maximum_transmittance(c.material) <= 0.0f) continue;
    const float w = static_cast<float>(c.weight / lobe.chance);
    const float* __restrict from = row(c.material);
    if (any)
      for (std::size_t k = 0; k < n; ++k) scratch[k] += w * from[k];
    else
      for (std::size_t k = 0; k < n; ++k) scratch[k] = w * from[k];
    any = true;
  }
  return scratch;
}

}  // namespace ifov::transport
