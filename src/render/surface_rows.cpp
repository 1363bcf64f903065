#include "render/surface_rows.h"

#include <algorithm>

namespace ifov::render {

namespace {

materials::ScatteringKind kind_of(const SpectralScene& scene, const scene::Constituent& constituent) {
  return scene.scene().materials[constituent.material].scattering;
}

}  // namespace

SurfaceRows surface_rows(const SpectralScene& scene, const scene::ResolvedSurface& surface, double choice,
                         float* scratch) {
  const materials::SpectralMaterials& materials = scene.materials();
  SurfaceRows rows;
  if (surface.count == 1) {
    const std::uint32_t material = surface.constituents[0].material;
    rows.scattering = &materials::scattering(kind_of(scene, surface.constituents[0]));
    rows.reflectance = materials.reflectance(material);
    rows.highest_reflectance = materials.maximum_reflectance(material);
    rows.highest_transmittance = materials.maximum_transmittance(material);
    if (rows.highest_transmittance > 0.0) rows.transmittance = materials.transmittance(material);
    return rows;
  }

  double whole = 0.0;
  for (const scene::Constituent& c : surface) whole += c.weight * scene.brightest(c.material);
  if (whole <= 0.0) return rows;
  // The shape of the constituent that the choice falls on; its chance is that of all constituents of that shape.
  double passed = 0.0;
  const scene::Constituent* chosen = nullptr;
  for (const scene::Constituent& c : surface) {
    const double share = c.weight * scene.brightest(c.material);
    if (share <= 0.0) continue;
    chosen = &c;
    passed += share;
    if (choice * whole < passed) break;
  }
  const materials::ScatteringKind kind = kind_of(scene, *chosen);
  double chance = 0.0;
  bool alone = true;
  for (const scene::Constituent& c : surface) {
    if (kind_of(scene, c) == kind)
      chance += c.weight * scene.brightest(c.material) / whole;
    else
      alone = alone && scene.brightest(c.material) <= 0.0;
  }
  if (alone) chance = 1.0;

  const std::size_t n = scene.stride();
  rows.scattering = &materials::scattering(kind);
  float* reflectance = scratch;
  float* transmittance = scratch + n;
  std::fill(reflectance, reflectance + n, 0.0f);
  rows.reflectance = reflectance;
  for (const scene::Constituent& c : surface) {
    if (kind_of(scene, c) != kind) continue;
    const double weight = c.weight / chance;
    const float w = static_cast<float>(weight);
    const float* from = materials.reflectance(c.material);
    for (std::size_t k = 0; k < n; ++k) reflectance[k] += w * from[k];
    rows.highest_reflectance += weight * materials.maximum_reflectance(c.material);
    if (materials.maximum_transmittance(c.material) <= 0.0f) continue;
    if (rows.transmittance == nullptr) std::fill(transmittance, transmittance + n, 0.0f);
    rows.transmittance = transmittance;
    from = materials.transmittance(c.material);
    for (std::size_t k = 0; k < n; ++k) transmittance[k] += w * from[k];
    rows.highest_transmittance += weight * materials.maximum_transmittance(c.material);
  }
  return rows;
}

}  // namespace ifov::render
