#include "materials/spectral_materials.h"

#include <algorithm>

#include "materials/bsdf/node_bsdf.h"
#include "materials/material.h"
#include "radiometry/spectral_nodes.h"

namespace ifov::materials {

SpectralMaterials::SpectralMaterials(std::span<const Material> materials,
                                     const radiometry::SpectralNodes& nodes, bool polarized)
    : reflectance_(materials.size(), nodes.node_count()), emissivity_(materials.size(), nodes.node_count()) {
  std::uint32_t rows = 1;
  for (const Material& material : materials)
    transmittance_index_.push_back(material.transmittance ? rows++ : 0u);
  transmittance_.resize(rows, nodes.node_count());

  const auto highest = [](std::span<const float> values) {
    return std::max(0.0f, *std::max_element(values.begin(), values.end()));
  };
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const Material& material = materials[m];
    const std::span<float> emissivity = emissivity_.values(m);
    nodes.average_surface(material.reflectance, reflectance_.values(m));
    nodes.average_surface(material.reflectance.complement(), emissivity);
    maximum_reflectance_.push_back(highest(reflectance_.values(m)));
    maximum_transmittance_.push_back(0.0f);
    directional_.push_back(material.bsdf->is_separable()
                               ? nullptr
                               : std::make_unique<NodeBsdf>(material.bsdf, nodes, polarized));
    any_pane_ = any_pane_ || material.bsdf->passage() == Passage::straight;
    any_medium_ = any_medium_ || material.bsdf->passage() == Passage::into;
    if (const NodeBsdf* model = directional_.back().get()) {
      maximum_reflectance_.back() = static_cast<float>(model->highest_reflectance());
      maximum_transmittance_.back() = static_cast<float>(model->highest_transmittance());
    }
    if (!material.transmittance) continue;
    const std::span<float> transmittance = transmittance_.values(transmittance_index_[m]);
    nodes.average_surface(*material.transmittance, transmittance);
    for (std::size_t n = 0; n < emissivity.size(); ++n)
      emissivity[n] = std::max(0.0f, emissivity[n] - transmittance[n]);
    if (directional_.back() == nullptr) maximum_transmittance_.back() = highest(transmittance);
  }
}

SpectralMaterials::~SpectralMaterials() = default;

}  // namespace ifov::materials
