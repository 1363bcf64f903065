#include "transport/surface_lobe.h"

#include <algorithm>

#include "materials/bsdf/node_bsdf.h"
#include "scene/scene.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

namespace {

const materials::Bsdf* bsdf_of(const SpectralScene& scene, const scene::Constituent& constituent) {
  return scene.scene().materials[constituent.material].bsdf.get();
}

void describe(const SpectralScene& scene, std::uint32_t material, SurfaceLobe& lobe) {
  lobe.bsdf = scene.scene().materials[material].bsdf.get();
  lobe.directional = scene.materials().directional(material) != nullptr;
  lobe.isotropic = !lobe.directional || lobe.bsdf->is_isotropic();
}

/// The model of the constituent that the choice falls on, and the probability of all constituents of that model.
void choose_model(const SpectralScene& scene, const scene::ResolvedSurface& surface, double whole,
                  double choice, SurfaceLobe& lobe) {
  double passed = 0.0;
  const scene::Constituent* chosen = nullptr;
  for (const scene::Constituent& c : surface) {
    const double share = c.weight * scene.brightest(c.material);
    if (share <= 0.0) continue;
    chosen = &c;
    passed += share;
    if (choice * whole < passed) break;
  }
  describe(scene, chosen->material, lobe);
  lobe.probability = 0.0;
  bool alone = true;
  for (const scene::Constituent& c : surface) {
    if (bsdf_of(scene, c) == lobe.bsdf)
      lobe.probability += c.weight * scene.brightest(c.material) / whole;
    else
      alone = alone && scene.brightest(c.material) <= 0.0;
  }
  if (alone) lobe.probability = 1.0;
}

const float* directional_row(const materials::NodeBsdf& model, const LobeEvent& event, std::size_t n,
                             float* spectrum, float* other) {
  materials::BsdfEvent one = event.event;
  if (event.weight > 0.0f) {
    model.evaluate(one, spectrum);
    if (event.weight != 1.0f)
      for (std::size_t k = 0; k < n; ++k) spectrum[k] *= event.weight;
  } else {
    std::fill_n(spectrum, n, 0.0f);
  }
  if (event.image_weight > 0.0f) {
    one.incoming = event.image;
    model.evaluate(one, other);
    for (std::size_t k = 0; k < n; ++k) spectrum[k] += event.image_weight * other[k];
  }
  return spectrum;
}

}  // namespace

bool belongs(const SpectralScene& scene, const SurfaceLobe& lobe, const scene::Constituent& constituent) {
  const materials::Bsdf* bsdf = bsdf_of(scene, constituent);
  switch (lobe.deltas) {
    case SurfaceLobe::Deltas::none: return bsdf == lobe.bsdf;
    case SurfaceLobe::Deltas::mirrors: return bsdf->is_delta();
    case SurfaceLobe::Deltas::panes: return bsdf->passage() == materials::Passage::straight;
  }
  return false;
}

SurfaceLobe surface_lobe(const SpectralScene& scene, const scene::ResolvedSurface& surface, double choice) {
  const materials::SpectralMaterials& materials = scene.materials();
  SurfaceLobe lobe;
  if (surface.count == 1) {
    const scene::Constituent& c = surface.constituents[0];
    describe(scene, c.material, lobe);
    lobe.highest_reflectance = materials.maximum_reflectance(c.material);
    lobe.highest_transmittance = materials.maximum_transmittance(c.material);
    return lobe;
  }
  double whole = 0.0;
  for (const scene::Constituent& c : surface) whole += c.weight * scene.brightest(c.material);
  if (whole <= 0.0) return lobe;
  choose_model(scene, surface, whole, choice, lobe);
  for (const scene::Constituent& c : surface) {
    if (bsdf_of(scene, c) != lobe.bsdf) continue;
    const double weight = c.weight / lobe.probability;
    lobe.highest_reflectance += weight * materials.maximum_reflectance(c.material);
    lobe.highest_transmittance += weight * materials.maximum_transmittance(c.material);
  }
  return lobe;
}

void narrow_to_angle(const SpectralScene& scene, const scene::ResolvedSurface& surface,
                     const materials::BsdfEvent& view, SurfaceLobe& lobe) {
  lobe.highest_reflectance = lobe.highest_transmittance = 0.0;
  for (const scene::Constituent& c : surface) {
    if (bsdf_of(scene, c) != lobe.bsdf) continue;
    const materials::NodeBsdf& model = *scene.materials().directional(c.material);
    const double weight = surface.count == 1 ? 1.0 : c.weight / lobe.probability;
    lobe.highest_reflectance += weight * model.highest_share(view, materials::Side::reflected);
    lobe.highest_transmittance += weight * model.highest_share(view, materials::Side::transmitted);
  }
}

bool passes_straight(const SpectralScene& scene, const scene::ResolvedSurface& surface) {
  return scene.materials().any_pane() &&
         std::any_of(surface.begin(), surface.end(), [&](const scene::Constituent& c) {
           return bsdf_of(scene, c)->passage() == materials::Passage::straight;
         });
}

double highest_of_deltas(const SpectralScene& scene, const scene::ResolvedSurface& surface,
                         const materials::BsdfEvent& view, SurfaceLobe::Deltas deltas) {
  SurfaceLobe lobe;
  lobe.deltas = deltas;
  const materials::Side side =
      deltas == SurfaceLobe::Deltas::panes ? materials::Side::transmitted : materials::Side::reflected;
  double highest = 0.0;
  for (const scene::Constituent& c : surface) {
    if (!belongs(scene, lobe, c)) continue;
    const materials::NodeBsdf* model = scene.materials().directional(c.material);
    highest +=
        c.weight * (model == nullptr ? static_cast<double>(scene.materials().maximum_reflectance(c.material))
                                     : model->highest_share(view, side));
  }
  return highest;
}

const float* lobe_factor(const SpectralScene& scene, const scene::ResolvedSurface& surface,
                         const SurfaceLobe& lobe, bool transmitted, const LobeEvent* event, float* scratch,
                         float* work) {
  const materials::SpectralMaterials& materials = scene.materials();
  const std::size_t n = scene.stride();
  const auto spectrum = [&](std::uint32_t material, float* own, float* other) -> const float* {
    if (const materials::NodeBsdf* model = materials.directional(material))
      return directional_row(*model, *event, n, own, other);
    return transmitted ? materials.transmittance(material) : materials.reflectance(material);
  };
  if (surface.count == 1) return spectrum(surface.constituents[0].material, scratch, work);
  bool any = false;
  for (const scene::Constituent& c : surface) {
    if (!belongs(scene, lobe, c)) continue;
    if (transmitted && materials.maximum_transmittance(c.material) <= 0.0f) continue;
    const float w = static_cast<float>(c.weight / lobe.probability);
    const float* __restrict from = spectrum(c.material, work, work + n);
    if (any)
      for (std::size_t k = 0; k < n; ++k) scratch[k] += w * from[k];
    else
      for (std::size_t k = 0; k < n; ++k) scratch[k] = w * from[k];
    any = true;
  }
  return scratch;
}

}  // namespace ifov::transport
